// The stacks of all ray slots, a memory of whole rows: each lane reads the row of its slot and writes any of its
// entries; a block of neighbouring entries is read for spilling. Reads give their data in the cycle after the address.
// The read of a block sees what is written in the same cycle; those of rows need not, as a slot's stack is written long
// before it is read.
module stack_ram #(
  parameter int unsigned Slots = 16,
  parameter int unsigned Row   = 19,
  parameter int unsigned Lanes = 2,
  localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1,
  localparam int unsigned PlaceWidth = $clog2(Row)
) (
  input  logic                       clk_i,
  input  logic [Lanes*SlotWidth-1:0] read_slot_i,
  output logic [Lanes*64*Row-1:0]    row_o,
  input  logic [SlotWidth-1:0]       block_slot_i,
  input  logic [PlaceWidth-1:0]      block_place_i,  // of the lowest entry
  output logic [255:0]               block_o,
  input  logic [Lanes*Row-1:0]       write_i,
  input  logic [Lanes*SlotWidth-1:0] write_slot_i,
  input  logic [Lanes*64*Row-1:0]    write_row_i
);

  logic [64*Row-1:0] block_row;
  logic [PlaceWidth-1:0] block_place_q;

  for (genvar i = 0; i < Row; i++) begin : gen_entry
    logic [Lanes-1:0] write;
    logic [Lanes*64-1:0] data;
    logic [(Lanes+1)*64-1:0] read_data;
    for (genvar lane = 0; lane < Lanes; lane++) begin : gen_lane
      assign write[lane] = write_i[lane*Row+i];
      assign data[64*lane+:64] = write_row_i[64*(lane*Row+i)+:64];
      assign row_o[64*(lane*Row+i)+:64] = read_data[64*lane+:64];
    end
    slot_ram #(.Width(64), .Slots(Slots), .Reads(Lanes + 1), .Writes(Lanes)) u_ram (
      .clk_i, .read_slot_i({block_slot_i, read_slot_i}), .read_data_o(read_data), .write_i(write),
      .write_slot_i, .write_data_i(data)
    );

    // What is written while it is read.
    logic is_new_d, is_new_q;
    logic [63:0] new_d, new_q;
    always_comb begin
      is_new_d = 1'b0;
      new_d = data[63:0];
      for (int unsigned lane = 0; lane < Lanes; lane++) begin
        if (write[lane] && write_slot_i[lane*SlotWidth+:SlotWidth] == block_slot_i) begin
          is_new_d = 1'b1;
          new_d = data[64*lane+:64];
        end
      end
    end
    always_ff @(posedge clk_i) begin
      is_new_q <= is_new_d;
      new_q <= new_d;
    end
    assign block_row[64*i+:64] = is_new_q ? new_q : read_data[64*Lanes+:64];
  end

  always_ff @(posedge clk_i) block_place_q <= block_place_i;
  for (genvar i = 0; i < rtu_pkg::BlockEntries; i++) begin : gen_block
    logic [PlaceWidth+1:0] place;
    assign place = (PlaceWidth + 2)'(block_place_q) + (PlaceWidth + 2)'(i);
    logic [PlaceWidth+1:0] in_ring;
    assign in_ring = place >= (PlaceWidth + 2)'(Row) ? place - (PlaceWidth + 2)'(Row) : place;
    assign block_o[64*i+:64] = block_row[64*in_ring[PlaceWidth-1:0]+:64];
  end

endmodule
