#pragma once

#include <string_view>

namespace rtu::apps {

/// Writes to standard output and makes sure that it arrived; throws Error when it did not (a full disk, say).
void print_all(std::string_view text);

/// Writes "rtusim: TEXT" and a line feed to standard error. Does not throw: when that is closed or full, the
/// exit code is all that can still tell.
void print_error(std::string_view text);

}  // namespace rtu::apps
