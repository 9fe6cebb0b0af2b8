// What the units of the dual-triangle tester share. Points are {z, y, x}.
package pair_pkg;

  // How many triangles a cycle, and what they share; as rtu.pair.mode of the simulator.
  localparam int unsigned Single = 0;           // one triangle: a pair takes two cycles
  localparam int unsigned DualIndependent = 1;  // two complete testers
  localparam int unsigned DualShared = 2;       // each of the four vertices and the common edge once

  // In cycles; miss_test and pair_reject check them against fp32_pkg. Yosys 0.23 knows no package in a package.
  localparam int unsigned ShearLatency = 12;   // add, multiply, add
  localparam int unsigned EdgeLatency = 8;     // multiply, add
  localparam int unsigned ReachLatency = 6;    // of a triangle from its sheared corners: add, twice the larger
  localparam int unsigned BoundLatency = 14;   // from the reach: halve, add, halve, multiply, add
  localparam int unsigned RejectLatency = 33;  // shear, reach, bound, compare

  // The axes (kz, ky, kx) of a point, kz being the axis of the ray's largest direction component.
  function automatic logic [95:0] turned(input logic [95:0] p, input logic [1:0] kz);
    unique case (kz)
      2'd0: turned = {p[31:0], p[95:64], p[63:32]};
      2'd1: turned = {p[63:32], p[31:0], p[95:64]};
      default: turned = p;
    endcase
  endfunction

endpackage
