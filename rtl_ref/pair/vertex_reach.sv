// How far a sheared vertex lies from the ray's origin, AddLatency later: |x| + |y| and |z|.
module vertex_reach (
  input  logic        clk_i,
  input  logic        en_i,
  input  logic [95:0] sheared_i,
  output logic [63:0] reach_o  // {along, across}
);
  /* verilator no_inline_module */

  fp32_add u_across (
    .clk_i, .en_i, .a_i(fp32_pkg::magnitude(sheared_i[31:0])), .b_i(fp32_pkg::magnitude(sheared_i[63:32])),
    .y_o(reach_o[31:0])
  );
  logic [30:0] along;
  delay_line #(.Width(31), .Depth(fp32_pkg::AddLatency)) u_along (
    .clk_i, .en_i, .d_i(sheared_i[94:64]), .q_o(along)
  );
  assign reach_o[63:32] = {1'b0, along};

endmodule
