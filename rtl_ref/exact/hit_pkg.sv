// What the parts of the hit unit share. A phase is 24 cycles of products, four groups of six, and 12 that settle the two
// sums. See exact_terms for what each sums.
package hit_pkg;

  localparam logic [2:0] Distance = 3'd0;  // sum 0: (a - origin) . n; sum 1: direction . n
  localparam logic [2:0] Weights = 3'd1;   // the edge functions of c -> a and of a -> b
  localparam logic [2:0] TieX = 3'd2;      // sum 1: that of a -> b for a ray moved by e along kx, over e
  localparam logic [2:0] TieY = 3'd3;      // ... along ky
  localparam logic [2:0] Midpoint = 3'd4;  // both sums less one axis of a midpoint times direction . n

  localparam logic [2:0] Tail = 3'd5;      // no products: the quotients of the edge functions
  localparam logic [2:0] Judge = 3'd6;     // one cycle: what the sign of an edge function leads to

  localparam logic [5:0] LastStep = 6'd35;     // of a phase
  localparam logic [5:0] LastProduct = 6'd23;  // enters
  localparam logic [5:0] SettleStep = 6'd27;
  // Of the phase after that of a sum, whose window opens at step 0:
  localparam logic [5:0] DivideStep = 6'd2;     // its leading bits are there
  localparam logic [5:0] QuotientStep = 6'd16;  // its quotient
  localparam logic [5:0] DecideStep = 6'd18;    // rounded

endpackage
