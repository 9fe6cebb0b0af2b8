// The cache's input: a queue of four requests, and the line accesses that stand at its head, in order, one a lane. A
// request of several lines is one access after the other. What was accepted of them goes at the end of the cycle.
module cache_requests #(
  parameter int unsigned Lanes       = 4,
  parameter int unsigned AddressBits = 32,
  parameter int unsigned TagBits     = 7
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,
  input  logic                         is_ready_i,
  input  logic [1:0]                   request_valid_i,
  output logic [1:0]                   request_ready_o,
  input  logic [2*AddressBits-1:0]     request_address_i,
  input  logic [7:0]                   request_sectors_i,
  input  logic [2*TagBits-1:0]         request_tag_i,
  input  logic [3:0]                   request_source_i,
  input  logic [1:0]                   request_is_write_i,
  output logic [3:0]                   request_place_o,  // of the queue, for each request's data
  output logic [Lanes-1:0]             valid_o,
  output logic                         has_more_o,       // accesses than lanes
  output logic [Lanes*(AddressBits-7)-1:0] line_o,
  output logic [Lanes*4-1:0]           sectors_o,        // of the line
  output logic [Lanes*TagBits-1:0]     tag_o,
  output logic [Lanes*2-1:0]           source_o,
  output logic [Lanes-1:0]             is_write_o,
  output logic [Lanes-1:0]             is_first_o,       // of its request's lines
  output logic [Lanes*2-1:0]           lines_o,          // of the request
  output logic [Lanes*3-1:0]           first_sector_o,   // the request's, modulo 8
  output logic [Lanes*2-1:0]           place_o,
  input  logic [2:0]                   accepted_i        // accesses, from lane 0 on
);

  localparam int unsigned SectorAddressBits = AddressBits - 5;
  localparam int unsigned LineNumberBits = AddressBits - 7;
  localparam int unsigned Width = SectorAddressBits + 4 + TagBits + 2 + 1;

  logic [Width-1:0] request_q[4];
  logic [1:0] head_q, tail;
  logic [2:0] count_q, pushes, pops;
  logic [1:0] lines_done_q, lines_done;

  assign tail = head_q + count_q[1:0];
  assign request_place_o = {tail + 2'd1, tail};
  assign request_ready_o = {count_q <= 3'd2, count_q <= 3'd3} & {2{is_ready_i}};
  assign pushes = {2'd0, request_valid_i[0] & request_ready_o[0]} +
                  {2'd0, request_valid_i[1] & request_ready_o[1]};

  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < 2; i++) begin
      if (request_valid_i[i] & request_ready_o[i]) begin
        request_q[request_place_o[2*i+:2]] <= {
          request_is_write_i[i], request_source_i[2*i+:2], request_tag_i[i*TagBits+:TagBits],
          request_sectors_i[4*i+:4], request_address_i[i*AddressBits+5+:SectorAddressBits]
        };
      end
    end
  end

  // Walks the accesses; request and line_in_request are those of the lane, and after the loop of the next one.
  logic [2:0] request;
  logic [1:0] line_in_request, place, lines, first, last;
  logic [3:0] last_sector, sectors;
  logic [SectorAddressBits-1:0] address;
  logic is_last;
  logic [3*Lanes-1:0] request_after;
  logic [2*Lanes-1:0] line_after;
  always_comb begin
    request = 3'd0;
    line_in_request = lines_done_q;
    for (int unsigned i = 0; i < Lanes; i++) begin
      place = head_q + request[1:0];
      {is_write_o[i], source_o[2*i+:2], tag_o[i*TagBits+:TagBits], sectors, address} = request_q[place];
      last_sector = {2'd0, address[1:0]} + sectors - 4'd1;  // counted from the first line's begin
      lines = last_sector[3:2] + 2'd1;
      is_last = line_in_request == last_sector[3:2];
      first = (line_in_request == 2'd0) ? address[1:0] : 2'd0;
      last = is_last ? last_sector[1:0] : 2'd3;
      valid_o[i] = request < count_q;
      line_o[i*LineNumberBits+:LineNumberBits] =
          address[SectorAddressBits-1:2] + {{(LineNumberBits - 2) {1'b0}}, line_in_request};
      sectors_o[4*i+:4] = (4'hf << first) & (4'hf >> (2'd3 - last));
      is_first_o[i] = line_in_request == 2'd0;
      lines_o[2*i+:2] = lines;
      first_sector_o[3*i+:3] = address[2:0];
      place_o[2*i+:2] = place;
      if (is_last) begin
        request = request + 3'd1;
        line_in_request = 2'd0;
      end else begin
        line_in_request = line_in_request + 2'd1;
      end
      request_after[3*i+:3] = request;
      line_after[2*i+:2] = line_in_request;
    end
    has_more_o = request < count_q;
  end

  always_comb begin
    pops = 3'd0;
    lines_done = lines_done_q;
    for (int unsigned i = 0; i < Lanes; i++) begin
      if ({29'd0, accepted_i} == i + 1) begin
        pops = request_after[3*i+:3];
        lines_done = line_after[2*i+:2];
      end
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      head_q <= 2'd0;
      count_q <= 3'd0;
      lines_done_q <= 2'd0;
    end else begin
      head_q <= head_q + pops[1:0];
      count_q <= count_q + pushes - pops;
      lines_done_q <= lines_done;
    end
  end

`ifndef SYNTHESIS
  assert property (@(posedge clk_i) disable iff (!rst_ni) pops <= count_q)
  else $error("more requests leave than there are");
  assert property (@(posedge clk_i) disable iff (!rst_ni) accepted_i != 3'd0 |-> valid_o[2'(accepted_i-3'd1)])
  else $error("an access is accepted that is none");
`endif

endmodule
