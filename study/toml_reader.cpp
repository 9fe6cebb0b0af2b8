#include "study/toml_reader.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "sim/config_file.hpp"

namespace rtu::study {
TomlReader::TomlReader(std::string_view text, std::string file) : file_(std::move(file)) {
    sim::check_line_lengths(text, file_);
    try {
        root_ = toml::parse(text, file_);
    } catch (const toml::parse_error& error) {
        throw Error("{}:{}: expected TOML, got: {}", file_, error.source().begin.line,
                    model::one_line(error.description()));
    }
}

std::string TomlReader::place(const toml::node& node) const {
    return fmt::format("{}:{}", file_, node.source().begin.line);
}

std::string TomlReader::place(const toml::key& key) const {
    return fmt::format("{}:{}", file_, key.source().begin.line);
}

void TomlReader::check_keys(const toml::table& table, std::initializer_list<std::string_view> known) const {
    for (const auto& [key, node] : table) {
        if (std::ranges::find(known, key.str()) != known.end()) continue;
        throw Error("{}: expected one of {}, got '{}'", place(key), fmt::join(known, ", "),
                    model::one_line(key.str()));
    }
}

std::string TomlReader::text(const toml::node& node, std::string_view what) const {
    const auto* value = node.as_string();
    if (value == nullptr) fail(node, what);
    return value->get();
}

std::uint64_t TomlReader::number(const toml::node& node, std::string_view what, std::uint64_t least,
                                 std::uint64_t most) const {
    const auto* value = node.as_integer();
    const std::string expected = fmt::format("{}, a number from {} to {}", what, least, most);
    if (value == nullptr) fail(node, expected);
    if (value->get() < 0 || std::uint64_t(value->get()) < least || std::uint64_t(value->get()) > most) {
        throw Error("{}: expected {}, got {}", place(node), expected, value->get());
    }
    return std::uint64_t(value->get());
}

const toml::array& TomlReader::array(const toml::node& node, std::string_view what) const {
    const auto* value = node.as_array();
    if (value == nullptr) fail(node, what);
    return *value;
}

const toml::table& TomlReader::table(const toml::node& node, std::string_view what) const {
    const auto* value = node.as_table();
    if (value == nullptr) fail(node, what);
    return *value;
}

void TomlReader::fail(const toml::node& node, std::string_view what) const {
    std::ostringstream type;
    type << node.type();
    throw Error("{}: expected {}, got a value of type {}", place(node), what, type.str());
}

}  // namespace rtu::study
