#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace rtu::model {

/// Parses the JSON of a glTF file, checks every member that geometry depends on (type, range, presence) and
/// drops the sections that geometry does not need. Checked here, because tinygltf takes a mistyped optional
/// member as absent, cuts large integers to 32 bits, drops a primitive without attributes, recurses as deep
/// as the text says, and loads images. Throws Error, which starts with `name`, for text that is no JSON,
/// nested deeper than 64 levels, not glTF 2.x, requires an extension that changes geometry, or holds a wrong
/// member.
[[nodiscard]] nlohmann::json parse_gltf_json(const std::string& text, const std::string& name);

}  // namespace rtu::model
