// The RTU's L1 with its data: what sim::Cache times, cycle by cycle. Lines of 128 bytes in sectors of 32, least recently
// used first out, write back. Up to two requests a cycle; replies for the box unit (0), the pair unit (1) and the
// scheduler (2). Requests are whole sectors, a write is one sector. A tag has at most one read under way: its data is
// put together under the tag and stays there until the reply is taken. While a read of a sector is under way, nobody
// writes it.
//
// The configuration is constant from reset on: sets and banks, powers of two with no more banks than sets, minus one;
// and the last way, MSHR, target and cycle of latency in use, counted from 0.
//
// events_o, from the lowest bits, one a lane: hits, misses, merges, writes, evictions, write-backs, fills; then why the
// next access was refused (cache_accept), whether a fill was stuck behind replies, and replies that wait for their channel.
module cache #(
  parameter int unsigned Banks       = 4,   // 2 or 4
  parameter int unsigned Sets        = 32,  // 2 a bank or more
  parameter int unsigned Ways        = 16,  // 2 or more
  parameter int unsigned Mshrs       = 64,
  parameter int unsigned Targets     = 16,
  parameter int unsigned Tags        = 128,
  parameter int unsigned AddressBits = 32,
  parameter int unsigned MaxLatency  = 32,
  parameter int unsigned ReadSectors = 4    // of the longest read, 2 to 8
) (
  input  logic                           clk_i,
  input  logic                           rst_ni,
  input  logic [$clog2(Sets)-1:0]        set_mask_i,
  input  logic [$clog2(Ways)-1:0]        last_way_i,
  input  logic [$clog2(Banks)-1:0]       bank_mask_i,
  input  logic [$clog2(Mshrs)-1:0]       last_mshr_i,
  input  logic [$clog2(Targets)-1:0]     last_target_i,
  input  logic [$clog2(MaxLatency)-1:0]  last_latency_i,
  output logic                           is_ready_o,        // some cycles after reset
  // Requests in order; request 1 only beside request 0. Each is taken when valid and ready.
  input  logic [1:0]                     request_valid_i,
  output logic [1:0]                     request_ready_o,
  input  logic [2*AddressBits-1:0]       request_address_i,
  input  logic [7:0]                     request_sectors_i,
  input  logic [2*$clog2(Tags)-1:0]      request_tag_i,
  input  logic [3:0]                     request_source_i,
  input  logic [1:0]                     request_is_write_i,
  input  logic [511:0]                   request_data_i,
  // Replies, one stream a source.
  output logic [2:0]                     reply_valid_o,
  input  logic [2:0]                     reply_ready_i,
  output logic [3*$clog2(Tags)-1:0]      reply_tag_o,
  output logic [3*$clog2(Tags)-1:0]      reply_next_tag_o,  // reply_tag_o of the next cycle, where it is valid
  output logic [ReadSectors*256-1:0]     node_o,
  output logic [511:0]                   leaf_o,
  output logic [255:0]                   stack_block_o,
  // Memory: adjacent sectors of a line, data at its place in the line. A read's id comes back with its fill.
  output logic                           mem_valid_o,
  input  logic                           mem_ready_i,
  output logic                           mem_is_write_o,
  output logic [AddressBits-8:0]         mem_line_o,
  output logic [3:0]                     mem_sectors_o,
  output logic [1023:0]                  mem_data_o,
  output logic [$clog2(Mshrs)+3:0]       mem_id_o,
  input  logic                           fill_valid_i,
  output logic                           fill_ready_o,
  input  logic [$clog2(Mshrs)+3:0]       fill_id_i,
  input  logic [1023:0]                  fill_data_i,
  output logic [7*Banks+6:0]             events_o
);

  localparam int unsigned EntryBits = $clog2(Sets / Banks) + $clog2(Ways);

  logic [3:0] request_place, mem_slot;
  logic [1:0] fill_place;
  logic [Banks-1:0] bank_is_fill, bank_leaves;
  logic [Banks*EntryBits-1:0] bank_entry;
  logic [Banks*2-1:0] bank_place;
  logic [Banks*4-1:0] bank_write, bank_valid, bank_reply, bank_slot;
  logic [Banks*$clog2(Tags)-1:0] bank_reply_tag;
  logic [Banks*3-1:0] bank_reply_base;

  cache_control #(
    .Banks(Banks), .Sets(Sets), .Ways(Ways), .Mshrs(Mshrs), .Targets(Targets), .Tags(Tags),
    .AddressBits(AddressBits), .MaxLatency(MaxLatency)
  ) u_control (
    .clk_i, .rst_ni, .set_mask_i, .last_way_i, .bank_mask_i, .last_mshr_i, .last_target_i, .last_latency_i,
    .is_ready_o, .request_valid_i, .request_ready_o, .request_address_i, .request_sectors_i, .request_tag_i,
    .request_source_i, .request_is_write_i, .request_place_o(request_place), .reply_valid_o, .reply_ready_i,
    .reply_tag_o, .reply_next_tag_o, .mem_valid_o, .mem_ready_i, .mem_is_write_o, .mem_line_o, .mem_sectors_o, .mem_id_o,
    .mem_slot_o(mem_slot), .fill_valid_i, .fill_ready_o, .fill_id_i, .fill_place_o(fill_place),
    .bank_is_fill_o(bank_is_fill), .bank_entry_o(bank_entry), .bank_place_o(bank_place), .bank_write_o(bank_write),
    .bank_valid_o(bank_valid), .bank_reply_o(bank_reply), .bank_reply_tag_o(bank_reply_tag),
    .bank_reply_base_o(bank_reply_base), .bank_leaves_o(bank_leaves), .bank_slot_o(bank_slot), .events_o
  );
  cache_data #(
    .Banks(Banks), .Sets(Sets), .Ways(Ways), .Tags(Tags), .ReadSectors(ReadSectors)
  ) u_data (
    .clk_i, .request_i(request_valid_i & request_ready_o), .request_place_i(request_place), .request_data_i,
    .fill_i(fill_valid_i & fill_ready_o), .fill_place_i(fill_place), .fill_data_i, .mem_slot_i(mem_slot),
    .mem_data_o, .reply_tag_i(reply_tag_o), .node_o, .leaf_o, .stack_block_o, .bank_is_fill_i(bank_is_fill),
    .bank_entry_i(bank_entry), .bank_place_i(bank_place), .bank_write_i(bank_write), .bank_valid_i(bank_valid),
    .bank_reply_i(bank_reply), .bank_reply_tag_i(bank_reply_tag), .bank_reply_base_i(bank_reply_base),
    .bank_leaves_i(bank_leaves), .bank_slot_i(bank_slot)
  );

`ifndef SYNTHESIS
  for (genvar i = 0; i < 2; i++) begin : gen_check
    assert property (@(posedge clk_i) disable iff (!rst_ni) request_valid_i[i] |->
        request_address_i[i*AddressBits+:5] == 5'd0 && request_sectors_i[4*i+:4] != 4'd0 &&
        {28'd0, request_sectors_i[4*i+:4]} <= (request_is_write_i[i] ? 1 : ReadSectors) &&
        request_source_i[2*i+:2] != 2'd3)
    else $error("a request that is not whole sectors, or too long, or from nowhere");
  end
  assert property (@(posedge clk_i) disable iff (!rst_ni) request_valid_i[1] |-> request_valid_i[0])
  else $error("the second request without the first");
  assert property (@(posedge clk_i) disable iff (!rst_ni) request_ready_o[1] |-> request_ready_o[0])
  else $error("the second request is taken before the first");
  // The second request may have become the first in the next cycle.
  stream_check #(.Width(AddressBits + $clog2(Tags) + 7)) u_check_request (
    .clk_i, .rst_ni, .valid_i(request_valid_i[0]), .ready_i(request_ready_o[0]),
    .data_i({request_address_i[0+:AddressBits], request_sectors_i[3:0], request_tag_i[0+:$clog2(Tags)],
             request_source_i[1:0], request_is_write_i[0]})
  );
  stream_check #(.Width($clog2(Tags) + ReadSectors * 256)) u_check_node (
    .clk_i, .rst_ni, .valid_i(reply_valid_o[0]), .ready_i(reply_ready_i[0]),
    .data_i({reply_tag_o[0+:$clog2(Tags)], node_o})
  );
  stream_check #(.Width($clog2(Tags) + 512)) u_check_leaf (
    .clk_i, .rst_ni, .valid_i(reply_valid_o[1]), .ready_i(reply_ready_i[1]),
    .data_i({reply_tag_o[$clog2(Tags)+:$clog2(Tags)], leaf_o})
  );
  stream_check #(.Width($clog2(Tags) + 256)) u_check_block (
    .clk_i, .rst_ni, .valid_i(reply_valid_o[2]), .ready_i(reply_ready_i[2]),
    .data_i({reply_tag_o[2*$clog2(Tags)+:$clog2(Tags)], stack_block_o})
  );
  stream_check #(.Width(AddressBits + $clog2(Mshrs) + 2)) u_check_memory (
    .clk_i, .rst_ni, .valid_i(mem_valid_o), .ready_i(mem_ready_i),
    .data_i({mem_is_write_o, mem_line_o, mem_sectors_o, mem_id_o})
  );
  // Data of a write; a read has none.
  stream_check #(.Width(1024)) u_check_written (
    .clk_i, .rst_ni, .valid_i(mem_valid_o & mem_is_write_o), .ready_i(mem_ready_i), .data_i(mem_data_o)
  );
  stream_check #(.Width($clog2(Mshrs) + 1028)) u_check_fill (
    .clk_i, .rst_ni, .valid_i(fill_valid_i), .ready_i(fill_ready_o), .data_i({fill_id_i, fill_data_i})
  );
`endif

endmodule
