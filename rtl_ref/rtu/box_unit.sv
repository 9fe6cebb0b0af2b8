// The box tester with what it needs of each ray: tests a fetched node a cycle. While a node waits its ray is read.
module box_unit #(
  parameter int unsigned Width = 4,
  parameter int unsigned Slots = 128,
  localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1,
  localparam int unsigned RayBits = 64 + 3 + 3 * 96
) (
  input  logic                 clk_i,
  input  logic                 rst_ni,
  // A ray enters its slot: {t_max, t_min, entry side, inverse direction, origin far, origin near}.
  input  logic                 ray_start_i,
  input  logic [SlotWidth-1:0] ray_slot_i,
  input  logic [RayBits-1:0]   ray_i,
  // Nodes of the cache, and the slot whose node will be the oldest in the next cycle.
  input  logic                 node_valid_i,
  output logic                 node_ready_o,
  input  logic [SlotWidth-1:0] node_slot_i,
  input  logic [SlotWidth-1:0] node_next_slot_i,
  input  logic [224*Width+3:0] node_i,          // planes, child references, child count
  // Best hit of the slot in node_slot_i.
  input  logic                 has_best_i,
  input  logic [31:0]          t_best_i,
  output logic                 valid_o,
  input  logic                 ready_i,
  output logic [SlotWidth-1:0] slot_o,
  output logic [3:0]           met_o,           // children that the ray meets
  output logic [64*Width-1:0]  entries_o        // {reference, t_near} of each, near to far
);

  logic [RayBits-1:0] ray;
  logic [31:0] t_max, t_min;
  logic [2:0] entry_side;
  logic [95:0] inv_direction, origin_far, origin_near;
  slot_ram #(.Width(RayBits), .Slots(Slots)) u_rays (
    .clk_i, .read_slot_i(node_next_slot_i), .read_data_o(ray), .write_i(ray_start_i), .write_slot_i(ray_slot_i),
    .write_data_i(ray_i)
  );
  assign {t_max, t_min, entry_side, inv_direction, origin_far, origin_near} = ray;

  logic [32*Width-1:0] refs, t_near;
  logic [3*Width-1:0] child;
  box_tester #(.Width(Width), .TagWidth(32 * Width + SlotWidth)) u_tester (
    .clk_i, .rst_ni, .valid_i(node_valid_i), .ready_o(node_ready_o),
    .tag_i({node_i[192*Width+:32*Width], node_slot_i}), .planes_i(node_i[192*Width-1:0]),
    .child_count_i(node_i[224*Width+:4]), .entry_side_i(entry_side), .origin_near_i(origin_near),
    .origin_far_i(origin_far), .inv_direction_i(inv_direction), .t_min_i(t_min),
    .t_end_i(has_best_i ? t_best_i : t_max), .valid_o, .ready_i, .tag_o({refs, slot_o}), .count_o(met_o),
    .child_o(child), .t_near_o(t_near)
  );
  for (genvar i = 0; i < Width; i++) begin : gen_entry
    assign entries_o[64*i+:64] = {refs[32*child[3*i+:3]+:32], t_near[32*i+:32]};
  end

endmodule
