#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace rtu {

/// Bad input from outside (file, configuration, command line). The text is one line that says where,
/// what was expected and what was found.
class Error : public std::runtime_error {
  public:
    template <class... Args>
    explicit Error(fmt::format_string<Args...> format, Args&&... args)
        : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

/// Throws std::logic_error: a broken invariant, that is a defect of this program and not of its input.
[[noreturn]] inline void fail_check(const char* file, int line, const std::string& text) {
    throw std::logic_error(fmt::format("{}:{}: {}", file, line, text));
}

}  // namespace rtu

/// Checks an invariant in every build; the rest is a format string with its arguments.
/// A macro, because the message must not be built unless the check fails.
#define RTU_CHECK(condition, ...) \
    ((condition) ? void(0) : ::rtu::fail_check(__FILE__, __LINE__, fmt::format(__VA_ARGS__)))
