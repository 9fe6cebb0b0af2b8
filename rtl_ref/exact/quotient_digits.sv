// The quotient of two significands, by two bits a cycle: with n doubled where it is less than d, q = floor(2^24 n / d), 25
// bits, and what remains, 13 cycles after start_i. Both have their leading bit set; d_i and 3 * d_i stay.
module quotient_digits (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        start_i,
  input  logic [40:0] n_i,
  input  logic        is_less_i,  // n < d
  input  logic [40:0] d_i,
  input  logic [42:0] triple_i,
  output logic [24:0] q_o,
  output logic [40:0] remainder_o
);

  // The first cycle takes the leading one.
  logic is_first_q, is_busy_q;
  logic [3:0] count_q;
  logic [41:0] remainder_q;
  logic [42:0] x, next;
  logic [43:0] less_1, less_2, less_3;
  logic [1:0] digit;
  logic [24:0] q_q;

  assign x = is_first_q ? {1'b0, remainder_q} : {remainder_q[40:0], 2'd0};
  assign less_1 = {1'b0, x} - {3'd0, d_i};
  assign less_2 = {1'b0, x} - {2'd0, d_i, 1'b0};
  assign less_3 = {1'b0, x} - {1'b0, triple_i};
  assign digit = {~less_2[43], less_2[43] ? ~less_1[43] : ~less_3[43]};
  assign next = digit[1] ? (digit[0] ? less_3[42:0] : less_2[42:0]) : (digit[0] ? less_1[42:0] : x);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) is_busy_q <= 1'b0;
    else is_busy_q <= start_i | (is_busy_q & count_q != 4'd12);
  end
  always_ff @(posedge clk_i) begin
    is_first_q <= start_i;
    if (start_i) begin
      count_q <= 4'd0;
      remainder_q <= is_less_i ? {n_i, 1'b0} : {1'b0, n_i};
    end else if (is_busy_q) begin
      count_q <= count_q + 4'd1;
      remainder_q <= next[41:0];
      q_q <= {q_q[22:0] & {23{~is_first_q}}, digit};
    end
  end
  assign q_o = q_q;
  assign remainder_o = remainder_q[40:0];

`ifndef SYNTHESIS
  assert property (@(posedge clk_i) disable iff (!rst_ni) is_busy_q |-> next < {2'd0, d_i})
  else $error("a quotient digit is wrong");
`endif

endmodule
