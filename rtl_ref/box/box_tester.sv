// Tests all children of one node against a ray each cycle and lists those that it meets near to far. Bit-equal to
// model/slab_test.hpp and to the order in which model/traversal.cpp visits.
//
//   stage  1- 4  plane - moved origin          6 adders a child
//          5- 8  * reciprocal direction        6 multipliers a child
//          9-10  largest entry, least exit
//         11     entry <= exit; all children against each other
//         12     places, and the children put there
module box_tester #(
  parameter int unsigned Width    = 4,  // children of a node, 2 to 8
  parameter int unsigned TagWidth = 8
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,
  input  logic                  valid_i,
  output logic                  ready_o,
  input  logic [TagWidth-1:0]   tag_i,
  input  logic [192*Width-1:0]  planes_i,         // as in the memory image: lo_x[Width], lo_y, lo_z, hi_x, ...
  input  logic [3:0]            child_count_i,    // 0 to Width
  input  logic [2:0]            entry_side_i,     // bit per axis x, y, z: 1: the ray enters at hi
  input  logic [95:0]           origin_near_i,    // {z, y, x}
  input  logic [95:0]           origin_far_i,
  input  logic [95:0]           inv_direction_i,  // NaN: the axis culls nothing
  input  logic [31:0]           t_min_i,          // not a NaN
  input  logic [31:0]           t_end_i,          // not a NaN
  output logic                  valid_o,
  input  logic                  ready_i,
  output logic [TagWidth-1:0]   tag_o,
  output logic [3:0]            count_o,          // children met
  output logic [3*Width-1:0]    child_o,          // their indices, near to far; then zeros
  output logic [32*Width-1:0]   t_near_o          // where the ray enters them; then zeros
);

  localparam int unsigned SlabLatency = fp32_pkg::AddLatency + fp32_pkg::MulLatency + 2;
  localparam int unsigned Latency = SlabLatency + 2;

  logic en;
  pipeline_control #(.Latency(Latency), .TagWidth(TagWidth)) u_control (
    .clk_i, .rst_ni, .valid_i, .ready_o, .tag_i, .valid_o, .ready_i, .tag_o, .en_o(en)
  );

  logic [95:0] inv_direction;
  logic [31:0] t_min, t_end;
  logic [3:0] child_count;
  delay_line #(.Width(96), .Depth(fp32_pkg::AddLatency)) u_inv_direction (
    .clk_i, .en_i(en), .d_i(inv_direction_i), .q_o(inv_direction)
  );
  delay_line #(.Width(64), .Depth(SlabLatency - 2)) u_interval (
    .clk_i, .en_i(en), .d_i({t_min_i, t_end_i}), .q_o({t_min, t_end})
  );
  delay_line #(.Width(4), .Depth(SlabLatency)) u_child_count (
    .clk_i, .en_i(en), .d_i(child_count_i), .q_o(child_count)
  );

  logic [Width-1:0] is_child;
  logic [32*Width-1:0] t_near, t_far;
  for (genvar i = 0; i < Width; i++) begin : gen_lane
    logic [95:0] lo, hi;
    for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
      assign lo[32*axis+:32] = planes_i[32*(Width*axis+i)+:32];
      assign hi[32*axis+:32] = planes_i[32*(Width*(3+axis)+i)+:32];
    end
    slab_lane u_lane (
      .clk_i, .en_i(en), .lo_i(lo), .hi_i(hi), .entry_side_i, .origin_near_i, .origin_far_i,
      .inv_direction_i(inv_direction), .t_min_i(t_min), .t_end_i(t_end),
      .t_near_o(t_near[32*i+:32]), .t_far_o(t_far[32*i+:32])
    );
    assign is_child[i] = child_count > i;
  end

  near_to_far #(.Width(Width)) u_order (
    .clk_i, .en_i(en), .is_child_i(is_child), .t_near_i(t_near), .t_far_i(t_far), .count_o, .child_o, .t_near_o
  );

`ifndef SYNTHESIS
  stream_check #(.Width(TagWidth + 192*Width + 359)) u_check_input (
    .clk_i, .rst_ni, .valid_i, .ready_i(ready_o),
    .data_i({tag_i, planes_i, child_count_i, entry_side_i, origin_near_i, origin_far_i, inv_direction_i, t_min_i,
             t_end_i})
  );
  stream_check #(.Width(TagWidth + 4 + 35*Width)) u_check_output (
    .clk_i, .rst_ni, .valid_i(valid_o), .ready_i, .data_i({tag_o, count_o, child_o, t_near_o})
  );
  assert property (@(posedge clk_i) disable iff (!rst_ni) valid_i |-> 32'(child_count_i) <= Width)
  else $error("more children than lanes");
  assert property (@(posedge clk_i) disable iff (!rst_ni)
                   valid_i |-> !fp32_pkg::is_nan(t_min_i) && !fp32_pkg::is_nan(t_end_i))
  else $error("the interval has a NaN");
  assert property (@(posedge clk_i) disable iff (!rst_ni) valid_o |-> 32'(count_o) <= Width)
  else $error("more results than lanes");
`endif

endmodule
