// What a ray does next: where it goes on, or that it has come to its end, and what becomes of its stack. Combinational.
//
// After a node: to the nearest child that was met; the others go onto the stack, nearer ones higher. Otherwise, and
// where no child was met: to the highest surviving entry; those above it are dropped. When none survives, the block
// written to memory last is read back, or the ray ends. When more entries are left than the stack holds, blocks leave
// from its lower end ahead of the fetch: they stay in their places until they were sent.
module ray_step #(
  parameter int unsigned Width = 4,   // children of a node
  parameter int unsigned Row   = 19,  // entries that the stack can hold before blocks leave
  localparam int unsigned PlaceWidth = $clog2(Row),
  localparam int unsigned CountWidth = $clog2(Row + 1),
  localparam int unsigned BlockBits = rtu_pkg::BlockBits,
  localparam int unsigned SpillBits = rtu_pkg::SpillBits,
  localparam int unsigned Payload = 64 * (Width > 4 ? Width : 4)
) (
  input  logic [CountWidth-1:0] entries_i,        // that the stack holds
  input  logic [2:0]            block_entries_i,  // of a block
  input  logic                  is_block_i,       // payload is a block read back; base_i is 0
  input  logic                  is_satisfied_i,   // the ray needs nothing more
  input  logic [3:0]            met_i,            // children met; 0 if this is no node
  input  logic [Payload-1:0]    payload_i,        // children met, nearest first, or a block, lowest entry first
  input  logic [32*Row-1:0]     refs_i,           // of the stack
  input  logic [Row-1:0]        low_i,            // surviving entries from base_i on
  input  logic [Row-1:0]        high_i,           // and before it: these are higher
  input  logic [PlaceWidth-1:0] base_i,           // place of the lowest entry
  input  logic [PlaceWidth-1:0] free_i,           // place above the highest entry
  input  logic [CountWidth-1:0] pushed_i,         // entries with all children met but one, if there are any
  input  logic [BlockBits-1:0]  blocks_i,         // in memory
  output logic                  ends_o,
  output logic                  reloads_o,
  output logic [31:0]           ref_o,
  output logic [SpillBits-1:0]  spills_o,         // blocks that leave
  output logic [PlaceWidth-1:0] base_o,
  output logic [CountWidth-1:0] count_o,
  output logic [BlockBits-1:0]  blocks_o,
  output logic [Row-1:0]        write_o,          // places of the stack, and what enters them
  output logic [64*Row-1:0]     row_o
);

  localparam int unsigned Wide = CountWidth + 2;

  function automatic logic [PlaceWidth-1:0] wrapped(input logic [Wide-1:0] place);
    logic [Wide-1:0] in_ring;
    in_ring = place >= Wide'(Row) ? place - Wide'(Row) : place;
    wrapped = in_ring[PlaceWidth-1:0];
  endfunction

  function automatic logic [4:0] highest(input logic [Row-1:0] places);
    logic [31:0] left;
    left = 32'(places);
    highest[4] = |left[31:16];
    if (highest[4]) left[15:0] = left[31:16];
    highest[3] = |left[15:8];
    if (highest[3]) left[7:0] = left[15:8];
    highest[2] = |left[7:4];
    if (highest[2]) left[3:0] = left[7:4];
    highest[1] = |left[3:2];
    highest[0] = highest[1] ? left[3] : left[1];
  endfunction

  // The highest surviving entry, and how many are below it.
  logic any_high, any_survives;
  logic [4:0] top;
  logic [CountWidth-1:0] below;
  assign any_high = |high_i;
  assign any_survives = any_high | (|low_i);
  assign top = highest(any_high ? high_i : low_i);
  assign below = CountWidth'(top) - CountWidth'(base_i) + (any_high ? CountWidth'(Row) : CountWidth'(0));

  logic has_child, goes_on;
  assign has_child = met_i != 4'd0;
  assign goes_on = ~is_satisfied_i & (has_child | any_survives);
  assign reloads_o = ~is_satisfied_i & ~goes_on & blocks_i != '0;
  assign ends_o = ~goes_on & ~reloads_o;
  assign ref_o = has_child ? payload_i[63:32] : refs_i[32*top+:32];

  // Only children can be more than the stack holds: a block leaves for every block of entries begun beyond that.
  logic [Width-2:0] leaves;
  logic [Wide-1:0] leaving;
  for (genvar i = 0; i < Width - 1; i++) begin : gen_leaves
    assign leaves[i] = has_child & Wide'(pushed_i) > Wide'(entries_i) + Wide'(i) * Wide'(block_entries_i);
  end
  always_comb begin
    spills_o = '0;
    leaving = '0;
    for (int unsigned i = 0; i < Width - 1; i++) begin
      if (leaves[i]) begin
        spills_o = SpillBits'(i + 1);
        leaving = Wide'(i + 1) * Wide'(block_entries_i);
      end
    end
  end
  assign count_o = has_child ? pushed_i - leaving[CountWidth-1:0] : any_survives ? below : '0;
  assign base_o = wrapped(Wide'(base_i) + leaving);
  assign blocks_o = blocks_i + BlockBits'(spills_o);

  // Children but the nearest go above the highest entry, the farthest first.
  for (genvar i = 0; i < Row; i++) begin : gen_write
    logic [PlaceWidth-1:0] above;
    logic [3:0] child;
    logic [63:0] child_entry;
    assign above = wrapped(PlaceWidth'(i) >= free_i ? Wide'(i) - Wide'(free_i)
                                                        : Wide'(i + Row) - Wide'(free_i));
    assign child = met_i - 4'd1 - 4'(above);
    always_comb begin
      child_entry = payload_i[63:0];
      for (int unsigned k = 1; k < Width; k++) begin
        if (child == 4'(k)) child_entry = payload_i[64*k+:64];
      end
    end
    if (i < rtu_pkg::BlockEntries) begin : gen_low
      assign write_o[i] = is_block_i | (has_child & Wide'(above) + 1'b1 < Wide'(met_i));
      assign row_o[64*i+:64] = is_block_i ? payload_i[64*i+:64] : child_entry;
    end else begin : gen_high
      assign write_o[i] = has_child & Wide'(above) + 1'b1 < Wide'(met_i);
      assign row_o[64*i+:64] = child_entry;
    end
  end

endmodule
