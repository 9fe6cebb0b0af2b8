// A queue between two valid/ready streams, held in registers. What is pushed in a cycle can be seen in the next; the
// place of what is popped in a cycle can be used in the next: sim/fifo.hpp. Full rate needs Depth >= 2.
module stream_fifo #(
  parameter int unsigned Width = 8,
  parameter int unsigned Depth = 2
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             valid_i,
  output logic             ready_o,
  input  logic [Width-1:0] data_i,
  output logic             valid_o,
  input  logic             ready_i,
  output logic [Width-1:0] data_o
);

  localparam int unsigned PointerWidth = Depth > 1 ? $clog2(Depth) : 1;
  localparam int unsigned CountWidth = $clog2(Depth + 1);
  localparam logic [PointerWidth-1:0] Last = PointerWidth'(Depth - 1);

  logic [Width-1:0] item_q[Depth];
  logic [PointerWidth-1:0] head_q, tail_q;
  logic [CountWidth-1:0] count_q;
  logic push, pop;

  assign ready_o = count_q != CountWidth'(Depth);
  assign valid_o = count_q != '0;
  assign data_o = item_q[head_q];
  assign push = valid_i & ready_o;
  assign pop = valid_o & ready_i;

  for (genvar i = 0; i < Depth; i++) begin : gen_item
    always_ff @(posedge clk_i) begin
      if (push && tail_q == PointerWidth'(i)) item_q[i] <= data_i;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      head_q <= '0;
      tail_q <= '0;
      count_q <= '0;
    end else begin
      if (push) tail_q <= tail_q == Last ? '0 : tail_q + 1'b1;
      if (pop) head_q <= head_q == Last ? '0 : head_q + 1'b1;
      if (push && !pop) count_q <= count_q + 1'b1;
      if (pop && !push) count_q <= count_q - 1'b1;
    end
  end

`ifndef SYNTHESIS
  stream_check #(.Width(Width)) u_check_input (.clk_i, .rst_ni, .valid_i, .ready_i(ready_o), .data_i);
  stream_check #(.Width(Width)) u_check_output (.clk_i, .rst_ni, .valid_i(valid_o), .ready_i, .data_i(data_o));
`endif

endmodule
