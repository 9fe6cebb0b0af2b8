// binary32 as all units see it: latencies of the pipelined operations, classes, comparisons.
//
// Every operation is IEEE 754 binary32 with subnormal numbers, rounded to nearest even, exactly as C++ float
// computes it. Which NaN an operation gives is left open by C++ and differs between hosts; here it is always
// QuietNan. No NaN reaches a result of a tester: comparisons treat them all alike.
package fp32_pkg;

  localparam int unsigned MulLatency = 4;
  localparam int unsigned AddLatency = 4;

  localparam logic [31:0] QuietNan = 32'h7fc0_0000;

  function automatic logic is_nan(input logic [31:0] x);
    is_nan = (&x[30:23]) & (|x[22:0]);
  endfunction

  function automatic logic is_infinite(input logic [31:0] x);
    is_infinite = (&x[30:23]) & ~(|x[22:0]);
  endfunction

  function automatic logic [31:0] magnitude(input logic [31:0] x);
    magnitude = {1'b0, x[30:0]};
  endfunction

  function automatic logic [31:0] negated(input logic [31:0] x);
    negated = {~x[31], x[30:0]};
  endfunction

  // a < b; false when either is a NaN, and for zeros of any sign.
  function automatic logic is_less(input logic [31:0] a, input logic [31:0] b);
    logic magnitude_is_less, magnitude_is_equal, is_ordered, are_zero;
    magnitude_is_less = a[30:0] < b[30:0];
    magnitude_is_equal = a[30:0] == b[30:0];
    is_ordered = ~is_nan(a) & ~is_nan(b);
    are_zero = ~(|a[30:0]) & ~(|b[30:0]);
    unique case ({a[31], b[31]})
      2'b00: is_less = is_ordered & magnitude_is_less;
      2'b01: is_less = 1'b0;
      2'b10: is_less = is_ordered & ~are_zero;
      2'b11: is_less = is_ordered & ~magnitude_is_less & ~magnitude_is_equal;
    endcase
  endfunction

  // As std::max and std::min: the first operand where the two are equal or either is a NaN.
  function automatic logic [31:0] larger(input logic [31:0] a, input logic [31:0] b);
    larger = is_less(a, b) ? b : a;
  endfunction

  function automatic logic [31:0] smaller(input logic [31:0] a, input logic [31:0] b);
    smaller = is_less(b, a) ? b : a;
  endfunction

  // How many zeros lead, and x without them. Requires x != 0; zero counts as 31.
  function automatic logic [36:0] normalised(input logic [31:0] x);
    logic [31:0] v;
    logic [4:0] zeros;
    v = x;
    zeros[4] = ~(|v[31:16]);
    if (zeros[4]) v = {v[15:0], 16'd0};
    zeros[3] = ~(|v[31:24]);
    if (zeros[3]) v = {v[23:0], 8'd0};
    zeros[2] = ~(|v[31:28]);
    if (zeros[2]) v = {v[27:0], 4'd0};
    zeros[1] = ~(|v[31:30]);
    if (zeros[1]) v = {v[29:0], 2'd0};
    zeros[0] = ~v[31];
    if (zeros[0]) v = {v[30:0], 1'b0};
    normalised = {zeros, v};
  endfunction

  function automatic logic [4:0] leading_zeros(input logic [31:0] x);
    logic [36:0] both;
    both = normalised(x);
    leading_zeros = both[36:32];
  endfunction

endpackage
