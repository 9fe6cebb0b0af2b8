#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

// Values of a TOML document, or errors that name file and line.

namespace rtu::study {

/// Hands out the parts of one document.
class TomlReader {
  public:
    /// Parses `text`; throws Error, with `file` and line, for what is not TOML.
    TomlReader(std::string_view text, std::string file);

    [[nodiscard]] const toml::table& root() const { return root_; }
    /// FILE:LINE of a value.
    [[nodiscard]] std::string place(const toml::node& node) const;
    /// FILE:LINE of a key.
    [[nodiscard]] std::string place(const toml::key& key) const;

    /// Throws Error for the first key of the table that is not one of `known`.
    void check_keys(const toml::table& table, std::initializer_list<std::string_view> known) const;

    // All throw Error for a value of another type; `what` names it.
    [[nodiscard]] std::string text(const toml::node& node, std::string_view what) const;
    /// From `least` to `most`, both allowed.
    [[nodiscard]] std::uint64_t number(const toml::node& node, std::string_view what, std::uint64_t least,
                                       std::uint64_t most) const;
    [[nodiscard]] const toml::array& array(const toml::node& node, std::string_view what) const;
    [[nodiscard]] const toml::table& table(const toml::node& node, std::string_view what) const;
    /// "expected WHAT, got a value of type ...".
    [[noreturn]] void fail(const toml::node& node, std::string_view what) const;

  private:
    std::string file_;
    toml::table root_;
};

}  // namespace rtu::study
