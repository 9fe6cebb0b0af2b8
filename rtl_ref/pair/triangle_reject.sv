// First pass for one triangle, RejectLatency later. Inputs as those of vertex_shear.
module triangle_reject (
  input  logic        clk_i,
  input  logic        en_i,
  input  logic [95:0] a_i,
  input  logic [95:0] b_i,
  input  logic [95:0] c_i,
  input  logic [95:0] origin_i,
  input  logic [31:0] shear_x_i,
  input  logic [31:0] shear_y_i,
  output logic        is_missed_o,
  output logic        is_inside_o
);

  logic [95:0] a, b, c;
  vertex_shear u_a (.clk_i, .en_i, .vertex_i(a_i), .origin_i, .shear_x_i, .shear_y_i, .sheared_o(a));
  vertex_shear u_b (.clk_i, .en_i, .vertex_i(b_i), .origin_i, .shear_x_i, .shear_y_i, .sheared_o(b));
  vertex_shear u_c (.clk_i, .en_i, .vertex_i(c_i), .origin_i, .shear_x_i, .shear_y_i, .sheared_o(c));

  logic [31:0] u, v, w;
  edge_function u_u (.clk_i, .en_i, .p_i(c[63:0]), .q_i(b[63:0]), .y_o(u));
  edge_function u_v (.clk_i, .en_i, .p_i(a[63:0]), .q_i(c[63:0]), .y_o(v));
  edge_function u_w (.clk_i, .en_i, .p_i(b[63:0]), .q_i(a[63:0]), .y_o(w));

  logic [63:0] reach_a, reach_b, reach_c, reach_ac, reach_b_later, reach;
  vertex_reach u_reach_a (.clk_i, .en_i, .sheared_i(a), .reach_o(reach_a));
  vertex_reach u_reach_b (.clk_i, .en_i, .sheared_i(b), .reach_o(reach_b));
  vertex_reach u_reach_c (.clk_i, .en_i, .sheared_i(c), .reach_o(reach_c));
  larger_reach u_reach_ac (.clk_i, .en_i, .a_i(reach_a), .b_i(reach_c), .larger_o(reach_ac));
  delay_line #(.Width(64), .Depth(1)) u_reach_b_later (.clk_i, .en_i, .d_i(reach_b), .q_o(reach_b_later));
  larger_reach u_reach (.clk_i, .en_i, .a_i(reach_ac), .b_i(reach_b_later), .larger_o(reach));

  miss_test u_miss (
    .clk_i, .en_i, .reach_i(reach), .edge_u_i(u), .edge_v_i(v), .edge_w_i(w), .is_missed_o, .is_inside_o
  );

endmodule
