// A ray-tracing unit with its L1: prepared rays in, hits out, a port to memory. What it computes is bit-equal to
// model/traversal.hpp, and it takes the cycles of sim/rtu.hpp.
//
//            rays                          hits
//             |                             ^
//             v                             |
//          +-----------------------------------+
//     +--->|             scheduler             |<----+
//     |    +-----------------------------------+     |
//     |              | requests     ^ stack blocks   |
//     |              v              |                |
//   +-----+ nodes  +------------------+  leaves  +------+
//   | box |<-------|      cache       |--------->| pair |
//   +-----+        +------------------+          +------+
//                    | memory       ^ fills
//                    v              |
//
// Configuration inputs are constant from the clock edge in reset on.
module rtu #(
  parameter int unsigned Width        = 4,    // children of a node, 2, 4, 6 or 8
  parameter int unsigned Mode         = pair_pkg::DualShared,
  parameter int unsigned HitUnits     = 8,
  parameter int unsigned Slots        = 128,  // most
  parameter int unsigned StackEntries = 16,   // most on chip
  parameter int unsigned TagWidth     = 32,   // of a ray
  parameter int unsigned AddressBits  = 32,
  parameter int unsigned Banks        = 4,    // of the cache; most of each
  parameter int unsigned Sets         = 32,
  parameter int unsigned Ways         = 16,
  parameter int unsigned Mshrs        = 64,
  parameter int unsigned Targets      = 16,
  parameter int unsigned MaxLatency   = 32,
  parameter int unsigned MailboxEntries = 0,  // most of a ray; 0: there is no mailbox
  localparam int unsigned SlotWidth = $clog2(Slots),
  localparam int unsigned HitBits = rtu_pkg::HitBits,
  localparam int unsigned NodeSectors = 2 * ((28 * Width + 4 + 63) / 64),
  localparam int unsigned ReadSectors = NodeSectors > 2 ? NodeSectors : 2
) (
  input  logic                           clk_i,
  input  logic                           rst_ni,
  input  logic [SlotWidth-1:0]           last_slot_i,
  input  logic [4:0]                     stack_entries_i,
  input  logic [4:0]                     mailbox_entries_i,
  input  logic [AddressBits-1:0]         stack_base_i,
  input  logic [15:0]                    stack_slot_bytes_i,
  input  logic [$clog2(Sets)-1:0]        set_mask_i,
  input  logic [$clog2(Ways)-1:0]        last_way_i,
  input  logic [$clog2(Banks)-1:0]       bank_mask_i,
  input  logic [$clog2(Mshrs)-1:0]       last_mshr_i,
  input  logic [$clog2(Targets)-1:0]     last_target_i,
  input  logic [$clog2(MaxLatency)-1:0]  last_latency_i,
  output logic                           is_ready_o,         // some cycles after reset; offer no ray before
  input  logic                           ray_valid_i,
  output logic                           ray_ready_o,
  input  logic [TagWidth-1:0]            ray_tag_i,
  input  logic                           ray_can_hit_i,
  input  logic                           ray_any_hit_i,
  input  logic [95:0]                    ray_origin_i,
  input  logic [95:0]                    ray_direction_i,
  input  logic [95:0]                    ray_origin_near_i,
  input  logic [95:0]                    ray_origin_far_i,
  input  logic [95:0]                    ray_inv_direction_i,
  input  logic [2:0]                     ray_entry_side_i,
  input  logic [1:0]                     ray_kz_i,
  input  logic [31:0]                    ray_shear_x_i,
  input  logic [31:0]                    ray_shear_y_i,
  input  logic [31:0]                    ray_t_min_i,
  input  logic [31:0]                    ray_t_max_i,
  output logic [1:0]                     hit_valid_o,
  input  logic [1:0]                     hit_ready_i,
  output logic [2*TagWidth-1:0]          hit_tag_o,
  output logic [1:0]                     hit_found_o,
  output logic [2*HitBits-1:0]           hit_o,
  output logic                           mem_valid_o,
  input  logic                           mem_ready_i,
  output logic                           mem_is_write_o,
  output logic [AddressBits-8:0]         mem_line_o,
  output logic [3:0]                     mem_sectors_o,
  output logic [1023:0]                  mem_data_o,
  output logic [$clog2(Mshrs)+3:0]       mem_id_o,
  input  logic                           fill_valid_i,
  output logic                           fill_ready_o,
  input  logic [$clog2(Mshrs)+3:0]       fill_id_i,
  input  logic [1023:0]                  fill_data_i,
  // What happens in the cycle, for counters: a node is tested, its children; a pair is tested, it has a second
  // triangle; stack blocks written (one at most) and asked for; leaves that mailboxes were asked for, those known.
  output logic                           node_visit_o,
  output logic [3:0]                     node_children_o,
  output logic                           pair_test_o,
  output logic                           pair_has_second_o,
  output logic                           block_write_o,
  output logic [1:0]                     block_read_o,
  output logic [1:0]                     mailbox_lookup_o,
  output logic [1:0]                     mailbox_hit_o,
  output logic [7*Banks+6:0]             cache_events_o
);

  // Configuration registers: nothing depends on the inputs within a cycle.
  logic [SlotWidth-1:0] last_slot_q;
  logic [5-1:0] stack_entries_q, mailbox_entries_q;
  logic [AddressBits-1:0] stack_base_q;
  logic [16-1:0] stack_slot_bytes_q;
  logic [$clog2(Sets)-1:0] set_mask_q;
  logic [$clog2(Ways)-1:0] last_way_q;
  logic [$clog2(Banks)-1:0] bank_mask_q;
  logic [$clog2(Mshrs)-1:0] last_mshr_q;
  logic [$clog2(Targets)-1:0] last_target_q;
  logic [$clog2(MaxLatency)-1:0] last_latency_q;
  always_ff @(posedge clk_i) begin
    last_slot_q <= last_slot_i;
    stack_entries_q <= stack_entries_i;
    mailbox_entries_q <= mailbox_entries_i;
    stack_base_q <= stack_base_i;
    stack_slot_bytes_q <= stack_slot_bytes_i;
    set_mask_q <= set_mask_i;
    last_way_q <= last_way_i;
    bank_mask_q <= bank_mask_i;
    last_mshr_q <= last_mshr_i;
    last_target_q <= last_target_i;
    last_latency_q <= last_latency_i;
  end

  logic [1:0] request_valid, request_ready, request_is_write;
  logic [2*AddressBits-1:0] request_address;
  logic [7:0] request_sectors;
  logic [2*SlotWidth-1:0] request_slot;
  logic [3:0] request_to;
  logic [255:0] request_data, stack_block;
  logic [2:0] reply_valid, reply_ready;
  logic [3*SlotWidth-1:0] reply_slot, reply_next_slot;
  logic [ReadSectors*256-1:0] node;
  logic [511:0] leaf;

  rtu_core #(
    .Width(Width), .Mode(Mode), .HitUnits(HitUnits), .Slots(Slots), .StackEntries(StackEntries), .TagWidth(TagWidth),
    .AddressBits(AddressBits), .MailboxEntries(MailboxEntries)
  ) u_core (
    .clk_i, .rst_ni, .last_slot_i(last_slot_q), .stack_entries_i(stack_entries_q),
    .mailbox_entries_i(mailbox_entries_q), .stack_base_i(stack_base_q), .stack_slot_bytes_i(stack_slot_bytes_q), .ray_valid_i, .ray_ready_o, .ray_tag_i, .ray_can_hit_i, .ray_any_hit_i,
    .ray_origin_i, .ray_direction_i, .ray_origin_near_i, .ray_origin_far_i, .ray_inv_direction_i, .ray_entry_side_i,
    .ray_kz_i, .ray_shear_x_i, .ray_shear_y_i, .ray_t_min_i, .ray_t_max_i, .hit_valid_o, .hit_ready_i, .hit_tag_o,
    .hit_found_o, .hit_o, .request_valid_o(request_valid), .request_ready_i(request_ready),
    .request_address_o(request_address), .request_sectors_o(request_sectors), .request_slot_o(request_slot),
    .request_to_o(request_to), .request_is_write_o(request_is_write), .request_data_o(request_data),
    .reply_valid_i(reply_valid), .reply_ready_o(reply_ready), .reply_slot_i(reply_slot),
    .reply_next_slot_i(reply_next_slot[2*SlotWidth-1:0]), .node_i(node[256*NodeSectors-1:0]), .leaf_i(leaf),
    .stack_block_i(stack_block), .mailbox_lookup_o, .mailbox_hit_o
  );

  cache #(
    .Banks(Banks), .Sets(Sets), .Ways(Ways), .Mshrs(Mshrs), .Targets(Targets), .Tags(Slots),
    .AddressBits(AddressBits), .MaxLatency(MaxLatency), .ReadSectors(ReadSectors)
  ) u_cache (
    .clk_i, .rst_ni, .set_mask_i(set_mask_q), .last_way_i(last_way_q), .bank_mask_i(bank_mask_q),
    .last_mshr_i(last_mshr_q), .last_target_i(last_target_q), .last_latency_i(last_latency_q), .is_ready_o,
    .request_valid_i(request_valid), .request_ready_o(request_ready), .request_address_i(request_address),
    .request_sectors_i(request_sectors), .request_tag_i(request_slot), .request_source_i(request_to),
    .request_is_write_i(request_is_write), .request_data_i({2{request_data}}), .reply_valid_o(reply_valid),
    .reply_ready_i(reply_ready), .reply_tag_o(reply_slot), .reply_next_tag_o(reply_next_slot), .node_o(node),
    .leaf_o(leaf), .stack_block_o(stack_block), .mem_valid_o, .mem_ready_i, .mem_is_write_o, .mem_line_o,
    .mem_sectors_o, .mem_data_o, .mem_id_o, .fill_valid_i, .fill_ready_o, .fill_id_i, .fill_data_i,
    .events_o(cache_events_o)
  );

  logic [1:0] request_leaves, is_block;
  assign request_leaves = request_valid & request_ready & {request_ready[0], 1'b1};
  for (genvar i = 0; i < 2; i++) begin : gen_event
    assign is_block[i] = request_leaves[i] & request_to[2*i+:2] == 2'(rtu_pkg::ToScheduler);
  end
  assign block_write_o = |(is_block & request_is_write);
  assign block_read_o = is_block & ~request_is_write;
  assign node_visit_o = reply_valid[rtu_pkg::ToBox] & reply_ready[rtu_pkg::ToBox];
  assign node_children_o = node[224*Width+:4];
  assign pair_test_o = reply_valid[rtu_pkg::ToPair] & reply_ready[rtu_pkg::ToPair];
  assign pair_has_second_o = leaf[448];  // flags of the pair, bit 0

endmodule
