#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "traces/ray_stream.hpp"

// What CSV and JSON lines have in common: a ray a line.

namespace rtu::traces {

/// A ray as a line of text has it.
struct RayRow {
    model::Ray ray;
    std::string workload = "rays";
    model::RayKind kind = model::RayKind::ClosestHit;
    IdKind id_kind = IdKind::None;
    std::uint32_t id = 0;
};

/// Makes a ray of a line without its line feed; an empty line is no ray. Throws Error without a place.
using ParseLine = std::function<std::optional<RayRow>(std::string_view line)>;

/// Reads rays line by line; errors name file and line.
[[nodiscard]] std::unique_ptr<RayReader> open_text_rays(const std::filesystem::path& path, ParseLine parse);

/// A ray as a line, with its line feed.
using FormatLine = std::function<std::string(const RayRow& row)>;

/// Writes a line for each ray after `head`.
[[nodiscard]] std::unique_ptr<RayWriter> create_text_rays(const std::filesystem::path& path, std::string head,
                                                          FormatLine format);

/// A binary32 number: decimal, inf, -inf or nan; nothing for any other text and for what overflows.
[[nodiscard]] std::optional<float> parse_float(std::string_view text);
/// The shortest text that parse_float() reads as the same number.
[[nodiscard]] std::string float_text(float value);
/// Digits only, below 2^32.
[[nodiscard]] std::optional<std::uint32_t> parse_id(std::string_view text);

}  // namespace rtu::traces
