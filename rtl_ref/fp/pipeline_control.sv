// Control of a pipeline of Latency stages between two valid/ready streams. All stages move together, in every cycle
// in which the last one is empty or taken (en_o), so a stalled output stops the whole pipeline. valid_o depends on
// registers only; ready_o follows ready_i within the cycle.
module pipeline_control #(
  parameter int unsigned Latency  = 2,  // 2 or more
  parameter int unsigned TagWidth = 1
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  input  logic                valid_i,
  output logic                ready_o,
  input  logic [TagWidth-1:0] tag_i,
  output logic                valid_o,
  input  logic                ready_i,
  output logic [TagWidth-1:0] tag_o,
  output logic                en_o
);

  logic [Latency-1:0] valid_q;

  assign en_o = ready_i | ~valid_o;
  assign ready_o = en_o;
  assign valid_o = valid_q[Latency-1];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) valid_q <= '0;
    else if (en_o) valid_q <= {valid_q[Latency-2:0], valid_i};
  end

  delay_line #(.Width(TagWidth), .Depth(Latency)) u_tag (
    .clk_i, .en_i(en_o), .d_i(tag_i), .q_o(tag_o)
  );

endmodule
