// Registers as Yosys knows them to registers of nand2.lib.
module \$_DFF_P_ (input C, D, output Q);
  DFF _TECHMAP_REPLACE_ (.C(C), .D(D), .Q(Q));
endmodule
module \$_DFFE_PP_ (input C, D, E, output Q);
  DFFE _TECHMAP_REPLACE_ (.C(C), .D(D), .E(E), .Q(Q));
endmodule
module \$_DFF_PN0_ (input C, D, R, output Q);
  DFFR _TECHMAP_REPLACE_ (.C(C), .D(D), .R(R), .Q(Q));
endmodule
module \$_DFFE_PN0P_ (input C, D, R, E, output Q);
  DFFRE _TECHMAP_REPLACE_ (.C(C), .D(D), .R(R), .E(E), .Q(Q));
endmodule
