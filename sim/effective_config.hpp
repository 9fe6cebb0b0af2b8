#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/config.hpp"
#include "sim/config_keys.hpp"

namespace rtu::sim {

/// One statement of a file or option about a key, not yet checked against the table.
struct ConfigAssignment {
    std::string key;
    std::variant<std::int64_t, std::string> value;
    std::string source;  ///< where the value was published, or "assumed: why"; empty: its place is its source
    std::string place;   ///< "FILE:LINE" or the option, for errors
};

/// A configuration, and where every value of it comes from.
struct EffectiveConfig {
    struct Origin {
        std::string source;  ///< where the value was published, who set it, or "assumed: why"
        std::string place;   ///< "FILE:LINE" or the option that set it; empty for a default
    };
    Config config;
    std::vector<Origin> origins;  ///< [config_keys().size()]
};

/// The machine of the struct's own defaults.
[[nodiscard]] EffectiveConfig default_config();

/// `base` with one more statement. Throws Error for an unknown key or a value that the table does not allow.
[[nodiscard]] EffectiveConfig assign(EffectiveConfig base, const ConfigAssignment& assignment);

/// The preset, with the link of that name (`none` changes nothing), changed by the file, changed by the
/// options (`sets`: "key=value" each), validated.
/// Throws Error, with file and line or the option, for anything unknown, repeated, out of range or
/// contradictory.
[[nodiscard]] EffectiveConfig load_config(std::string_view preset,
                                          const std::optional<std::filesystem::path>& file,
                                          std::span<const std::string> sets, std::string_view link = "none");

/// Checks every range and the rules between keys; throws Error naming the keys and where they were set.
void validate(const EffectiveConfig& effective);

/// The whole configuration as TOML that load_config() reads back to the same values and sources; comments
/// tell unit, range and meaning of every key.
[[nodiscard]] std::string describe_config(const EffectiveConfig& effective);

/// A Markdown table of every key: value, unit, range, meaning, source.
[[nodiscard]] std::string config_markdown(const EffectiveConfig& effective);

/// A Markdown table of every key's value in every preset; an assumed value is in italics.
[[nodiscard]] std::string presets_markdown();

}  // namespace rtu::sim
