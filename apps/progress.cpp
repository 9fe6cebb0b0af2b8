#include "apps/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace rtu::apps {

Progress::Progress() : is_terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (is_terminal_) std::fwrite(clear_line.data(), 1, clear_line.size(), stderr);
}

void Progress::show(std::string_view scene, std::string_view phase) {
    // 72 characters: a line that wraps could not be cleared.
    if (!is_terminal_) return;
    const std::string line = fmt::format("{}{:.72}", clear_line, fmt::format("{}: {}", scene, phase));
    std::fwrite(line.data(), 1, line.size(), stderr);  // a terminal that has gone is no reason to stop
}

}  // namespace rtu::apps
