// A ray-tracing unit without its cache: scheduler, box unit, pair unit.
//
//   rays -> scheduler -> requests ... node -> box unit ---> scheduler -> hits
//                                     leaf -> pair unit -->
//                                     stack block -------->
module rtu_core #(
  parameter int unsigned Width        = 4,    // children of a node, 2, 4, 6 or 8
  parameter int unsigned Mode         = pair_pkg::DualShared,
  parameter int unsigned HitUnits     = 8,
  parameter int unsigned Slots        = 128,
  parameter int unsigned StackEntries = 16,
  parameter int unsigned TagWidth     = 32,
  parameter int unsigned AddressBits  = 32,
  parameter int unsigned MailboxEntries = 0,
  localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1,
  localparam int unsigned HitBits = rtu_pkg::HitBits,
  localparam int unsigned NodeSectors = 2 * ((28 * Width + 4 + 63) / 64)
) (
  input  logic                       clk_i,
  input  logic                       rst_ni,
  input  logic [SlotWidth-1:0]       last_slot_i,
  input  logic [4:0]                 stack_entries_i,
  input  logic [4:0]                 mailbox_entries_i,
  input  logic [AddressBits-1:0]     stack_base_i,
  input  logic [15:0]                stack_slot_bytes_i,
  // Rays, prepared as by model/ray_setup.hpp. Vectors are {z, y, x}.
  input  logic                       ray_valid_i,
  output logic                       ray_ready_o,
  input  logic [TagWidth-1:0]        ray_tag_i,
  input  logic                       ray_can_hit_i,
  input  logic                       ray_any_hit_i,
  input  logic [95:0]                ray_origin_i,
  input  logic [95:0]                ray_direction_i,
  input  logic [95:0]                ray_origin_near_i,
  input  logic [95:0]                ray_origin_far_i,
  input  logic [95:0]                ray_inv_direction_i,
  input  logic [2:0]                 ray_entry_side_i,
  input  logic [1:0]                 ray_kz_i,
  input  logic [31:0]                ray_shear_x_i,
  input  logic [31:0]                ray_shear_y_i,
  input  logic [31:0]                ray_t_min_i,
  input  logic [31:0]                ray_t_max_i,
  // Finished rays, up to two a cycle.
  output logic [1:0]                 hit_valid_o,
  input  logic [1:0]                 hit_ready_i,
  output logic [2*TagWidth-1:0]      hit_tag_o,
  output logic [1:0]                 hit_found_o,
  output logic [2*HitBits-1:0]       hit_o,         // {primitive id, v, u, t}, when found
  // The cache: requests, and replies as rtu_pkg::ToBox, ToPair, ToScheduler.
  output logic [1:0]                 request_valid_o,
  input  logic [1:0]                 request_ready_i,
  output logic [2*AddressBits-1:0]   request_address_o,
  output logic [7:0]                 request_sectors_o,
  output logic [2*SlotWidth-1:0]     request_slot_o,
  output logic [3:0]                 request_to_o,
  output logic [1:0]                 request_is_write_o,
  output logic [255:0]               request_data_o,
  input  logic [2:0]                 reply_valid_i,
  output logic [2:0]                 reply_ready_o,
  input  logic [3*SlotWidth-1:0]     reply_slot_i,
  input  logic [2*SlotWidth-1:0]     reply_next_slot_i,  // of the oldest reply in the next cycle
  input  logic [NodeSectors*256-1:0] node_i,
  input  logic [511:0]               leaf_i,
  input  logic [255:0]               stack_block_i,
  output logic [1:0]                 mailbox_lookup_o,
  output logic [1:0]                 mailbox_hit_o
);

  localparam int unsigned ToBox = rtu_pkg::ToBox, ToPair = rtu_pkg::ToPair, ToScheduler = rtu_pkg::ToScheduler;

  logic start;
  logic [SlotWidth-1:0] start_slot;
  logic box_valid, box_ready, pair_valid, pair_ready, pair_found, box_has_best, pair_has_best;
  logic [SlotWidth-1:0] box_slot, pair_slot;
  logic [3:0] box_met;
  logic [64*Width-1:0] box_entries;
  logic [HitBits-1:0] pair_hit;
  logic [63:0] pair_best;
  logic [31:0] box_t_best;

  // Rays wait here for a slot, as in the simulator's channel.
  localparam int unsigned RayBits = TagWidth + 2 + 5 * 96 + 3 + 2 + 4 * 32;
  logic ray_valid, ray_ready, can_hit, any_hit;
  logic [TagWidth-1:0] tag;
  logic [95:0] origin, direction, origin_near, origin_far, inv_direction;
  logic [2:0] entry_side;
  logic [1:0] kz, ray_space;
  logic [31:0] shear_x, shear_y, t_min, t_max;
  assign ray_ready_o = ray_space != '0;
  multi_fifo #(.Width(RayBits), .Depth(2)) u_rays (
    .clk_i, .rst_ni, .push_i(ray_valid_i & ray_ready_o),
    .data_i({ray_tag_i, ray_can_hit_i, ray_any_hit_i, ray_origin_i, ray_direction_i, ray_origin_near_i,
             ray_origin_far_i, ray_inv_direction_i, ray_entry_side_i, ray_kz_i, ray_shear_x_i, ray_shear_y_i,
             ray_t_min_i, ray_t_max_i}),
    .space_o(ray_space), .valid_o(ray_valid),
    .data_o({tag, can_hit, any_hit, origin, direction, origin_near, origin_far, inv_direction, entry_side, kz, shear_x,
             shear_y, t_min, t_max}),
    .next_o(), .pop_i(ray_valid & ray_ready)
  );

  scheduler #(
    .Width(Width), .Slots(Slots), .StackEntries(StackEntries), .TagWidth(TagWidth), .AddressBits(AddressBits),
    .MailboxEntries(MailboxEntries)
  ) u_scheduler (
    .clk_i, .rst_ni, .last_slot_i, .stack_entries_i, .mailbox_entries_i, .stack_base_i, .stack_slot_bytes_i,
    .ray_valid_i(ray_valid), .ray_ready_o(ray_ready), .ray_tag_i(tag), .ray_can_hit_i(can_hit), .ray_any_hit_i(any_hit), .ray_t_max_i(t_max),
    .ray_start_o(start), .ray_slot_o(start_slot), .box_valid_i(box_valid), .box_ready_o(box_ready),
    .box_slot_i(box_slot), .box_met_i(box_met), .box_entries_i(box_entries), .pair_valid_i(pair_valid),
    .pair_ready_o(pair_ready), .pair_slot_i(pair_slot), .pair_found_i(pair_found), .pair_hit_i(pair_hit),
    .block_valid_i(reply_valid_i[ToScheduler]), .block_ready_o(reply_ready_o[ToScheduler]),
    .block_slot_i(reply_slot_i[ToScheduler*SlotWidth+:SlotWidth]), .block_i(stack_block_i),
    .box_read_slot_i(reply_next_slot_i[ToBox*SlotWidth+:SlotWidth]), .box_has_best_o(box_has_best),
    .box_t_best_o(box_t_best), .pair_read_slot_i(reply_next_slot_i[ToPair*SlotWidth+:SlotWidth]),
    .pair_has_best_o(pair_has_best), .pair_best_o(pair_best), .request_valid_o, .request_ready_i, .request_address_o,
    .request_sectors_o, .request_slot_o, .request_to_o, .request_is_write_o, .request_data_o, .hit_valid_o,
    .hit_ready_i, .hit_tag_o, .hit_found_o, .hit_o, .mailbox_lookup_o, .mailbox_hit_o
  );

  box_unit #(.Width(Width), .Slots(Slots)) u_box (
    .clk_i, .rst_ni, .ray_start_i(start), .ray_slot_i(start_slot),
    .ray_i({t_max, t_min, entry_side, inv_direction, origin_far, origin_near}),
    .node_valid_i(reply_valid_i[ToBox]), .node_ready_o(reply_ready_o[ToBox]),
    .node_slot_i(reply_slot_i[ToBox*SlotWidth+:SlotWidth]),
    .node_next_slot_i(reply_next_slot_i[ToBox*SlotWidth+:SlotWidth]), .node_i(node_i[224*Width+3:0]),
    .has_best_i(box_has_best), .t_best_i(box_t_best), .valid_o(box_valid), .ready_i(box_ready), .slot_o(box_slot),
    .met_o(box_met), .entries_o(box_entries)
  );

  pair_unit #(.Mode(Mode), .HitUnits(HitUnits), .Slots(Slots)) u_pair (
    .clk_i, .rst_ni, .ray_start_i(start), .ray_slot_i(start_slot),
    .ray_i({t_max, t_min, shear_y, shear_x, kz, direction, origin}), .leaf_valid_i(reply_valid_i[ToPair]),
    .leaf_ready_o(reply_ready_o[ToPair]), .leaf_slot_i(reply_slot_i[ToPair*SlotWidth+:SlotWidth]),
    .leaf_next_slot_i(reply_next_slot_i[ToPair*SlotWidth+:SlotWidth]), .leaf_i, .has_best_i(pair_has_best),
    .best_i(pair_best), .valid_o(pair_valid), .ready_i(pair_ready), .slot_o(pair_slot), .found_o(pair_found),
    .hit_o(pair_hit)
  );

`ifndef SYNTHESIS
  stream_check #(.Width(RayBits)) u_check_ray (
    .clk_i, .rst_ni, .valid_i(ray_valid_i), .ready_i(ray_ready_o),
    .data_i({ray_tag_i, ray_can_hit_i, ray_any_hit_i, ray_origin_i, ray_direction_i, ray_origin_near_i,
             ray_origin_far_i, ray_inv_direction_i, ray_entry_side_i, ray_kz_i, ray_shear_x_i, ray_shear_y_i,
             ray_t_min_i, ray_t_max_i})
  );
  // The second hit, too, stays at its place until the first leaves.
  stream_check #(.Width(TagWidth + 1 + HitBits)) u_check_hit (
    .clk_i, .rst_ni, .valid_i(hit_valid_o[0]), .ready_i(hit_ready_i[0]),
    .data_i({hit_tag_o[0+:TagWidth], hit_found_o[0], hit_o[0+:HitBits]})
  );
  stream_check #(.Width(TagWidth + 1 + HitBits)) u_check_second_hit (
    .clk_i, .rst_ni, .valid_i(hit_valid_o[1]), .ready_i(hit_ready_i[0]),
    .data_i({hit_tag_o[TagWidth+:TagWidth], hit_found_o[1], hit_o[HitBits+:HitBits]})
  );
  stream_check #(.Width(SlotWidth + 4 + 64 * Width)) u_check_box (
    .clk_i, .rst_ni, .valid_i(box_valid), .ready_i(box_ready), .data_i({box_slot, box_met, box_entries})
  );
  stream_check #(.Width(SlotWidth + 1 + HitBits)) u_check_pair (
    .clk_i, .rst_ni, .valid_i(pair_valid), .ready_i(pair_ready), .data_i({pair_slot, pair_found, pair_hit})
  );
  assert property (@(posedge clk_i) disable iff (!rst_ni) hit_ready_i[1] |-> hit_ready_i[0])
  else $error("the second hit is taken before the first");
  assert property (@(posedge clk_i) disable iff (!rst_ni)
                   ray_valid_i |-> stack_entries_i >= 5'd1 && 32'(stack_entries_i) <= StackEntries)
  else $error("a stack of no entry, or of more than there are");
  assert property (@(posedge clk_i) disable iff (!rst_ni) ray_valid_i |-> 32'(mailbox_entries_i) <= MailboxEntries)
  else $error("a mailbox of more entries than there are");
  assert property (@(posedge clk_i) disable iff (!rst_ni) ray_valid_i |-> ray_kz_i <= 2'd2)
  else $error("kz is no axis");
`endif

endmodule
