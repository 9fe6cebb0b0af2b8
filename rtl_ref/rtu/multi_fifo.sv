// A queue that takes up to Push items and gives up to Pop items a cycle, in order, held in registers. What is pushed in
// a cycle can be seen in the next; the place of what is popped in a cycle can be used in the next: sim/fifo.hpp.
// Any subset of the inputs may be valid; lower indices enter first. The owner pushes no more than space_o and pops no
// more than valid_o.
module multi_fifo #(
  parameter int unsigned Width = 8,
  parameter int unsigned Depth = 4,
  parameter int unsigned Push  = 1,
  parameter int unsigned Pop   = 1,
  localparam int unsigned CountWidth = $clog2(Depth + 1),
  localparam int unsigned PopWidth = $clog2(Pop + 1)
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,
  input  logic [Push-1:0]       push_i,
  input  logic [Push*Width-1:0] data_i,
  output logic [CountWidth-1:0] space_o,
  output logic [Pop-1:0]        valid_o,   // bit i: there are more than i
  output logic [Pop*Width-1:0]  data_o,    // the oldest in place 0
  output logic [Pop*Width-1:0]  next_o,    // what data_o will be in the next cycle, where there is anything
  input  logic [PopWidth-1:0]   pop_i      // how many of them leave
);

  localparam int unsigned PointerWidth = Depth > 1 ? $clog2(Depth) : 1;
  localparam int unsigned SumWidth = PointerWidth + 3;

  function automatic logic [PointerWidth-1:0] after(input logic [PointerWidth-1:0] place,
                                                    input logic [2:0] steps);
    logic [SumWidth-1:0] sum;
    sum = SumWidth'(place) + SumWidth'(steps);
    if (sum >= SumWidth'(Depth)) sum = sum - SumWidth'(Depth);
    after = sum[PointerWidth-1:0];
  endfunction

  logic [Width-1:0] item_q[Depth];
  logic [PointerWidth-1:0] head_q, head_d, tail_q, tail_d;
  logic [CountWidth-1:0] count_q, count_d;

  // Where each valid input goes.
  logic [PointerWidth-1:0] place[Push];
  always_comb begin
    tail_d = tail_q;
    count_d = count_q - CountWidth'(pop_i);
    for (int unsigned i = 0; i < Push; i++) begin
      place[i] = tail_d;
      if (push_i[i]) begin
        tail_d = after(tail_d, 3'd1);
        count_d = count_d + 1'b1;
      end
    end
    head_d = after(head_q, 3'(pop_i));
  end

  assign space_o = CountWidth'(Depth) - count_q;
  for (genvar i = 0; i < Pop; i++) begin : gen_output
    logic [PointerWidth-1:0] next_place;
    logic [Width-1:0] next;
    assign valid_o[i] = count_q > CountWidth'(i);
    assign data_o[i*Width+:Width] = item_q[after(head_q, 3'(i))];
    assign next_place = after(head_d, 3'(i));
    always_comb begin
      next = item_q[next_place];
      for (int unsigned k = 0; k < Push; k++) begin
        if (push_i[k] && place[k] == next_place) next = data_i[k*Width+:Width];
      end
    end
    assign next_o[i*Width+:Width] = next;
  end

  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < Push; i++) begin
      if (push_i[i]) item_q[place[i]] <= data_i[i*Width+:Width];
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      head_q <= '0;
      tail_q <= '0;
      count_q <= '0;
    end else begin
      head_q <= head_d;
      tail_q <= tail_d;
      count_q <= count_d;
    end
  end

`ifndef SYNTHESIS
  assert property (@(posedge clk_i) disable iff (!rst_ni) $countones(push_i) <= 32'(space_o))
  else $error("pushed to a full queue");
  assert property (@(posedge clk_i) disable iff (!rst_ni) CountWidth'(pop_i) <= count_q)
  else $error("popped from an empty queue");
`endif

endmodule
