// a_i < b_i, and the larger and the smaller of the two as std::max and std::min give them, one cycle later.
module fp32_compare (
  input  logic        clk_i,
  input  logic        en_i,
  input  logic [31:0] a_i,
  input  logic [31:0] b_i,
  output logic        is_less_o,
  output logic [31:0] larger_o,
  output logic [31:0] smaller_o
);

  logic is_less_q;
  logic [31:0] larger_q, smaller_q;

  always_ff @(posedge clk_i) begin
    if (en_i) begin
      is_less_q <= fp32_pkg::is_less(a_i, b_i);
      larger_q <= fp32_pkg::larger(a_i, b_i);
      smaller_q <= fp32_pkg::smaller(a_i, b_i);
    end
  end
  assign is_less_o = is_less_q;
  assign larger_o = larger_q;
  assign smaller_o = smaller_q;

endmodule
