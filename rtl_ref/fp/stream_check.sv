// Checks one side of a valid/ready stream: what is offered stays offered, unchanged, until it is taken.
module stream_check #(
  parameter int unsigned Width = 1
) (
  input logic             clk_i,
  input logic             rst_ni,
  input logic             valid_i,
  input logic             ready_i,
  input logic [Width-1:0] data_i
);

  logic waits_q;
  logic [Width-1:0] data_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) waits_q <= 1'b0;
    else waits_q <= valid_i & ~ready_i;
  end
  always_ff @(posedge clk_i) begin
    if (valid_i & ~ready_i) data_q <= data_i;
  end

  // Not concurrent assertions: Verilator would copy all of data_i in every cycle, to sample it.
  always_ff @(posedge clk_i) begin
    if (rst_ni & waits_q) begin
      assert (valid_i)
      else $error("valid was withdrawn");
      assert (data_i == data_q)
      else $error("data changed while waiting");
    end
  end

endmodule
