// The first of an MSHR's targets that needs nothing but arrived sectors, and the row without it. A row is {count,
// targets}, a target {tag, sectors}, the oldest lowest.
module satisfied_target #(
  parameter int unsigned Targets = 16,
  parameter int unsigned TagBits = 7
) (
  input  logic [$clog2(Targets)+Targets*(TagBits+4):0] row_i,
  input  logic [3:0]                                   arrived_i,
  output logic                                         is_found_o,
  output logic                                         has_more_o,
  output logic [TagBits-1:0]                           tag_o,
  output logic [3:0]                                   sectors_o,
  output logic [$clog2(Targets)+Targets*(TagBits+4):0] row_o
);

  localparam int unsigned Width = TagBits + 4;
  localparam int unsigned CountBits = $clog2(Targets) + 1;

  logic [CountBits-1:0] count;
  logic [(Targets+1)*Width-1:0] targets;
  logic is_satisfied, moves;  // moves: the first has been found, and the rest close up
  assign count = row_i[Targets*Width+:CountBits];
  assign targets = {{Width{1'b0}}, row_i[Targets*Width-1:0]};

  always_comb begin
    moves = 1'b0;
    has_more_o = 1'b0;
    {tag_o, sectors_o} = '0;
    row_o[Targets*Width+:CountBits] = count;
    for (int unsigned i = 0; i < Targets; i++) begin
      is_satisfied = (CountBits'(i) < count) & ~(|(targets[i*Width+:4] & ~arrived_i));
      has_more_o = has_more_o | (moves & is_satisfied);
      if (is_satisfied & ~moves) {tag_o, sectors_o} = targets[i*Width+:Width];
      moves = moves | is_satisfied;
      row_o[i*Width+:Width] = moves ? targets[(i+1)*Width+:Width] : targets[i*Width+:Width];
    end
    if (moves) row_o[Targets*Width+:CountBits] = count - CountBits'(1);
  end
  assign is_found_o = moves;

endmodule
