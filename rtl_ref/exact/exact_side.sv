// On which side of the edge p -> q a ray's line passes: exactly ExactTriangle::side() of model/exact_triangle.hpp. One
// edge at a time, one product a cycle:
//
//   18 products   direction . ((p - origin) x (q - p)), whose sign decides; where it is zero,
//    4 products   the sign for the line moved by e along axis kx, e infinitely small; where that is zero too,
//    4 products   for the line moved by e^2 along ky. Three zeros: the ends coincide as the ray sees them.
//
// Each sum takes its products, 3 cycles until the last one is in, and 8 to settle its carries. Points are {z, y, x}, all
// numbers finite.
module exact_side #(
  parameter int unsigned TagWidth = 8
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  input  logic                valid_i,
  output logic                ready_o,
  input  logic [TagWidth-1:0] tag_i,
  input  logic [95:0]         origin_i,
  input  logic [95:0]         direction_i,
  input  logic [1:0]          kz_i,  // axis of the largest direction component, 0 to 2
  input  logic [95:0]         p_i,
  input  logic [95:0]         q_i,
  output logic                valid_o,
  input  logic                ready_i,
  output logic [TagWidth-1:0] tag_o,
  output logic                is_positive_o,
  output logic                is_negative_o
);

  typedef enum logic [2:0] {
    Clear,   // after reset: settle once, which clears the sum
    Idle,
    Issue,
    Drain,
    Settle,
    Result
  } state_e;

  localparam logic [31:0] One = 32'h3f80_0000;

  function automatic logic [31:0] component(input logic [95:0] v, input logic [1:0] axis);
    unique case (axis)
      2'd0: component = v[31:0];
      2'd1: component = v[63:32];
      default: component = v[95:64];
    endcase
  endfunction

  function automatic logic [1:0] axis_after(input logic [1:0] axis);
    axis_after = (axis == 2'd2) ? 2'd0 : axis + 2'd1;
  endfunction

  state_e state_q;
  logic [TagWidth-1:0] tag_q;
  logic [95:0] origin_q, direction_q, p_q, q_q;
  logic [1:0] kz_q;
  logic is_positive_q, is_negative_q;

  // Place in the program: sum 0 is the volume, 1 and 2 are the ties. A term of the volume is (part, axis, swap), one of
  // a tie (part, swap).
  logic [1:0] sum_q, part_q, axis_q, drain_q;
  logic is_swapped_q, is_last_axis, is_last_part, is_done, is_negative, is_zero;

  // Factors of the term under way. In the volume, parts 0, 1 and 2 are d.(p x q), -d.(o x q) and -d.(p x o), their
  // terms d[i] (v[j] w[k] - v[k] w[j]). In a tie, part 0 is d[kz] * (first - second)[other] and part 1
  // -d[other] * (first - second)[kz], with (first, second) = (p, q), other = ky for e, and (q, p), kx for e^2.
  logic [31:0] a, b, c;
  logic [95:0] v, w, end_point;
  logic [1:0] axis_j, axis_k, other;
  logic negate;
  always_comb begin
    axis_j = axis_after(axis_q);
    axis_k = axis_after(axis_j);
    v = (part_q == 2'd1) ? origin_q : p_q;
    w = (part_q == 2'd2) ? origin_q : q_q;
    other = (sum_q == 2'd1) ? axis_after(axis_after(kz_q)) : axis_after(kz_q);
    end_point = (is_swapped_q ^ (sum_q == 2'd2)) ? q_q : p_q;
    if (sum_q == 2'd0) begin
      a = component(direction_q, axis_q);
      b = component(v, is_swapped_q ? axis_k : axis_j);
      c = component(w, is_swapped_q ? axis_j : axis_k);
      negate = is_swapped_q ^ (part_q != 2'd0);
    end else begin
      a = component(direction_q, part_q[0] ? other : kz_q);
      b = component(end_point, part_q[0] ? kz_q : other);
      c = One;
      negate = is_swapped_q ^ part_q[0];
    end
  end
  assign is_last_axis = (sum_q != 2'd0) | (axis_q == 2'd2);
  assign is_last_part = (sum_q == 2'd0) ? part_q == 2'd2 : part_q == 2'd1;

  logic product_valid, product_sign, resolve;
  logic [9:0] product_exponent;
  logic [71:0] product_significand;
  triple_product u_product (
    .clk_i, .rst_ni, .valid_i(state_q == Issue), .negate_i(negate), .a_i(a), .b_i(b), .c_i(c),
    .valid_o(product_valid), .sign_o(product_sign), .exponent_o(product_exponent),
    .significand_o(product_significand)
  );
  exact_accumulator u_sum (
    .clk_i, .rst_ni, .valid_i(product_valid), .sign_i(product_sign), .exponent_i(product_exponent),
    .significand_i(product_significand), .resolve_i(resolve), .is_done_o(is_done), .is_negative_o(is_negative),
    .is_zero_o(is_zero)
  );
  assign resolve = (state_q == Drain && drain_q == 2'd2) || state_q == Clear;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Clear;
      sum_q <= 2'd3;
    end else begin
      unique case (state_q)
        Clear: state_q <= Settle;
        Idle: begin
          if (valid_i) begin
            state_q <= Issue;
            sum_q <= 2'd0;
          end
        end
        Issue: if (is_swapped_q & is_last_axis & is_last_part) state_q <= Drain;
        Drain: if (drain_q == 2'd2) state_q <= Settle;
        Settle: begin
          if (is_done) begin
            if (sum_q == 2'd3) begin
              state_q <= Idle;
            end else if (is_zero && sum_q != 2'd2) begin
              state_q <= Issue;
              sum_q <= sum_q + 2'd1;
            end else begin
              state_q <= Result;
            end
          end
        end
        Result: if (ready_i) state_q <= Idle;
        default: state_q <= Clear;
      endcase
    end
  end

  always_ff @(posedge clk_i) begin
    if (state_q == Idle && valid_i) begin
      tag_q <= tag_i;
      origin_q <= origin_i;
      direction_q <= direction_i;
      kz_q <= kz_i;
      p_q <= p_i;
      q_q <= q_i;
    end
    if (state_q == Issue) begin
      is_swapped_q <= ~is_swapped_q;
      if (is_swapped_q) begin
        axis_q <= is_last_axis ? 2'd0 : axis_q + 2'd1;
        if (is_last_axis) part_q <= part_q + 2'd1;
      end
    end else begin
      is_swapped_q <= 1'b0;
      axis_q <= 2'd0;
      part_q <= 2'd0;
    end
    drain_q <= (state_q == Drain) ? drain_q + 2'd1 : 2'd0;
    if (is_done) begin
      is_negative_q <= is_negative;
      is_positive_q <= ~is_negative & ~is_zero;
    end
  end

  assign ready_o = state_q == Idle;
  assign valid_o = state_q == Result;
  assign tag_o = tag_q;
  assign is_positive_o = is_positive_q;
  assign is_negative_o = is_negative_q;

`ifndef SYNTHESIS
  stream_check #(.Width(TagWidth + 386)) u_check_input (
    .clk_i, .rst_ni, .valid_i, .ready_i(ready_o), .data_i({tag_i, origin_i, direction_i, kz_i, p_i, q_i})
  );
  stream_check #(.Width(TagWidth + 2)) u_check_output (
    .clk_i, .rst_ni, .valid_i(valid_o), .ready_i, .data_i({tag_o, is_positive_o, is_negative_o})
  );
  assert property (@(posedge clk_i) disable iff (!rst_ni) valid_i |-> kz_i <= 2'd2)
  else $error("kz is no axis");
`endif

endmodule
