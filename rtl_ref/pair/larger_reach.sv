// The larger of two reaches, one enabled cycle later.
module larger_reach (
  input  logic        clk_i,
  input  logic        en_i,
  input  logic [63:0] a_i,
  input  logic [63:0] b_i,
  output logic [63:0] larger_o
);

  logic [63:0] larger_q;

  always_ff @(posedge clk_i) begin
    if (en_i) begin
      larger_q <= {fp32_pkg::larger(a_i[63:32], b_i[63:32]), fp32_pkg::larger(a_i[31:0], b_i[31:0])};
    end
  end
  assign larger_o = larger_q;

endmodule
