// The exact sum of up to 31 products, and its leading bits: a fixed-point number of 28 words of 32 bits, modulo 2^896,
// wide enough for every product of three binary32 numbers [KUL] and for 25 bits more. A word has six bits more than its
// digits, so that a product is added to the four words that it covers without a carry. settle_i carries them: words then
// are digits, and more products may follow.
//
//   clear_i    the sum is zero from the next cycle on, whatever is under way
//   settle_i   2 cycles or more after the last product's valid_i; 9 cycles later is_negative_o and is_zero_o hold until
//              the sum changes, and 11 cycles later significand_o, is_exact_o and exponent_o for one cycle
module exact_accumulator (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,
  input  logic        settle_i,
  // a product: (-1)^sign * product * factor * 2^exponent, in units of the last place
  input  logic        valid_i,
  input  logic        sign_i,
  input  logic [9:0]  exponent_i,
  input  logic [47:0] product_i,
  input  logic [23:0] factor_i,
  // the sum
  output logic        is_negative_o,
  output logic        is_zero_o,
  output logic [40:0] significand_o,  // leading bits of the magnitude, cut off; [40] is set unless the sum is zero
  output logic        is_exact_o,     // nothing was cut off
  output logic [9:0]  exponent_o      // of [40]
);
  /* verilator no_inline_module */

  localparam logic [2:0] LastRow = 3'd6;

  // First cycle: multiply.
  logic product_valid_q, product_sign_q;
  logic [9:0] product_exponent_q;
  logic [71:0] product_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) product_valid_q <= 1'b0;
    else product_valid_q <= valid_i & ~clear_i;
  end
  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      product_sign_q <= sign_i;
      product_exponent_q <= exponent_i;
      product_q <= {24'd0, product_i} * {48'd0, factor_i};
    end
  end

  // Second cycle: four digits from word exponent / 32 on. The same register holds digits that are being settled, and the
  // window; its shifter normalises that.
  logic add_q, sign_q, is_reading_q, is_writing_q, opens_window_q, is_window_q;
  logic [4:0] first_word_q, zeros;
  logic [71:0] shifted;
  logic [4:0] shift;
  logic [127:0] digits_q, summed, window;
  assign shifted = is_window_q ? digits_q[95:24] : product_q;
  assign shift = is_window_q ? zeros : product_exponent_q[4:0];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      add_q <= 1'b0;
      opens_window_q <= 1'b0;
      is_window_q <= 1'b0;
    end else begin
      add_q <= product_valid_q & ~clear_i;
      opens_window_q <= is_writing_q & ~is_reading_q;
      is_window_q <= opens_window_q;
    end
  end
  always_ff @(posedge clk_i) begin
    if (is_reading_q) digits_q <= summed;
    else if (opens_window_q) digits_q <= window;
    else if (product_valid_q | is_window_q) digits_q <= {56'd0, shifted} << shift;
    if (is_reading_q) first_word_q <= 5'd0;
    else if (product_valid_q) first_word_q <= product_exponent_q[9:5];
    if (product_valid_q) sign_q <= product_sign_q;
  end

  // Settling, a row of four words a cycle from below: first every word takes what its lower neighbour has beyond 32
  // bits, which leaves carries of -1, 0 and 1; a cycle later these ripple through the row as the words are written.
  logic [2:0] read_row_q, write_row_q;
  logic signed [5:0] high[5], high_q;
  logic [3:0] carries_up, carries_down, carries_up_q, carries_down_q, is_zero, is_full;
  logic up[5]  /* verilator split_var */, down[5]  /* verilator split_var */;
  logic up_q, down_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      is_reading_q <= 1'b0;
      is_writing_q <= 1'b0;
    end else begin
      is_reading_q <= settle_i | (is_reading_q & (read_row_q != LastRow));
      is_writing_q <= is_reading_q;
    end
  end
  always_ff @(posedge clk_i) begin
    if (settle_i) begin
      read_row_q <= 3'd0;
      high_q <= 6'd0;
    end else if (is_reading_q) begin
      read_row_q <= read_row_q + 3'd1;
      high_q <= high[4];
    end
    write_row_q <= read_row_q;
    carries_up_q <= carries_up;
    carries_down_q <= carries_down;
    up_q <= is_writing_q & up[4];
    down_q <= is_writing_q & down[4];
  end
  assign high[0] = high_q;
  assign up[0] = up_q;
  assign down[0] = down_q;

  // Of the settled words: the lowest that is not zero; and where the window begins, three words below the highest that is
  // not zero, as if the sum were positive, or not all ones, as if it were negative.
  logic is_negative, has_digit_q;
  logic [4:0] lowest_q, begin_q, begin_if_negative_q, window_begin;
  function automatic logic [1:0] highest_of(input logic [3:1] set);
    highest_of = {|set[3:2], set[3] | (set[1] & ~set[2])};
  endfunction
  always_ff @(posedge clk_i) begin
    if (settle_i) begin
      has_digit_q <= 1'b0;
      begin_q <= -5'd3;
      begin_if_negative_q <= -5'd3;
    end else if (is_writing_q) begin
      has_digit_q <= has_digit_q | ~(&is_zero);
      if (!has_digit_q) begin
        lowest_q <= {write_row_q, ~is_zero[0] ? 2'd0 : ~is_zero[1] ? 2'd1 : ~is_zero[2] ? 2'd2 : 2'd3};
      end
      if (!(&is_zero)) begin_q <= {write_row_q, highest_of(~is_zero[3:1])} - 5'd3;
      if (!(&is_full)) begin_if_negative_q <= {write_row_q, highest_of(~is_full[3:1])} - 5'd3;
    end
  end
  assign window_begin = is_negative ? begin_if_negative_q : begin_q;

  // Word i is in bank i % 4, row i / 4; words beyond the 28 are dropped, and read as zero.
  logic [4:0] first_read;
  logic [31:0] read[4];
  assign first_read = opens_window_q ? window_begin : first_word_q;
  for (genvar bank = 0; bank < 4; bank++) begin : gen_bank
    logic signed [37:0] word_q[7], word, addend, settling, sum;
    logic [6:0] is_live_q;  // a row's word was written since the sum was cleared
    logic [1:0] place;
    logic [4:0] digit_word;
    logic [2:0] read_row, write_row;
    logic [31:0] digit;
    logic [33:0] settled;
    logic is_one, is_almost_full, is_upper_zero, is_upper_full;

    assign digit_word = first_read + 5'(3 - bank);  // rounded down to this bank's
    assign read_row = is_reading_q ? read_row_q : digit_word[4:2];
    always_comb begin
      word = 38'sd0;
      for (int unsigned i = 0; i < 7; i++) begin
        if (read_row == 3'(i) && is_live_q[i]) word = word | word_q[i];
      end
    end
    assign read[bank] = word[31:0];

    // A product's digit, or a settled one with its carry.
    assign place = 2'(bank) - first_word_q[1:0];
    assign digit = digits_q[32*place+:32];
    assign settling = {{37{down[bank]}}, up[bank] | down[bank]};
    assign addend = is_writing_q ? settling : word;
    assign sum = sign_q & ~is_writing_q ? addend - $signed({6'd0, digit}) : addend + $signed({6'd0, digit});
    assign write_row = is_writing_q ? write_row_q : read_row;
    always_ff @(posedge clk_i) begin
      for (int unsigned i = 0; i < 7; i++) begin
        if ((add_q | is_writing_q) && write_row == 3'(i)) begin
          word_q[i] <= is_writing_q ? {6'd0, sum[31:0]} : sum;
        end
      end
    end
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) is_live_q <= 7'd0;
      else if (clear_i) is_live_q <= 7'd0;
      else if (add_q | is_writing_q) is_live_q <= is_live_q | 7'(8'd1 << write_row);
    end

    assign high[bank+1] = word[37:32];
    assign settled = {2'd0, word[31:0]} + {{28{high[bank][5]}}, high[bank]};
    assign summed[32*bank+:32] = settled[31:0];
    assign carries_up[bank] = settled[33:32] == 2'b01;
    assign carries_down[bank] = settled[33];

    assign is_upper_zero = ~(|digits_q[32*bank+1+:31]);
    assign is_upper_full = &digits_q[32*bank+1+:31];
    assign is_one = is_upper_zero & digits_q[32*bank];
    assign is_almost_full = is_upper_full & ~digits_q[32*bank];
    assign up[bank+1] = (carries_up_q[bank] & ~(down[bank] & is_upper_zero & ~is_one)) |
        (~carries_down_q[bank] & up[bank] & is_upper_full & ~is_almost_full);
    assign down[bank+1] = (carries_down_q[bank] & ~(up[bank] & is_upper_full & ~is_almost_full)) |
        (~carries_up_q[bank] & down[bank] & is_upper_zero & ~is_one);
    assign is_zero[bank] = up[bank] ? is_upper_full & ~is_almost_full : down[bank] ? is_one : is_upper_zero & ~is_one;
    assign is_full[bank] = up[bank] ? is_almost_full : down[bank] ? is_upper_zero & ~is_one : is_upper_full &
        ~is_almost_full;
  end
  assign is_negative = gen_bank[3].word_q[6][31] & gen_bank[3].is_live_q[6];
  assign is_negative_o = is_negative;
  assign is_zero_o = ~has_digit_q;

  // The window: the leading word and the next two; then the leading one is shifted to bit 71.
  always_comb begin
    window = 128'd0;
    for (int unsigned i = 1; i < 4; i++) window[32*(i-1)+:32] = read[2'(first_read + 5'(i))];
  end
  logic [31:0] leading_digit;
  logic is_rest_zero_q, was_negative_q;
  logic [4:0] leading_word_q, zeros_q;
  assign leading_digit = digits_q[95:64] ^ {32{was_negative_q}};
  assign zeros = fp32_pkg::leading_zeros(leading_digit);
  always_ff @(posedge clk_i) begin
    if (opens_window_q) begin
      was_negative_q <= is_negative;
      leading_word_q <= window_begin + 5'd3;
    end
    if (is_window_q) begin
      zeros_q <= zeros;
      is_rest_zero_q <= ~(|digits_q[23:0]) & ({1'b0, lowest_q} + 6'd2 >= {1'b0, leading_word_q});
    end
  end

  // The magnitude of a negative sum is its complement, and one more where nothing was cut off.
  logic [41:0] magnitude;
  assign is_exact_o = is_rest_zero_q & ~(|digits_q[30:0]);
  assign magnitude = {1'b0, digits_q[71:31] ^ {41{was_negative_q}}} + {41'd0, was_negative_q & is_exact_o};
  assign significand_o = {magnitude[41] | magnitude[40], magnitude[39:0]};
  assign exponent_o = {leading_word_q, ~zeros_q} + {9'd0, magnitude[41]};

`ifndef SYNTHESIS
  logic busy;
  assign busy = is_reading_q | is_writing_q;
  assert property (@(posedge clk_i) disable iff (!rst_ni) busy |-> !add_q)
  else $error("a product enters while the sum is settled");
  assert property (@(posedge clk_i) disable iff (!rst_ni) is_reading_q | opens_window_q | is_window_q |-> !product_valid_q)
  else $error("a product enters while its register is in use");
  assert property (@(posedge clk_i) disable iff (!rst_ni) clear_i |-> !busy)
  else $error("the sum is cleared while it is settled");
`endif

endmodule
