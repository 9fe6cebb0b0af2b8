// The free MSHRs, as a ring of their numbers. Of the ones that are closed in a cycle, an access of the same cycle may
// take one; those are the last in the order in which they are given out. After reset the ring is filled, a number a
// cycle.
module mshr_ids #(
  parameter int unsigned Lanes = 4,
  parameter int unsigned Mshrs = 64
) (
  input  logic                            clk_i,
  input  logic                            rst_ni,
  input  logic [$clog2(Mshrs)-1:0]        last_mshr_i,  // in use
  input  logic                            fill_i,       // put fill_index_i at its place
  input  logic [$clog2(Mshrs)-1:0]        fill_index_i,
  input  logic [Lanes-1:0]                close_i,
  input  logic [Lanes*$clog2(Mshrs)-1:0]  closed_i,
  output logic [$clog2(Mshrs):0]          free_o,       // with those that are closed in this cycle
  output logic [Lanes*$clog2(Mshrs)-1:0]  next_o,       // the ones that are given out next, in order
  input  logic [2:0]                      taken_i
);

  localparam int unsigned Bits = $clog2(Mshrs);

  logic [Bits-1:0] head_q, tail;
  logic [Bits:0] count_q;
  logic [Lanes*Bits-1:0] place, head_place, stored, closed_in_order;
  logic [2:0] closes;

  assign tail = head_q + count_q[Bits-1:0];
  always_comb begin
    closes = 3'd0;
    closed_in_order = '0;
    for (int unsigned i = 0; i < Lanes; i++) begin
      place[i*Bits+:Bits] = tail + Bits'(closes);
      head_place[i*Bits+:Bits] = head_q + Bits'(i);
      for (int unsigned k = 0; k <= i; k++) begin
        if (close_i[i] & ({29'd0, closes} == k)) begin
          closed_in_order[k*Bits+:Bits] = closed_i[i*Bits+:Bits];
        end
      end
      closes = closes + {2'd0, close_i[i]};
    end
  end

  logic [Lanes-1:0] write;
  logic [Lanes*Bits-1:0] write_index, write_data;
  always_comb begin
    write = close_i;
    write_index = place;
    write_data = closed_i;
    if (fill_i) begin
      write[0] = 1'b1;
      write_index[0+:Bits] = fill_index_i;
      write_data[0+:Bits] = fill_index_i;
    end
  end
  storage #(.Width(Bits), .Entries(Mshrs), .Reads(Lanes), .Writes(Lanes)) u_ring (
    .clk_i, .read_index_i(head_place), .read_o(stored), .write_i(write), .write_index_i(write_index),
    .data_i(write_data)
  );

  assign free_o = count_q + (Bits + 1)'(closes);
  always_comb begin
    next_o = stored;
    for (int unsigned i = 0; i < Lanes; i++) begin
      for (int unsigned k = 0; k <= i; k++) begin
        if ({{(31 - Bits) {1'b0}}, count_q} == i - k) next_o[i*Bits+:Bits] = closed_in_order[k*Bits+:Bits];
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      head_q <= '0;
      count_q <= '0;
    end else if (fill_i) begin
      count_q <= {1'b0, last_mshr_i} + (Bits + 1)'(1);
    end else begin
      head_q <= head_q + Bits'(taken_i);
      count_q <= count_q + (Bits + 1)'(closes) - (Bits + 1)'(taken_i);
    end
  end

`ifndef SYNTHESIS
  assert property (@(posedge clk_i) disable iff (!rst_ni) (Bits + 1)'(taken_i) <= free_o)
  else $error("more MSHRs are taken than are free");
  assert property (@(posedge clk_i) disable iff (!rst_ni) !fill_i |-> {1'b0, count_q} <= {2'b0, last_mshr_i} + 1'b1)
  else $error("an MSHR was given back twice");
`endif

endmodule
