// A memory with a write port and a read port, whose data come in the cycle after the address. An array, not gates: Yosys
// sees no body.
(* blackbox *)
module pair_ram #(
  parameter int unsigned Width   = 8,
  parameter int unsigned Entries = 4
) (
  input  logic                       clk_i,
  input  logic                       write_i,
  input  logic [$clog2(Entries)-1:0] write_entry_i,
  input  logic [Width-1:0]           data_i,
  input  logic                       read_i,
  input  logic [$clog2(Entries)-1:0] read_entry_i,
  output logic [Width-1:0]           data_o
);

  logic [Width-1:0] word_q[Entries], data_q;

  always_ff @(posedge clk_i) begin
    if (write_i) word_q[write_entry_i] <= data_i;
    if (read_i) data_q <= word_q[read_entry_i];
  end
  assign data_o = data_q;

endmodule
