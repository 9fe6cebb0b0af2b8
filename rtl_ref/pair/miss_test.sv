// Whether the edge functions of a triangle have different signs by more than their rounding errors may amount to, as
// is_missed() in model/pair_test.cpp: low < -bound, high > bound and bound < 2^100, where low and high are the
// least and the largest of the three and
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
  output logic        is_missed_o
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

  // The farther from zero the weaker of the two signs is, the surer: least of -low and high. A NaN means nothing.
  logic [31:0] low_uv_q, high_uv_q, edge_w_q, low_q, high_q, weaker_d, weaker_q, weaker;
  always_comb begin
    weaker_d = fp32_pkg::smaller(fp32_pkg::negated(low_q), high_q);
    if (fp32_pkg::is_nan(low_q) | fp32_pkg::is_nan(high_q)) weaker_d = fp32_pkg::QuietNan;
  end
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      low_uv_q <= fp32_pkg::smaller(edge_u_i, edge_v_i);
      high_uv_q <= fp32_pkg::larger(edge_u_i, edge_v_i);
      edge_w_q <= edge_w_i;
      low_q <= fp32_pkg::smaller(low_uv_q, edge_w_q);
      high_q <= fp32_pkg::larger(high_uv_q, edge_w_q);
      weaker_q <= weaker_d;
    end
  end
  localparam int unsigned Wait = pair_pkg::BoundLatency + pair_pkg::ReachLatency - pair_pkg::EdgeLatency - 3;
  delay_line #(.Width(32), .Depth(Wait)) u_weaker (.clk_i, .en_i, .d_i(weaker_q), .q_o(weaker));

  logic is_missed_q;
  always_ff @(posedge clk_i) begin
    if (en_i) is_missed_q <= fp32_pkg::is_less(bound, weaker) & fp32_pkg::is_less(bound, Largest);
  end
  assign is_missed_o = is_missed_q;

endmodule
