// y_o = a_i + b_i, fp32_pkg::AddLatency enabled cycles later, one sum a cycle. For a difference, negate b_i.
module fp32_add (
  input  logic        clk_i,
  input  logic        en_i,
  input  logic [31:0] a_i,
  input  logic [31:0] b_i,
  output logic [31:0] y_o
);
  /* verilator no_inline_module */

  // What is not in the significands. The sign is that of the operand of larger magnitude.
  typedef struct packed {
    logic sign;
    logic is_nan;
    logic is_infinite;
  } kind_t;

  // Stage 1: order by magnitude, difference of the exponents; beyond 27 only the sticky bit is left.
  logic [31:0] greater, lesser;
  logic [7:0] greater_exponent, lesser_exponent, distance;
  kind_t kind1_d, kind1_q;
  logic is_difference, is_difference1_q;
  logic [7:0] exponent1_q;
  logic [4:0] shift1_q;
  logic [23:0] greater_q, lesser_q;

  always_comb begin
    {greater, lesser} = (b_i[30:0] > a_i[30:0]) ? {b_i, a_i} : {a_i, b_i};
    greater_exponent = {greater[30:24], greater[23] | ~(|greater[30:23])};
    lesser_exponent = {lesser[30:24], lesser[23] | ~(|lesser[30:23])};
    distance = greater_exponent - lesser_exponent;
    kind1_d.sign = greater[31];
    is_difference = greater[31] ^ lesser[31];
    // A NaN is the operand of larger magnitude.
    kind1_d.is_nan = fp32_pkg::is_nan(greater) |
        (fp32_pkg::is_infinite(greater) & fp32_pkg::is_infinite(lesser) & is_difference);
    kind1_d.is_infinite = fp32_pkg::is_infinite(greater);
  end
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      kind1_q <= kind1_d;
      is_difference1_q <= is_difference;
      exponent1_q <= greater_exponent;
      shift1_q <= (distance > 8'd27) ? 5'd27 : distance[4:0];
      greater_q <= {|greater[30:23], greater[22:0]};
      lesser_q <= {|lesser[30:23], lesser[22:0]};
    end
  end

  // Stage 2: align, with guard, round and sticky bits, and add.
  kind_t kind2_q;
  logic is_difference2_q;
  logic [7:0] exponent2_q;
  logic [26:0] whole, aligned, lost_mask;
  logic [27:0] sum_q;

  always_comb begin
    whole = {lesser_q, 3'd0};
    lost_mask = ~(27'h7ff_ffff << shift1_q);
    aligned = whole >> shift1_q;
    aligned[0] = aligned[0] | (|(whole & lost_mask));
  end
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      kind2_q <= kind1_q;
      is_difference2_q <= is_difference1_q;
      exponent2_q <= exponent1_q;
      sum_q <= is_difference1_q ? {1'b0, greater_q, 3'd0} - {1'b0, aligned}
                                     : {1'b0, greater_q, 3'd0} + {1'b0, aligned};
    end
  end

  // Stage 3: normalise, but not below exponent 1; sum bit 27 weighs 2^(exponent + 1).
  kind_t kind3_d, kind3_q;
  logic [4:0] zeros, shift;
  logic is_zero, is_zero3_q;
  logic [8:0] exponent3_q;
  logic [27:0] sum3_q;

  always_comb begin
    zeros = fp32_pkg::leading_zeros({sum_q, 4'd0});
    shift = ({3'd0, zeros} > exponent2_q) ? exponent2_q[4:0] : zeros;
    is_zero = ~(|sum_q);
    kind3_d = kind2_q;
    // An exact difference of zero is positive.
    if (is_zero & is_difference2_q) kind3_d.sign = 1'b0;
  end
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      kind3_q <= kind3_d;
      is_zero3_q <= is_zero;
      exponent3_q <= {1'b0, exponent2_q} + 9'd1 - {4'd0, shift};
      sum3_q <= sum_q << shift;
    end
  end

  // Stage 4: round, pack. Without a leading one the result is subnormal.
  logic [24:0] rounded;
  logic [8:0] exponent4;
  logic [22:0] fraction;
  logic [31:0] y_d, y_q;

  always_comb begin
    rounded = {1'b0, sum3_q[27:4]} + {24'd0, sum3_q[3] & ((|sum3_q[2:0]) | sum3_q[4])};
    exponent4 = rounded[24] ? exponent3_q + 9'd1 : rounded[23] ? exponent3_q : 9'd0;
    fraction = rounded[24] ? rounded[23:1] : rounded[22:0];
    if (kind3_q.is_nan) y_d = fp32_pkg::QuietNan;
    else if (kind3_q.is_infinite) y_d = {kind3_q.sign, 8'hff, 23'd0};
    else if (is_zero3_q) y_d = {kind3_q.sign, 31'd0};
    else if (exponent4 >= 9'd255) y_d = {kind3_q.sign, 8'hff, 23'd0};
    else y_d = {kind3_q.sign, exponent4[7:0], fraction};
  end
  always_ff @(posedge clk_i) begin
    if (en_i) y_q <= y_d;
  end
  assign y_o = y_q;

endmodule
