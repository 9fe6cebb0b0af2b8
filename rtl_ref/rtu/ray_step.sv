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
  input  logic [Row-1:0]        survives_i,
  input  logic [PlaceWidth-1:0] base_i,
  input  logic [CountWidth-1:0] count_i,
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

  // The highest surviving entry: beyond the ring's end are the higher ones.
  logic any_survives;
  logic [PlaceWidth-1:0] top;
  always_comb begin
    top = '0;
    any_survives = 1'b0;
    for (int unsigned i = 0; i < Row; i++) begin
      if (survives_i[i] && PlaceWidth'(i) >= base_i) begin
        top = PlaceWidth'(i);
        any_survives = 1'b1;
      end
    end
    for (int unsigned i = 0; i < Row; i++) begin
      if (survives_i[i] && PlaceWidth'(i) < base_i) begin
        top = PlaceWidth'(i);
        any_survives = 1'b1;
      end
    end
  end

  logic has_child, goes_on;
  assign has_child = met_i != 4'd0;
  assign goes_on = ~is_satisfied_i & (has_child | any_survives);
  assign reloads_o = ~is_satisfied_i & ~goes_on & blocks_i != '0;
  assign ends_o = ~goes_on & ~reloads_o;
  assign ref_o = has_child ? payload_i[63:32] : refs_i[32*top+:32];

  // Entries left, and the blocks among them that find no place.
  logic [CountWidth-1:0] left, leaving;
  always_comb begin
    if (has_child) left = count_i + CountWidth'(met_i) - 1'b1;
    else if (any_survives) left = CountWidth'(wrapped(Wide'(top) + Wide'(Row) - Wide'(base_i)));
    else left = '0;
    spills_o = '0;
    leaving = '0;
    for (int unsigned i = 0; i < Width - 1; i++) begin
      if (Wide'(left) > Wide'(entries_i) + Wide'(leaving)) begin
        leaving = leaving + CountWidth'(block_entries_i);
        spills_o = spills_o + 1'b1;
      end
    end
  end
  assign count_o = left - leaving;
  assign base_o = wrapped(Wide'(base_i) + Wide'(leaving));
  assign blocks_o = blocks_i + BlockBits'(spills_o);

  // Children but the nearest go above the highest entry, the farthest first.
  logic [PlaceWidth-1:0] free_place;
  assign free_place = wrapped(Wide'(base_i) + Wide'(count_i));
  for (genvar i = 0; i < Row; i++) begin : gen_write
    logic [PlaceWidth-1:0] above;
    logic [3:0] child;
    logic [63:0] child_entry;
    assign above = wrapped(PlaceWidth'(i) >= free_place ? Wide'(i) - Wide'(free_place)
                                                        : Wide'(i + Row) - Wide'(free_place));
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
