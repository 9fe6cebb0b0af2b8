// The binary32 operations side by side, for the test.
module fp32_ops (
  input  logic        clk_i,
  input  logic        en_i,
  input  logic [31:0] a_i,
  input  logic [31:0] b_i,
  output logic [31:0] product_o,
  output logic [31:0] sum_o,
  output logic        is_less_o,
  output logic [31:0] larger_o,
  output logic [31:0] smaller_o,
  output logic [31:0] halved_o,
  output logic [31:0] mul_latency_o,
  output logic [31:0] add_latency_o
);

  fp32_mul u_mul (.clk_i, .en_i, .a_i, .b_i, .y_o(product_o));
  fp32_add u_add (.clk_i, .en_i, .a_i, .b_i, .y_o(sum_o));
  fp32_compare u_compare (.clk_i, .en_i, .a_i, .b_i, .is_less_o, .larger_o, .smaller_o);
  fp32_halve u_halve (.clk_i, .en_i, .x_i(a_i), .y_o(halved_o));
  assign mul_latency_o = fp32_pkg::MulLatency;
  assign add_latency_o = fp32_pkg::AddLatency;

endmodule
