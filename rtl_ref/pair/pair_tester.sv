// The pair test: a ray against the one or two triangles of a leaf, and whether a hit is better than the ray's best so
// far; bit-equal to test_pair() of model/pair_test.cpp with is_better() of model/traversal.cpp. pair_reject finds what
// the ray may hit. Pairs with nothing left leave at once, the others wait in order for one of HitUnits hit units; so
// misses overtake survivors. A pair's numbers wait in a memory of Entries pairs.
//
// One result leaves a cycle: of the lowest hit unit that has one, else a miss. In the meantime the first pass stands.
module pair_tester #(
  parameter int unsigned Mode     = pair_pkg::DualShared,
  parameter int unsigned HitUnits = 8,
  parameter int unsigned Entries  = 40,  // pairs inside at most
  parameter int unsigned TagWidth = 8
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  input  logic                valid_i,
  output logic                ready_o,
  input  logic [TagWidth-1:0] tag_i,
  input  logic [511:0]        leaf_i,      // a pair as in the memory image
  input  logic [95:0]         origin_i,
  input  logic [95:0]         direction_i,
  input  logic [1:0]          kz_i,        // axis of the largest direction component, 0 to 2
  input  logic [31:0]         shear_x_i,
  input  logic [31:0]         shear_y_i,
  input  logic [31:0]         t_min_i,
  input  logic [31:0]         t_best_i,    // of the best hit so far, or t_max
  input  logic                has_best_i,
  input  logic [31:0]         best_id_i,
  output logic                valid_o,
  input  logic                ready_i,
  output logic [TagWidth-1:0] tag_o,
  output logic                found_o,     // a better hit; the rest is meaningful then
  output logic [31:0]         t_o,
  output logic [31:0]         u_o,
  output logic [31:0]         v_o,
  output logic [31:0]         primitive_id_o
);

  localparam int unsigned EntryWidth = $clog2(Entries);
  localparam int unsigned NameWidth = TagWidth + EntryWidth;
  localparam int unsigned Numbers = 745;
  localparam int unsigned HitWidth = NameWidth + 129;

  // A pair takes the entry that was chosen for it before: the lowest free one, or else that of the result that leaves.
  logic [Entries-1:0] is_used_q, is_free, lowest;
  logic [EntryWidth-1:0] entry_q, lowest_free, freed_entry;
  logic has_entry_q, accepts, leaves, first_ready;
  always_comb begin
    lowest = is_free & (~is_free + Entries'(1));
    lowest_free = '0;
    for (int unsigned i = 0; i < Entries; i++) begin
      if (lowest[i]) lowest_free = lowest_free | EntryWidth'(i);
    end
  end
  assign ready_o = has_entry_q & first_ready;
  assign accepts = valid_i & ready_o;
  assign leaves = valid_o & ready_i;
  for (genvar i = 0; i < Entries; i++) begin : gen_entry
    logic is_chosen, is_left;
    assign is_chosen = has_entry_q && entry_q == EntryWidth'(i);
    assign is_left = leaves && freed_entry == EntryWidth'(i);
    assign is_free[i] = ~is_used_q[i] & ~is_chosen;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) is_used_q[i] <= 1'b0;
      else is_used_q[i] <= (is_used_q[i] & ~is_left) | (accepts & is_chosen);
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      has_entry_q <= 1'b0;
      entry_q <= '0;
    end else if (accepts | ~has_entry_q) begin
      has_entry_q <= (|is_free) | leaves;
      entry_q <= (|is_free) ? lowest_free : freed_entry;
    end
  end

  // First pass.
  logic first_valid, takes_first, is_survivor;
  logic [NameWidth-1:0] first_name;
  logic [1:0] goes_on, is_inside;
  pair_reject #(.Mode(Mode), .TagWidth(NameWidth)) u_reject (
    .clk_i, .rst_ni, .valid_i(valid_i & has_entry_q), .ready_o(first_ready), .tag_i({entry_q, tag_i}),
    .vertices_i(leaf_i[383:0]), .has_second_i(leaf_i[448]), .is_degenerate_i(leaf_i[457:456]), .origin_i, .kz_i,
    .shear_x_i, .shear_y_i, .valid_o(first_valid), .ready_i(takes_first), .tag_o(first_name), .goes_on_o(goes_on),
    .is_inside_o(is_inside)
  );
  assign is_survivor = |goes_on;

  // Survivors wait in order, and the first one's numbers are read.
  logic has_place, queue_valid, queue_ready, waits_q, starts;
  logic [NameWidth+3:0] waiting, name_q;
  stream_fifo #(.Width(NameWidth + 4), .Depth(Entries)) u_survivors (
    .clk_i, .rst_ni, .valid_i(first_valid & is_survivor), 
    .ready_o(has_place), .data_i({goes_on, is_inside, first_name}),
    .valid_o(queue_valid), .ready_i(queue_ready), .data_o(waiting)
  );
  assign queue_ready = ~waits_q | starts;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) waits_q <= 1'b0;
    else if (queue_ready) waits_q <= queue_valid;
  end
  always_ff @(posedge clk_i) begin
    if (queue_ready) name_q <= waiting;
  end
  logic [Numbers-1:0] numbers;
  pair_ram #(.Width(Numbers), .Entries(Entries)) u_numbers (
    .clk_i, .write_i(accepts), .write_entry_i(entry_q),
    .data_i({best_id_i, has_best_i, t_best_i, t_min_i, kz_i, direction_i, origin_i, leaf_i[454:449], leaf_i[447:0]}),
    .read_i(queue_ready), .read_entry_i(waiting[TagWidth+:EntryWidth]), .data_o(numbers)
  );

  // Hit units; the lowest free one takes the next survivor.
  logic [HitUnits-1:0] hit_valid, hit_ready, hit_starts, hit_leaves;
  logic [HitUnits*HitWidth-1:0] hit;
  assign hit_starts = {HitUnits{waits_q}} & hit_ready & (~hit_ready + HitUnits'(1));
  assign starts = waits_q & (|hit_ready);
  for (genvar i = 0; i < HitUnits; i++) begin : gen_hit_unit
    logic [NameWidth-1:0] tag;
    logic [31:0] t, u, v, primitive_id;
    logic found;
    hit_unit #(.TagWidth(NameWidth)) u_hit (
      .clk_i, .rst_ni, .valid_i(hit_starts[i]), .ready_o(hit_ready[i]), .tag_i(name_q[NameWidth-1:0]),
      .vertices_i(numbers[383:0]), .primitive_ids_i(numbers[447:384]), .corner_order_i(numbers[453:448]),
      .goes_on_i(name_q[NameWidth+2+:2]), .is_inside_i(name_q[NameWidth+:2]), .origin_i(numbers[549:454]),
      .direction_i(numbers[645:550]), .kz_i(numbers[647:646]), .t_min_i(numbers[679:648]),
      .t_best_i(numbers[711:680]), .has_best_i(numbers[712]), .best_id_i(numbers[744:713]), .valid_o(hit_valid[i]),
      .ready_i(hit_leaves[i]), .tag_o(tag), .found_o(found), .t_o(t), .u_o(u), .v_o(v), .primitive_id_o(primitive_id)
    );
    assign hit[HitWidth*i+:HitWidth] = {primitive_id, v, u, t, found, tag};
  end

  // What leaves. An offer that was not taken stays, though a result that goes before it may come meanwhile.
  logic [HitUnits-1:0] chosen, chosen_q;
  logic is_miss, is_kept_q, offers_hit;
  logic [HitWidth-1:0] result;
  assign chosen = is_kept_q ? chosen_q : hit_valid & (~hit_valid + HitUnits'(1));
  assign offers_hit = |chosen;
  assign is_miss = first_valid & ~is_survivor;
  assign valid_o = offers_hit | is_miss;
  assign hit_leaves = chosen & {HitUnits{ready_i}};
  assign takes_first = is_survivor | (~offers_hit & ready_i);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) is_kept_q <= 1'b0;
    else is_kept_q <= valid_o & ~ready_i;
  end
  always_ff @(posedge clk_i) chosen_q <= chosen;
  always_comb begin
    result = offers_hit ? '0 : HitWidth'(first_name);
    for (int unsigned i = 0; i < HitUnits; i++) begin
      if (chosen[i]) result = result | hit[HitWidth*i+:HitWidth];
    end
  end
  assign {primitive_id_o, v_o, u_o, t_o, found_o, freed_entry, tag_o} = result;

`ifndef SYNTHESIS
  assert property (@(posedge clk_i) disable iff (!rst_ni) has_place)
  else $error("more survivors than pairs");
  assert property (@(posedge clk_i) disable iff (!rst_ni) leaves |-> is_used_q[freed_entry])
  else $error("a result of no pair");
  stream_check #(.Width(TagWidth + 867)) u_check_input (
    .clk_i, .rst_ni, .valid_i, .ready_i(ready_o),
    .data_i({tag_i, leaf_i, origin_i, direction_i, kz_i, shear_x_i, shear_y_i, t_min_i, t_best_i, has_best_i, best_id_i})
  );
  stream_check #(.Width(TagWidth + 129)) u_check_output (
    .clk_i, .rst_ni, .valid_i(valid_o), .ready_i, .data_i({tag_o, found_o, t_o, u_o, v_o, primitive_id_o})
  );
`endif

endmodule
