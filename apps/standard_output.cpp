#include "apps/standard_output.hpp"

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "model/error.hpp"

namespace rtu::apps {

void print_all(std::string_view text) {
    const std::size_t written = std::fwrite(text.data(), 1, text.size(), stdout);
    if (written != text.size() || std::fflush(stdout) != 0) {
        throw Error("standard output: cannot write: {}", std::generic_category().message(errno));
    }
}

}  // namespace rtu::apps
