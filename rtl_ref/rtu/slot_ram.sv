// A word for each ray slot: a memory with synchronous reads (data in the cycle after the address) and a write port for
// each writer. A read does not see what is written in the same cycle; no two writers share an address in a cycle.
// An array, not gates: Yosys sees no body, and docs/area.md counts its bits.
(* blackbox *)
module slot_ram #(
  parameter int unsigned Width  = 32,
  parameter int unsigned Slots  = 16,
  parameter int unsigned Reads  = 1,
  parameter int unsigned Writes = 1,
  localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1
) (
  input  logic                        clk_i,
  input  logic [Reads*SlotWidth-1:0]  read_slot_i,
  output logic [Reads*Width-1:0]      read_data_o,
  input  logic [Writes-1:0]           write_i,
  input  logic [Writes*SlotWidth-1:0] write_slot_i,
  input  logic [Writes*Width-1:0]     write_data_i
);

  logic [Width-1:0] word_q[Slots];

  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < Reads; i++) begin
      read_data_o[i*Width+:Width] <= word_q[read_slot_i[i*SlotWidth+:SlotWidth]];
    end
  end
  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < Writes; i++) begin
      if (write_i[i]) word_q[write_slot_i[i*SlotWidth+:SlotWidth]] <= write_data_i[i*Width+:Width];
    end
  end

endmodule
