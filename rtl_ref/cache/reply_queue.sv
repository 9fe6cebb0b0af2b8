// One client's replies: tags wait here for their latency, then go over to the channel, which is the older part of the
// same ring. What enters in cycle t may go over in t + latency, and is seen by the client in the cycle after that.
// The ring has a place for every tag, so it cannot overflow; room_o says what the latency times the banks leave.
module reply_queue #(
  parameter int unsigned Lanes      = 8,  // pushes a cycle, at most
  parameter int unsigned Tags       = 128,
  parameter int unsigned MaxLatency = 32
) (
  input  logic                          clk_i,
  input  logic                          rst_ni,
  input  logic [$clog2(MaxLatency)-1:0] last_latency_i,
  input  logic [1:0]                    last_bank_i,   // in use
  output logic [3:0]                    room_o,        // replies that may enter in this cycle; 15 is 15 or more
  input  logic [Lanes-1:0]              push_i,
  input  logic [Lanes*$clog2(Tags)-1:0] tag_i,
  output logic                          is_stalled_o,  // one could go over but for the channel
  output logic                          valid_o,
  input  logic                          ready_i,
  output logic [$clog2(Tags)-1:0]       tag_o,
  output logic [$clog2(Tags)-1:0]       next_tag_o     // tag_o of the next cycle, if it is valid then
);

  localparam int unsigned TagBits = $clog2(Tags);
  localparam int unsigned CountBits = $clog2(MaxLatency) + 4;

  logic [TagBits-1:0] head_q, tail_q;
  logic [Lanes*TagBits-1:0] place;
  logic [CountBits-1:0] under_way_q, ripe_q, ripe, free;
  logic [3:0] in_channel_q, channel_room, moved, pushes, ripened;
  logic pop;

  // How many entered in each of the last cycles; the newest first.
  logic [4*MaxLatency-1:0] entered_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) entered_q <= '0;
    else entered_q <= {entered_q[4*MaxLatency-5:0], pushes};
  end
  assign ripened = entered_q[4*last_latency_i+:4];

  assign ripe = ripe_q + {{(CountBits - 4) {1'b0}}, ripened};
  assign channel_room = {1'b0, last_bank_i, 1'b0} + 4'd2 - in_channel_q;
  assign moved = (ripe < {{(CountBits - 4) {1'b0}}, channel_room}) ? ripe[3:0] : channel_room;
  assign is_stalled_o = ripe > {{(CountBits - 4) {1'b0}}, channel_room};

  // (latency) * (banks) places under way.
  logic [CountBits-1:0] latency, depth;
  assign latency = {4'd0, last_latency_i} + CountBits'(1);
  assign depth = (last_bank_i == 2'd0) ? latency : (last_bank_i == 2'd1) ? latency << 1 : latency << 2;
  assign free = depth - under_way_q + {{(CountBits - 4) {1'b0}}, moved};
  assign room_o = (free > CountBits'(15)) ? 4'd15 : free[3:0];

  always_comb begin
    pushes = 4'd0;
    for (int unsigned i = 0; i < Lanes; i++) begin
      place[i*TagBits+:TagBits] = tail_q + TagBits'(pushes);
      pushes = pushes + {3'd0, push_i[i]};
    end
  end
  storage #(.Width(TagBits), .Entries(Tags), .Reads(1), .Writes(Lanes)) u_ring (
    .clk_i, .read_index_i(head_q), .read_o(tag_o), .write_i(push_i), .write_index_i(place), .data_i(tag_i)
  );
  // A copy, as tag_o must not seem to depend on ready_i.
  storage #(.Width(TagBits), .Entries(Tags), .Reads(1), .Writes(Lanes)) u_next_ring (
    .clk_i, .read_index_i(head_q + TagBits'(pop)), .read_o(next_tag_o), .write_i(push_i), .write_index_i(place),
    .data_i(tag_i)
  );

  assign valid_o = in_channel_q != 4'd0;
  assign pop = valid_o & ready_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      head_q <= '0;
      tail_q <= '0;
      under_way_q <= '0;
      ripe_q <= '0;
      in_channel_q <= '0;
    end else begin
      head_q <= head_q + TagBits'(pop);
      tail_q <= tail_q + TagBits'(pushes);
      under_way_q <= under_way_q - {{(CountBits - 4) {1'b0}}, moved} + {{(CountBits - 4) {1'b0}}, pushes};
      ripe_q <= ripe - {{(CountBits - 4) {1'b0}}, moved};
      in_channel_q <= in_channel_q + moved - {3'd0, pop};
    end
  end

`ifndef SYNTHESIS
  assert property (@(posedge clk_i) disable iff (!rst_ni) CountBits'(pushes) <= free)
  else $error("more replies than there is room for");
  assert property (@(posedge clk_i) disable iff (!rst_ni) in_channel_q <= {1'b0, last_bank_i, 1'b0} + 4'd2)
  else $error("more replies in the channel than it holds");
`endif

endmodule
