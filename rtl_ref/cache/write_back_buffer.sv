// Replaced lines with dirty sectors, oldest first, eight of them: their numbers and masks. In every cycle in which
// there is room below, the next run of adjacent dirty sectors leaves. A line's data has a slot of the data path, given
// out in order, until its last run is in memory.
module write_back_buffer #(
  parameter int unsigned Lanes          = 4,
  parameter int unsigned LineNumberBits = 25
) (
  input  logic                            clk_i,
  input  logic                            rst_ni,
  // One run a cycle, below.
  input  logic                            can_send_i,
  output logic                            send_o,
  output logic [LineNumberBits-1:0]       line_o,
  output logic [3:0]                      sectors_o,
  output logic [3:0]                      slot_o,
  // After that: room for more lines, and which of the lanes' lines are still here.
  output logic [3:0]                      room_o,
  input  logic [Lanes*LineNumberBits-1:0] sought_i,
  output logic [Lanes-1:0]                is_held_o,
  input  logic [Lanes-1:0]                push_i,
  input  logic [Lanes*LineNumberBits-1:0] line_i,
  input  logic [Lanes*4-1:0]              dirty_i,
  output logic [Lanes*4-1:0]              slot_for_o
);

  localparam int unsigned Entries = 8;

  logic [LineNumberBits-1:0] line_q[Entries];
  logic [3:0] dirty_q[Entries], slot_q[Entries];
  logic [Entries-1:0] is_held;
  logic [2:0] head_q, place[Lanes];
  logic [3:0] count_q, pushes, next_slot_q, dirty, lowest, beyond, rest;
  logic pop;

  assign dirty = dirty_q[head_q];
  assign lowest = dirty & (~dirty + 4'd1);
  assign beyond = dirty + lowest;  // carries through the run of ones
  assign sectors_o = dirty & ~beyond;
  assign rest = dirty & beyond;
  assign line_o = line_q[head_q];
  assign slot_o = slot_q[head_q];
  assign send_o = can_send_i & (count_q != 4'd0);
  assign pop = send_o & (rest == 4'd0);
  assign room_o = 4'd8 - count_q + {3'd0, pop};

  for (genvar e = 0; e < Entries; e++) begin : gen_held
    logic [2:0] age;
    assign age = 3'(e) - head_q;
    assign is_held[e] = ({1'b0, age} < count_q) & ~(pop & (age == 3'd0));
  end
  always_comb begin
    pushes = 4'd0;
    for (int unsigned i = 0; i < Lanes; i++) begin
      is_held_o[i] = 1'b0;
      for (int unsigned e = 0; e < Entries; e++) begin
        if (is_held[e] & (line_q[e] == sought_i[i*LineNumberBits+:LineNumberBits])) is_held_o[i] = 1'b1;
      end
      place[i] = head_q + count_q[2:0] + pushes[2:0];
      slot_for_o[4*i+:4] = next_slot_q + pushes;
      pushes = pushes + {3'd0, push_i[i]};
    end
  end

  always_ff @(posedge clk_i) begin
    if (send_o) dirty_q[head_q] <= rest;
    for (int unsigned i = 0; i < Lanes; i++) begin
      if (push_i[i]) begin
        line_q[place[i]] <= line_i[i*LineNumberBits+:LineNumberBits];
        dirty_q[place[i]] <= dirty_i[4*i+:4];
        slot_q[place[i]] <= slot_for_o[4*i+:4];
      end
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      head_q <= 3'd0;
      count_q <= 4'd0;
      next_slot_q <= 4'd0;
    end else begin
      head_q <= head_q + {2'd0, pop};
      count_q <= count_q - {3'd0, pop} + pushes;
      next_slot_q <= next_slot_q + pushes;
    end
  end

`ifndef SYNTHESIS
  assert property (@(posedge clk_i) disable iff (!rst_ni) pushes <= room_o)
  else $error("more lines than there is room for");
`endif

endmodule
