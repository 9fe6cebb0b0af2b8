// Second pass of the pair test: whether the triangles that the first pass let through are better hits than the best so
// far, triangle 0 and then 1, and t, u and v, each the exact value rounded once. Bit-equal to test_pair() of
// model/pair_test.cpp with is_better() of model/traversal.cpp. One pair at a time; latencies in docs/rtl.md.
//
// A triangle goes through phases of 36 cycles, each of which forms two exact sums (exact_terms): Distance, whose quotient
// is t, and Weights, whose quotients by the same denominator are u and v. The quotient of a phase is taken while the next
// forms its sums. Before them come, if the first pass did not settle the sides, Weights and the ties for each edge; after
// them, if a quotient's leading bits do not tell how to round it, its numerator again, less the midpoint in question
// times the denominator.
module hit_unit #(
  parameter int unsigned TagWidth = 8
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  input  logic                valid_i,
  output logic                ready_o,
  input  logic [TagWidth-1:0] tag_i,
  input  logic [383:0]        vertices_i,       // as in the memory image
  input  logic [63:0]         primitive_ids_i,
  input  logic [5:0]          corner_order_i,   // bits 6 to 1 of the pair's flags
  input  logic [1:0]          goes_on_i,        // triangles to decide, at least one
  input  logic [1:0]          is_inside_i,      // of those, the ones whose sides are settled
  input  logic [95:0]         origin_i,
  input  logic [95:0]         direction_i,
  input  logic [1:0]          kz_i,
  input  logic [31:0]         t_min_i,
  input  logic [31:0]         t_best_i,         // of the best hit so far, or t_max
  input  logic                has_best_i,
  input  logic [31:0]         best_id_i,
  output logic                valid_o,
  input  logic                ready_i,
  output logic [TagWidth-1:0] tag_o,
  output logic                found_o,          // a better hit; the rest is meaningful then
  output logic [31:0]         t_o,
  output logic [31:0]         u_o,
  output logic [31:0]         v_o,
  output logic [31:0]         primitive_id_o
);
  /* verilator no_inline_module */

  typedef enum logic [1:0] {
    Idle,
    Start,  // of the second triangle
    Run,
    Result
  } state_e;

  localparam logic [1:0] QuotientT = 2'd0, QuotientU = 2'd1, QuotientV = 2'd2;

  state_e state_q;
  logic [TagWidth-1:0] tag_q;
  logic [383:0] vertices_q;
  logic [63:0] primitive_ids_q;
  logic [5:0] corner_order_q;
  logic [95:0] origin_q, direction_q;
  logic [1:0] kz_q;
  logic [31:0] t_min_q, t_best_q, best_id_q, u_q, v_q;
  logic has_best_q, found_q, has_next_q, is_second_inside_q;

  // Place in the program. is_midpoint_q: a quotient is being settled by its midpoint.
  logic [2:0] phase_q, previous_q;
  logic [5:0] step_q;
  logic [1:0] edge_q, target_q, axis_q;
  logic triangle_q, is_side_q, is_midpoint_q, first_side_q, sides_differ_q, starts, ends, is_new_phase;
  logic [5:0] corners_q;
  logic [2:0] next_phase;

  // The phase forms the numerator of target_q once more, from which its midpoint will be taken; or quotients of the
  // phase before it are taken in it.
  logic sums_again, has_quotients;
  assign sums_again = is_midpoint_q & (phase_q == ((target_q == QuotientT) ? hit_pkg::Distance : hit_pkg::Weights));
  assign has_quotients = state_q == Run &&
      (phase_q == hit_pkg::Tail || (phase_q == hit_pkg::Weights && !is_side_q && !sums_again));

  // The corners of a triangle in the file's order: which vertices are c, b, a.
  function automatic logic [1:0] vertex_of(input logic triangle, input logic [1:0] corner);
    vertex_of = (triangle && corner != 2'd0) ? corner + 2'd1 : corner;
  endfunction
  function automatic logic [1:0] corner_after(input logic [1:0] corner);
    corner_after = corner[1] ? 2'd0 : corner + 2'd1;
  endfunction
  function automatic logic [5:0] corners_of(input logic triangle, input logic [5:0] order);
    logic [1:0] a, b, c;
    a = triangle ? order[4:3] : order[1:0];
    b = corner_after(a);
    c = corner_after(b);
    if (triangle ? order[5] : order[2]) {b, c} = {c, b};
    corners_of = {vertex_of(triangle, c), vertex_of(triangle, b), vertex_of(triangle, a)};
  endfunction

  // The sums.
  logic issues, clear, settle, window;
  logic [1:0] place;
  logic [1:0] is_negative, is_zero, is_exact, term_valid, term_sign;
  logic [19:0] term_exponent;
  logic [9:0] sum_exponent[2];
  logic [47:0] term_factor;
  logic [47:0] term_product;
  logic [40:0] significand[2];
  logic [2:0] in_group;
  logic [1:0] group;
  logic [7:0] scale;
  logic [23:0] whole_q;
  logic negate;

  exact_terms u_terms (
    .clk_i, .rst_ni, .clear_i(clear), .valid_i(issues), .phase_i(phase_q), .group_i(group), .place_i(place),
    .is_swapped_i(in_group[0]), .axis_i(axis_q), .whole_i(whole_q), .negate_i(negate), .scale_i(scale),
    .vertices_i(vertices_q), .corners_i(corners_q), .origin_i(origin_q), .direction_i(direction_q), .kz_i(kz_q),
    .valid_o(term_valid), .sign_o(term_sign), .exponent_o(term_exponent), .product_o(term_product),
    .factor_o(term_factor)
  );
  for (genvar i = 0; i < 2; i++) begin : gen_sum
    exact_accumulator u_sum (
      .clk_i, .rst_ni, .clear_i(clear), .settle_i(settle), .valid_i(term_valid[i]),
      .sign_i(term_sign[i]), .exponent_i(term_exponent[10*i+:10]), .product_i(term_product), .factor_i(term_factor[24*i+:24]),
      .is_negative_o(is_negative[i]), .is_zero_o(is_zero[i]), .significand_o(significand[i]),
      .is_exact_o(is_exact[i]), .exponent_o(sum_exponent[i])
    );
  end

  // Steps 0 to 23 are six of each group.
  logic [4:0] program_q;  // {group, place, is_swapped}
  assign issues = state_q == Run && phase_q <= hit_pkg::Midpoint && step_q <= hit_pkg::LastProduct;
  assign group = program_q[4:3];
  assign in_group = program_q[2:0];
  assign place = in_group[2:1];
  always_ff @(posedge clk_i) begin
    if (starts | ends | is_new_phase) program_q <= 5'd0;
    else if (issues) program_q <= (in_group == 3'd5) ? {group + 2'd1, 3'd0} : program_q + 5'd1;
  end
  assign clear = state_q == Run && step_q == 6'd0 && phase_q < hit_pkg::Midpoint;
  assign settle = state_q == Run && step_q == hit_pkg::SettleStep && phase_q <= hit_pkg::Midpoint;
  assign window = has_quotients && step_q == 6'd0;

  // Quotients: of the sums by the denominator, which is sum 1 of phase Distance.
  logic divides_t, divides, is_denominator_negative_q, is_t_negative_q, is_denominator_exact_q;
  logic [40:0] denominator_q, denominator;
  logic [42:0] triple_q;
  logic [9:0] denominator_exponent_q, denominator_exponent;
  logic [1:0] is_less_q, is_zero_q, is_exact_q, is_negative_before_q;  // signs are gone with the window
  logic signed [11:0] exponent_q[2];
  logic [24:0] quotient[2];
  logic [40:0] remainder[2];
  assign divides_t = phase_q == hit_pkg::Weights;
  assign divides = has_quotients && step_q == hit_pkg::DivideStep && !is_midpoint_q;
  assign denominator = divides_t ? significand[1] : denominator_q;
  assign denominator_exponent = divides_t ? sum_exponent[1] : denominator_exponent_q;
  always_ff @(posedge clk_i) begin
    if (window) is_negative_before_q <= is_negative;
    if (divides) begin
      is_zero_q <= is_zero;
      is_exact_q <= is_exact;
    end
    if (divides & divides_t) begin
      denominator_q <= significand[1];
      triple_q <= {2'd0, significand[1]} + {1'd0, significand[1], 1'b0};
      denominator_exponent_q <= sum_exponent[1];
      is_denominator_exact_q <= is_exact[1];
      is_denominator_negative_q <= is_negative_before_q[1];
      is_t_negative_q <= is_negative_before_q[0] ^ is_negative_before_q[1];
    end
  end
  for (genvar i = 0; i < 2; i++) begin : gen_quotient
    logic is_less;
    assign is_less = significand[i] < denominator;
    always_ff @(posedge clk_i) begin
      if (divides) begin
        exponent_q[i] <= $signed({2'd0, sum_exponent[i]}) - $signed({2'd0, denominator_exponent}) + 12'sd127;
        is_less_q[i] <= is_less;
      end
    end
    quotient_digits u_digits (
      .clk_i, .rst_ni, .start_i(divides), .n_i(significand[i]), .is_less_i(is_less), .d_i(denominator_q),
      .triple_i(triple_q), .q_o(quotient[i]), .remainder_o(remainder[i])
    );
  end

  // Rounding, in two cycles; one quotient after the other. That of t and u is ready at QuotientStep, that of v waits.
  logic asks_midpoint, rounds, is_second, is_unsure, is_up, up_q, is_unsure_q, is_positive_q;
  logic [23:0] whole;
  logic [8:0] exponent, exponent_q1;
  logic [31:0] rounded;
  assign is_second = step_q[0];
  assign rounds = has_quotients && !asks_midpoint &&
      ((step_q == hit_pkg::QuotientStep && !is_midpoint_q) ||
       (step_q == hit_pkg::QuotientStep + 6'd1 && phase_q == hit_pkg::Tail && !(is_midpoint_q && target_q == QuotientV)));
  round_quotient u_round (
    .q_i(quotient[is_second]), .remainder_i(remainder[is_second]), .d_i(denominator_q[40:25]),
    .is_exact_i(is_exact_q[is_second] & is_denominator_exact_q), .exponent_i(exponent_q[is_second]),
    .is_less_i(is_less_q[is_second]), .whole_o(whole), .exponent_o(exponent), .is_up_o(is_up), .is_unsure_o(is_unsure)
  );
  logic sum_is_zero, sum_is_negative, is_target_v;
  assign is_target_v = target_q == QuotientV;
  assign sum_is_zero = is_zero[is_target_v];
  assign sum_is_negative = is_negative[is_target_v];
  always_ff @(posedge clk_i) begin
    if (rounds) begin
      whole_q <= is_zero_q[is_second] ? 24'd0 : whole;
      exponent_q1 <= is_zero_q[is_second] ? 9'd1 : exponent;
      up_q <= is_up & ~is_zero_q[is_second];
      is_unsure_q <= is_unsure & ~is_zero_q[is_second];
      is_positive_q <= (phase_q == hit_pkg::Tail) | is_zero_q[is_second] | ~is_t_negative_q;
    end else if (window & is_midpoint_q) begin
      // The numerator is beyond the midpoint, or at it.
      up_q <= sum_is_zero ? whole_q[0] : ~(sum_is_negative ^ is_denominator_negative_q ^ negate);
      is_unsure_q <= 1'b0;
    end
  end
  assign rounded = {~is_positive_q, {exponent_q1[7:0] - 8'd1, 23'd0} + {7'd0, whole_q} + {30'd0, up_q}};
  assign negate = (target_q == QuotientT) & is_t_negative_q;

  // A midpoint is (2 whole + 1) 2^(exponent - 151): what is left of the binary point moves the numerator up instead.
  always_comb begin
    scale = 8'd0;
    if (phase_q == hit_pkg::Midpoint && exponent_q1 > 9'd151) scale = 8'(exponent_q1 - 9'd151);
    if (sums_again && exponent_q1 < 9'd151) scale = 8'(9'd151 - exponent_q1);
  end

  // Better than the best so far?
  logic [31:0] t_q, primitive_id;
  logic is_nearer, is_farther, is_better;
  assign primitive_id = triangle_q ? primitive_ids_q[63:32] : primitive_ids_q[31:0];
  assign is_nearer = fp32_pkg::is_less(t_q, t_best_q);
  assign is_farther = fp32_pkg::is_less(t_best_q, t_q);
  assign is_better = fp32_pkg::is_less(t_min_q, t_q) &
      (is_nearer | (~is_farther & has_best_q & (primitive_id < best_id_q)));

  // What comes next.
  logic asks_tie, differs;
  assign asks_tie = is_zero[1] & previous_q != hit_pkg::TieY;
  assign differs = is_zero[1] | (edge_q != 2'd0 & is_negative[1] != first_side_q);
  assign asks_midpoint = has_quotients && is_unsure_q &&
      (step_q == hit_pkg::QuotientStep + 6'd1 || (step_q == hit_pkg::DecideStep && phase_q == hit_pkg::Tail));
  always_comb begin
    ends = 1'b0;
    is_new_phase = 1'b0;
    next_phase = phase_q;
    if (state_q == Run) begin
      if (asks_midpoint) begin
        is_new_phase = 1'b1;
        next_phase = divides_t ? hit_pkg::Distance : hit_pkg::Weights;
      end else if (phase_q == hit_pkg::Judge) begin
        is_new_phase = 1'b1;
        if (asks_tie) begin
          next_phase = (previous_q == hit_pkg::Weights) ? hit_pkg::TieX : hit_pkg::TieY;
        end else begin
          next_phase = (edge_q == 2'd2) ? hit_pkg::Distance : hit_pkg::Weights;
          ends = edge_q == 2'd2 && (sides_differ_q || differs);
        end
      end else if (step_q == hit_pkg::DecideStep && has_quotients) begin
        ends = phase_q == hit_pkg::Tail || !is_better;
      end else if (step_q == hit_pkg::LastStep) begin
        is_new_phase = 1'b1;
        unique case (phase_q)
          hit_pkg::Distance: next_phase = is_midpoint_q ? hit_pkg::Midpoint : hit_pkg::Weights;
          hit_pkg::Weights:
            next_phase = is_side_q ? hit_pkg::Judge : sums_again ? hit_pkg::Midpoint : hit_pkg::Tail;
          hit_pkg::Midpoint:
            next_phase = (axis_q != 2'd2) ? hit_pkg::Midpoint : (target_q == QuotientT) ? hit_pkg::Weights : hit_pkg::Tail;
          default: next_phase = hit_pkg::Judge;
        endcase
      end
    end
  end
  // The next triangle: the first of a pair as it is accepted, or the second.
  logic next_triangle, next_is_inside;
  logic [5:0] next_corners;
  assign starts = state_q == Idle & valid_i;
  assign next_triangle = starts ? ~goes_on_i[0] : 1'b1;
  assign next_is_inside = starts ? is_inside_i[next_triangle] : is_second_inside_q;
  assign next_corners = corners_of(next_triangle, starts ? corner_order_i : corner_order_q);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Idle;
    end else begin
      unique case (state_q)
        Idle: if (valid_i) state_q <= Run;
        Start: state_q <= Run;
        Run: if (ends) state_q <= has_next_q ? Start : Result;
        Result: if (ready_i) state_q <= Idle;
        default: state_q <= Idle;
      endcase
    end
  end

  always_ff @(posedge clk_i) begin
    if (starts) begin
      tag_q <= tag_i;
      vertices_q <= vertices_i;
      primitive_ids_q <= primitive_ids_i;
      corner_order_q <= corner_order_i;
      is_second_inside_q <= is_inside_i[1];
      origin_q <= origin_i;
      direction_q <= direction_i;
      kz_q <= kz_i;
      t_min_q <= t_min_i;
    end
    if (starts | ends) begin
      has_next_q <= starts & (&goes_on_i);
      triangle_q <= next_triangle;
      corners_q <= next_corners;
      is_side_q <= ~next_is_inside;
      is_midpoint_q <= 1'b0;
      target_q <= QuotientT;
      edge_q <= 2'd0;
      sides_differ_q <= 1'b0;
      phase_q <= next_is_inside ? hit_pkg::Distance : hit_pkg::Weights;
      step_q <= 6'd0;
    end else if (is_new_phase) begin
      phase_q <= next_phase;
      previous_q <= phase_q;
      step_q <= 6'd0;
      axis_q <= (phase_q == hit_pkg::Midpoint) ? axis_q + 2'd1 : 2'd0;
      if (asks_midpoint) begin
        is_midpoint_q <= 1'b1;
        target_q <= divides_t ? QuotientT : (step_q == hit_pkg::DecideStep) ? QuotientV : QuotientU;
      end
      if (phase_q == hit_pkg::Judge & ~asks_tie) begin
        corners_q <= {corners_q[1:0], corners_q[5:2]};
        edge_q <= edge_q + 2'd1;
        if (edge_q == 2'd0) first_side_q <= is_negative[1];
        sides_differ_q <= sides_differ_q | differs;
        if (edge_q == 2'd2) is_side_q <= 1'b0;
      end
    end else if (state_q == Run) begin
      step_q <= step_q + 6'd1;
      // The midpoint of t is settled once it is compared.
      if (has_quotients && step_q == hit_pkg::DecideStep) is_midpoint_q <= 1'b0;
    end
  end

  always_ff @(posedge clk_i) begin
    if (starts) begin
      t_best_q <= t_best_i;
      has_best_q <= has_best_i;
      best_id_q <= best_id_i;
      found_q <= 1'b0;
    end else if (has_quotients && divides_t && step_q == hit_pkg::DecideStep && is_better) begin
      t_best_q <= t_q;
      has_best_q <= 1'b1;
      best_id_q <= primitive_id;
      found_q <= 1'b1;
    end
    if (step_q == hit_pkg::QuotientStep + 6'd1) begin
      if (phase_q == hit_pkg::Weights) t_q <= rounded;
      if (phase_q == hit_pkg::Tail && !(is_midpoint_q && is_target_v)) u_q <= rounded;
    end
    if (step_q == hit_pkg::DecideStep && phase_q == hit_pkg::Tail) v_q <= rounded;
  end

`ifndef SYNTHESIS
  stream_check #(.Width(TagWidth + 749)) u_check_input (
    .clk_i, .rst_ni, .valid_i, .ready_i(ready_o),
    .data_i({tag_i, vertices_i, primitive_ids_i, corner_order_i, goes_on_i, is_inside_i, origin_i, direction_i, kz_i,
             t_min_i, t_best_i, has_best_i, best_id_i})
  );
  stream_check #(.Width(TagWidth + 129)) u_check_output (
    .clk_i, .rst_ni, .valid_i(valid_o), .ready_i, .data_i({tag_o, found_o, t_o, u_o, v_o, primitive_id_o})
  );
  assert property (@(posedge clk_i) disable iff (!rst_ni) valid_i |-> kz_i <= 2'd2)
  else $error("kz is no axis");
  assert property (@(posedge clk_i) disable iff (!rst_ni) valid_i |-> goes_on_i != 2'd0)
  else $error("no triangle to decide");
  assert property (@(posedge clk_i) disable iff (!rst_ni) divides |-> !is_zero[1] || !divides_t)
  else $error("the denominator is zero");
`endif

  assign ready_o = state_q == Idle;
  assign valid_o = state_q == Result;
  assign tag_o = tag_q;
  assign found_o = found_q;
  assign t_o = t_best_q;
  assign u_o = u_q;
  assign v_o = v_q;
  assign primitive_id_o = best_id_q;

endmodule
