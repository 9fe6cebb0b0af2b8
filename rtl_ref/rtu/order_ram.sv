// What each ray slot asks memory for, read in the order in which it was asked: synchronous reads, which see what is
// written in the same cycle.
module order_ram #(
  parameter int unsigned Width = 45,
  parameter int unsigned Slots = 16,
  parameter int unsigned Lanes = 2,   // readers, and writers
  localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1
) (
  input  logic                       clk_i,
  input  logic [Lanes*SlotWidth-1:0] read_slot_i,
  output logic [Lanes*Width-1:0]     read_data_o,
  input  logic [Lanes-1:0]           write_i,
  input  logic [Lanes*SlotWidth-1:0] write_slot_i,
  input  logic [Lanes*Width-1:0]     write_data_i
);

  logic [Lanes*Width-1:0] stored;
  slot_ram #(.Width(Width), .Slots(Slots), .Reads(Lanes), .Writes(Lanes)) u_ram (
    .clk_i, .read_slot_i, .read_data_o(stored), .write_i, .write_slot_i, .write_data_i
  );

  for (genvar i = 0; i < Lanes; i++) begin : gen_read
    logic is_new_d, is_new_q;
    logic [Width-1:0] new_d, new_q;
    always_comb begin
      is_new_d = 1'b0;
      new_d = write_data_i[Width-1:0];
      for (int unsigned k = 0; k < Lanes; k++) begin
        if (write_i[k] && write_slot_i[k*SlotWidth+:SlotWidth] == read_slot_i[i*SlotWidth+:SlotWidth]) begin
          is_new_d = 1'b1;
          new_d = write_data_i[k*Width+:Width];
        end
      end
    end
    always_ff @(posedge clk_i) begin
      is_new_q <= is_new_d;
      new_q <= new_d;
    end
    assign read_data_o[i*Width+:Width] = is_new_q ? new_q : stored[i*Width+:Width];
  end

endmodule
