// Slab test of one box: where the ray enters and leaves it, Latency enabled cycles later. The operations are those of
// model/slab_test.hpp on each value; as comparisons do not round, the three axes are compared as a tree. Vectors are
// {z, y, x}. inv_direction_i, t_min_i and t_end_i come later than the rest, when they are used: after AddLatency
// and after AddLatency + MulLatency cycles, so that all lanes share what delays them.
module slab_lane (
  input  logic        clk_i,
  input  logic        en_i,
  input  logic [95:0] lo_i,
  input  logic [95:0] hi_i,
  input  logic [2:0]  entry_side_i,  // per axis: 1: the ray enters at hi
  input  logic [95:0] origin_near_i,
  input  logic [95:0] origin_far_i,
  input  logic [95:0] inv_direction_i,
  input  logic [31:0] t_min_i,
  input  logic [31:0] t_end_i,
  output logic [31:0] t_near_o,
  output logic [31:0] t_far_o
);
  /* verilator no_inline_module */

  logic [31:0] near[3], far[3];

  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    logic [31:0] lo, hi, near_plane, far_plane, to_near, to_far;
    assign lo = lo_i[32*axis+:32];
    assign hi = hi_i[32*axis+:32];
    assign near_plane = entry_side_i[axis] ? hi : lo;
    assign far_plane = entry_side_i[axis] ? lo : hi;
    fp32_add u_to_near (
      .clk_i, .en_i, .a_i(near_plane), .b_i(fp32_pkg::negated(origin_near_i[32*axis+:32])), .y_o(to_near)
    );
    fp32_add u_to_far (
      .clk_i, .en_i, .a_i(far_plane), .b_i(fp32_pkg::negated(origin_far_i[32*axis+:32])), .y_o(to_far)
    );
    fp32_mul u_near (
      .clk_i, .en_i, .a_i(to_near), .b_i(inv_direction_i[32*axis+:32]), .y_o(near[axis])
    );
    fp32_mul u_far (
      .clk_i, .en_i, .a_i(to_far), .b_i(inv_direction_i[32*axis+:32]), .y_o(far[axis])
    );
  end

  // A NaN culls nothing: it never wins. t_min and t_end are numbers, and so are the results.
  logic [31:0] near_x_q, near_yz_q, t_near_q, far_x_q, far_yz_q, t_far_q;

  always_ff @(posedge clk_i) begin
    if (en_i) begin
      near_x_q <= fp32_pkg::larger(t_min_i, near[0]);
      near_yz_q <= fp32_pkg::is_nan(near[1]) ? near[2] : fp32_pkg::larger(near[1], near[2]);
      t_near_q <= fp32_pkg::larger(near_x_q, near_yz_q);
      far_x_q <= fp32_pkg::smaller(t_end_i, far[0]);
      far_yz_q <= fp32_pkg::is_nan(far[1]) ? far[2] : fp32_pkg::smaller(far[1], far[2]);
      t_far_q <= fp32_pkg::smaller(far_x_q, far_yz_q);
    end
  end
  assign t_near_o = t_near_q;
  assign t_far_o = t_far_q;

endmodule
