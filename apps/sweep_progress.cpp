#include "apps/sweep_progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "apps/progress.hpp"
#include "study/sweep/sweep_text.hpp"

namespace rtu::apps {
namespace {

constexpr auto log_interval = std::chrono::seconds(30);

std::string text_of(const study::SweepProgress& progress) {
    if (!progress.phase.empty()) return progress.phase;
    const study::SweepCounts& points = progress.points;
    std::string text = fmt::format("{} of {} points", points.done + points.failed, points.total());
    if (points.failed > 0) text += fmt::format(", {} failed", points.failed);
    if (progress.points_per_second > 0) {
        text += fmt::format(", {:.3g}/s, {} left", progress.points_per_second,
                            study::duration_text(progress.seconds_left));
    }
    if (!progress.best.empty()) text += ", best " + progress.best;
    return text;
}

// A line that wraps could not be cleared.
std::size_t terminal_width() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1U : 79U;
}

// A standard error that has gone is no reason to stop.
void write(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

}  // namespace

SweepProgressLine::SweepProgressLine() : is_terminal_(::isatty(STDERR_FILENO) == 1), last_(Clock::now()) {}

SweepProgressLine::~SweepProgressLine() {
    if (is_terminal_) write(std::string(clear_line));
}

void SweepProgressLine::show(const study::SweepProgress& progress) {
    if (is_terminal_) {
        write(fmt::format("{}{}", clear_line, text_of(progress).substr(0, terminal_width())));
    } else if (progress.phase.empty() && Clock::now() - last_ >= log_interval) {
        write(text_of(progress) + "\n");
        last_ = Clock::now();
    }
}

}  // namespace rtu::apps
