// All of the cache but its data: queues, tags and MSHRs, and what happens in a cycle. Its order is that of sim::Cache:
// replies go over to their channels, a write-back leaves, fills take their banks, then requests take what is left.
// What it decides, the data path (cache_data.sv) does to a bank's data at the end of the cycle.
module cache_control #(
  parameter int unsigned Banks       = 4,
  parameter int unsigned Sets        = 32,
  parameter int unsigned Ways        = 16,
  parameter int unsigned Mshrs       = 64,
  parameter int unsigned Targets     = 16,
  parameter int unsigned Tags        = 128,
  parameter int unsigned AddressBits = 32,
  parameter int unsigned MaxLatency  = 32
) (
  input  logic                              clk_i,
  input  logic                              rst_ni,
  input  logic [$clog2(Sets)-1:0]           set_mask_i,
  input  logic [$clog2(Ways)-1:0]           last_way_i,
  input  logic [$clog2(Banks)-1:0]          bank_mask_i,
  input  logic [$clog2(Mshrs)-1:0]          last_mshr_i,
  input  logic [$clog2(Targets)-1:0]        last_target_i,
  input  logic [$clog2(MaxLatency)-1:0]     last_latency_i,
  output logic                              is_ready_o,
  input  logic [1:0]                        request_valid_i,
  output logic [1:0]                        request_ready_o,
  input  logic [2*AddressBits-1:0]          request_address_i,
  input  logic [7:0]                        request_sectors_i,
  input  logic [2*$clog2(Tags)-1:0]         request_tag_i,
  input  logic [3:0]                        request_source_i,
  input  logic [1:0]                        request_is_write_i,
  output logic [3:0]                        request_place_o,
  output logic [2:0]                        reply_valid_o,
  input  logic [2:0]                        reply_ready_i,
  output logic [3*$clog2(Tags)-1:0]         reply_tag_o,
  output logic [3*$clog2(Tags)-1:0]         reply_next_tag_o,
  output logic                              mem_valid_o,
  input  logic                              mem_ready_i,
  output logic                              mem_is_write_o,
  output logic [AddressBits-8:0]            mem_line_o,
  output logic [3:0]                        mem_sectors_o,
  output logic [$clog2(Mshrs)+3:0]          mem_id_o,
  output logic [3:0]                        mem_slot_o,
  input  logic                              fill_valid_i,
  output logic                              fill_ready_o,
  input  logic [$clog2(Mshrs)+3:0]          fill_id_i,
  output logic [1:0]                        fill_place_o,
  // For the data of each bank: the entry that it reads and writes, what comes in (a place of the queue of fills, else
  // of requests) and to which sectors, what goes to the replies, and whether the line goes to a write-back slot.
  output logic [Banks-1:0]                  bank_is_fill_o,
  output logic [Banks*($clog2(Sets/Banks)+$clog2(Ways))-1:0] bank_entry_o,
  output logic [Banks*2-1:0]                bank_place_o,
  output logic [Banks*4-1:0]                bank_write_o,
  output logic [Banks*4-1:0]                bank_valid_o,   // sectors that the replies take from the bank
  output logic [Banks*4-1:0]                bank_reply_o,
  output logic [Banks*$clog2(Tags)-1:0]     bank_reply_tag_o,
  output logic [Banks*3-1:0]                bank_reply_base_o,  // the line's first sector in the reply, modulo 8
  output logic [Banks-1:0]                  bank_leaves_o,
  output logic [Banks*4-1:0]                bank_slot_o,
  output logic [7*Banks+6:0]                events_o  // see cache.sv
);

  localparam int unsigned LineNumberBits = AddressBits - 7;
  localparam int unsigned BankBits = $clog2(Banks);
  localparam int unsigned RowBits = $clog2(Sets / Banks);  // sets of a bank
  localparam int unsigned WayBits = $clog2(Ways);
  localparam int unsigned MshrBits = $clog2(Mshrs);
  localparam int unsigned TagBits = $clog2(Tags);
  localparam int unsigned CountBits = $clog2(Targets) + 1;
  localparam int unsigned TargetBits = TagBits + 4;
  localparam int unsigned TargetsBits = CountBits + Targets * TargetBits;
  localparam int unsigned EntryBits = LineNumberBits + 12 + MshrBits;
  localparam int unsigned ReadBits = 2 + 2 + 3;  // {parts, source, first sector}
  localparam int unsigned ClearBits = (MshrBits > RowBits) ? MshrBits : RowBits;

  // After reset: a set of each bank and a free MSHR a cycle.
  logic [ClearBits:0] clear_q;
  logic clears;
  assign is_ready_o = clear_q[ClearBits];
  assign clears = ~is_ready_o;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) clear_q <= '0;
    else if (clears) clear_q <= clear_q + (ClearBits + 1)'(1);
  end

  logic [1:0] last_bank;
  assign last_bank = 2'(bank_mask_i);

  // Requests and their accesses.
  logic [Banks-1:0] valid, is_write, is_first, accept, hits, waits, opens, evicts, writes_back, replies, is_there;
  logic [Banks-1:0] has_victim, is_held;
  logic [Banks*LineNumberBits-1:0] line;
  logic [Banks*4-1:0] sectors, missing, has_valid, has_dirty, has_pending, slot;
  logic [Banks*TagBits-1:0] tag;
  logic [Banks*2-1:0] source, lines, place, parts, parts_left, line_low;
  logic [Banks*3-1:0] first_sector;
  logic [Banks*CountBits-1:0] targets_waiting;
  logic [Banks*MshrBits-1:0] mshr, next_mshr;
  logic [Banks*EntryBits-1:0] entry;
  logic [2:0] accepted, opened, refusal;
  logic has_more;
  cache_requests #(.Lanes(Banks), .AddressBits(AddressBits), .TagBits(TagBits)) u_requests (
    .clk_i, .rst_ni, .is_ready_i(is_ready_o), .request_valid_i, .request_ready_o, .request_address_i,
    .request_sectors_i, .request_tag_i, .request_source_i, .request_is_write_i, .request_place_o,
    .valid_o(valid), .has_more_o(has_more), .line_o(line), .sectors_o(sectors), .tag_o(tag), .source_o(source), .is_write_o(is_write),
    .is_first_o(is_first), .lines_o(lines), .first_sector_o(first_sector), .place_o(place), .accepted_i(accepted)
  );

  // Fills.
  logic [Banks-1:0] acts, answers, answer_replies, is_done, closes;
  logic [Banks*MshrBits-1:0] fill_mshr;
  logic [Banks*4-1:0] fill_sectors, fill_valid, fill_pending, wanted;
  logic [Banks*2-1:0] fill_place, fill_parts, fill_parts_left, fill_source;
  logic [Banks*LineNumberBits-1:0] fill_line;
  logic [Banks*WayBits-1:0] fill_way;
  logic [Banks*TagBits-1:0] answered_tag;
  logic [Banks*3-1:0] answered_first;
  logic [Banks*TargetsBits-1:0] fill_row, fill_row_left;
  logic [11:0] room, used;
  logic [3:0] busy;
  logic is_stuck;
  cache_fills #(
    .Lanes(Banks), .LineNumberBits(LineNumberBits), .Mshrs(Mshrs), .Targets(Targets), .TagBits(TagBits)
  ) u_fills (
    .clk_i, .rst_ni, .last_bank_i(last_bank), .fill_valid_i, .fill_ready_o, .fill_id_i, .fill_place_o,
    .mshr_o(fill_mshr), .sectors_o(fill_sectors), .place_o(fill_place), .line_i(fill_line), .valid_i(fill_valid),
    .pending_i(fill_pending), .row_i(fill_row), .tag_o(answered_tag), .wanted_o(wanted), .parts_i(fill_parts),
    .source_i(fill_source), .room_i(room), .acts_o(acts), .answers_o(answers), .replies_o(answer_replies),
    .is_done_o(is_done), .closes_o(closes), .row_o(fill_row_left), .parts_o(fill_parts_left), .used_o(used),
    .busy_o(busy), .is_stuck_o(is_stuck)
  );

  // Write-backs and requests below.
  logic sends;
  logic [3:0] below_room, write_back_room, sent_sectors, sent_slot;
  logic [LineNumberBits-1:0] sent_line;
  logic [Banks-1:0] fetches;
  logic [Banks*LineNumberBits-1:0] victim_line;
  logic [Banks*(MshrBits+4)-1:0] fetch_id;
  write_back_buffer #(.Lanes(Banks), .LineNumberBits(LineNumberBits)) u_write_backs (
    .clk_i, .rst_ni, .can_send_i(below_room != 4'd0), .send_o(sends), .line_o(sent_line),
    .sectors_o(sent_sectors), .slot_o(sent_slot), .room_o(write_back_room), .sought_i(line), .is_held_o(is_held),
    .push_i(writes_back), .line_i(victim_line), .dirty_i(has_dirty), .slot_for_o(slot)
  );
  memory_requests #(.Lanes(Banks), .LineNumberBits(LineNumberBits), .IdBits(MshrBits + 4)) u_below (
    .clk_i, .rst_ni, .room_o(below_room), .write_i(sends), .write_line_i(sent_line),
    .write_sectors_i(sent_sectors), .write_slot_i(sent_slot), .fetch_i(fetches), .fetch_line_i(line),
    .fetch_id_i(fetch_id), .valid_o(mem_valid_o), .ready_i(mem_ready_i), .is_write_o(mem_is_write_o),
    .line_o(mem_line_o), .sectors_o(mem_sectors_o), .id_o(mem_id_o), .slot_o(mem_slot_o)
  );

  logic [MshrBits:0] free_mshrs;
  mshr_ids #(.Lanes(Banks), .Mshrs(Mshrs)) u_ids (
    .clk_i, .rst_ni, .last_mshr_i, .fill_i(clears), .fill_index_i(clear_q[MshrBits-1:0]), .close_i(closes),
    .closed_i(fill_mshr), .free_o(free_mshrs), .next_o(next_mshr), .taken_i(opened)
  );

  for (genvar l = 0; l < Banks; l++) begin : gen_line_low
    assign line_low[2*l+:2] = line[l*LineNumberBits+:2];
    assign fetches[l] = |missing[4*l+:4];
    assign victim_line[l*LineNumberBits+:LineNumberBits] = entry[l*EntryBits+:LineNumberBits];
  end
  cache_accept #(.Lanes(Banks), .MshrBits(MshrBits), .CountBits(CountBits), .TagBits(TagBits)) u_accept (
    .last_bank_i(last_bank), .last_target_i, .valid_i(valid), .has_more_i(has_more), .line_i(line_low), .sectors_i(sectors), .tag_i(tag),
    .source_i(source), .is_write_i(is_write), .is_first_i(is_first), .lines_i(lines), .is_there_i(is_there),
    .has_victim_i(has_victim), .has_valid_i(has_valid), .has_dirty_i(has_dirty), .has_pending_i(has_pending),
    .targets_i(targets_waiting), .is_held_i(is_held), .busy_i(busy), .room_i(room), .used_i(used),
    .free_mshrs_i(free_mshrs), .next_mshr_i(next_mshr), .below_room_i(below_room - {3'd0, sends}),
    .write_back_room_i(write_back_room), .answers_i(answers), .answered_tag_i(answered_tag), .parts_i(parts),
    .accepted_o(accepted), .refusal_o(refusal), .accept_o(accept), .hits_o(hits), .waits_o(waits), .opens_o(opens),
    .mshr_o(mshr), .opened_o(opened), .missing_o(missing), .evicts_o(evicts), .writes_back_o(writes_back),
    .parts_o(parts_left), .replies_o(replies)
  );

  // Tags: an access, or a fill, goes to the bank of its set.
  logic [Banks*RowBits-1:0] set, fill_set;
  logic [Banks*BankBits-1:0] bank, fill_bank;
  for (genvar l = 0; l < Banks; l++) begin : gen_place
    assign {set[l*RowBits+:RowBits], bank[l*BankBits+:BankBits]} =
        line[l*LineNumberBits+:RowBits+BankBits] & set_mask_i;
    assign {fill_set[l*RowBits+:RowBits], fill_bank[l*BankBits+:BankBits]} =
        fill_line[l*LineNumberBits+:RowBits+BankBits] & set_mask_i;
  end

  logic [Banks*EntryBits-1:0] new_entry, filled_entry, bank_entry, bank_fill_entry;
  logic [Banks*WayBits-1:0] way, bank_way;
  logic [Banks-1:0] bank_is_hit, bank_has_victim;
  for (genvar b = 0; b < Banks; b++) begin : gen_bank
    // Of several accesses, or fills, only the first can find the bank free.
    logic [RowBits-1:0] access_set, filled_set;
    logic [LineNumberBits-1:0] access_line;
    logic [WayBits-1:0] filled_way;
    logic [Banks-1:0] is_access, is_fill;
    logic [EntryBits-1:0] written;
    always_comb begin
      access_set = '0;
      access_line = '0;
      filled_set = '0;
      filled_way = '0;
      written = '0;
      bank_place_o[2*b+:2] = '0;
      bank_write_o[4*b+:4] = '0;
      bank_valid_o[4*b+:4] = '0;
      bank_reply_o[4*b+:4] = '0;
      bank_reply_tag_o[b*TagBits+:TagBits] = '0;
      bank_reply_base_o[3*b+:3] = '0;
      bank_leaves_o[b] = 1'b0;
      bank_slot_o[4*b+:4] = '0;
      for (int unsigned i = Banks; i > 0; i--) begin
        if (valid[i-1] & (bank[(i-1)*BankBits+:BankBits] == BankBits'(b))) begin
          access_set = set[(i-1)*RowBits+:RowBits];
          access_line = line[(i-1)*LineNumberBits+:LineNumberBits];
        end
        if (fill_bank[(i-1)*BankBits+:BankBits] == BankBits'(b)) begin
          filled_set = fill_set[(i-1)*RowBits+:RowBits];
          filled_way = fill_way[(i-1)*WayBits+:WayBits];
        end
      end
      for (int unsigned i = 0; i < Banks; i++) begin
        is_access[i] = accept[i] & (bank[i*BankBits+:BankBits] == BankBits'(b));
        is_fill[i] = acts[i] & (fill_bank[i*BankBits+:BankBits] == BankBits'(b));
        if (is_access[i]) begin
          written = new_entry[i*EntryBits+:EntryBits];
          bank_place_o[2*b+:2] = place[2*i+:2];
          bank_write_o[4*b+:4] = sectors[4*i+:4] & {4{is_write[i]}};
          bank_valid_o[4*b+:4] = 4'hf;
          bank_reply_o[4*b+:4] = sectors[4*i+:4] & {4{hits[i]}};
          bank_reply_tag_o[b*TagBits+:TagBits] = tag[i*TagBits+:TagBits];
          bank_reply_base_o[3*b+:3] = {line[i*LineNumberBits], 2'd0} - first_sector[3*i+:3];
          bank_leaves_o[b] = writes_back[i];
          bank_slot_o[4*b+:4] = slot[4*i+:4];
        end
        if (is_fill[i]) begin
          written = filled_entry[i*EntryBits+:EntryBits];
          bank_place_o[2*b+:2] = fill_place[2*i+:2];
          bank_write_o[4*b+:4] = fill_sectors[4*i+:4] & ~fill_valid[4*i+:4] & {4{is_done[i]}};
          bank_valid_o[4*b+:4] = fill_valid[4*i+:4];
          bank_reply_o[4*b+:4] = wanted[4*i+:4] & {4{answers[i]}};
          bank_reply_tag_o[b*TagBits+:TagBits] = answered_tag[i*TagBits+:TagBits];
          bank_reply_base_o[3*b+:3] = {fill_line[i*LineNumberBits], 2'd0} - answered_first[3*i+:3];
        end
      end
    end
    assign bank_is_fill_o[b] = |is_fill;
    assign bank_entry_o[b*(RowBits+WayBits)+:RowBits+WayBits] =
        (|is_fill) ? {filled_set, filled_way} : {access_set, bank_way[b*WayBits+:WayBits]};
    cache_bank #(
      .Sets(Sets / Banks), .Ways(Ways), .LineNumberBits(LineNumberBits), .MshrBits(MshrBits)
    ) u_tags (
      .clk_i, .last_way_i, .clear_i(clears), .clear_set_i(clear_q[RowBits-1:0]), .set_i(access_set),
      .line_i(access_line), .is_hit_o(bank_is_hit[b]), .has_victim_o(bank_has_victim[b]),
      .way_o(bank_way[b*WayBits+:WayBits]), .entry_o(bank_entry[b*EntryBits+:EntryBits]),
      .fill_set_i(filled_set), .fill_way_i(filled_way), .fill_entry_o(bank_fill_entry[b*EntryBits+:EntryBits]),
      .access_i(|is_access), .fill_i(|(is_fill & is_done)), .entry_i(written)
    );
  end

  // What the lanes find there, and what they leave.
  logic [Banks*TargetsBits-1:0] row, new_row;
  logic [Banks*MshrBits-1:0] waiting_mshr;
  for (genvar l = 0; l < Banks; l++) begin : gen_lane
    logic [MshrBits-1:0] entry_mshr;
    logic [3:0] here_valid, here_dirty, here_pending, written;
    logic [CountBits-1:0] waiting;
    assign is_there[l] = bank_is_hit[bank[l*BankBits+:BankBits]];
    assign has_victim[l] = bank_has_victim[bank[l*BankBits+:BankBits]];
    assign way[l*WayBits+:WayBits] = bank_way[bank[l*BankBits+:BankBits]*WayBits+:WayBits];
    assign entry[l*EntryBits+:EntryBits] = bank_entry[bank[l*BankBits+:BankBits]*EntryBits+:EntryBits];
    assign {entry_mshr, has_pending[4*l+:4], has_dirty[4*l+:4], has_valid[4*l+:4]} =
        entry[l*EntryBits+LineNumberBits+:12+MshrBits];
    assign {here_pending, here_dirty, here_valid} =
        is_there[l] ? {has_pending[4*l+:4], has_dirty[4*l+:4], has_valid[4*l+:4]} : 12'd0;
    assign written = sectors[4*l+:4] & {4{is_write[l]}};
    assign waiting_mshr[l*MshrBits+:MshrBits] = opens[l] ? mshr[l*MshrBits+:MshrBits] : entry_mshr;
    assign new_entry[l*EntryBits+:EntryBits] = {
      waiting_mshr[l*MshrBits+:MshrBits], here_pending | missing[4*l+:4], here_dirty | written, here_valid | written,
      line[l*LineNumberBits+:LineNumberBits]
    };
    assign fetch_id[l*(MshrBits+4)+:MshrBits+4] = {waiting_mshr[l*MshrBits+:MshrBits], missing[4*l+:4]};

    // One more target of the line's MSHR.
    assign targets_waiting[l*CountBits+:CountBits] = row[l*TargetsBits+Targets*TargetBits+:CountBits];
    assign waiting = opens[l] ? '0 : targets_waiting[l*CountBits+:CountBits];
    assign new_row[l*TargetsBits+Targets*TargetBits+:CountBits] = waiting + CountBits'(1);
    for (genvar t = 0; t < Targets; t++) begin : gen_target
      assign new_row[l*TargetsBits+t*TargetBits+:TargetBits] =
          (waiting == CountBits'(t)) ? {tag[l*TagBits+:TagBits], sectors[4*l+:4]}
                                     : row[l*TargetsBits+t*TargetBits+:TargetBits];
    end

    logic [EntryBits-1:0] filled;
    assign filled = bank_fill_entry[fill_bank[l*BankBits+:BankBits]*EntryBits+:EntryBits];
    assign fill_valid[4*l+:4] = filled[LineNumberBits+:4];
    assign fill_pending[4*l+:4] = filled[LineNumberBits+8+:4];
    assign filled_entry[l*EntryBits+:EntryBits] = {
      filled[LineNumberBits+12+:MshrBits], fill_pending[4*l+:4] & ~fill_sectors[4*l+:4],
      filled[LineNumberBits+4+:4], fill_valid[4*l+:4] | fill_sectors[4*l+:4], filled[LineNumberBits-1:0]
    };
  end

  // MSHRs: their lines, and the targets that wait for them.
  logic [Banks*(LineNumberBits+WayBits)-1:0] opened_line, fetched_line;
  logic [Banks*MshrBits-1:0] entry_mshr;
  for (genvar l = 0; l < Banks; l++) begin : gen_mshr
    assign opened_line[l*(LineNumberBits+WayBits)+:LineNumberBits+WayBits] =
        {line[l*LineNumberBits+:LineNumberBits], way[l*WayBits+:WayBits]};
    assign {fill_line[l*LineNumberBits+:LineNumberBits], fill_way[l*WayBits+:WayBits]} =
        fetched_line[l*(LineNumberBits+WayBits)+:LineNumberBits+WayBits];
    assign entry_mshr[l*MshrBits+:MshrBits] = entry[l*EntryBits+LineNumberBits+12+:MshrBits];
  end
  storage #(.Width(LineNumberBits + WayBits), .Entries(Mshrs), .Reads(Banks), .Writes(Banks)) u_mshrs (
    .clk_i, .read_index_i(fill_mshr), .read_o(fetched_line), .write_i(opens), .write_index_i(mshr),
    .data_i(opened_line)
  );
  storage #(.Width(TargetsBits), .Entries(Mshrs), .Reads(2 * Banks), .Writes(2 * Banks)) u_targets (
    .clk_i, .read_index_i({entry_mshr, fill_mshr}), .read_o({row, fill_row}), .write_i({waits, answers}),
    .write_index_i({waiting_mshr, fill_mshr}), .data_i({new_row, fill_row_left})
  );

  // Reads under way, by tag.
  logic [Banks*ReadBits-1:0] read, answered_read, read_left, answered_left;
  for (genvar l = 0; l < Banks; l++) begin : gen_read
    assign parts[2*l+:2] = read[l*ReadBits+5+:2];
    assign {fill_parts[2*l+:2], fill_source[2*l+:2], answered_first[3*l+:3]} =
        answered_read[l*ReadBits+:ReadBits];
    assign read_left[l*ReadBits+:ReadBits] = {parts_left[2*l+:2], source[2*l+:2], first_sector[3*l+:3]};
    assign answered_left[l*ReadBits+:ReadBits] =
        {fill_parts_left[2*l+:2], fill_source[2*l+:2], answered_first[3*l+:3]};
  end
  storage #(.Width(ReadBits), .Entries(Tags), .Reads(2 * Banks), .Writes(2 * Banks)) u_reads (
    .clk_i, .read_index_i({tag, answered_tag}), .read_o({read, answered_read}),
    .write_i({accept & ~is_write, answers}), .write_index_i({tag, answered_tag}),
    .data_i({read_left, answered_left})
  );

  // Replies, a queue for each source.
  logic [2:0] stalls;
  for (genvar s = 0; s < 3; s++) begin : gen_source
    logic [2*Banks-1:0] push;
    for (genvar l = 0; l < Banks; l++) begin : gen_push
      assign push[l] = answer_replies[l] & (fill_source[2*l+:2] == 2'(s));
      assign push[Banks+l] = replies[l] & (source[2*l+:2] == 2'(s));
    end
    reply_queue #(.Lanes(2 * Banks), .Tags(Tags), .MaxLatency(MaxLatency)) u_replies (
      .clk_i, .rst_ni, .last_latency_i, .last_bank_i(last_bank), .room_o(room[4*s+:4]), .push_i(push),
      .tag_i({tag, answered_tag}), .is_stalled_o(stalls[s]), .valid_o(reply_valid_o[s]),
      .ready_i(reply_ready_i[s]), .tag_o(reply_tag_o[s*TagBits+:TagBits]),
      .next_tag_o(reply_next_tag_o[s*TagBits+:TagBits])
    );
  end

  assign events_o = {
    stalls, is_stuck, refusal, is_done, writes_back, evicts, accept & is_write, waits & ~fetches, waits & fetches, hits
  };

endmodule
