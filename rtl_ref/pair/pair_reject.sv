// First pass of the pair test (model/pair_test.cpp): which of a pair's triangles the ray may hit. Bit-equal to the
// model in every build (Mode, see pair_pkg). A pair a cycle; in the single build, two cycles for two triangles.
//
//   stage  1-12  vertices translated and sheared
//         13-20  edge functions                     13-18  reach of the triangle
//         21-23  margin of the signs                19-32  error bound
//            33  comparison
module pair_reject #(
  parameter int unsigned Mode     = pair_pkg::DualShared,
  parameter int unsigned TagWidth = 8
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  input  logic                valid_i,
  output logic                ready_o,
  input  logic [TagWidth-1:0] tag_i,
  input  logic [383:0]        vertices_i,       // as in the memory image: v0, v1, v2, v3
  input  logic                has_second_i,
  input  logic [1:0]          is_degenerate_i,  // triangle 1, triangle 0
  input  logic [95:0]         origin_i,
  input  logic [1:0]          kz_i,             // axis of the largest direction component, 0 to 2
  input  logic [31:0]         shear_x_i,
  input  logic [31:0]         shear_y_i,
  output logic                valid_o,
  input  logic                ready_i,
  output logic [TagWidth-1:0] tag_o,
  output logic [1:0]          goes_on_o,        // triangles that the second pass must decide
  output logic [1:0]          is_inside_o       // of those, the ones whose edges the ray surely passes on one side
);

  logic en;
  logic [95:0] origin, v[4];
  logic [31:0] shear_x, shear_y;

  assign origin = pair_pkg::turned(origin_i, kz_i);
  for (genvar i = 0; i < 4; i++) begin : gen_turned
    assign v[i] = pair_pkg::turned(vertices_i[96*i+:96], kz_i);
  end
  delay_line #(.Width(64), .Depth(fp32_pkg::AddLatency)) u_shear (
    .clk_i, .en_i(en), .d_i({shear_y_i, shear_x_i}), .q_o({shear_y, shear_x})
  );

  // Triangles that are there and have an area.
  logic [1:0] counts;
  assign counts = {has_second_i, 1'b1} & ~is_degenerate_i;

  if (Mode == pair_pkg::Single) begin : gen_single
    // A pair with two triangles stays at the input for a second cycle.
    logic is_second_q, is_last, last_ready, last_valid, is_missed, is_inside;
    logic [1:0] part;  // {is last, counts} of the triangle at the end of the pipeline
    logic [1:0] answer, first_q;  // {is inside, goes on}

    assign is_last = ~has_second_i | is_second_q;
    assign ready_o = last_ready & is_last;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) is_second_q <= 1'b0;
      else if (valid_i & last_ready) is_second_q <= ~is_last;
    end

    pipeline_control #(.Latency(pair_pkg::RejectLatency), .TagWidth(TagWidth + 2)) u_control (
      .clk_i, .rst_ni, .valid_i, .ready_o(last_ready),
      .tag_i({tag_i, is_last, is_second_q ? counts[1] : counts[0]}),
      .valid_o(last_valid), .ready_i(ready_i | ~part[1]), .tag_o({tag_o, part}), .en_o(en)
    );
    triangle_reject u_triangle (
      .clk_i, .en_i(en), .a_i(v[0]), .b_i(is_second_q ? v[2] : v[1]), .c_i(is_second_q ? v[3] : v[2]),
      .origin_i(origin), .shear_x_i(shear_x), .shear_y_i(shear_y), .is_missed_o(is_missed), .is_inside_o(is_inside)
    );
    assign answer = {part[0] & is_inside, part[0] & ~is_missed};

    // The first triangle's answer waits for the second's.
    logic has_first_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) has_first_q <= 1'b0;
      else if (last_valid & en) has_first_q <= ~part[1];
    end
    always_ff @(posedge clk_i) begin
      if (en) first_q <= answer;
    end
    assign valid_o = last_valid & part[1];
    assign goes_on_o = has_first_q ? {answer[0], first_q[0]} : {1'b0, answer[0]};
    assign is_inside_o = has_first_q ? {answer[1], first_q[1]} : {1'b0, answer[1]};
  end else begin : gen_dual
    logic [1:0] counts_later, is_missed, is_inside;

    pipeline_control #(.Latency(pair_pkg::RejectLatency), .TagWidth(TagWidth + 2)) u_control (
      .clk_i, .rst_ni, .valid_i, .ready_o, .tag_i({tag_i, counts}), .valid_o, .ready_i,
      .tag_o({tag_o, counts_later}), .en_o(en)
    );
    assign goes_on_o = counts_later & ~is_missed;
    assign is_inside_o = counts_later & is_inside;
    if (Mode == pair_pkg::DualShared) begin : gen_shared
      shared_reject u_pair (
        .clk_i, .en_i(en), .vertices_i({v[3], v[2], v[1], v[0]}), .origin_i(origin), .shear_x_i(shear_x),
        .shear_y_i(shear_y), .is_missed_o(is_missed), .is_inside_o(is_inside)
      );
    end else begin : gen_independent
      triangle_reject u_triangle_0 (
        .clk_i, .en_i(en), .a_i(v[0]), .b_i(v[1]), .c_i(v[2]), .origin_i(origin), .shear_x_i(shear_x),
        .shear_y_i(shear_y), .is_missed_o(is_missed[0]), .is_inside_o(is_inside[0])
      );
      triangle_reject u_triangle_1 (
        .clk_i, .en_i(en), .a_i(v[0]), .b_i(v[2]), .c_i(v[3]), .origin_i(origin), .shear_x_i(shear_x),
        .shear_y_i(shear_y), .is_missed_o(is_missed[1]), .is_inside_o(is_inside[1])
      );
    end
  end

`ifndef SYNTHESIS
  initial begin
    assert (pair_pkg::ShearLatency == 2 * fp32_pkg::AddLatency + fp32_pkg::MulLatency);
    assert (pair_pkg::RejectLatency ==
            pair_pkg::ShearLatency + pair_pkg::ReachLatency + pair_pkg::BoundLatency + 1);
  end
  stream_check #(.Width(TagWidth + 384 + 165)) u_check_input (
    .clk_i, .rst_ni, .valid_i, .ready_i(ready_o),
    .data_i({tag_i, vertices_i, has_second_i, is_degenerate_i, origin_i, kz_i, shear_x_i, shear_y_i})
  );
  stream_check #(.Width(TagWidth + 4)) u_check_output (
    .clk_i, .rst_ni, .valid_i(valid_o), .ready_i, .data_i({tag_o, goes_on_o, is_inside_o})
  );
  assert property (@(posedge clk_i) disable iff (!rst_ni) valid_i |-> kz_i <= 2'd2)
  else $error("kz is no axis");
`endif

endmodule
