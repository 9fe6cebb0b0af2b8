// Which of the accesses at the head of the queue are accepted in this cycle: in order, each in another bank, until one
// lacks something. Every resource is asked for before any is taken; a refused access leaves no trace.
module cache_accept #(
  parameter int unsigned Lanes     = 4,
  parameter int unsigned MshrBits  = 6,
  parameter int unsigned CountBits = 5,
  parameter int unsigned TagBits   = 7
) (
  input  logic [1:0]               last_bank_i,
  input  logic [CountBits-2:0]     last_target_i,
  // The accesses.
  input  logic [Lanes-1:0]         valid_i,
  input  logic                     has_more_i,     // than lanes
  input  logic [Lanes*2-1:0]       line_i,         // lowest bits
  input  logic [Lanes*4-1:0]       sectors_i,
  input  logic [Lanes*TagBits-1:0] tag_i,
  input  logic [Lanes*2-1:0]       source_i,
  input  logic [Lanes-1:0]         is_write_i,
  input  logic [Lanes-1:0]         is_first_i,
  input  logic [Lanes*2-1:0]       lines_i,
  // What their banks hold.
  input  logic [Lanes-1:0]         is_there_i,
  input  logic [Lanes-1:0]         has_victim_i,
  input  logic [Lanes*4-1:0]       has_valid_i,    // of the line, or of the victim
  input  logic [Lanes*4-1:0]       has_dirty_i,
  input  logic [Lanes*4-1:0]       has_pending_i,
  input  logic [Lanes*CountBits-1:0] targets_i,    // waiting at the line's MSHR
  input  logic [Lanes-1:0]         is_held_i,      // still being written back
  // What fills have left of this cycle.
  input  logic [3:0]               busy_i,
  input  logic [11:0]              room_i,
  input  logic [11:0]              used_i,
  input  logic [MshrBits:0]        free_mshrs_i,
  input  logic [Lanes*MshrBits-1:0] next_mshr_i,
  input  logic [3:0]               below_room_i,
  input  logic [3:0]               write_back_room_i,
  input  logic [Lanes-1:0]         answers_i,      // a fill has answered a part of
  input  logic [Lanes*TagBits-1:0] answered_tag_i,
  input  logic [Lanes*2-1:0]       parts_i,        // of the lane's read, before this cycle
  // What happens.
  output logic [2:0]               accepted_o,     // accesses
  output logic [2:0]               refusal_o,      // of the next one
  output logic [Lanes-1:0]         accept_o,
  output logic [Lanes-1:0]         hits_o,         // a read with all its sectors there
  output logic [Lanes-1:0]         waits_o,        // a read that becomes a target
  output logic [Lanes-1:0]         opens_o,        // an MSHR
  output logic [Lanes*MshrBits-1:0] mshr_o,        // which
  output logic [2:0]               opened_o,
  output logic [Lanes*4-1:0]       missing_o,      // sectors that it asks for
  output logic [Lanes-1:0]         evicts_o,
  output logic [Lanes-1:0]         writes_back_o,
  output logic [Lanes*2-1:0]       parts_o,        // of its read, after this access
  output logic [Lanes-1:0]         replies_o       // its read is complete
);

  // Why an access is refused, as CacheCounters of sim/memory_counters.hpp has it.
  localparam logic [2:0] Accepted = 3'd0;
  localparam logic [2:0] BankConflict = 3'd1;
  localparam logic [2:0] PipelineFull = 3'd2;
  localparam logic [2:0] TargetFull = 3'd3;
  localparam logic [2:0] MshrFull = 3'd4;
  localparam logic [2:0] BelowFull = 3'd5;
  localparam logic [2:0] WriteBackStall = 3'd6;
  localparam logic [2:0] SetFull = 3'd7;

  logic goes_on, is_there, is_hit, has_mshr, lacks_way, lacks_write_back, is_new;
  logic [1:0] bank, source, parts;
  logic [3:0] valid, pending, missing, fetched, written_back;
  logic [2:0] refusal;
  logic [11:0] used;
  logic [3:0] busy;
  always_comb begin
    goes_on = 1'b1;
    is_new = 1'b0;
    parts = 2'd0;
    accepted_o = 3'd0;
    opened_o = 3'd0;
    refusal_o = Accepted;
    busy = busy_i;
    used = used_i;
    fetched = 4'd0;
    written_back = 4'd0;
    for (int unsigned i = 0; i < Lanes; i++) begin
      bank = line_i[2*i+:2] & last_bank_i;
      source = source_i[2*i+:2];
      is_there = is_there_i[i];
      valid = has_valid_i[4*i+:4] & {4{is_there}};
      pending = has_pending_i[4*i+:4] & {4{is_there}};
      is_hit = (sectors_i[4*i+:4] & ~valid) == 4'd0;
      has_mshr = |pending;
      missing = sectors_i[4*i+:4] & ~(valid | pending);
      lacks_way = ~is_there & ~has_victim_i[i];
      lacks_write_back = ~is_there & (|has_dirty_i[4*i+:4]) & (written_back == write_back_room_i);

      refusal = Accepted;
      if (busy[bank]) refusal = BankConflict;
      else if (is_write_i[i]) begin
        if (lacks_way) refusal = SetFull;
        else if (lacks_write_back) refusal = WriteBackStall;
      end else if (used[4*source+:4] == room_i[4*source+:4]) refusal = PipelineFull;
      else if (~is_hit) begin
        if (has_mshr & (targets_i[i*CountBits+:CountBits] > {1'b0, last_target_i})) refusal = TargetFull;
        else if (~has_mshr & ({{(31 - MshrBits) {1'b0}}, free_mshrs_i} <= {29'd0, opened_o})) begin
          refusal = MshrFull;
        end else if ((missing != 4'd0) & (fetched == below_room_i)) refusal = BelowFull;
        else if ((missing != 4'd0) & is_held_i[i]) refusal = WriteBackStall;
        else if (lacks_way) refusal = SetFull;
        else if (lacks_write_back) refusal = WriteBackStall;
      end
      goes_on = goes_on & valid_i[i];
      if (goes_on) refusal_o = refusal;
      goes_on = goes_on & (refusal == Accepted);

      accept_o[i] = goes_on;
      hits_o[i] = goes_on & ~is_write_i[i] & is_hit;
      waits_o[i] = goes_on & ~is_write_i[i] & ~is_hit;
      opens_o[i] = waits_o[i] & ~has_mshr;
      missing_o[4*i+:4] = waits_o[i] ? missing : 4'd0;
      evicts_o[i] = goes_on & ~is_there & (|has_valid_i[4*i+:4]);
      writes_back_o[i] = goes_on & ~is_there & (|has_dirty_i[4*i+:4]);
      mshr_o[i*MshrBits+:MshrBits] = next_mshr_i[0+:MshrBits];
      for (int unsigned k = 1; k < Lanes; k++) begin
        if ({29'd0, opened_o} == k) mshr_o[i*MshrBits+:MshrBits] = next_mshr_i[k*MshrBits+:MshrBits];
      end

      // The read's parts: of its first line all, later what other lanes and fills leave.
      if (is_first_i[i]) begin
        parts = lines_i[2*i+:2];
        is_new = 1'b1;
      end else if (~is_new) begin
        parts = parts_i[2*i+:2];
        for (int unsigned f = 0; f < Lanes; f++) begin
          if (answers_i[f] & (answered_tag_i[f*TagBits+:TagBits] == tag_i[i*TagBits+:TagBits])) parts = parts - 2'd1;
        end
        is_new = 1'b1;  // the next lines of this request go on from here
      end
      if (hits_o[i]) parts = parts - 2'd1;
      parts_o[2*i+:2] = parts;
      replies_o[i] = hits_o[i] & (parts == 2'd0);

      if (goes_on) busy[bank] = 1'b1;
      if (replies_o[i]) used[4*source+:4] = used[4*source+:4] + 4'd1;
      accepted_o = accepted_o + {2'd0, goes_on};
      opened_o = opened_o + {2'd0, opens_o[i]};
      fetched = fetched + {3'd0, |missing_o[4*i+:4]};
      written_back = written_back + {3'd0, writes_back_o[i]};
    end
    if (goes_on & has_more_i) refusal_o = BankConflict;  // no bank is left
  end

endmodule
