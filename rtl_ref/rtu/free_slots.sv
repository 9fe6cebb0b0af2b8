// Free ray slots, last in, first out; those never used yet come in order, 0 first, after all that were given back.
module free_slots #(
  parameter int unsigned Slots  = 16,
  parameter int unsigned Frees  = 2,  // slots given back a cycle, at most
  localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1
) (
  input  logic                       clk_i,
  input  logic                       rst_ni,
  input  logic [SlotWidth-1:0]       last_slot_i,  // slots in use - 1, constant
  output logic                       valid_o,
  output logic [SlotWidth-1:0]       slot_o,
  input  logic                       take_i,       // requires valid_o
  input  logic [Frees-1:0]           free_i,
  input  logic [Frees*SlotWidth-1:0] free_slot_i   // lower indices are given back first
);

  localparam int unsigned CountWidth = $clog2(Slots + 1);

  logic [SlotWidth-1:0] slot_q[Slots];
  logic [CountWidth-1:0] count_q, count_d;  // of slots that were given back
  logic [CountWidth-1:0] fresh_q;           // the next never used
  logic has_returned;

  assign has_returned = count_q != '0;
  assign valid_o = has_returned | fresh_q <= CountWidth'(last_slot_i);
  assign slot_o = has_returned ? slot_q[SlotWidth'(count_q - 1'b1)] : fresh_q[SlotWidth-1:0];

  logic [SlotWidth-1:0] place[Frees];
  always_comb begin
    count_d = take_i && has_returned ? count_q - 1'b1 : count_q;
    for (int unsigned i = 0; i < Frees; i++) begin
      place[i] = count_d[SlotWidth-1:0];
      if (free_i[i]) count_d = count_d + 1'b1;
    end
  end

  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < Frees; i++) begin
      if (free_i[i]) slot_q[place[i]] <= free_slot_i[i*SlotWidth+:SlotWidth];
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      count_q <= '0;
      fresh_q <= '0;
    end else begin
      count_q <= count_d;
      if (take_i && !has_returned) fresh_q <= fresh_q + 1'b1;
    end
  end

`ifndef SYNTHESIS
  assert property (@(posedge clk_i) disable iff (!rst_ni) take_i |-> valid_o) else $error("no slot is free");
  assert property (@(posedge clk_i) disable iff (!rst_ni) 32'(count_d) <= Slots)
  else $error("a slot was given back twice");
`endif

endmodule
