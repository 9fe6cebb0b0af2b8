// What the parts of the RTU share. An entry of a stack is {NodeRef, t_near}; NodeRef as in model/memory_image.hpp. A
// hit is {primitive id, v, u, t}.
package rtu_pkg;

  // Where a result comes from, and with the same number: to whom the cache replies.
  localparam int unsigned FromPair = 0, FromBox = 1, FromStack = 2;
  localparam int unsigned ToBox = 0, ToPair = 1, ToScheduler = 2;

  localparam int unsigned EntryBits = 64;
  localparam int unsigned HitBits = 128;
  localparam int unsigned BlockEntries = 4;  // of a stack, written and read back together, at most
  localparam int unsigned BlockBits = 12;    // blocks of a ray in memory: their number
  localparam int unsigned SpillBits = 3;     // blocks written after one visit: their number

endpackage
