#pragma once

namespace rtu::apps {

inline constexpr int exit_done = 0;
inline constexpr int exit_bad_input = 1;
inline constexpr int exit_usage = 2;  ///< the command line itself is wrong
inline constexpr int exit_internal =
    3;  ///< a failed check, a broken invariant, or a machine that stands still

}  // namespace rtu::apps
