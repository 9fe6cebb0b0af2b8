// The exact product of three finite binary32 numbers, two cycles later: (-1)^sign * significand * 2^(exponent - 447).
// A product with 1 is one of two.
module triple_product (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        valid_i,
  input  logic        negate_i,
  input  logic [31:0] a_i,
  input  logic [31:0] b_i,
  input  logic [31:0] c_i,
  output logic        valid_o,
  output logic        sign_o,
  output logic [9:0]  exponent_o,  // 0 to 759
  output logic [71:0] significand_o
);

  // Exponent field less 1; that of a subnormal number is 0 as well.
  function automatic logic [9:0] exponent_of(input logic [7:0] field);
    exponent_of = (|field) ? {2'd0, field} - 10'd1 : 10'd0;
  endfunction

  function automatic logic [23:0] significand_of(input logic [30:0] x);
    significand_of = {|x[30:23], x[22:0]};
  endfunction

  logic valid1_q, valid2_q, sign1_q, sign2_q;
  logic [9:0] exponent1_q, exponent2_q;
  logic [23:0] c_q;
  logic [47:0] product1_q;
  logic [71:0] product2_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {valid1_q, valid2_q} <= 2'b00;
    else {valid1_q, valid2_q} <= {valid_i, valid1_q};
  end
  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      sign1_q <= a_i[31] ^ b_i[31] ^ c_i[31] ^ negate_i;
      exponent1_q <= exponent_of(a_i[30:23]) + exponent_of(b_i[30:23]) + exponent_of(c_i[30:23]);
      c_q <= significand_of(c_i[30:0]);
      product1_q <= {24'd0, significand_of(a_i[30:0])} * {24'd0, significand_of(b_i[30:0])};
    end
    if (valid1_q) begin
      sign2_q <= sign1_q;
      exponent2_q <= exponent1_q;
      product2_q <= {24'd0, product1_q} * {48'd0, c_q};
    end
  end
  assign valid_o = valid2_q;
  assign sign_o = sign2_q;
  assign exponent_o = exponent2_q;
  assign significand_o = product2_q;

endmodule
