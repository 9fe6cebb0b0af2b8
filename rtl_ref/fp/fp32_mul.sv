// y_o = a_i * b_i, fp32_pkg::MulLatency enabled cycles later, one product a cycle.
module fp32_mul (
  input  logic        clk_i,
  input  logic        en_i,
  input  logic [31:0] a_i,
  input  logic [31:0] b_i,
  output logic [31:0] y_o
);
  /* verilator no_inline_module */

  // Results that do not come from the significands.
  typedef struct packed {
    logic sign;
    logic is_nan;
    logic is_infinite;
    logic is_zero;
  } kind_t;

  // Stage 1: unpack; subnormal operands get a leading one and an exponent below 1.
  logic [4:0] a_zeros, b_zeros;
  logic [31:0] a_normal, b_normal;
  logic a_has_one, b_has_one, a_is_zero, b_is_zero, a_is_infinite, b_is_infinite;
  kind_t kind1_d, kind1_q;
  logic [23:0] a_q, b_q;
  logic signed [10:0] exponent1_d, exponent1_q;

  assign a_has_one = |a_i[30:23];
  assign b_has_one = |b_i[30:23];
  assign {a_zeros, a_normal} = fp32_pkg::normalised({a_has_one, a_i[22:0], 8'd0});
  assign {b_zeros, b_normal} = fp32_pkg::normalised({b_has_one, b_i[22:0], 8'd0});
  assign a_is_zero = ~(|a_i[30:0]);
  assign b_is_zero = ~(|b_i[30:0]);
  assign a_is_infinite = fp32_pkg::is_infinite(a_i);
  assign b_is_infinite = fp32_pkg::is_infinite(b_i);
  always_comb begin
    kind1_d.sign = a_i[31] ^ b_i[31];
    kind1_d.is_nan = fp32_pkg::is_nan(a_i) | fp32_pkg::is_nan(b_i) | (a_is_infinite & b_is_zero) |
        (b_is_infinite & a_is_zero);
    kind1_d.is_infinite = a_is_infinite | b_is_infinite;
    kind1_d.is_zero = a_is_zero | b_is_zero;
    exponent1_d = $signed({3'b0, a_i[30:24], a_i[23] | ~a_has_one}) - $signed({6'd0, a_zeros}) +
        $signed({3'b0, b_i[30:24], b_i[23] | ~b_has_one}) - $signed({6'd0, b_zeros}) - 11'sd127;
  end
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      kind1_q <= kind1_d;
      exponent1_q <= exponent1_d;
      a_q <= a_normal[31:8];
      b_q <= b_normal[31:8];
    end
  end

  // Stage 2: product of the significands, in [1, 4) * 2^46.
  kind_t kind2_q;
  logic [47:0] product_q;
  logic signed [10:0] exponent2_q;

  always_ff @(posedge clk_i) begin
    if (en_i) begin
      kind2_q <= kind1_q;
      exponent2_q <= exponent1_q;
      product_q <= {24'd0, a_q} * {24'd0, b_q};
    end
  end

  // Stage 3: normalise to [1, 2); a result below the normal range is shifted to its exponent 1 instead, 26
  // places at most, beyond which nothing but the sticky bit is left.
  kind_t kind3_q;
  logic [47:0] normal, kept, lost_mask;
  logic signed [10:0] normal_exponent, exponent3_q;
  logic [10:0] below;
  logic is_subnormal, guard3_q, sticky3_q;
  logic [4:0] shift;
  logic [23:0] significand3_q;

  always_comb begin
    normal = product_q[47] ? product_q : {product_q[46:0], 1'b0};
    normal_exponent = exponent2_q + $signed({10'd0, product_q[47]});
    is_subnormal = normal_exponent < 11'sd1;
    below = 11'd1 - normal_exponent;
    shift = !is_subnormal ? 5'd0 : (below > 11'd26) ? 5'd26 : below[4:0];
    kept = normal >> shift;
    lost_mask = ~(48'hffff_ffff_ffff << shift);
  end
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      kind3_q <= kind2_q;
      exponent3_q <= is_subnormal ? 11'sd0 : normal_exponent;
      significand3_q <= kept[47:24];
      guard3_q <= kept[23];
      sticky3_q <= (|kept[22:0]) | (|(normal & lost_mask));
    end
  end

  // Stage 4: round, pack. A subnormal that rounds up to a leading one is the least normal number.
  logic [24:0] rounded;
  logic [22:0] fraction;
  logic signed [10:0] exponent4;
  logic [31:0] y_d, y_q;

  always_comb begin
    rounded = {1'b0, significand3_q} + {24'd0, guard3_q & (sticky3_q | significand3_q[0])};
    fraction = rounded[24] ? rounded[23:1] : rounded[22:0];
    exponent4 = rounded[24] ? exponent3_q + 11'sd1
        : (exponent3_q == 11'sd0 && rounded[23]) ? 11'sd1 : exponent3_q;
    if (kind3_q.is_nan) y_d = fp32_pkg::QuietNan;
    else if (kind3_q.is_infinite) y_d = {kind3_q.sign, 8'hff, 23'd0};
    else if (kind3_q.is_zero) y_d = {kind3_q.sign, 31'd0};
    else if (exponent4 >= 11'sd255) y_d = {kind3_q.sign, 8'hff, 23'd0};
    else y_d = {kind3_q.sign, exponent4[7:0], fraction};
  end
  always_ff @(posedge clk_i) begin
    if (en_i) y_q <= y_d;
  end
  assign y_o = y_q;

endmodule
