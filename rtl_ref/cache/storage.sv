// Words of storage with read ports that answer within the cycle and write ports that act at its end; of two writes to
// one word the higher port's stays. An array, not gates: Yosys sees no body, and docs/rtl.md counts its bits.
(* blackbox *)
module storage #(
  parameter int unsigned Width   = 8,
  parameter int unsigned Entries = 4,  // a power of two, 2 or more
  parameter int unsigned Reads   = 1,
  parameter int unsigned Writes  = 1
) (
  input  logic                              clk_i,
  input  logic [Reads*$clog2(Entries)-1:0]  read_index_i,
  output logic [Reads*Width-1:0]            read_o,
  input  logic [Writes-1:0]                 write_i,
  input  logic [Writes*$clog2(Entries)-1:0] write_index_i,
  input  logic [Writes*Width-1:0]           data_i
);

  localparam int unsigned IndexBits = $clog2(Entries);

  logic [Width-1:0] word_q[Entries];

  for (genvar r = 0; r < Reads; r++) begin : gen_read
    assign read_o[r*Width+:Width] = word_q[read_index_i[r*IndexBits+:IndexBits]];
  end
  always_ff @(posedge clk_i) begin
    for (int unsigned w = 0; w < Writes; w++) begin
      if (write_i[w]) word_q[write_index_i[w*IndexBits+:IndexBits]] <= data_i[w*Width+:Width];
    end
  end

endmodule
