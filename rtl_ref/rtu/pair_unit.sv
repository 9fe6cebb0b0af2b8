// The pair tester with what it needs of each ray. While a leaf waits its ray is read.
module pair_unit #(
  parameter int unsigned Mode     = pair_pkg::DualShared,
  parameter int unsigned HitUnits = 8,
  parameter int unsigned Slots    = 128,
  localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1,
  localparam int unsigned RayBits = 64 + 64 + 2 + 2 * 96
) (
  input  logic                        clk_i,
  input  logic                        rst_ni,
  // A ray enters its slot: {t_max, t_min, shear y, shear x, kz, direction, origin}.
  input  logic                        ray_start_i,
  input  logic [SlotWidth-1:0]        ray_slot_i,
  input  logic [RayBits-1:0]          ray_i,
  // Leaves of the cache, and the slot whose leaf will be the oldest in the next cycle.
  input  logic                        leaf_valid_i,
  output logic                        leaf_ready_o,
  input  logic [SlotWidth-1:0]        leaf_slot_i,
  input  logic [SlotWidth-1:0]        leaf_next_slot_i,
  input  logic [511:0]                leaf_i,
  // Best hit of the slot in leaf_slot_i.
  input  logic                        has_best_i,
  input  logic [63:0]                 best_i,   // {primitive id, t}
  output logic                        valid_o,
  input  logic                        ready_i,
  output logic [SlotWidth-1:0]        slot_o,
  output logic                        found_o,  // a better hit
  output logic [rtu_pkg::HitBits-1:0] hit_o
);

  logic [RayBits-1:0] ray;
  logic [31:0] t_max, t_min, shear_y, shear_x;
  logic [1:0] kz;
  logic [95:0] direction, origin;
  slot_ram #(.Width(RayBits), .Slots(Slots)) u_rays (
    .clk_i, .read_slot_i(leaf_next_slot_i), .read_data_o(ray), .write_i(ray_start_i), .write_slot_i(ray_slot_i),
    .write_data_i(ray_i)
  );
  assign {t_max, t_min, shear_y, shear_x, kz, direction, origin} = ray;

  logic [31:0] t, u, v, primitive_id;
  pair_tester #(.Mode(Mode), .HitUnits(HitUnits), .TagWidth(SlotWidth)) u_tester (
    .clk_i, .rst_ni, .valid_i(leaf_valid_i), .ready_o(leaf_ready_o), .tag_i(leaf_slot_i), .leaf_i,
    .origin_i(origin), .direction_i(direction), .kz_i(kz), .shear_x_i(shear_x), .shear_y_i(shear_y), .t_min_i(t_min),
    .t_best_i(has_best_i ? best_i[31:0] : t_max), .has_best_i, .best_id_i(best_i[63:32]), .valid_o, .ready_i,
    .tag_o(slot_o), .found_o, .t_o(t), .u_o(u), .v_o(v), .primitive_id_o(primitive_id)
  );
  assign hit_o = {primitive_id, v, u, t};

endmodule
