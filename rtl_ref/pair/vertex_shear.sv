// A vertex as the ray sees it, ShearLatency later: the ray runs along z through (0, 0). vertex_i and origin_i are
// turned so that z is the ray's axis; shear_x_i and shear_y_i come AddLatency after them, when they are used.
//
//   A = vertex - origin;  x = A.x - shear_x * A.z;  y = A.y - shear_y * A.z;  z = A.z
module vertex_shear (
  input  logic        clk_i,
  input  logic        en_i,
  input  logic [95:0] vertex_i,
  input  logic [95:0] origin_i,
  input  logic [31:0] shear_x_i,
  input  logic [31:0] shear_y_i,
  output logic [95:0] sheared_o
);
  /* verilator no_inline_module */

  logic [95:0] seen;
  logic [63:0] across, shift;
  logic [31:0] z;

  for (genvar axis = 0; axis < 3; axis++) begin : gen_axis
    fp32_add u_seen (
      .clk_i, .en_i, .a_i(vertex_i[32*axis+:32]), .b_i(fp32_pkg::negated(origin_i[32*axis+:32])),
      .y_o(seen[32*axis+:32])
    );
  end
  fp32_mul u_shift_x (.clk_i, .en_i, .a_i(shear_x_i), .b_i(seen[95:64]), .y_o(shift[31:0]));
  fp32_mul u_shift_y (.clk_i, .en_i, .a_i(shear_y_i), .b_i(seen[95:64]), .y_o(shift[63:32]));
  delay_line #(.Width(64), .Depth(fp32_pkg::MulLatency)) u_across (
    .clk_i, .en_i, .d_i(seen[63:0]), .q_o(across)
  );
  for (genvar axis = 0; axis < 2; axis++) begin : gen_sheared
    fp32_add u_sheared (
      .clk_i, .en_i, .a_i(across[32*axis+:32]), .b_i(fp32_pkg::negated(shift[32*axis+:32])),
      .y_o(sheared_o[32*axis+:32])
    );
  end
  delay_line #(.Width(32), .Depth(fp32_pkg::MulLatency + fp32_pkg::AddLatency)) u_z (
    .clk_i, .en_i, .d_i(seen[95:64]), .q_o(z)
  );
  assign sheared_o[95:64] = z;

endmodule
