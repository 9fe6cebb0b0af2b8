// q_o = d_i, Depth enabled cycles later.
module delay_line #(
  parameter int unsigned Width = 32,
  parameter int unsigned Depth = 1
) (
  input  logic             clk_i,
  input  logic             en_i,
  input  logic [Width-1:0] d_i,
  output logic [Width-1:0] q_o
);

  logic [Width-1:0] stage_q[Depth];

  always_ff @(posedge clk_i) begin
    if (en_i) stage_q[0] <= d_i;
  end
  for (genvar i = 1; i < Depth; i++) begin : gen_stage
    always_ff @(posedge clk_i) begin
      if (en_i) stage_q[i] <= stage_q[i-1];
    end
  end
  assign q_o = stage_q[Depth-1];

endmodule
