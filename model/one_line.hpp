#pragma once

#include <string>
#include <string_view>

namespace rtu::model {

/// `text` made fit for a one-line message: control characters become spaces, and what is longer than 160
/// characters ends in "...". For foreign text: library messages and values quoted from files.
[[nodiscard]] inline std::string one_line(std::string_view text) {
    constexpr std::size_t longest = 160;
    std::string line(text.substr(0, longest));
    for (char& c : line) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            c = ' ';
        }
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return text.size() > longest ? line + "..." : line;
}

}  // namespace rtu::model
