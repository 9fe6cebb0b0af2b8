// One bank's tags: of each set the ways' entries {mshr, pending, dirty, valid, line} and ages. In a cycle an access is
// looked up in one set and a fill's entry read in another; one of the two, or clearing after reset, writes.
module cache_bank #(
  parameter int unsigned Sets           = 8,
  parameter int unsigned Ways           = 16,
  parameter int unsigned LineNumberBits = 25,
  parameter int unsigned MshrBits       = 6
) (
  input  logic                                  clk_i,
  input  logic [$clog2(Ways)-1:0]               last_way_i,
  input  logic                                  clear_i,
  input  logic [$clog2(Sets)-1:0]               clear_set_i,
  input  logic [$clog2(Sets)-1:0]               set_i,
  input  logic [LineNumberBits-1:0]             line_i,
  output logic                                  is_hit_o,
  output logic                                  has_victim_o,
  output logic [$clog2(Ways)-1:0]               way_o,
  output logic [LineNumberBits+12+MshrBits-1:0] entry_o,
  input  logic [$clog2(Sets)-1:0]               fill_set_i,
  input  logic [$clog2(Ways)-1:0]               fill_way_i,
  output logic [LineNumberBits+12+MshrBits-1:0] fill_entry_o,
  input  logic                                  access_i,  // writes the entry at way_o, which is used
  input  logic                                  fill_i,    // writes the fill's entry
  input  logic [LineNumberBits+12+MshrBits-1:0] entry_i
);

  localparam int unsigned WayBits = $clog2(Ways);
  localparam int unsigned EntryBits = LineNumberBits + 12 + MshrBits;

  logic [$clog2(Sets)-1:0] write_set;
  logic [Ways*EntryBits-1:0] set;
  logic [Ways*WayBits-1:0] ages, ages_used, ages_cleared;
  logic [EntryBits-1:0] entry, fill_entry[Ways];

  assign write_set = clear_i ? clear_set_i : fill_i ? fill_set_i : set_i;
  assign entry = clear_i ? '0 : entry_i;
  for (genvar w = 0; w < Ways; w++) begin : gen_way
    logic write;
    assign write = clear_i | (access_i & (way_o == WayBits'(w))) | (fill_i & (fill_way_i == WayBits'(w)));
    storage #(.Width(EntryBits), .Entries(Sets), .Reads(2), .Writes(1)) u_entries (
      .clk_i, .read_index_i({fill_set_i, set_i}), .read_o({fill_entry[w], set[w*EntryBits+:EntryBits]}),
      .write_i(write), .write_index_i(write_set), .data_i(entry)
    );
    // At first the lowest way is the oldest.
    assign ages_cleared[w*WayBits+:WayBits] = WayBits'(Ways - 1 - w);
  end
  assign fill_entry_o = fill_entry[fill_way_i];
  storage #(.Width(Ways * WayBits), .Entries(Sets), .Reads(1), .Writes(1)) u_ages (
    .clk_i, .read_index_i(set_i), .read_o(ages), .write_i(clear_i | access_i), .write_index_i(write_set),
    .data_i(clear_i ? ages_cleared : ages_used)
  );
  cache_lookup #(.Ways(Ways), .LineNumberBits(LineNumberBits), .MshrBits(MshrBits)) u_lookup (
    .last_way_i, .line_i, .set_i(set), .ages_i(ages), .is_hit_o, .has_victim_o, .way_o, .entry_o, .ages_o(ages_used)
  );

endmodule
