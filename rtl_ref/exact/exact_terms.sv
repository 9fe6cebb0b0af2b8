// The products of the exact sums of a ray and a triangle with corners a, b, c, n = (b - a) x (c - a), two cycles after
// their place in the program: a product of two numbers that the sums share, and for each sum a third factor. A phase has
// four groups (two vectors and a third for each sum) of six products, x[j] y[k] z[i] and - x[k] y[j] z[i] for three axes
// i, (i, j, k) in cyclic order: z . (x x y) in all, the cross product of the two.
//
//   phase      group  x, y          z of sum 0, (a - origin) . n        z of sum 1, direction . n
//   Distance   0-2    a,b b,c c,a   - origin                            direction
//              3      b,c           a
//                                   edge c -> a                         edge a -> b
//   Weights    0      c,a           direction
//              1      a,b                                               direction
//              2      dir., origin  c                                   a
//              3      dir., origin  - a                                 - b
//   TieX, TieY 0      dir., a                                           - the unit vector of axis kx, ky
//              1      dir., b                                           the same
//   Midpoint   1-3    a,b b,c c,a   - (2 whole + 1) direction, one axis a phase, in three parts
//
// Without its differences, d . ((p - o) x (q - p)) is d . (p x q) + (p - q) . (d x o), and (a - o) . n is a . (b x c) -
// o . n with n = a x b + b x c + c x a. In phase Midpoint the first product of group 0 is direction[axis] * whole, 48
// bits, whose halves are two of the parts.
module exact_terms (
  input  logic         clk_i,
  input  logic         rst_ni,
  input  logic         clear_i,       // drops what is under way
  input  logic         valid_i,
  input  logic [2:0]   phase_i,
  input  logic [1:0]   group_i,
  input  logic [1:0]   place_i,       // 0 to 2: the axis i; in phase Midpoint the part
  input  logic         is_swapped_i,  // the second product of two
  input  logic [1:0]   axis_i,        // of phase Midpoint
  input  logic [23:0]  whole_i,
  input  logic         negate_i,      // the midpoint
  input  logic [7:0]   scale_i,       // added to all exponents
  input  logic [383:0] vertices_i,
  input  logic [5:0]   corners_i,     // which vertex is c, b, a
  input  logic [95:0]  origin_i,
  input  logic [95:0]  direction_i,
  input  logic [1:0]   kz_i,
  output logic [47:0]  product_o,
  output logic [1:0]   valid_o,       // sum 1, sum 0
  output logic [1:0]   sign_o,
  output logic [19:0]  exponent_o,    // 0 to 909, the product's last place being 2^(exponent - 447)
  output logic [47:0]  factor_o
);

  // Exponent field less 1; that of a subnormal number is 0 as well.
  function automatic logic [9:0] exponent_of(input logic [7:0] field);
    exponent_of = {2'd0, field} - {9'd0, |field};
  endfunction

  function automatic logic [23:0] significand_of(input logic [30:0] x);
    significand_of = {|x[30:23], x[22:0]};
  endfunction

  function automatic logic [31:0] component(input logic [95:0] v, input logic [1:0] axis);
    component = axis[1] ? v[95:64] : axis[0] ? v[63:32] : v[31:0];
  endfunction

  function automatic logic [1:0] axis_after(input logic [1:0] axis);
    axis_after = axis[1] ? 2'd0 : axis + 2'd1;
  endfunction

  // The vectors of a group.
  logic is_midpoint, is_tie, is_weights;
  logic [1:0] corner[3], first, second, third[2];
  logic [95:0] x, y, z[2], unit;
  assign is_midpoint = phase_i == hit_pkg::Midpoint;
  assign is_weights = phase_i == hit_pkg::Weights;
  assign is_tie = (phase_i == hit_pkg::TieX) | (phase_i == hit_pkg::TieY);
  for (genvar i = 0; i < 3; i++) begin : gen_corner
    assign corner[i] = corners_i[2*i+:2];
  end
  logic [1:0] tie_axis, number;
  assign tie_axis = (phase_i == hit_pkg::TieX) ? axis_after(kz_i) : axis_after(axis_after(kz_i));
  assign unit[31:0] = (tie_axis == 2'd0) ? 32'h3f80_0000 : 32'd0;
  assign unit[63:32] = (tie_axis == 2'd1) ? 32'h3f80_0000 : 32'd0;
  assign unit[95:64] = (tie_axis == 2'd2) ? 32'h3f80_0000 : 32'd0;

  // Which of ab, bc, ca.
  always_comb begin
    unique case (phase_i)
      hit_pkg::Distance: number = (group_i == 2'd3) ? 2'd1 : group_i;
      hit_pkg::Midpoint: number = group_i - 2'd1;
      hit_pkg::Weights: number = (group_i == 2'd0) ? 2'd2 : 2'd0;
      default: number = 2'd0;
    endcase
    first = number[1] ? corner[2] : number[0] ? corner[1] : corner[0];
    second = number[1] ? corner[0] : number[0] ? corner[2] : corner[1];
    if (is_tie) second = group_i[0] ? corner[1] : corner[0];
    third[0] = (is_weights & ~group_i[0]) ? corner[2] : corner[0];
    third[1] = group_i[0] ? corner[1] : corner[0];
    x = vertices_i[96*first+:96];
    y = vertices_i[96*second+:96];
    if (is_tie | (is_weights & group_i[1]) | (is_midpoint & group_i == 2'd0)) x = direction_i;
    if (is_weights & group_i[1]) y = origin_i;
    z[0] = vertices_i[96*third[0]+:96];
    if (is_weights & ~group_i[1]) z[0] = direction_i;
    if (~is_weights & group_i != 2'd3) z[0] = origin_i;
    z[1] = vertices_i[96*third[1]+:96];
    if (~is_weights | ~group_i[1]) z[1] = is_tie ? unit : direction_i;
  end

  // Whether a sum takes the product, and with the other sign.
  logic [1:0] takes, negates;
  always_comb begin
    takes = 2'b11;
    negates = {2{is_swapped_i}};
    unique case (phase_i)
      hit_pkg::Distance: begin
        takes[1] = group_i != 2'd3;
        negates[0] = is_swapped_i ^ (group_i != 2'd3);
      end
      hit_pkg::Weights: begin
        takes[0] = group_i != 2'd1;
        takes[1] = group_i != 2'd0;
        negates = {2{is_swapped_i ^ (group_i == 2'd3)}};
      end
      hit_pkg::Midpoint: begin
        takes = {2{group_i != 2'd0}};
        negates = {2{is_swapped_i ^ ~negate_i}};
      end
      default: begin
        takes = {~group_i[1], 1'b0};
        negates[1] = is_swapped_i ^ ~group_i[0];
      end
    endcase
  end

  // The numbers, and in phase Midpoint the parts of the third.
  logic [1:0] axis, axis_j, axis_k;
  logic [31:0] number_x, number_y, number_z[2];
  logic [23:0] part;
  logic [4:0] part_scale;
  logic [47:0] product_d, product_q, scaled_q;
  assign axis = is_midpoint ? axis_i : place_i;
  assign axis_j = axis_after(axis);
  assign axis_k = axis_after(axis_j);
  assign number_x = component(x, (is_midpoint & group_i == 2'd0) ? axis : is_swapped_i ? axis_k : axis_j);
  assign number_y = component(y, is_swapped_i ? axis_j : axis_k);
  assign number_z[0] = component(is_midpoint ? direction_i : z[0], axis);
  assign number_z[1] = component(z[1], axis);
  always_comb begin
    unique case (place_i)
      2'd0: {part_scale, part} = {5'd25, scaled_q[47:24]};
      2'd1: {part_scale, part} = {5'd1, scaled_q[23:0]};
      default: {part_scale, part} = {5'd0, significand_of(number_z[0][30:0])};
    endcase
  end

  // First cycle: select. Second: multiply.
  logic valid_q, is_scaled1_q, is_scaled2_q, sign_xy_q;
  logic [1:0] takes_q;
  logic [9:0] exponent_xy_q;
  logic [23:0] significand_x_q, significand_y_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) valid_q <= 1'b0;
    else valid_q <= valid_i;
  end
  assign product_d = {24'd0, significand_x_q} * {24'd0, significand_y_q};
  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      is_scaled1_q <= is_midpoint & group_i == 2'd0 & place_i == 2'd0 & ~is_swapped_i;
      takes_q <= takes;
      sign_xy_q <= number_x[31] ^ number_y[31];
      exponent_xy_q <= exponent_of(number_x[30:23]) + exponent_of(number_y[30:23]);
      significand_x_q <= significand_of(number_x[30:0]);
      significand_y_q <= (is_midpoint & group_i == 2'd0) ? whole_i : significand_of(number_y[30:0]);
    end
    is_scaled2_q <= valid_q & is_scaled1_q;
    if (valid_q) product_q <= product_d;
    if (is_scaled2_q) scaled_q <= product_q;
  end
  assign product_o = product_q;

  for (genvar sum = 0; sum < 2; sum++) begin : gen_sum
    logic sign1_q, sign2_q, valid2_q;
    logic [9:0] exponent1_q, exponent2_q;
    logic [23:0] factor1_q, factor2_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) valid2_q <= 1'b0;
      else valid2_q <= valid_q & takes_q[sum] & ~clear_i;
    end
    always_ff @(posedge clk_i) begin
      if (valid_i) begin
        sign1_q <= number_z[sum][31] ^ negates[sum];
        exponent1_q <= exponent_of(number_z[sum][30:23]) + {2'd0, scale_i} + (is_midpoint ? {5'd0, part_scale} : 10'd0);
        factor1_q <= is_midpoint ? part : significand_of(number_z[sum][30:0]);
      end
      if (valid_q) begin
        sign2_q <= sign1_q ^ sign_xy_q;
        exponent2_q <= exponent1_q + exponent_xy_q;
        factor2_q <= factor1_q;
      end
    end
    assign valid_o[sum] = valid2_q;
    assign sign_o[sum] = sign2_q;
    assign exponent_o[10*sum+:10] = exponent2_q;
    assign factor_o[24*sum+:24] = factor2_q;
  end

endmodule
