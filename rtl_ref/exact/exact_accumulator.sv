// The exact sum of up to 31 products, and its sign: a fixed-point number of 28 words of 32 bits, wide enough for every
// product of three binary32 numbers [KUL]. A word has six bits more than its digits, so that a product is added to the
// four words that it covers without a carry; the carries are settled when the sign is asked for, four words a cycle
// from below, which also clears the sum.
//
// A product enters each cycle. resolve_i, a cycle or more after the last product, starts the settling; is_done_o comes
// 8 cycles later, for one cycle, with the sign. Nothing may enter in between. After reset, resolve first.
module exact_accumulator (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        valid_i,
  input  logic        sign_i,
  input  logic [9:0]  exponent_i,
  input  logic [71:0] significand_i,
  input  logic        resolve_i,
  output logic        is_done_o,
  output logic        is_negative_o,
  output logic        is_zero_o
);

  localparam logic [2:0] LastRow = 3'd6;

  // First cycle: the product as four digits from word exponent / 32 on.
  logic valid_q, sign_q;
  logic [4:0] first_word_q;
  logic [127:0] digits_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) valid_q <= 1'b0;
    else valid_q <= valid_i;
  end
  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      sign_q <= sign_i;
      first_word_q <= exponent_i[9:5];
      digits_q <= {56'd0, significand_i} << exponent_i[4:0];
    end
  end

  // Settling: row by row, {bank 3, ... bank 0} being four consecutive words.
  logic is_settling_q, is_last_row, is_done_q, has_digit_q, has_digit;
  logic [2:0] row_q;
  logic signed [6:0] carry_q;
  logic signed [6:0] carry[5]  /* verilator split_var */;
  logic [3:0] digit_is_set;

  assign is_last_row = row_q == LastRow;
  assign carry[0] = carry_q;
  assign has_digit = has_digit_q | (|digit_is_set);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      is_settling_q <= 1'b0;
      is_done_q <= 1'b0;
    end else begin
      is_settling_q <= resolve_i | (is_settling_q & ~is_last_row);
      is_done_q <= is_settling_q & is_last_row;
    end
  end
  always_ff @(posedge clk_i) begin
    if (resolve_i) begin
      row_q <= 3'd0;
      carry_q <= 7'sd0;
      has_digit_q <= 1'b0;
    end else if (is_settling_q) begin
      row_q <= row_q + 3'd1;
      carry_q <= carry[4];
      has_digit_q <= has_digit;
    end
  end
  // The carry out of the top is minus one for a negative sum, else zero.
  assign is_done_o = is_done_q;
  assign is_negative_o = carry_q[6];
  assign is_zero_o = ~carry_q[6] & ~has_digit_q;

  // Word i is in bank i % 4, row i / 4.
  for (genvar bank = 0; bank < 4; bank++) begin : gen_bank
    logic signed [37:0] word_q[7], word, added, next;
    logic signed [38:0] settled;
    logic [1:0] place;
    logic [4:0] digit_word;
    logic [2:0] row;
    logic [31:0] digit;

    assign place = 2'(bank) - first_word_q[1:0];
    assign digit = digits_q[32*place+:32];
    assign digit_word = first_word_q + 5'(3 - bank);  // rounded down to this bank's
    assign row = is_settling_q ? row_q : digit_word[4:2];
    assign word = word_q[row];
    assign added = sign_q ? word - $signed({6'd0, digit}) : word + $signed({6'd0, digit});
    assign next = is_settling_q ? 38'sd0 : added;
    always_ff @(posedge clk_i) begin
      if (valid_q | is_settling_q) word_q[row] <= next;
    end
    assign settled = 39'(word) + 39'(carry[bank]);
    assign carry[bank+1] = settled[38:32];
    assign digit_is_set[bank] = |settled[31:0];
  end

`ifndef SYNTHESIS
  assert property (@(posedge clk_i) disable iff (!rst_ni) (resolve_i | is_settling_q) |-> !valid_i)
  else $error("a product enters while the sum is settled");
  assert property (@(posedge clk_i) disable iff (!rst_ni) is_settling_q |-> !valid_q)
  else $error("a product enters while the sum is settled");
  assert property (@(posedge clk_i) disable iff (!rst_ni) valid_i |-> exponent_i <= 10'd759)
  else $error("a product beyond the accumulator");
`endif

endmodule
