#include "study/sweep/sweep_constraint.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "sim/config_keys.hpp"

namespace rtu::study {
namespace {

using Sum = std::function<double(const sim::Config&)>;

bool is_name_key(const sim::ConfigKey& key) {
    return std::holds_alternative<std::string_view>(sim::config_value({}, key));
}

// Reads a condition from left to right; one character decides what comes next.
class ConstraintParser {
  public:
    ConstraintParser(std::string_view text, const std::string& place)
        : text_(text), rest_(text), place_(place) {}

    std::function<bool(const sim::Config&)> condition() {
        if (const sim::ConfigKey* key = peek_name_key()) return choice(*key);
        const Sum left = sum();
        const std::string_view comparison = take_comparison();
        const Sum right = sum();
        expect_end();
        return [=](const sim::Config& config) { return compare(comparison, left(config), right(config)); };
    }

  private:
    static constexpr std::string_view word_characters =
        "abcdefghijklmnopqrstuvwxyz0123456789_.ABCDEFGHIJKLMNOPQRSTUVWXYZ";

    [[noreturn]] void fail(std::string_view expected) {
        skip_blanks();
        throw Error("{}: constraint '{}': expected {}, got {}", place_, model::one_line(text_), expected,
                    rest_.empty() ? "its end" : fmt::format("'{}'", model::one_line(rest_)));
    }
    void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t"), rest_.size())); }
    bool take(std::string_view token) {
        skip_blanks();
        if (!rest_.starts_with(token)) return false;
        rest_.remove_prefix(token.size());
        return true;
    }
    std::string_view peek_word() {
        skip_blanks();
        return rest_.substr(0, std::min(rest_.find_first_not_of(word_characters), rest_.size()));
    }
    const sim::ConfigKey* peek_name_key() {
        const auto keys = sim::config_keys();
        const auto key = std::ranges::find(keys, peek_word(), &sim::ConfigKey::name);
        return key != keys.end() && is_name_key(*key) ? &*key : nullptr;
    }
    void expect_end() {
        skip_blanks();
        if (!rest_.empty()) fail("nothing more");
    }

    std::function<bool(const sim::Config&)> choice(const sim::ConfigKey& key) {
        rest_.remove_prefix(key.name.size());
        const bool is_equal = take("==");
        if (!is_equal && !take("!=")) fail("== or !=");
        if (!take("'")) fail("a name in single quotes");
        const std::string name(rest_.substr(0, rest_.find('\'')));
        rest_.remove_prefix(name.size());
        if (!take("'")) fail("a closing quote");
        const auto names = sim::pair_mode_names();
        if (std::ranges::find(names, name) == names.end()) {
            throw Error("{}: constraint '{}': {}: expected {}, got '{}'", place_, model::one_line(text_),
                        key.name, describe_range(key), model::one_line(name));
        }
        expect_end();
        return [&key, name, is_equal](const sim::Config& config) {
            return (sim::config_value_text(config, key) == name) == is_equal;
        };
    }

    std::string_view take_comparison() {
        for (const std::string_view token : {"<=", ">=", "==", "!=", "<", ">"}) {
            if (take(token)) return token;
        }
        fail("a comparison (<, <=, >, >=, == or !=)");
    }
    static bool compare(std::string_view comparison, double left, double right) {
        if (!std::isfinite(left) || !std::isfinite(right)) return false;
        if (comparison == "<=") return left <= right;
        if (comparison == ">=") return left >= right;
        if (comparison == "==") return left == right;
        if (comparison == "!=") return left != right;
        return comparison == "<" ? left < right : left > right;
    }

    Sum sum() {
        Sum left = product();
        while (true) {
            if (take("+")) {
                left = [left, right = product()](const auto& c) { return left(c) + right(c); };
            } else if (take("-")) {
                left = [left, right = product()](const auto& c) { return left(c) - right(c); };
            } else {
                return left;
            }
        }
    }
    Sum product() {
        Sum left = factor();
        while (true) {
            if (take("*")) {
                left = [left, right = factor()](const auto& c) { return left(c) * right(c); };
            } else if (take("/")) {
                left = [left, right = factor()](const auto& c) { return left(c) / right(c); };
            } else {
                return left;
            }
        }
    }
    Sum factor() {
        if (take("(")) {
            if (++depth_ > most_parentheses) fail("fewer parentheses");
            Sum inner = sum();
            if (!take(")")) fail("')'");
            --depth_;
            return inner;
        }
        const std::string_view word = peek_word();
        if (word.empty()) fail("a configuration key or a number");
        std::uint64_t number = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error == std::errc() && end == word.data() + word.size()) {
            rest_.remove_prefix(word.size());
            return [number](const sim::Config&) { return double(number); };
        }
        const sim::ConfigKey& key = sim::config_keys()[sim::config_key_index(word, place_)];
        if (is_name_key(key)) fail("a key that holds a number");
        rest_.remove_prefix(word.size());
        return [&key](const sim::Config& config) {
            return double(std::get<std::uint32_t>(sim::config_value(config, key)));
        };
    }

    static constexpr int most_parentheses = 32;
    std::string_view text_;
    std::string_view rest_;
    const std::string& place_;
    int depth_ = 0;
};

}  // namespace

SweepConstraint::SweepConstraint(std::string_view text, const std::string& place)
    : condition_(ConstraintParser(text, place).condition()) {}

}  // namespace rtu::study
