#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace rtu::test {

/// What a value change dump (IEEE 1364, 18.2) holds of named signals.
struct Vcd {
    std::vector<std::string> signals;  ///< all of them, with their scopes: "rtu.u_core.clk_i"
    std::vector<std::uint64_t> times;  ///< at which anything changes, rising
};

/// Reads a dump, and after all changes of each of its times calls `at_time` with the values so far, as binary
/// digits, of the signals by their names.
inline Vcd read_vcd(
    const std::string& text,
    const std::function<void(std::uint64_t, const std::map<std::string, std::string>&)>& at_time) {
    Vcd vcd;
    std::vector<std::string> scopes;
    std::multimap<std::string, std::string> names;  // by the dump's short ones
    std::map<std::string, std::string> values;
    std::istringstream lines(text);
    const auto set = [&](const std::string& code, const std::string& value) {
        for (auto [name, end] = names.equal_range(code); name != end; ++name) values[name->second] = value;
    };
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string word, type, bits, code, name;
        words >> word;
        if (word == "$scope") {
            words >> type >> name;
            scopes.push_back(name);
        } else if (word == "$upscope") {
            scopes.pop_back();
        } else if (word == "$var") {
            words >> type >> bits >> code >> name;
            std::string full;
            for (const std::string& scope : scopes) full += scope + ".";
            vcd.signals.push_back(full + name);
            names.emplace(code, full + name);
        } else if (word.starts_with('#')) {
            if (!vcd.times.empty()) at_time(vcd.times.back(), values);
            vcd.times.push_back(std::stoull(word.substr(1)));
        } else if (word.starts_with('b')) {
            words >> code;
            set(code, word.substr(1));
        } else if (word.starts_with('0') || word.starts_with('1')) {
            set(word.substr(1), word.substr(0, 1));
        }
    }
    if (!vcd.times.empty()) at_time(vcd.times.back(), values);
    return vcd;
}

}  // namespace rtu::test
