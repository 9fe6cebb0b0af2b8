// Keeps the children that the ray meets and lists them near to far, two enabled cycles later; of equally near ones
// the lowest index comes first. Places count_o and up hold zeros.
module near_to_far #(
  parameter int unsigned Width = 4
) (
  input  logic                clk_i,
  input  logic                en_i,
  input  logic [Width-1:0]    is_child_i,
  input  logic [32*Width-1:0] t_near_i,
  input  logic [32*Width-1:0] t_far_i,
  output logic [3:0]          count_o,
  output logic [3*Width-1:0]  child_o,
  output logic [32*Width-1:0] t_near_o
);

  // First stage: all comparisons. is_before[i][j], i < j: child i goes before child j.
  logic [Width-1:0] is_met_q;
  logic [32*Width-1:0] t_near_q;
  logic [Width-1:0] is_before[Width];

  for (genvar i = 0; i < Width; i++) begin : gen_compare
    logic is_met_d;
    assign is_met_d = is_child_i[i] & ~fp32_pkg::is_less(t_far_i[32*i+:32], t_near_i[32*i+:32]);
    always_ff @(posedge clk_i) begin
      if (en_i) is_met_q[i] <= is_met_d;
    end
    for (genvar j = 0; j < Width; j++) begin : gen_pair
      if (j > i) begin : gen_upper
        logic before_d, before_q;
        assign before_d = ~fp32_pkg::is_less(t_near_i[32*j+:32], t_near_i[32*i+:32]);
        always_ff @(posedge clk_i) begin
          if (en_i) before_q <= before_d;
        end
        assign is_before[i][j] = before_q;
        assign is_before[j][i] = ~before_q;
      end else if (j == i) begin : gen_self
        assign is_before[i][i] = 1'b0;
      end
    end
  end
  always_ff @(posedge clk_i) begin
    if (en_i) t_near_q <= t_near_i;
  end

  // Second stage: a child's place is the number of met children before it.
  logic [3:0] place[Width], count_d, count_q;
  logic [3*Width-1:0] child_d, child_q;
  logic [32*Width-1:0] sorted_d, sorted_q;

  for (genvar i = 0; i < Width; i++) begin : gen_place
    always_comb begin
      place[i] = 4'd0;
      for (int unsigned j = 0; j < Width; j++) place[i] = place[i] + {3'd0, is_met_q[j] & is_before[j][i]};
    end
  end
  always_comb begin
    count_d = 4'd0;
    child_d = '0;
    sorted_d = '0;
    for (int unsigned i = 0; i < Width; i++) begin
      count_d = count_d + {3'd0, is_met_q[i]};
      for (int unsigned k = 0; k < Width; k++) begin
        if (is_met_q[i] && place[i] == k[3:0]) begin
          child_d[3*k+:3] = child_d[3*k+:3] | i[2:0];
          sorted_d[32*k+:32] = sorted_d[32*k+:32] | t_near_q[32*i+:32];
        end
      end
    end
  end
  always_ff @(posedge clk_i) begin
    if (en_i) begin
      count_q <= count_d;
      child_q <= child_d;
      sorted_q <= sorted_d;
    end
  end
  assign count_o = count_q;
  assign child_o = child_q;
  assign t_near_o = sorted_q;

endmodule
