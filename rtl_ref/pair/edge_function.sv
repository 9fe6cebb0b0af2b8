// p.x * q.y - p.y * q.x, EdgeLatency later: on which side of the sheared edge p -> q the ray passes.
module edge_function (
  input  logic        clk_i,
  input  logic        en_i,
  input  logic [63:0] p_i,  // {y, x}
  input  logic [63:0] q_i,
  output logic [31:0] y_o
);
  /* verilator no_inline_module */

  logic [31:0] plus, minus;

  fp32_mul u_plus (.clk_i, .en_i, .a_i(p_i[31:0]), .b_i(q_i[63:32]), .y_o(plus));
  fp32_mul u_minus (.clk_i, .en_i, .a_i(p_i[63:32]), .b_i(q_i[31:0]), .y_o(minus));
  fp32_add u_difference (.clk_i, .en_i, .a_i(plus), .b_i(fp32_pkg::negated(minus)), .y_o);

endmodule
