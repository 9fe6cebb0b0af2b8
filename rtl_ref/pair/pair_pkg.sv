// What the units of the dual-triangle tester share. Points are {z, y, x}.
package pair_pkg;

  // How many triangles a cycle, and what they share; as rtu.pair.mode of the simulator.
  localparam int unsigned Single = 0;           // one triangle: a pair takes two cycles
  localparam int unsigned DualIndependent = 1;  // two complete testers
  localparam int unsigned DualShared = 2;       // each of the four vertices and the common edge once

  localparam int unsigned ShearLatency = 2 * fp32_pkg::AddLatency + fp32_pkg::MulLatency;
  localparam int unsigned EdgeLatency = fp32_pkg::MulLatency + fp32_pkg::AddLatency;
  localparam int unsigned ReachLatency = fp32_pkg::AddLatency + 2;  // of a triangle, from its sheared corners
  localparam int unsigned BoundLatency = 2 * fp32_pkg::AddLatency + fp32_pkg::MulLatency + 2;  // from its reach
  localparam int unsigned RejectLatency = ShearLatency + ReachLatency + BoundLatency + 1;

  // The axes (kz, ky, kx) of a point, kz being the axis of the ray's largest direction component.
  function automatic logic [95:0] turned(input logic [95:0] p, input logic [1:0] kz);
    unique case (kz)
      2'd0: turned = {p[31:0], p[95:64], p[63:32]};
      2'd1: turned = {p[63:32], p[31:0], p[95:64]};
      default: turned = p;
    endcase
  endfunction

endpackage
