// What the edge functions of a triangle tell beyond their rounding errors: that the ray misses it, as is_missed() in
// model/pair_test.cpp (low < -bound, high > bound and bound < 2^100, low and high being the least and the largest of the
// three), or that all three have one sign, so that the ray surely passes the edges on one side (low > bound or high <
// -bound, and bound < 2^100). The bound is
//   bound = 2^-20 * (across + 2^-20 * along) * (across + along) + 2^-126.
// reach_i enters at cycle 0 and the edge functions EdgeLatency - ReachLatency later; the answer comes
// BoundLatency + 1 after the reach.
module miss_test (
  input  logic        clk_i,
  input  logic        en_i,
  input  logic [63:0] reach_i,   // {along, across}
  input  logic [31:0] edge_u_i,
  input  logic [31:0] edge_v_i,
  input  logic [31:0] edge_w_i,
  output logic        is_missed_o,
  output logic        is_inside_o
);
  /* verilator no_inline_module */

  localparam logic [31:0] Smallest = 32'h0080_0000;  // 2^-126
  localparam logic [31:0] Largest = 32'h7180_0000;   // 2^100

  // The bound.
  logic [31:0] along_scaled, bent, bent_scaled, whole, whole_later, product, bound;
  logic [63:0] reach;
  fp32_halve u_along_scaled (.clk_i, .en_i, .x_i(reach_i[63:32]), .y_o(along_scaled));
  delay_line #(.Width(64), .Depth(1)) u_reach (.clk_i, .en_i, .d_i(reach_i), .q_o(reach));
  fp32_add u_bent (.clk_i, .en_i, .a_i(reach[31:0]), .b_i(along_scaled), .y_o(bent));
  fp32_add u_whole (.clk_i, .en_i, .a_i(reach[31:0]), .b_i(reach[63:32]), .y_o(whole));
  fp32_halve u_bent_scaled (.clk_i, .en_i, .x_i(bent), .y_o(bent_scaled));
  delay_line #(.Width(32), .Depth(1)) u_whole_later (.clk_i, .en_i, .d_i(whole), .q_o(whole_later));
  fp32_mul u_product (.clk_i, .en_i, .a_i(bent_scaled), .b_i(whole_later), .y_o(product));
  fp32_add u_bound (.clk_i, .en_i, .a_i(product), .b_i(Smallest), .y_o(bound));

  // Whatever the signs, both answers need the lesser magnitude of low and high to be above the bound. A NaN is
  // the first function's, and then both low and high are; it is above nothing.
  logic [31:0] low_uv_q, high_uv_q, edge_w_q, low_q, high_q, margin_q, margin;
  logic signs_differ_q, signs_differ;
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      low_uv_q <= fp32_pkg::smaller(edge_u_i, edge_v_i);
      high_uv_q <= fp32_pkg::larger(edge_u_i, edge_v_i);
      edge_w_q <= edge_w_i;
      low_q <= fp32_pkg::smaller(low_uv_q, edge_w_q);
      high_q <= fp32_pkg::larger(high_uv_q, edge_w_q);
      margin_q <= fp32_pkg::smaller(fp32_pkg::magnitude(low_q), fp32_pkg::magnitude(high_q));
      signs_differ_q <= low_q[31] ^ high_q[31];
    end
  end
  localparam int unsigned Wait = pair_pkg::BoundLatency + pair_pkg::ReachLatency - pair_pkg::EdgeLatency - 3;
  delay_line #(.Width(33), .Depth(Wait)) u_margin (
    .clk_i, .en_i, .d_i({signs_differ_q, margin_q}), .q_o({signs_differ, margin})
  );

  logic is_certain, is_missed_q, is_inside_q;
  assign is_certain = fp32_pkg::is_less(bound, margin) & fp32_pkg::is_less(bound, Largest);
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      is_missed_q <= is_certain & signs_differ;
      is_inside_q <= is_certain & ~signs_differ;
    end
  end
  assign is_missed_o = is_missed_q;
  assign is_inside_o = is_inside_q;

`ifndef SYNTHESIS
  initial begin
    assert (pair_pkg::EdgeLatency == fp32_pkg::MulLatency + fp32_pkg::AddLatency);
    assert (pair_pkg::ReachLatency == fp32_pkg::AddLatency + 2);
    assert (pair_pkg::BoundLatency == 2 * fp32_pkg::AddLatency + fp32_pkg::MulLatency + 2);
  end
`endif

endmodule
