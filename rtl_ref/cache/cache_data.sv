// The cache's data: a line of each entry in Banks banks, the queued requests' and fills' data, the lines that are
// written back, and the replies, which are put together under their tag. In a cycle a bank reads one entry and writes
// sectors of the same one at the end.
module cache_data #(
  parameter int unsigned Banks       = 4,
  parameter int unsigned Sets        = 32,
  parameter int unsigned Ways        = 16,
  parameter int unsigned Tags        = 128,
  parameter int unsigned ReadSectors = 4
) (
  input  logic                        clk_i,
  input  logic [1:0]                  request_i,
  input  logic [3:0]                  request_place_i,
  input  logic [511:0]                request_data_i,
  input  logic                        fill_i,
  input  logic [1:0]                  fill_place_i,
  input  logic [1023:0]               fill_data_i,
  input  logic [3:0]                  mem_slot_i,
  output logic [1023:0]               mem_data_o,
  input  logic [3*$clog2(Tags)-1:0]   reply_tag_i,
  output logic [ReadSectors*256-1:0]  node_o,
  output logic [511:0]                leaf_o,
  output logic [255:0]                stack_block_o,
  input  logic [Banks-1:0]            bank_is_fill_i,
  input  logic [Banks*($clog2(Sets/Banks)+$clog2(Ways))-1:0] bank_entry_i,
  input  logic [Banks*2-1:0]          bank_place_i,
  input  logic [Banks*4-1:0]          bank_write_i,
  input  logic [Banks*4-1:0]          bank_valid_i,
  input  logic [Banks*4-1:0]          bank_reply_i,
  input  logic [Banks*$clog2(Tags)-1:0] bank_reply_tag_i,
  input  logic [Banks*3-1:0]          bank_reply_base_i,
  input  logic [Banks-1:0]            bank_leaves_i,
  input  logic [Banks*4-1:0]          bank_slot_i
);

  localparam int unsigned EntryBits = $clog2(Sets / Banks) + $clog2(Ways);
  localparam int unsigned TagBits = $clog2(Tags);

  // Queued data. It is written when the queue takes the request or fill, so that a place is read later.
  logic [Banks*256-1:0] request_data;
  logic [Banks*1024-1:0] fill_data, line, leaving;
  storage #(.Width(256), .Entries(4), .Reads(Banks), .Writes(2)) u_request_data (
    .clk_i, .read_index_i(bank_place_i), .read_o(request_data), .write_i(request_i),
    .write_index_i(request_place_i), .data_i(request_data_i)
  );
  storage #(.Width(1024), .Entries(4), .Reads(Banks), .Writes(1)) u_fill_data (
    .clk_i, .read_index_i(bank_place_i), .read_o(fill_data), .write_i(fill_i), .write_index_i(fill_place_i),
    .data_i(fill_data_i)
  );
  storage #(.Width(1024), .Entries(16), .Reads(1), .Writes(Banks)) u_leaving (
    .clk_i, .read_index_i(mem_slot_i), .read_o(mem_data_o), .write_i(bank_leaves_i), .write_index_i(bank_slot_i),
    .data_i(leaving)
  );

  for (genvar b = 0; b < Banks; b++) begin : gen_bank
    for (genvar s = 0; s < 4; s++) begin : gen_sector
      logic [255:0] stored, brought;
      assign brought = bank_is_fill_i[b] ? fill_data[b*1024+s*256+:256] : request_data[b*256+:256];
      storage #(.Width(256), .Entries(2 ** EntryBits), .Reads(1), .Writes(1)) u_sectors (
        .clk_i, .read_index_i(bank_entry_i[b*EntryBits+:EntryBits]), .read_o(stored), .write_i(bank_write_i[4*b+s]),
        .write_index_i(bank_entry_i[b*EntryBits+:EntryBits]), .data_i(brought)
      );
      assign leaving[b*1024+s*256+:256] = stored;
      assign line[b*1024+s*256+:256] = bank_valid_i[4*b+s] ? stored : fill_data[b*1024+s*256+:256];
    end
  end

  // Sector k of a reply is sector k - base of the line. The first one is of all replies, the next of leaves too.
  for (genvar k = 0; k < ReadSectors; k++) begin : gen_reply
    localparam int unsigned Reads = (k == 0) ? 3 : (k == 1) ? 2 : 1;
    logic [Banks-1:0] write;
    logic [Banks*256-1:0] sector;
    logic [Reads*256-1:0] reply;
    for (genvar b = 0; b < Banks; b++) begin : gen_bank
      logic [2:0] from;
      assign from = 3'(k) - bank_reply_base_i[3*b+:3];
      assign write[b] = ~from[2] & bank_reply_i[4*b+from[1:0]];
      assign sector[b*256+:256] = line[b*1024+256*from[1:0]+:256];
    end
    storage #(.Width(256), .Entries(Tags), .Reads(Reads), .Writes(Banks)) u_replies (
      .clk_i, .read_index_i(reply_tag_i[Reads*TagBits-1:0]), .read_o(reply), .write_i(write),
      .write_index_i(bank_reply_tag_i), .data_i(sector)
    );
    assign node_o[256*k+:256] = reply[255:0];
    if (k < 2) begin : gen_leaf
      assign leaf_o[256*k+:256] = reply[511:256];
    end
    if (k < 1) begin : gen_block
      assign stack_block_o = reply[767:512];
    end
  end

endmodule
