#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "model/error.hpp"

namespace rtu::test {

/// A fuzzer's bytes as a file in memory, for readers that want a path.
class FuzzFile {
  public:
    FuzzFile(const std::uint8_t* bytes, std::size_t size) : descriptor_(::memfd_create("fuzz", 0)) {
        for (std::size_t done = 0; done < size;) {
            const ssize_t count = ::write(descriptor_, bytes + done, size - done);
            if (count <= 0) std::abort();
            done += std::size_t(count);
        }
    }
    FuzzFile(const FuzzFile&) = delete;
    FuzzFile& operator=(const FuzzFile&) = delete;
    ~FuzzFile() { ::close(descriptor_); }
    [[nodiscard]] std::filesystem::path path() const {
        return "/proc/self/fd/" + std::to_string(descriptor_);
    }

  private:
    int descriptor_;
};

/// Calls f; that it throws Error is as it should be, and anything else is a find.
template <class F>
void expect_result_or_error(F f) {
    try {
        f();
    } catch (const Error&) {
    }
}

}  // namespace rtu::test
