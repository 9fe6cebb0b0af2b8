# Writes OUTPUT, a C++ source that holds every file of PRESETS (a list of .toml paths separated by commas) as a string
# literal, in the order given. Run as a script: cmake -DOUTPUT=... -DPRESETS=a.toml,b.toml -P EmbedPresets.cmake
string(REPLACE "," ";" PRESETS "${PRESETS}")
set(rows "")
foreach(path IN LISTS PRESETS)
  get_filename_component(name "${path}" NAME_WE)
  file(READ "${path}" text)
  string(APPEND rows "    {\"${name}\", R\"__toml__(${text})__toml__\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Generated from sim/presets by cmake/EmbedPresets.cmake.
#include \"sim/presets.hpp\"

namespace rtu::sim {
namespace {

constexpr EmbeddedPreset presets[] = {
${rows}};

}  // namespace

std::span<const EmbeddedPreset> embedded_presets() { return presets; }

}  // namespace rtu::sim
")
