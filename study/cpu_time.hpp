#pragma once

#include <ctime>

namespace rtu::study {

/// CPU time of this process so far, over all its threads.
[[nodiscard]] inline double cpu_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

}  // namespace rtu::study
