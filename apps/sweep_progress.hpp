#pragma once

#include <chrono>

#include "study/sweep/sweep_run.hpp"

namespace rtu::apps {

/// How far a sweep is, on standard error: on a terminal one line that is overwritten, else a line now and
/// then.
class SweepProgressLine {
  public:
    SweepProgressLine();
    SweepProgressLine(const SweepProgressLine&) = delete;
    SweepProgressLine& operator=(const SweepProgressLine&) = delete;
    ~SweepProgressLine();
    void show(const study::SweepProgress& progress);

  private:
    using Clock = std::chrono::steady_clock;
    bool is_terminal_;
    Clock::time_point last_;
};

}  // namespace rtu::apps
