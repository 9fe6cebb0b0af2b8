// The queue of eight requests to memory. In a cycle a write-back may enter, and after it a fetch of each lane.
module memory_requests #(
  parameter int unsigned Lanes          = 4,
  parameter int unsigned LineNumberBits = 25,
  parameter int unsigned IdBits         = 10
) (
  input  logic                            clk_i,
  input  logic                            rst_ni,
  output logic [3:0]                      room_o,       // at the begin of the cycle
  input  logic                            write_i,
  input  logic [LineNumberBits-1:0]       write_line_i,
  input  logic [3:0]                      write_sectors_i,
  input  logic [3:0]                      write_slot_i,
  input  logic [Lanes-1:0]                fetch_i,
  input  logic [Lanes*LineNumberBits-1:0] fetch_line_i,
  input  logic [Lanes*IdBits-1:0]         fetch_id_i,   // {MSHR, missing sectors}: from the first to the last is asked for
  output logic                            valid_o,
  input  logic                            ready_i,
  output logic                            is_write_o,
  output logic [LineNumberBits-1:0]       line_o,
  output logic [3:0]                      sectors_o,
  output logic [IdBits-1:0]               id_o,
  output logic [3:0]                      slot_o        // of the data of a write
);

  localparam int unsigned Width = 1 + LineNumberBits + 4 + IdBits;

  // All sectors from the first to the last of the mask.
  function automatic logic [3:0] span(input logic [3:0] mask);
    span = mask | ((mask[0] & (mask[2] | mask[3])) ? 4'b0010 : 4'd0) |
           (((mask[0] | mask[1]) & mask[3]) ? 4'b0100 : 4'd0);
  endfunction

  logic [Width-1:0] request_q[8];
  logic [2:0] head_q, place[Lanes];
  logic [3:0] count_q, pushes;
  logic pop;

  assign room_o = 4'd8 - count_q;
  always_comb begin
    pushes = {3'd0, write_i};
    for (int unsigned i = 0; i < Lanes; i++) begin
      place[i] = head_q + count_q[2:0] + pushes[2:0];
      pushes = pushes + {3'd0, fetch_i[i]};
    end
  end
  always_ff @(posedge clk_i) begin
    if (write_i) begin
      request_q[head_q+count_q[2:0]] <= {1'b1, write_line_i, write_sectors_i, {(IdBits - 4) {1'b0}}, write_slot_i};
    end
    for (int unsigned i = 0; i < Lanes; i++) begin
      if (fetch_i[i]) begin
        request_q[place[i]] <= {
          1'b0, fetch_line_i[i*LineNumberBits+:LineNumberBits], span(fetch_id_i[i*IdBits+:4]), fetch_id_i[i*IdBits+:IdBits]
        };
      end
    end
  end

  assign {is_write_o, line_o, sectors_o, id_o} = request_q[head_q];
  assign slot_o = id_o[3:0];
  assign valid_o = count_q != 4'd0;
  assign pop = valid_o & ready_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      head_q <= 3'd0;
      count_q <= 4'd0;
    end else begin
      head_q <= head_q + {2'd0, pop};
      count_q <= count_q + pushes - {3'd0, pop};
    end
  end

`ifndef SYNTHESIS
  assert property (@(posedge clk_i) disable iff (!rst_ni) pushes <= room_o)
  else $error("more requests than there is room for");
`endif

endmodule
