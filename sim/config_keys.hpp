#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "sim/config.hpp"

namespace rtu::sim {

/// What a key holds: a number, or the name of a choice.
using ConfigValue = std::variant<std::uint32_t, std::string_view>;

/// One row of the table that drives parsing, printing and validation of the configuration.
struct ConfigKey {
    /// What a number must be besides lying in its range.
    enum class Form : std::uint8_t { Any, Even, PowerOfTwo };
    using Field = std::variant<std::uint32_t*, PairMode*, MemoryModel*, model::NodeFormat*, BvhBuilder*,
                               SplitKind*, MailboxKind*>;

    std::string_view name;     ///< dotted, as in files and options; equals the member's path in Config
    std::string_view unit;     ///< of the number; empty for a choice
    std::string_view meaning;  ///< one line
    std::uint32_t min = 0;     ///< both ends are allowed; not used by a choice
    std::uint32_t max = 0;
    Form form = Form::Any;
    std::string_view
        source;  ///< of the default; `[key]` refers to the list in docs/machine.md, or "assumed: why"
    Field (*field)(Config&) = nullptr;
};

/// Every key, in the order of printing.
[[nodiscard]] std::span<const ConfigKey> config_keys();

/// Where `name` stands in config_keys(). Throws Error, with the nearest key as a suggestion, for an unknown
/// name; `place` (file and line, or option) begins its text.
[[nodiscard]] std::size_t config_key_index(std::string_view name, std::string_view place);

/// The value of `key` in `config`.
[[nodiscard]] ConfigValue config_value(const Config& config, const ConfigKey& key);

/// The value of `key` as it is written in files, without quotes.
[[nodiscard]] std::string config_value_text(const Config& config, const ConfigKey& key);

/// What `key` allows, e.g. "a power of two from 32 to 1024" or "single, dual_independent or dual_shared".
[[nodiscard]] std::string describe_range(const ConfigKey& key);

/// The names of PairMode, in the order of its enumerators.
[[nodiscard]] std::span<const std::string_view> pair_mode_names();

/// What a choice may be called, in the order of its enumerators; empty for a number.
[[nodiscard]] std::span<const std::string_view> choice_names(const ConfigKey::Field& field);

}  // namespace rtu::sim
