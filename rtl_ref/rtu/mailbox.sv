// The pairs that each ray was tested with last, all compared at once: the circuit of model/mailbox.hpp, kind Recent. A
// number that is found leaves the entries as they are; one that is not takes the place of the entry that went in first.
//
//   cycle t      read_slot_i: the slot's entries are read
//         t + 1  valid_i: the slot's ray is decided on; lookup_i: its pair's number is looked up, found_o says the answer
//                at once, and what the slot then holds is written
//
// Decisions are on different slots, and one on a slot follows another no sooner than three cycles later: no entry is
// read while it is written. A ray's first decision finds the mailbox empty, whatever the slot held.
module mailbox #(
  parameter int unsigned Entries    = 4,    // of a slot, at most; 1 to 16
  parameter int unsigned Slots      = 128,
  parameter int unsigned Lanes      = 2,    // decisions a cycle
  parameter int unsigned NumberBits = 28,   // of a pair's number: its leaf's address / 64
  localparam int unsigned SlotWidth = Slots > 1 ? $clog2(Slots) : 1,
  localparam int unsigned PlaceWidth = Entries > 1 ? $clog2(Entries) : 1
) (
  input  logic                        clk_i,
  input  logic                        rst_ni,
  input  logic [PlaceWidth-1:0]       last_entry_i,  // entries in use - 1, constant
  input  logic [Lanes*SlotWidth-1:0]  read_slot_i,
  input  logic [Lanes-1:0]            valid_i,
  input  logic [Lanes*SlotWidth-1:0]  slot_i,        // read_slot_i of the cycle before
  input  logic [Lanes-1:0]            is_first_i,    // since the slot's ray was accepted
  input  logic [Lanes-1:0]            lookup_i,      // requires valid_i
  input  logic [Lanes*NumberBits-1:0] number_i,
  output logic [Lanes-1:0]            found_o
);

  logic [Entries*Lanes*NumberBits-1:0] entries;
  logic [Entries*Lanes-1:0] write;
  logic [Lanes*(PlaceWidth+1)-1:0] state, new_state;  // {all entries are taken, place of the next}

  for (genvar i = 0; i < Entries; i++) begin : gen_entry
    slot_ram #(.Width(NumberBits), .Slots(Slots), .Reads(Lanes), .Writes(Lanes)) u_numbers (
      .clk_i, .read_slot_i, .read_data_o(entries[i*Lanes*NumberBits+:Lanes*NumberBits]),
      .write_i(write[i*Lanes+:Lanes]), .write_slot_i(slot_i), .write_data_i(number_i)
    );
  end
  slot_ram #(.Width(PlaceWidth + 1), .Slots(Slots), .Reads(Lanes), .Writes(Lanes)) u_states (
    .clk_i, .read_slot_i, .read_data_o(state), .write_i(valid_i), .write_slot_i(slot_i), .write_data_i(new_state)
  );

  for (genvar lane = 0; lane < Lanes; lane++) begin : gen_lane
    logic is_full, goes_in;
    logic [PlaceWidth-1:0] next;
    logic [Entries-1:0] equal;
    assign {is_full, next} = is_first_i[lane] ? '0 : state[lane*(PlaceWidth+1)+:PlaceWidth+1];
    for (genvar i = 0; i < Entries; i++) begin : gen_compare
      logic is_taken;
      assign is_taken = is_full ? PlaceWidth'(i) <= last_entry_i : PlaceWidth'(i) < next;
      assign equal[i] = is_taken & entries[(i*Lanes+lane)*NumberBits+:NumberBits] == number_i[lane*NumberBits+:NumberBits];
      assign write[i*Lanes+lane] = goes_in & next == PlaceWidth'(i);
    end
    assign found_o[lane] = lookup_i[lane] & |equal;
    assign goes_in = lookup_i[lane] & ~|equal;
    always_comb begin
      new_state[lane*(PlaceWidth+1)+:PlaceWidth+1] = {is_full, next};
      if (goes_in) begin
        new_state[lane*(PlaceWidth+1)+:PlaceWidth+1] =
            next == last_entry_i ? {1'b1, PlaceWidth'(0)} : {is_full, next + 1'b1};
      end
    end
  end

`ifndef SYNTHESIS
  assert property (@(posedge clk_i) disable iff (!rst_ni) lookup_i != '0 |-> 32'(last_entry_i) < Entries)
  else $error("more entries than there are");
  for (genvar lane = 0; lane < Lanes; lane++) begin : gen_check
    assert property (@(posedge clk_i) disable iff (!rst_ni) lookup_i[lane] |-> valid_i[lane])
    else $error("a lookup without a decision");
    assert property (@(posedge clk_i) disable iff (!rst_ni) lookup_i[lane] |-> $onehot0(gen_lane[lane].equal))
    else $error("a number in two entries");
    assert property (@(posedge clk_i) disable iff (!rst_ni)
                     valid_i[lane] |-> slot_i[lane*SlotWidth+:SlotWidth] == $past(read_slot_i[lane*SlotWidth+:SlotWidth]))
    else $error("a decision on a slot that was not read");
    for (genvar other = 0; other < Lanes; other++) begin : gen_other
      if (other != lane) begin : gen_differs
        assert property (@(posedge clk_i) disable iff (!rst_ni)
                         valid_i[lane] && valid_i[other] |->
                         slot_i[lane*SlotWidth+:SlotWidth] != slot_i[other*SlotWidth+:SlotWidth])
        else $error("two decisions on one slot");
      end
      assert property (@(posedge clk_i) disable iff (!rst_ni)
                       valid_i[lane] && $past(valid_i[other]) |->
                       slot_i[lane*SlotWidth+:SlotWidth] != $past(slot_i[other*SlotWidth+:SlotWidth]))
      else $error("entries read while they are written");
    end
  end
`endif

endmodule
