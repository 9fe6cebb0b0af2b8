// First pass for two triangles (a, b, c) and (a, c, d), RejectLatency later: each vertex is sheared once and the common
// edge a-c evaluated once. Inputs as those of vertex_shear.
module shared_reject (
  input  logic         clk_i,
  input  logic         en_i,
  input  logic [383:0] vertices_i,  // {d, c, b, a}
  input  logic [95:0]  origin_i,
  input  logic [31:0]  shear_x_i,
  input  logic [31:0]  shear_y_i,
  output logic [1:0]   is_missed_o,
  output logic [1:0]   is_inside_o
);

  logic [95:0] v[4];
  logic [63:0] reach_v[4];
  for (genvar i = 0; i < 4; i++) begin : gen_vertex
    vertex_shear u_shear (
      .clk_i, .en_i, .vertex_i(vertices_i[96*i+:96]), .origin_i, .shear_x_i, .shear_y_i, .sheared_o(v[i])
    );
    vertex_reach u_reach (.clk_i, .en_i, .sheared_i(v[i]), .reach_o(reach_v[i]));
  end

  logic [31:0] common, edge_cb, edge_ba, edge_dc, edge_ad;
  edge_function u_common (.clk_i, .en_i, .p_i(v[0][63:0]), .q_i(v[2][63:0]), .y_o(common));
  edge_function u_edge_cb (.clk_i, .en_i, .p_i(v[2][63:0]), .q_i(v[1][63:0]), .y_o(edge_cb));
  edge_function u_edge_ba (.clk_i, .en_i, .p_i(v[1][63:0]), .q_i(v[0][63:0]), .y_o(edge_ba));
  edge_function u_edge_dc (.clk_i, .en_i, .p_i(v[3][63:0]), .q_i(v[2][63:0]), .y_o(edge_dc));
  edge_function u_edge_ad (.clk_i, .en_i, .p_i(v[0][63:0]), .q_i(v[3][63:0]), .y_o(edge_ad));

  logic [63:0] reach_ac, reach_b, reach_d, reach_0, reach_1;
  larger_reach u_reach_ac (.clk_i, .en_i, .a_i(reach_v[0]), .b_i(reach_v[2]), .larger_o(reach_ac));
  delay_line #(.Width(128), .Depth(1)) u_reach_later (
    .clk_i, .en_i, .d_i({reach_v[3], reach_v[1]}), .q_o({reach_d, reach_b})
  );
  larger_reach u_reach_0 (.clk_i, .en_i, .a_i(reach_ac), .b_i(reach_b), .larger_o(reach_0));
  larger_reach u_reach_1 (.clk_i, .en_i, .a_i(reach_ac), .b_i(reach_d), .larger_o(reach_1));

  miss_test u_miss_0 (
    .clk_i, .en_i, .reach_i(reach_0), .edge_u_i(edge_cb), .edge_v_i(common), .edge_w_i(edge_ba),
    .is_missed_o(is_missed_o[0]), .is_inside_o(is_inside_o[0])
  );
  miss_test u_miss_1 (
    .clk_i, .en_i, .reach_i(reach_1), .edge_u_i(edge_dc), .edge_v_i(edge_ad),
    .edge_w_i(fp32_pkg::negated(common)), .is_missed_o(is_missed_o[1]), .is_inside_o(is_inside_o[1])
  );

endmodule
