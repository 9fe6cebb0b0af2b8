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

void print_error(std::string_view text) {
    std::fwrite("rtusim: ", 1, 8, stderr);
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fputc('\n', stderr);
}

}  // namespace rtu::apps
