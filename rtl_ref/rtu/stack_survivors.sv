// Which entries of a stack on chip can still matter: they are in it, and the ray enters them no farther than its best
// hit. All entries are compared at once. The stack lies in a ring of Row places: count_i from base_i, the lowest, on;
// those that wrapped around, before base_i, are the higher ones.
module stack_survivors #(
  parameter int unsigned Row = 19,
  localparam int unsigned PlaceWidth = $clog2(Row),
  localparam int unsigned CountWidth = $clog2(Row + 1)
) (
  input  logic [32*Row-1:0]     t_near_i,  // of the entries
  input  logic [PlaceWidth-1:0] base_i,
  input  logic [CountWidth-1:0] count_i,
  input  logic [31:0]           t_end_i,
  output logic [Row-1:0]        low_o,     // surviving entries from base_i on
  output logic [Row-1:0]        high_o     // surviving entries before it
);

  for (genvar i = 0; i < Row; i++) begin : gen_entry
    logic is_low, survives;
    logic [CountWidth:0] end_place;  // the first that is free, as if there were no ring
    assign end_place = (CountWidth + 1)'(base_i) + (CountWidth + 1)'(count_i);
    assign is_low = PlaceWidth'(i) >= base_i;
    assign survives = ~fp32_pkg::is_less(t_end_i, t_near_i[32*i+:32]);
    assign low_o[i] = survives & is_low & (CountWidth + 1)'(i) < end_place;
    assign high_o[i] = survives & ~is_low & (CountWidth + 1)'(i + Row) < end_place;
  end

endmodule
