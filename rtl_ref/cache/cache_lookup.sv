// Looks for a line in one set: where it is, or else which way gives it up: the least recently used one whose line has
// no fill on its way. Also the set's ages once that way has been used; an age is a way's rank, 0 the youngest.
module cache_lookup #(
  parameter int unsigned Ways           = 16,
  parameter int unsigned LineNumberBits = 25,
  parameter int unsigned MshrBits       = 6
) (
  input  logic [$clog2(Ways)-1:0]                     last_way_i,  // in use
  input  logic [LineNumberBits-1:0]                   line_i,
  input  logic [Ways*(LineNumberBits+12+MshrBits)-1:0] set_i,      // {mshr, pending, dirty, valid, line} of each way
  input  logic [Ways*$clog2(Ways)-1:0]                ages_i,
  output logic                                        is_hit_o,
  output logic                                        has_victim_o,
  output logic [$clog2(Ways)-1:0]                     way_o,       // of the line, or of the victim
  output logic [LineNumberBits+12+MshrBits-1:0]       entry_o,     // there
  output logic [Ways*$clog2(Ways)-1:0]                ages_o
);

  localparam int unsigned WayBits = $clog2(Ways);
  localparam int unsigned EntryBits = LineNumberBits + 12 + MshrBits;

  logic [Ways-1:0] is_in_use, is_there, may_leave, is_chosen, is_victim;
  logic [Ways-1:0] age_may_leave, age_leaves;  // [age]
  for (genvar w = 0; w < Ways; w++) begin : gen_way
    logic [LineNumberBits-1:0] line;
    logic [3:0] valid, pending;
    assign line = set_i[w*EntryBits+:LineNumberBits];
    assign valid = set_i[w*EntryBits+LineNumberBits+:4];
    assign pending = set_i[w*EntryBits+LineNumberBits+8+:4];
    if (w == 0) begin : gen_first
      assign is_in_use[w] = 1'b1;
    end else begin : gen_other
      assign is_in_use[w] = WayBits'(w) <= last_way_i;
    end
    assign is_there[w] = is_in_use[w] & (line == line_i) & (|{valid, pending});
    assign may_leave[w] = is_in_use[w] & ~(|pending);
  end

  // Ages are a permutation, so that the oldest one that may leave names the victim.
  logic [WayBits-1:0] age;
  logic older_leaves;
  always_comb begin
    age_may_leave = '0;
    for (int unsigned w = 0; w < Ways; w++) begin
      age_may_leave = age_may_leave | (Ways'(may_leave[w]) << ages_i[w*WayBits+:WayBits]);
    end
    older_leaves = 1'b0;
    for (int unsigned a = Ways; a > 0; a--) begin
      age_leaves[a-1] = age_may_leave[a-1] & ~older_leaves;
      older_leaves = older_leaves | age_may_leave[a-1];
    end
    for (int unsigned w = 0; w < Ways; w++) is_victim[w] = age_leaves[ages_i[w*WayBits+:WayBits]];
  end

  assign is_hit_o = |is_there;
  assign has_victim_o = |may_leave;
  assign is_chosen = is_hit_o ? is_there : is_victim;
  always_comb begin
    way_o = '0;
    entry_o = '0;
    age = '0;
    for (int unsigned w = 0; w < Ways; w++) begin
      if (is_chosen[w]) begin
        way_o = way_o | WayBits'(w);
        entry_o = entry_o | set_i[w*EntryBits+:EntryBits];
        age = age | ages_i[w*WayBits+:WayBits];
      end
    end
    for (int unsigned w = 0; w < Ways; w++) begin
      ages_o[w*WayBits+:WayBits] = ages_i[w*WayBits+:WayBits];
      if (ages_i[w*WayBits+:WayBits] < age) ages_o[w*WayBits+:WayBits] = ages_i[w*WayBits+:WayBits] + WayBits'(1);
      if (is_chosen[w]) ages_o[w*WayBits+:WayBits] = '0;
    end
  end

endmodule
