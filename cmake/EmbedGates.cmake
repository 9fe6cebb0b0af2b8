# Writes OUTPUT, a C++ source that holds the file CSV as a string literal. Run as a script:
# cmake -DOUTPUT=... -DCSV=... -P EmbedGates.cmake
file(READ "${CSV}" text)
file(WRITE "${OUTPUT}" "// Generated from rtl_ref/gates/gates.csv by cmake/EmbedGates.cmake.
#include \"study/area/embedded_gates.hpp\"

namespace rtu::study {

std::string_view embedded_gates_csv() { return R\"__csv__(${text})__csv__\"; }

}  // namespace rtu::study
")
