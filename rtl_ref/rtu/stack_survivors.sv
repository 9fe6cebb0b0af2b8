// Which entries of a stack on chip can still matter: they are in it, and the ray enters them no farther than its best
// hit. All entries are compared at once. The stack lies in a ring of Row places: count_i from base_i, the lowest, on.
module stack_survivors #(
  parameter int unsigned Row = 19,
  localparam int unsigned PlaceWidth = $clog2(Row),
  localparam int unsigned CountWidth = $clog2(Row + 1)
) (
  input  logic [32*Row-1:0]     t_near_i,  // of the entries
  input  logic [PlaceWidth-1:0] base_i,
  input  logic [CountWidth-1:0] count_i,
  input  logic [31:0]           t_end_i,
  output logic [Row-1:0]        survives_o
);

  for (genvar i = 0; i < Row; i++) begin : gen_entry
    logic [CountWidth:0] height;  // above the lowest
    assign height = PlaceWidth'(i) >= base_i ? (CountWidth + 1)'(i) - (CountWidth + 1)'(base_i)
                                             : (CountWidth + 1)'(i + Row) - (CountWidth + 1)'(base_i);
    assign survives_o[i] = height < (CountWidth + 1)'(count_i) & ~fp32_pkg::is_less(t_end_i, t_near_i[32*i+:32]);
  end

endmodule
