#include "sim/config_file.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

#include "model/error.hpp"
#include "model/one_line.hpp"

namespace rtu::sim {
namespace {

constexpr std::size_t max_file_bytes = 1U << 20;

constexpr std::size_t max_line_bytes = 1024;

struct Statement {
    std::uint32_t line = 0;
    ConfigAssignment assignment;
};

class Reader {
  public:
    explicit Reader(const std::string& file) : file_(file) {}

    /// Collects the statements of a table; `prefix` is its dotted name with the final dot, or empty.
    void read_table(const toml::table& table, const std::string& prefix) {
        for (const auto& [key, node] : table) {
            const std::string name = prefix + std::string(key.str());
            const auto line = key.source().begin.line;
            const toml::table* inner = node.as_table();
            if (inner == nullptr) {
                add(line, name, node, {});
            } else if (is_key(name)) {
                read_sourced_value(line, name, *inner);
            } else if (inner->empty() && !is_group(name)) {
                (void)config_key_index(name, place(line));  // throws: there is no such key
            } else {
                read_table(*inner, name + ".");
            }
        }
    }

    [[nodiscard]] std::vector<ConfigAssignment> in_line_order() && {
        std::ranges::stable_sort(statements_, {}, &Statement::line);
        std::vector<ConfigAssignment> result;
        for (Statement& statement : statements_) result.push_back(std::move(statement.assignment));
        return result;
    }

  private:
    [[nodiscard]] std::string place(std::uint32_t line) const { return fmt::format("{}:{}", file_, line); }

    [[nodiscard]] static bool is_key(std::string_view name) {
        return std::ranges::find(config_keys(), name, &ConfigKey::name) != config_keys().end();
    }

    [[nodiscard]] static bool is_group(const std::string& name) {
        return std::ranges::any_of(config_keys(),
                                   [&](const ConfigKey& key) { return key.name.starts_with(name + "."); });
    }

    void read_sourced_value(std::uint32_t line, const std::string& name, const toml::table& table) {
        for (const auto& [key, node] : table) {
            if (key.str() == "value" || (key.str() == "source" && node.is_string())) continue;
            throw Error("{}: {}: expected {{ value = ..., source = \"...\" }}, got '{}' of type {}",
                        place(key.source().begin.line), name, key.str(), type_name(node));
        }
        const toml::node* value = table.get("value");
        if (value == nullptr)
            throw Error("{}: {}: expected a value with its source, got no value", place(line), name);
        add(line, name, *value, table["source"].value_or(std::string()));
    }

    void add(std::uint32_t line, const std::string& name, const toml::node& node, std::string source) {
        ConfigAssignment assignment{name, {}, std::move(source), place(line)};
        if (const auto* number = node.as_integer()) {
            assignment.value = number->get();
        } else if (const auto* text = node.as_string()) {
            assignment.value = text->get();
        } else {
            const ConfigKey& key = config_keys()[config_key_index(name, place(line))];
            throw Error("{}: {}: expected {}, got a value of type {}", place(line), name, describe_range(key),
                        type_name(node));
        }
        statements_.push_back({line, std::move(assignment)});
    }

    [[nodiscard]] static std::string type_name(const toml::node& node) {
        std::ostringstream text;
        text << node.type();
        return text.str();
    }

    const std::string& file_;
    std::vector<Statement> statements_;
};

}  // namespace

void check_line_lengths(std::string_view text, const std::string& file) {
    std::size_t line = 1;
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        if (end - begin > max_line_bytes) {
            throw Error("{}:{}: expected lines of at most {} bytes, got {}", file, line, max_line_bytes,
                        end - begin);
        }
        begin = end + 1;
        ++line;
    }
}

std::vector<ConfigAssignment> parse_config_toml(std::string_view text, const std::string& file) try {
    check_line_lengths(text, file);
    Reader reader(file);
    reader.read_table(toml::parse(text, file), {});
    return std::move(reader).in_line_order();
} catch (const toml::parse_error& error) {
    throw Error("{}:{}: expected TOML, got: {}", file, error.source().begin.line,
                model::one_line(error.description()));
}

std::vector<ConfigAssignment> read_config_file(const std::filesystem::path& path) {
    const std::string file = path.string();
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw Error("{}: expected a file, got a directory", file);
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw Error("{}: expected a configuration file that can be read", file);
    std::string text(max_file_bytes + 1, '\0');
    stream.read(text.data(), std::streamsize(text.size()));
    text.resize(std::size_t(stream.gcount()));
    if (stream.bad()) throw Error("{}: expected a configuration file that can be read", file);
    if (text.size() > max_file_bytes) {
        throw Error("{}: expected a configuration of at most {} bytes", file, max_file_bytes);
    }
    return parse_config_toml(text, file);
}

}  // namespace rtu::sim
