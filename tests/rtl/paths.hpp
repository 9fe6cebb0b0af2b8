#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>

namespace rtu::test {

/// How many vectors of a test took which path through the unit: properties of the test in GoogleTest's XML,
/// which `./dev rtl` prints.
class Paths {
  public:
    /// Makes the path appear, even if nothing takes it.
    void count(const std::string& path, std::uint64_t times = 1) { times_[path] += times; }
    [[nodiscard]] std::uint64_t times(const std::string& path) const {
        const auto found = times_.find(path);
        return found != times_.end() ? found->second : 0;
    }
    void record() const {
        for (const auto& [path, times] : times_) testing::Test::RecordProperty(path, std::to_string(times));
    }

  private:
    std::map<std::string, std::uint64_t> times_;
};

}  // namespace rtu::test
