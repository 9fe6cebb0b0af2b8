// Gives rays their slots, decides what each asks memory for next, and hands finished rays back: the circuit that
// sim/ray_scheduler.hpp times.
//
//   stage 1  up to two results are taken; their slots' stacks, best hits and states are addressed
//         2  a found hit replaces the best; every entry on the stack is compared with it
//         3  where the ray goes on (ray_step); its stack, best hit and state are written, its slot is given back
//         4  what it asks for leaves, if nothing is queued ahead of it; or its hit does
//
// With a mailbox, the leaf of stage 3 is looked up within the stage. A ray whose leaf is known asks for nothing: it
// begins anew at stage 1, in the cycle after stage 4 at the soonest, ahead of results.
//
// A ray is accepted beside that: its root's fetch is queued at once. Two lanes work side by side, on different rays: a
// ray has one thing under way at a time, so whoever holds its slot's number is the only one to touch the slot.
module scheduler #(
  parameter int unsigned Width        = 4,    // children of a node
  parameter int unsigned Slots        = 128,  // most ray slots
  parameter int unsigned StackEntries = 16,   // most entries of a stack on chip
  parameter int unsigned TagWidth     = 32,
  parameter int unsigned AddressBits  = 32,
  parameter int unsigned MailboxEntries = 0,  // most entries of a ray's mailbox, 0 to 16; 0: there is none
  localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1,
  localparam int unsigned HitBits = rtu_pkg::HitBits,
  localparam int unsigned NodeSectors = 2 * ((28 * Width + 4 + 63) / 64)
) (
  input  logic                     clk_i,
  input  logic                     rst_ni,
  // Configuration, constant from reset on.
  input  logic [SlotWidth-1:0]     last_slot_i,      // slots in use - 1
  input  logic [4:0]               stack_entries_i,  // in use, 1 to StackEntries
  input  logic [4:0]               mailbox_entries_i,  // in use, 0 to MailboxEntries
  input  logic [AddressBits-1:0]   stack_base_i,
  input  logic [15:0]              stack_slot_bytes_i,
  // Rays.
  input  logic                     ray_valid_i,
  output logic                     ray_ready_o,
  input  logic [TagWidth-1:0]      ray_tag_i,
  input  logic                     ray_can_hit_i,    // otherwise it is handed back at once
  input  logic                     ray_any_hit_i,
  input  logic [31:0]              ray_t_max_i,
  output logic                     ray_start_o,      // it goes into slot ray_slot_o
  output logic [SlotWidth-1:0]     ray_slot_o,
  // Results: children met, nearest first; a better hit or none; a block of the stack.
  input  logic                     box_valid_i,
  output logic                     box_ready_o,
  input  logic [SlotWidth-1:0]     box_slot_i,
  input  logic [3:0]               box_met_i,
  input  logic [64*Width-1:0]      box_entries_i,
  input  logic                     pair_valid_i,
  output logic                     pair_ready_o,
  input  logic [SlotWidth-1:0]     pair_slot_i,
  input  logic                     pair_found_i,
  input  logic [HitBits-1:0]       pair_hit_i,
  input  logic                     block_valid_i,
  output logic                     block_ready_o,
  input  logic [SlotWidth-1:0]     block_slot_i,
  input  logic [255:0]             block_i,
  // Best hits for the testers: of the slot in the cycle before.
  input  logic [SlotWidth-1:0]     box_read_slot_i,
  output logic                     box_has_best_o,
  output logic [31:0]              box_t_best_o,
  input  logic [SlotWidth-1:0]     pair_read_slot_i,
  output logic                     pair_has_best_o,
  output logic [63:0]              pair_best_o,      // {primitive id, t}
  // Requests to the cache.
  output logic [1:0]               request_valid_o,
  input  logic [1:0]               request_ready_i,
  output logic [2*AddressBits-1:0] request_address_o,
  output logic [7:0]               request_sectors_o,
  output logic [2*SlotWidth-1:0]   request_slot_o,
  output logic [3:0]               request_to_o,
  output logic [1:0]               request_is_write_o,
  output logic [255:0]             request_data_o,   // of the one that is a write
  // Finished rays, two a cycle: 1 only beside 0.
  output logic [1:0]               hit_valid_o,
  input  logic [1:0]               hit_ready_i,      // 1 only beside 0
  output logic [2*TagWidth-1:0]    hit_tag_o,
  output logic [1:0]               hit_found_o,
  output logic [2*HitBits-1:0]     hit_o,
  // For counters, a bit a lane: a mailbox is asked for a leaf; it is known.
  output logic [1:0]               mailbox_lookup_o,
  output logic [1:0]               mailbox_hit_o
);

  localparam int unsigned Lanes = 2;
  localparam int unsigned Row = StackEntries + Width - 1;
  localparam int unsigned PlaceWidth = $clog2(Row);
  localparam int unsigned CountWidth = $clog2(Row + 1);
  localparam int unsigned BlockBits = rtu_pkg::BlockBits;
  localparam int unsigned SpillBits = rtu_pkg::SpillBits;
  localparam int unsigned Payload = 64 * (Width > 4 ? Width : 4);
  localparam int unsigned StateBits = PlaceWidth + CountWidth + BlockBits;
  localparam int unsigned HeadBits = PlaceWidth + SpillBits + 1 + SlotWidth;  // of an order: as order_issue wants it
  localparam int unsigned OrderBits = BlockBits + 33;
  localparam int unsigned BoxResult = 64 * Width + 4 + SlotWidth;
  localparam int unsigned PairResult = HitBits + 1 + SlotWidth;
  localparam int unsigned HitResult = HitBits + 1 + TagWidth;
  // Room for all that is on its way when no more is taken: two lanes in three stages, and a ray that hits nothing.
  localparam int unsigned HitQueue = 16, HitReserve = 10;
  localparam int unsigned NumberBits = 28, FromPassed = 3;
  localparam int unsigned HitSpaceWidth = $clog2(HitQueue + 1);

  logic [2:0] block_entries;
  assign block_entries = stack_entries_i < 5'd4 ? stack_entries_i[2:0] : 3'd4;

  // ---- Results, waiting. The cache holds blocks in a queue of its own.
  logic [1:0] box_valid, pair_valid;
  logic [2*BoxResult-1:0] box_result;
  logic [2*PairResult-1:0] pair_result;
  logic [3:0] box_space;
  logic [2:0] pair_space;
  logic [5:0] pop;
  logic [1:0] passed_valid, passed_pop;
  logic [2*SlotWidth-1:0] passed_slot;

  multi_fifo #(.Width(BoxResult), .Depth(8), .Pop(2)) u_box_results (
    .clk_i, .rst_ni, .push_i(box_valid_i & box_ready_o), .data_i({box_entries_i, box_met_i, box_slot_i}),
    .space_o(box_space), .valid_o(box_valid), .data_o(box_result), .next_o(), .pop_i(pop[2*rtu_pkg::FromBox+:2])
  );
  multi_fifo #(.Width(PairResult), .Depth(4), .Pop(2)) u_pair_results (
    .clk_i, .rst_ni, .push_i(pair_valid_i & pair_ready_o), .data_i({pair_hit_i, pair_found_i, pair_slot_i}),
    .space_o(pair_space), .valid_o(pair_valid), .data_o(pair_result), .next_o(), .pop_i(pop[2*rtu_pkg::FromPair+:2])
  );
  assign box_ready_o = box_space != '0;
  assign pair_ready_o = pair_space != '0;
  assign block_ready_o = pop[2*rtu_pkg::FromStack];

  // ---- Stage 1: take.
  logic [HitSpaceWidth-1:0] hit_space;
  logic has_room;
  logic [Lanes-1:0] take, place;
  logic [2*Lanes-1:0] source;
  assign has_room = hit_space >= HitSpaceWidth'(HitReserve);
  result_select #(.Passes(MailboxEntries > 0)) u_select (
    .clk_i, .rst_ni, .enable_i(has_room), .valid_i({1'b0, block_valid_i, box_valid, pair_valid}),
    .passed_valid_i(passed_valid), .valid_o(take), .source_o(source), .place_o(place), .pop_o(pop),
    .passed_pop_o(passed_pop)
  );

  logic [Lanes*SlotWidth-1:0] take_slot;
  logic [Lanes-1:0] valid_2_q, valid_3_q, valid_4_q;
  logic [Lanes*SlotWidth-1:0] slot_2_q, slot_3_q;
  logic [Payload-1:0] payload_2_q[Lanes], payload_3_q[Lanes];
  logic [3:0] met_2_q[Lanes], met_3_q[Lanes];
  logic [Lanes-1:0] is_block_2_q, is_block_3_q, found_2_q, found_3_q;

  for (genvar lane = 0; lane < Lanes; lane++) begin : gen_take
    logic [BoxResult-1:0] box;
    logic [PairResult-1:0] pair;
    logic from_box, from_pair, from_passed;
    logic [Payload-1:0] payload;
    assign box = place[lane] ? box_result[BoxResult+:BoxResult] : box_result[0+:BoxResult];
    assign pair = place[lane] ? pair_result[PairResult+:PairResult] : pair_result[0+:PairResult];
    assign from_box = source[2*lane+:2] == 2'(rtu_pkg::FromBox);
    assign from_pair = source[2*lane+:2] == 2'(rtu_pkg::FromPair);
    assign from_passed = MailboxEntries > 0 && source[2*lane+:2] == 2'(FromPassed);
    always_comb begin
      if (from_box) begin
        take_slot[lane*SlotWidth+:SlotWidth] = box[SlotWidth-1:0];
        payload = Payload'(box[SlotWidth+4+:64*Width]);
      end else if (from_pair) begin
        take_slot[lane*SlotWidth+:SlotWidth] = pair[SlotWidth-1:0];
        payload = Payload'(pair[SlotWidth+1+:HitBits]);
      end else if (from_passed) begin
        take_slot[lane*SlotWidth+:SlotWidth] = passed_slot[(place[lane]?SlotWidth:0)+:SlotWidth];
        payload = Payload'(block_i);
      end else begin
        take_slot[lane*SlotWidth+:SlotWidth] = block_slot_i;
        payload = Payload'(block_i);
      end
    end
    always_ff @(posedge clk_i) begin
      slot_2_q[lane*SlotWidth+:SlotWidth] <= take_slot[lane*SlotWidth+:SlotWidth];
      payload_2_q[lane] <= payload;
      met_2_q[lane] <= from_box ? box[SlotWidth+:4] : '0;
      is_block_2_q[lane] <= ~from_box & ~from_pair & ~from_passed;
      found_2_q[lane] <= from_pair & pair[SlotWidth];
    end
  end

  // ---- Stage 2: the best hit, and what of the stack it leaves.
  logic [Lanes*64*Row-1:0] row;
  logic [Lanes*StateBits-1:0] state;
  logic [Lanes*HitBits-1:0] best;
  logic [Lanes*(TagWidth+33)-1:0] ray;
  logic [Slots-1:0] has_stack_q, has_best_q;  // since it was accepted, the slot got a stack; a hit
  logic [Lanes-1:0] had_stack_q, had_best_q;

  logic [32*Row-1:0] refs_3_q[Lanes];
  logic [Row-1:0] low_3_q[Lanes], high_3_q[Lanes];
  logic [PlaceWidth-1:0] base_3_q[Lanes], free_3_q[Lanes];
  logic [CountWidth-1:0] pushed_3_q[Lanes];
  logic [BlockBits-1:0] blocks_3_q[Lanes];
  logic [Lanes-1:0] is_satisfied_3_q, has_best_3_q;
  logic [HitBits-1:0] best_3_q[Lanes];
  logic [TagWidth-1:0] tag_3_q[Lanes];

  for (genvar lane = 0; lane < Lanes; lane++) begin : gen_compare
    logic [64*Row-1:0] entries;
    logic [32*Row-1:0] refs, t_near;
    logic [PlaceWidth-1:0] base;
    logic [CountWidth-1:0] count;
    logic [BlockBits-1:0] blocks;
    logic [HitBits-1:0] best_now;
    logic has_best_now, any_hit;
    logic [31:0] t_max;
    logic [Row-1:0] low, high;
    logic [CountWidth:0] end_place, in_ring;

    assign {any_hit, t_max} = ray[lane*(TagWidth+33)+TagWidth+:33];
    assign has_best_now = had_best_q[lane] | found_2_q[lane];
    assign best_now = found_2_q[lane] ? payload_2_q[lane][HitBits-1:0] : best[lane*HitBits+:HitBits];
    always_comb begin
      entries = row[lane*64*Row+:64*Row];
      if (is_block_2_q[lane]) entries[255:0] = payload_2_q[lane][255:0];
      {blocks, count, base} = had_stack_q[lane] ? state[lane*StateBits+:StateBits] : '0;
      if (is_block_2_q[lane]) begin
        base = '0;
        count = CountWidth'(block_entries);
        blocks = blocks - 1'b1;
      end
    end
    for (genvar i = 0; i < Row; i++) begin : gen_ref
      assign {refs[32*i+:32], t_near[32*i+:32]} = entries[64*i+:64];
    end
    stack_survivors #(.Row(Row)) u_survivors (
      .t_near_i(t_near), .base_i(base), .count_i(count), .t_end_i(has_best_now ? best_now[31:0] : t_max),
      .low_o(low), .high_o(high)
    );
    assign end_place = (CountWidth + 1)'(base) + (CountWidth + 1)'(count);
    assign in_ring = end_place >= (CountWidth + 1)'(Row) ? end_place - (CountWidth + 1)'(Row) : end_place;
    always_ff @(posedge clk_i) begin
      payload_3_q[lane] <= payload_2_q[lane];
      met_3_q[lane] <= met_2_q[lane];
      is_block_3_q[lane] <= is_block_2_q[lane];
      found_3_q[lane] <= found_2_q[lane];
      refs_3_q[lane] <= refs;
      low_3_q[lane] <= low;
      high_3_q[lane] <= high;
      base_3_q[lane] <= base;
      free_3_q[lane] <= in_ring[PlaceWidth-1:0];
      pushed_3_q[lane] <= count + CountWidth'(met_2_q[lane]) - 1'b1;
      blocks_3_q[lane] <= blocks;
      is_satisfied_3_q[lane] <= any_hit & has_best_now;
      has_best_3_q[lane] <= has_best_now;
      best_3_q[lane] <= best_now;
      tag_3_q[lane] <= ray[lane*(TagWidth+33)+:TagWidth];
    end
  end
  always_ff @(posedge clk_i) begin
    slot_3_q <= slot_2_q;
    for (int unsigned lane = 0; lane < Lanes; lane++) begin
      had_stack_q[lane] <= has_stack_q[take_slot[lane*SlotWidth+:SlotWidth]];
      had_best_q[lane] <= has_best_q[take_slot[lane*SlotWidth+:SlotWidth]];
    end
    box_has_best_o <= has_best_q[box_read_slot_i];
    pair_has_best_o <= has_best_q[pair_read_slot_i];
  end

  // ---- Stage 3: decide, and write it down.
  logic [Lanes-1:0] ends, order_valid, best_write, to_leaf, is_known;
  logic [Lanes*NumberBits-1:0] number;  // of the leaf's pair
  logic [Lanes*HeadBits-1:0] new_head;
  logic [Lanes*OrderBits-1:0] new_order;
  logic [Lanes*Row-1:0] entry_write;
  logic [Lanes*64*Row-1:0] new_row;
  logic [Lanes*StateBits-1:0] new_state;
  logic [Lanes*HitResult-1:0] hit_4_q;
  assign best_write = valid_3_q & found_3_q;

  for (genvar lane = 0; lane < Lanes; lane++) begin : gen_decide
    logic step_ends, reloads;
    logic [31:0] node_ref;
    logic [SpillBits-1:0] step_spills, spills;
    logic [PlaceWidth-1:0] step_base, base;
    logic [CountWidth-1:0] step_count, count;
    logic [BlockBits-1:0] step_blocks, blocks;
    logic [Row-1:0] write;
    ray_step #(.Width(Width), .Row(Row)) u_step (
      .entries_i(CountWidth'(stack_entries_i)), .block_entries_i(block_entries), .is_block_i(is_block_3_q[lane]),
      .is_satisfied_i(is_satisfied_3_q[lane]), .met_i(met_3_q[lane]), .payload_i(payload_3_q[lane]),
      .refs_i(refs_3_q[lane]), .low_i(low_3_q[lane]), .high_i(high_3_q[lane]), .base_i(base_3_q[lane]),
      .free_i(free_3_q[lane]), .pushed_i(pushed_3_q[lane]), .blocks_i(blocks_3_q[lane]),
      .ends_o(step_ends), .reloads_o(reloads), .ref_o(node_ref), .spills_o(step_spills), .base_o(step_base),
      .count_o(step_count), .blocks_o(step_blocks), .write_o(write), .row_o(new_row[lane*64*Row+:64*Row])
    );
    if (MailboxEntries > 0) begin : gen_held
      held_stack #(.Width(Width), .Row(Row)) u_held (
        .entries_i(CountWidth'(stack_entries_i)), .block_entries_i(block_entries),
        .has_child_i(met_3_q[lane] != '0), .is_known_i(is_known[lane]), .base_i(base_3_q[lane]),
        .pushed_i(pushed_3_q[lane]), .blocks_i(blocks_3_q[lane]), .step_spills_i(step_spills),
        .step_base_i(step_base), .step_count_i(step_count), .step_blocks_i(step_blocks), .spills_o(spills),
        .base_o(base), .count_o(count), .blocks_o(blocks)
      );
    end else begin : gen_step
      assign {spills, base, count, blocks} = {step_spills, step_base, step_count, step_blocks};
    end
    assign to_leaf[lane] = valid_3_q[lane] & ~step_ends & ~reloads & node_ref[31];
    assign number[lane*NumberBits+:NumberBits] = node_ref[NumberBits-1:0];
    assign ends[lane] = valid_3_q[lane] & step_ends;
    assign order_valid[lane] = valid_3_q[lane] & ~step_ends & ~is_known[lane];
    assign entry_write[lane*Row+:Row] = write & {Row{valid_3_q[lane]}};
    assign new_state[lane*StateBits+:StateBits] = {blocks, count, base};
    assign new_head[lane*HeadBits+:HeadBits] = {
      base_3_q[lane], reloads ? SpillBits'(0) : spills, 1'b0, slot_3_q[lane*SlotWidth+:SlotWidth]
    };
    assign new_order[lane*OrderBits+:OrderBits] = {
      reloads ? blocks_3_q[lane] - 1'b1 : blocks_3_q[lane], reloads, node_ref
    };
    always_ff @(posedge clk_i) begin
      hit_4_q[lane*HitResult+:HitResult] <= {best_3_q[lane], has_best_3_q[lane], tag_3_q[lane]};
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      valid_2_q <= '0;
      valid_3_q <= '0;
      valid_4_q <= '0;
    end else begin
      valid_2_q <= take;
      valid_3_q <= valid_2_q;
      valid_4_q <= ends;
    end
  end

  // ---- Stage 3 again: the leaf in the mailbox; and a stage later, rays that pass it over.
  if (MailboxEntries > 0) begin : gen_mailbox
    localparam int unsigned EntryWidth = MailboxEntries > 1 ? $clog2(MailboxEntries) : 1;
    // Two lanes in three stages, and two that wait.
    localparam int unsigned PassedQueue = 8;
    logic [Lanes-1:0] is_first_3_q, lookup, is_known_4_q;
    logic [Lanes*SlotWidth-1:0] slot_4_q;
    assign lookup = to_leaf & {Lanes{mailbox_entries_i != '0}};
    mailbox #(.Entries(MailboxEntries), .Slots(Slots), .Lanes(Lanes), .NumberBits(NumberBits)) u_mailbox (
      .clk_i, .rst_ni, .last_entry_i(EntryWidth'(mailbox_entries_i - 1'b1)), .read_slot_i(slot_2_q),
      .valid_i(valid_3_q), .slot_i(slot_3_q), .is_first_i(is_first_3_q), .lookup_i(lookup), .number_i(number),
      .found_o(is_known)
    );
    multi_fifo #(.Width(SlotWidth), .Depth(PassedQueue), .Push(Lanes), .Pop(2)) u_passed (
      .clk_i, .rst_ni, .push_i(is_known_4_q), .data_i(slot_4_q), .space_o(), .valid_o(passed_valid),
      .data_o(passed_slot), .next_o(), .pop_i(passed_pop)
    );
    always_ff @(posedge clk_i) begin
      is_first_3_q <= ~had_stack_q;
      slot_4_q <= slot_3_q;
    end
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) is_known_4_q <= '0;
      else is_known_4_q <= is_known;
    end
    assign mailbox_lookup_o = lookup;
  end else begin : gen_no_mailbox
    assign is_known = '0;
    assign passed_valid = '0;
    assign passed_slot = '0;
    assign mailbox_lookup_o = '0;
  end
  assign mailbox_hit_o = is_known;

  // ---- Rays come in.
  logic slot_is_free, accept;
  assign ray_ready_o = slot_is_free & has_room;
  assign accept = ray_valid_i & ray_ready_o;
  assign ray_start_o = accept & ray_can_hit_i;
  free_slots #(.Slots(Slots), .Frees(Lanes)) u_free (
    .clk_i, .rst_ni, .last_slot_i, .valid_o(slot_is_free), .slot_o(ray_slot_o), .take_i(ray_start_o),
    .free_i(ends), .free_slot_i(slot_3_q)
  );

  // ---- Memories of the slots.
  logic [SlotWidth-1:0] block_read_slot;
  logic [PlaceWidth-1:0] block_read_place;
  stack_ram #(.Slots(Slots), .Row(Row), .Lanes(Lanes)) u_stacks (
    .clk_i, .read_slot_i(take_slot), .row_o(row), .block_slot_i(block_read_slot), .block_place_i(block_read_place),
    .block_o(request_data_o), .write_i(entry_write), .write_slot_i(slot_3_q), .write_row_i(new_row)
  );
  slot_ram #(.Width(StateBits), .Slots(Slots), .Reads(Lanes), .Writes(Lanes)) u_states (
    .clk_i, .read_slot_i(take_slot), .read_data_o(state), .write_i(valid_3_q), .write_slot_i(slot_3_q),
    .write_data_i(new_state)
  );
  slot_ram #(.Width(HitBits), .Slots(Slots), .Reads(Lanes), .Writes(Lanes)) u_best (
    .clk_i, .read_slot_i(take_slot), .read_data_o(best), .write_i(best_write), .write_slot_i(slot_3_q),
    .write_data_i({best_3_q[1], best_3_q[0]})
  );
  slot_ram #(.Width(32), .Slots(Slots), .Reads(1), .Writes(Lanes)) u_best_of_box (
    .clk_i, .read_slot_i(box_read_slot_i), .read_data_o(box_t_best_o), .write_i(best_write), .write_slot_i(slot_3_q),
    .write_data_i({best_3_q[1][31:0], best_3_q[0][31:0]})
  );
  slot_ram #(.Width(64), .Slots(Slots), .Reads(1), .Writes(Lanes)) u_best_of_pair (
    .clk_i, .read_slot_i(pair_read_slot_i), .read_data_o(pair_best_o), .write_i(best_write), .write_slot_i(slot_3_q),
    .write_data_i({best_3_q[1][127:96], best_3_q[1][31:0], best_3_q[0][127:96], best_3_q[0][31:0]})
  );
  slot_ram #(.Width(TagWidth + 33), .Slots(Slots), .Reads(Lanes), .Writes(1)) u_rays (
    .clk_i, .read_slot_i(take_slot), .read_data_o(ray), .write_i(ray_start_o), .write_slot_i(ray_slot_o),
    .write_data_i({ray_any_hit_i, ray_t_max_i, ray_tag_i})
  );
  always_ff @(posedge clk_i) begin
    for (int unsigned lane = 0; lane < Lanes; lane++) begin
      if (valid_3_q[lane]) has_stack_q[slot_3_q[lane*SlotWidth+:SlotWidth]] <= 1'b1;
      if (best_write[lane]) has_best_q[slot_3_q[lane*SlotWidth+:SlotWidth]] <= 1'b1;
    end
    if (ray_start_o) begin
      has_stack_q[ray_slot_o] <= 1'b0;
      has_best_q[ray_slot_o] <= 1'b0;
    end
  end

  // ---- Stage 4: what rays ask for, and finished rays. An order a slot at most.
  logic [1:0] head_valid, order_pop;
  logic [2*HeadBits-1:0] head, next_head;
  logic [2*OrderBits-1:0] order;
  multi_fifo #(.Width(HeadBits), .Depth(Slots), .Push(Lanes + 1), .Pop(2)) u_order_heads (
    .clk_i, .rst_ni, .push_i({order_valid, ray_start_o}), .data_i({new_head, HeadBits'({1'b1, ray_slot_o})}),
    .space_o(), .valid_o(head_valid), .data_o(head), .next_o(next_head), .pop_i(order_pop)
  );
  order_ram #(.Width(OrderBits), .Slots(Slots), .Lanes(2)) u_orders (
    .clk_i, .read_slot_i({next_head[HeadBits+:SlotWidth], next_head[0+:SlotWidth]}), .read_data_o(order),
    .write_i(order_valid), .write_slot_i(slot_3_q), .write_data_i(new_order)
  );
  order_issue #(.Slots(Slots), .Row(Row), .NodeSectors(NodeSectors), .AddressBits(AddressBits)) u_issue (
    .clk_i, .rst_ni, .block_entries_i(block_entries), .stack_base_i, .stack_slot_bytes_i, .valid_i(head_valid),
    .head_i(head), .next_head_i(next_head), .order_i(order), .pop_o(order_pop), .block_slot_o(block_read_slot),
    .block_place_o(block_read_place), .request_valid_o, .request_ready_i, .request_address_o, .request_sectors_o,
    .request_slot_o, .request_to_o, .request_is_write_o
  );

  logic [2*HitResult-1:0] hit_result;
  logic [1:0] hit_pop;
  assign hit_pop = {1'b0, hit_valid_o[0] & hit_ready_i[0]} + {1'b0, hit_valid_o[1] & hit_ready_i[1]};
  multi_fifo #(.Width(HitResult), .Depth(HitQueue), .Push(Lanes + 1), .Pop(2)) u_hits (
    .clk_i, .rst_ni, .push_i({accept & ~ray_can_hit_i, valid_4_q}),
    .data_i({HitResult'(ray_tag_i), hit_4_q}), .space_o(hit_space), .valid_o(hit_valid_o), .data_o(hit_result),
    .next_o(), .pop_i(hit_pop)
  );
  for (genvar i = 0; i < 2; i++) begin : gen_hit
    assign {hit_o[i*HitBits+:HitBits], hit_found_o[i], hit_tag_o[i*TagWidth+:TagWidth]} =
        hit_result[i*HitResult+:HitResult];
  end

endmodule
