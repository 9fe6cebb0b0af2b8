// What has come from memory: a queue of four fills, and what becomes of them in this cycle, in order, one a lane. A
// fill takes its line's bank for a cycle for each target that it satisfies, one without targets for one cycle; the last
// of these writes the line, and the next fill may go on in the same cycle in another bank.
module cache_fills #(
  parameter int unsigned Lanes          = 4,
  parameter int unsigned LineNumberBits = 25,
  parameter int unsigned Mshrs          = 64,
  parameter int unsigned Targets        = 16,
  parameter int unsigned TagBits        = 7
) (
  input  logic                                                 clk_i,
  input  logic                                                 rst_ni,
  input  logic [1:0]                                           last_bank_i,
  input  logic                                                 fill_valid_i,
  output logic                                                 fill_ready_o,
  input  logic [$clog2(Mshrs)+3:0]                             fill_id_i,
  output logic [1:0]                                           fill_place_o,  // of the queue, for its data
  // Looked up for the fills at the head of the queue.
  output logic [Lanes*$clog2(Mshrs)-1:0]                       mshr_o,
  output logic [Lanes*4-1:0]                                   sectors_o,     // that the fill brings
  output logic [Lanes*2-1:0]                                   place_o,
  input  logic [Lanes*LineNumberBits-1:0]                      line_i,
  input  logic [Lanes*4-1:0]                                   valid_i,
  input  logic [Lanes*4-1:0]                                   pending_i,
  input  logic [Lanes*($clog2(Targets)+1+Targets*(TagBits+4))-1:0] row_i,
  output logic [Lanes*TagBits-1:0]                             tag_o,         // of the target that is answered
  output logic [Lanes*4-1:0]                                   wanted_o,      // its sectors
  input  logic [Lanes*2-1:0]                                   parts_i,       // of its read, before this cycle
  input  logic [Lanes*2-1:0]                                   source_i,
  input  logic [11:0]                                          room_i,        // for each source's replies
  // What happens.
  output logic [Lanes-1:0]                                     acts_o,        // takes its bank
  output logic [Lanes-1:0]                                     answers_o,     // a target
  output logic [Lanes-1:0]                                     replies_o,     // whose read is complete with it
  output logic [Lanes-1:0]                                     is_done_o,     // writes the line, leaves the queue
  output logic [Lanes-1:0]                                     closes_o,      // the MSHR too
  output logic [Lanes*($clog2(Targets)+1+Targets*(TagBits+4))-1:0] row_o,
  output logic [Lanes*2-1:0]                                   parts_o,
  output logic [11:0]                                          used_o,        // of the room
  output logic [3:0]                                           busy_o,        // banks
  output logic                                                 is_stuck_o     // behind replies
);

  localparam int unsigned MshrBits = $clog2(Mshrs);
  localparam int unsigned RowBits = $clog2(Targets) + 1 + Targets * (TagBits + 4);

  logic [MshrBits+3:0] id_q[4];
  logic [1:0] head_q;
  logic [2:0] count_q, pops;
  logic [Lanes-1:0] is_found, has_more;

  assign fill_ready_o = count_q != 3'd4;
  assign fill_place_o = head_q + count_q[1:0];
  always_ff @(posedge clk_i) begin
    if (fill_valid_i & fill_ready_o) id_q[fill_place_o] <= fill_id_i;
  end

  for (genvar f = 0; f < Lanes; f++) begin : gen_lane
    assign place_o[2*f+:2] = head_q + 2'(f);
    assign {mshr_o[f*MshrBits+:MshrBits], sectors_o[4*f+:4]} = id_q[place_o[2*f+:2]];
    satisfied_target #(.Targets(Targets), .TagBits(TagBits)) u_target (
      .row_i(row_i[f*RowBits+:RowBits]), .arrived_i(valid_i[4*f+:4] | sectors_o[4*f+:4]),
      .is_found_o(is_found[f]), .has_more_o(has_more[f]), .tag_o(tag_o[f*TagBits+:TagBits]),
      .sectors_o(wanted_o[4*f+:4]), .row_o(row_o[f*RowBits+:RowBits])
    );
    assign closes_o[f] = is_done_o[f] & ~(|(pending_i[4*f+:4] & ~sectors_o[4*f+:4]));
  end

  logic goes_on, is_complete;
  logic [1:0] bank, source;
  always_comb begin
    goes_on = 1'b1;
    answers_o = '0;
    pops = 3'd0;
    used_o = '0;
    busy_o = '0;
    is_stuck_o = 1'b0;
    for (int unsigned f = 0; f < Lanes; f++) begin
      bank = line_i[f*LineNumberBits+:2] & last_bank_i;
      source = source_i[2*f+:2];
      parts_o[2*f+:2] = parts_i[2*f+:2] - 2'd1;
      for (int unsigned e = 0; e < f; e++) begin
        if (answers_o[e] & (tag_o[e*TagBits+:TagBits] == tag_o[f*TagBits+:TagBits])) begin
          parts_o[2*f+:2] = parts_o[2*f+:2] - 2'd1;
        end
      end
      is_complete = is_found[f] & (parts_o[2*f+:2] == 2'd0);
      goes_on = goes_on & (f < {29'd0, count_q}) & ~busy_o[bank];
      if (goes_on & is_complete & (used_o[4*source+:4] == room_i[4*source+:4])) begin
        goes_on = 1'b0;
        is_stuck_o = 1'b1;
      end
      acts_o[f] = goes_on;
      answers_o[f] = goes_on & is_found[f];
      replies_o[f] = goes_on & is_complete;
      is_done_o[f] = goes_on & ~has_more[f];
      if (goes_on) busy_o[bank] = 1'b1;
      if (goes_on & is_complete) used_o[4*source+:4] = used_o[4*source+:4] + 4'd1;
      goes_on = is_done_o[f];
      pops = pops + {2'd0, goes_on};
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      head_q <= 2'd0;
      count_q <= 3'd0;
    end else begin
      head_q <= head_q + pops[1:0];
      count_q <= count_q + {2'd0, fill_valid_i & fill_ready_o} - pops;
    end
  end

endmodule
