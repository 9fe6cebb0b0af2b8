// y_o = x_i * 2^-Halvings, one enabled cycle later: the exponent goes down, and where it ends below the normal range
// the significand is shifted and rounded as in any product.
module fp32_halve #(
  parameter logic [7:0] Halvings = 8'd20  // 1 to 25
) (
  input  logic        clk_i,
  input  logic        en_i,
  input  logic [31:0] x_i,
  output logic [31:0] y_o
);

  logic [7:0] exponent, shift;
  logic [49:0] significand, shifted;
  logic [23:0] rounded;
  logic is_subnormal;
  logic [31:0] y_d, y_q;

  always_comb begin
    exponent = {x_i[30:24], x_i[23] | ~(|x_i[30:23])};
    is_subnormal = exponent <= Halvings;
    shift = is_subnormal ? Halvings + 8'd1 - exponent : 8'd0;
    significand = {|x_i[30:23], x_i[22:0], 26'd0};
    shifted = significand >> shift;  // by 26 at most: no bit is lost
    rounded = shifted[49:26] + {23'd0, shifted[25] & ((|shifted[24:0]) | shifted[26])};
    if (&x_i[30:23]) y_d = fp32_pkg::is_nan(x_i) ? fp32_pkg::QuietNan : x_i;
    else if (is_subnormal) y_d = {x_i[31], 7'd0, rounded};
    else y_d = {x_i[31], exponent - Halvings, x_i[22:0]};
  end
  always_ff @(posedge clk_i) begin
    if (en_i) y_q <= y_d;
  end
  assign y_o = y_q;

endmodule
