// The binary32 number next to a quotient, but for what is added at the end: which number lies below it, whether it is to
// be rounded up, or whether its operands have been cut off too early to say so (is_unsure_o; then the midpoint above
// whole_o decides).
//
// The quotient is q + remainder / d times 2^(exponent - 127 - 24), and q + remainder / d errs by less than 2^25 / d to
// either side where the operands are not exact. So it is on the same side of a midpoint as q says, unless that is nearer.
module round_quotient (
  input  logic        [24:0] q_i,          // leading bit set
  input  logic        [40:0] remainder_i,  // less than d
  input  logic        [15:0] d_i,          // its leading bits
  input  logic               is_exact_i,
  input  logic signed [11:0] exponent_i,   // of the leading bit, as in the binary32 field if from 1 to 254;
  input  logic               is_less_i,    // or one more
  output logic        [23:0] whole_o,      // significand of the number below; its last place is 2^(exponent_o - 150)
  output logic        [8:0]  exponent_o,   // 1 to 255, 255 being infinity
  output logic               is_up_o,
  output logic               is_unsure_o
);

  // A subnormal number has fewer bits; below half of the least one, none, and nothing is near a midpoint.
  logic is_subnormal, is_tiny, is_huge;
  logic [11:0] below;
  logic [4:0] shift;
  logic [23:0] whole;
  logic [25:0] dropped_mask, dropped, half_bit;
  logic signed [11:0] exponent;
  assign exponent = exponent_i - $signed({11'd0, is_less_i});
  assign is_subnormal = exponent < 12'sd1;
  assign is_huge = exponent > 12'sd254;
  assign below = 12'd1 - exponent;
  assign is_tiny = is_subnormal & (below > 12'd25);
  assign shift = !is_subnormal ? 5'd0 : is_tiny ? 5'd25 : below[4:0];
  assign whole = q_i[24:1] >> shift;
  assign dropped_mask = ~(26'h3ff_fffe << shift);
  assign half_bit = dropped_mask & ~{1'b0, dropped_mask[25:1]};
  assign dropped = {1'b0, q_i} & dropped_mask;

  logic is_half, is_rest_zero, is_rest_full, is_near_below, is_near_above;
  assign is_half = |(dropped & half_bit);
  assign is_rest_zero = ~(|(dropped & ~half_bit));
  assign is_rest_full = &(dropped | half_bit | ~dropped_mask);
  assign is_near_below = ~(|remainder_i[40:25]);
  assign is_near_above = d_i - remainder_i[40:25] < 16'd2;

  assign is_unsure_o = ~is_exact_i & ~is_tiny & ~is_huge &
      (is_half ? is_rest_zero & is_near_below : is_rest_full & is_near_above);
  assign is_up_o = ~is_tiny & ~is_huge & is_half & (~is_rest_zero | (|remainder_i) | whole[0]);
  assign whole_o = is_tiny ? 24'd0 : is_huge ? 24'h80_0000 : whole;
  assign exponent_o = is_huge ? 9'd255 : is_subnormal ? 9'd1 : exponent[8:0];

endmodule
