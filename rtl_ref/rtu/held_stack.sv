// What becomes of a ray's stack where leaves may be known: what ray_step says, but for two cases. Combinational.
//
// A ray that passes a leaf over fetches nothing, so nothing leaves its stack either: that may hold more entries than it
// should until the ray comes again, never more than its ring does. Then blocks leave for what is left of them, as they
// do for children.
module held_stack #(
  parameter int unsigned Width = 4,   // children of a node
  parameter int unsigned Row   = 19,  // places of the ring
  localparam int unsigned PlaceWidth = $clog2(Row),
  localparam int unsigned CountWidth = $clog2(Row + 1),
  localparam int unsigned BlockBits = rtu_pkg::BlockBits,
  localparam int unsigned SpillBits = rtu_pkg::SpillBits
) (
  input  logic [CountWidth-1:0] entries_i,        // that the stack should hold at most
  input  logic [2:0]            block_entries_i,
  input  logic                  has_child_i,
  input  logic                  is_known_i,       // the leaf that the ray would go to; comes late
  // As ray_step has them, and what it makes of them.
  input  logic [PlaceWidth-1:0] base_i,
  input  logic [CountWidth-1:0] pushed_i,
  input  logic [BlockBits-1:0]  blocks_i,
  input  logic [SpillBits-1:0]  step_spills_i,
  input  logic [PlaceWidth-1:0] step_base_i,
  input  logic [CountWidth-1:0] step_count_i,
  input  logic [BlockBits-1:0]  step_blocks_i,
  output logic [SpillBits-1:0]  spills_o,         // if the leaf is not known
  output logic [PlaceWidth-1:0] base_o,
  output logic [CountWidth-1:0] count_o,
  output logic [BlockBits-1:0]  blocks_o
);

  localparam int unsigned Wide = CountWidth + 2;

  always_comb begin
    spills_o = step_spills_i;
    base_o = step_base_i;
    count_o = step_count_i;
    blocks_o = step_blocks_i;
    // Of Width - 1 entries too many at least one is gone.
    for (int unsigned i = 1; i + 1 < Width; i++) begin
      logic [Wide-1:0] leaving, place;
      leaving = Wide'(i) * Wide'(block_entries_i);
      place = Wide'(base_i) + leaving;
      if (!has_child_i && Wide'(step_count_i) > Wide'(entries_i) + leaving - Wide'(block_entries_i)) begin
        spills_o = SpillBits'(i);
        base_o = PlaceWidth'(place >= Wide'(Row) ? place - Wide'(Row) : place);
        count_o = step_count_i - CountWidth'(leaving);
        blocks_o = blocks_i + BlockBits'(i);
      end
    end
    if (is_known_i) begin
      base_o = base_i;
      count_o = has_child_i ? pushed_i : step_count_i;
      blocks_o = blocks_i;
    end
  end

endmodule
