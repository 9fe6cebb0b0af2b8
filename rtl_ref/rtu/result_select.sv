// Which results are taken in a cycle: up to two, all of one source before the next source is asked. The source that is
// asked first moves on whenever something was taken, so that none starves: pair unit, box unit, stack blocks. Rays that
// pass a leaf over come before all of them: each does so a few times at most.
module result_select #(
  parameter bit Passes = 1'b0  // there are such rays
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       enable_i,
  input  logic [5:0] valid_i,   // two of each source: bit 2 * source + place
  input  logic [1:0] passed_valid_i,
  output logic [1:0] valid_o,   // lane 1 only beside lane 0
  output logic [3:0] source_o,  // two bits a lane; 3: a ray that passes a leaf over
  output logic [1:0] place_o,   // of a lane's result in its source
  output logic [5:0] pop_o,     // how many leave each source, two bits each
  output logic [1:0] passed_pop_o
);

  logic [1:0] first_q;
  logic [1:0] passing;  // rays that pass a leaf over: their number
  assign passing = ~(Passes & enable_i) ? 2'd0 : passed_valid_i[1] ? 2'd2 : {1'b0, passed_valid_i[0]};
  assign passed_pop_o = passing;

  always_comb begin
    logic [1:0] taken, source;
    taken = passing;
    source = first_q;
    source_o = Passes ? '1 : '0;
    place_o = Passes ? 2'b10 : '0;
    pop_o = '0;
    for (int unsigned i = 0; i < 3; i++) begin
      for (int unsigned place = 0; place < 2; place++) begin
        if (enable_i && valid_i[3'({source, 1'b0}) + 3'(place)] && !taken[1]) begin
          source_o[2*taken[0]+:2] = source;
          place_o[taken[0]] = place[0];
          pop_o[2*source+:2] = 2'(place + 1);
          taken = taken + 2'd1;
        end
      end
      source = source == 2'd2 ? 2'd0 : source + 2'd1;
    end
    valid_o = {taken[1], |taken};
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) first_q <= 2'd0;
    else if (|valid_o) first_q <= first_q == 2'd2 ? 2'd0 : first_q + 2'd1;
  end

endmodule
