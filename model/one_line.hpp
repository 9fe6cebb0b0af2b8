#pragma once

#include <string>
#include <string_view>

namespace rtu::model {

/// `text` with a space for each control character: fit for one line.
[[nodiscard]] inline std::string printable(std::string_view text) {
    std::string line(text);
    for (char& c : line) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            c = ' ';
        }
    }
    return line;
}

/// `text` made fit for a one-line message: as printable(), and what is longer than 160 characters ends in
/// "...". For foreign text: library messages and values quoted from files.
[[nodiscard]] inline std::string one_line(std::string_view text) {
    constexpr std::size_t longest = 160;
    std::string line = printable(text.substr(0, longest));
    line.erase(line.find_last_not_of(' ') + 1);
    return text.size() > longest ? line + "..." : line;
}

}  // namespace rtu::model
