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
  logic [Targets-1:0] is_satisfied, is_first, is_behind;
  logic [(Targets+1)*Width-1:0] targets;
  assign count = row_i[Targets*Width+:CountBits];
  assign targets = {{Width{1'b0}}, row_i[Targets*Width-1:0]};

  for (genvar i = 0; i < Targets; i++) begin : gen_target
    assign is_satisfied[i] = (CountBits'(i) < count) & ~(|(targets[i*Width+:4] & ~arrived_i));
    if (i == 0) begin : gen_oldest
      assign is_behind[i] = 1'b0;
    end else begin : gen_younger
      assign is_behind[i] = |is_satisfied[i-1:0];
    end
    assign is_first[i] = is_satisfied[i] & ~is_behind[i];
    assign row_o[i*Width+:Width] = targets[(i+((is_behind[i]|is_first[i])?1 : 0))*Width+:Width];
  end
  assign row_o[Targets*Width+:CountBits] = count - CountBits'(is_found_o);
  assign is_found_o = |is_satisfied;
  assign has_more_o = |(is_satisfied & is_behind);
  always_comb begin
    {tag_o, sectors_o} = '0;
    for (int unsigned i = 0; i < Targets; i++) begin
      if (is_first[i]) {tag_o, sectors_o} = {tag_o, sectors_o} | targets[i*Width+:Width];
    end
  end

endmodule
