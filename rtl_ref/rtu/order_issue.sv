// Turns what rays ask for into requests to the cache, up to two a cycle, in order. An order is a fetch of a node, a
// leaf or a block of the stack, and before it the blocks of the stack that leave. Of two requests in a cycle one may
// be a write. The block that the next cycle may write is read from the stacks ahead.
module order_issue #(
  parameter int unsigned Slots       = 16,
  parameter int unsigned Row         = 19,
  parameter int unsigned NodeSectors = 4,   // of 32 bytes
  parameter int unsigned AddressBits = 32,
  localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1,
  localparam int unsigned PlaceWidth = $clog2(Row),
  localparam int unsigned BlockBits = rtu_pkg::BlockBits,
  localparam int unsigned SpillBits = rtu_pkg::SpillBits,
  localparam int unsigned HeadBits = PlaceWidth + SpillBits + 1 + SlotWidth,
  localparam int unsigned OrderBits = BlockBits + 33
) (
  input  logic                     clk_i,
  input  logic                     rst_ni,
  input  logic [2:0]               block_entries_i,
  input  logic [AddressBits-1:0]   stack_base_i,
  input  logic [15:0]              stack_slot_bytes_i,
  // The two oldest orders, {place of the first block, blocks that leave, is a new ray's, slot}, and the next cycle's.
  input  logic [1:0]               valid_i,
  input  logic [2*HeadBits-1:0]    head_i,
  input  logic [2*HeadBits-1:0]    next_head_i,
  input  logic [2*OrderBits-1:0]   order_i,        // {first block, is a reload, ref}; nothing of a new ray
  output logic [1:0]               pop_o,
  output logic [SlotWidth-1:0]     block_slot_o,   // of the block whose entries block_i shows in the next cycle
  output logic [PlaceWidth-1:0]    block_place_o,
  output logic [1:0]               request_valid_o,
  input  logic [1:0]               request_ready_i,
  output logic [2*AddressBits-1:0] request_address_o,
  output logic [7:0]               request_sectors_o,
  output logic [2*SlotWidth-1:0]   request_slot_o,
  output logic [3:0]               request_to_o,   // rtu_pkg::ToBox ...
  output logic [1:0]               request_is_write_o
);

  localparam int unsigned SpillsAt = SlotWidth + 1, PlaceAt = SpillsAt + SpillBits;
  localparam int unsigned ReloadAt = 32, BlockAt = 33;

  logic [HeadBits-1:0] head[2], next_head[2];
  logic [OrderBits-1:0] order[2];
  for (genvar i = 0; i < 2; i++) begin : gen_order
    assign head[i] = head_i[i*HeadBits+:HeadBits];
    assign next_head[i] = next_head_i[i*HeadBits+:HeadBits];
    assign order[i] = head[i][SlotWidth] ? '0 : order_i[i*OrderBits+:OrderBits];
  end

  logic [SpillBits-1:0] sent_q, sent_d;  // blocks of the oldest order that have left
  logic first_is_spill, second_is_spill, second_is_same;  // second_is_same: both requests are of the oldest order
  logic first_leaves, second_leaves;
  assign first_is_spill = head[0][SpillsAt+:SpillBits] != sent_q;
  assign second_is_same = first_is_spill;
  assign second_is_spill = ~second_is_same & head[1][SpillsAt+:SpillBits] != '0;
  assign request_valid_o[0] = valid_i[0];
  assign request_valid_o[1] = second_is_same ? valid_i[0] & head[0][SpillsAt+:SpillBits] == sent_q + 1'b1 : valid_i[1];
  assign first_leaves = request_valid_o[0] & request_ready_i[0];
  assign second_leaves = request_valid_o[1] & request_ready_i[1] & first_leaves;
  assign pop_o = {1'b0, first_leaves & ~first_is_spill} + {1'b0, second_leaves & ~second_is_spill};

  always_comb begin
    sent_d = sent_q;
    if (second_leaves) sent_d = SpillBits'(second_is_spill);
    else if (first_leaves) sent_d = first_is_spill ? sent_q + 1'b1 : '0;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) sent_q <= '0;
    else sent_q <= sent_d;
  end

  for (genvar i = 0; i < 2; i++) begin : gen_request
    logic [OrderBits-1:0] mine;
    logic [31:0] node_ref;
    logic [SlotWidth-1:0] slot;
    logic [BlockBits-1:0] block;
    logic is_spill, is_stack;
    assign is_spill = i == 0 ? first_is_spill : second_is_spill;
    if (i == 0) begin : gen_first
      assign mine = order[0];
      assign slot = head[0][SlotWidth-1:0];
    end else begin : gen_second
      assign mine = second_is_same ? order[0] : order[1];
      assign slot = second_is_same ? head[0][SlotWidth-1:0] : head[1][SlotWidth-1:0];
    end
    assign node_ref = mine[31:0];
    assign is_stack = is_spill | mine[ReloadAt];
    assign block = mine[BlockAt+:BlockBits] + (i == 0 && first_is_spill ? BlockBits'(sent_q) : '0);
    assign request_slot_o[i*SlotWidth+:SlotWidth] = slot;
    assign request_address_o[i*AddressBits+:AddressBits] =
        is_stack ? stack_base_i + AddressBits'(slot) * AddressBits'(stack_slot_bytes_i) + (AddressBits'(block) << 5)
                 : AddressBits'(node_ref[27:0]) << 6;
    assign request_is_write_o[i] = is_spill;
    always_comb begin
      if (is_stack) begin
        request_sectors_o[4*i+:4] = 4'd1;
        request_to_o[2*i+:2] = 2'(rtu_pkg::ToScheduler);
      end else if (node_ref[31]) begin
        request_sectors_o[4*i+:4] = 4'd2;
        request_to_o[2*i+:2] = 2'(rtu_pkg::ToPair);
      end else begin
        request_sectors_o[4*i+:4] = 4'(NodeSectors);
        request_to_o[2*i+:2] = 2'(rtu_pkg::ToBox);
      end
    end
`ifndef SYNTHESIS
    assert property (@(posedge clk_i) disable iff (!rst_ni)
                     request_valid_o[i] && !is_stack && node_ref[31] |-> node_ref[30:28] == 3'd0)
    else $error("a leaf of several pairs");
`endif
  end

  // The first block that the next cycle can write: of the oldest order then, or of the one behind it.
  logic next_is_spill;
  logic [PlaceWidth+1:0] next_place, in_ring;
  assign next_is_spill = next_head[0][SpillsAt+:SpillBits] != sent_d;
  assign block_slot_o = next_is_spill ? next_head[0][SlotWidth-1:0] : next_head[1][SlotWidth-1:0];
  assign next_place = next_is_spill ? (PlaceWidth + 2)'(next_head[0][PlaceAt+:PlaceWidth]) +
                                          (PlaceWidth + 2)'(sent_d) * (PlaceWidth + 2)'(block_entries_i)
                                    : (PlaceWidth + 2)'(next_head[1][PlaceAt+:PlaceWidth]);
  assign in_ring = next_place >= (PlaceWidth + 2)'(Row) ? next_place - (PlaceWidth + 2)'(Row) : next_place;
  assign block_place_o = in_ring[PlaceWidth-1:0];

endmodule
