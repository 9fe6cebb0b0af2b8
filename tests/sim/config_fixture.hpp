#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/error.hpp"
#include "sim/effective_config.hpp"

namespace rtu::sim::test {

/// The text of the Error that `action` throws; empty when it throws none.
template <class Action>
std::string error_of(Action action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

inline std::string error_of_set(const std::string& set) {
    return error_of([&] { (void)load_config("default", {}, std::vector{set}); });
}

/// A file in the temporary folder that goes when the test ends.
class TemporaryFile {
  public:
    explicit TemporaryFile(std::string_view text)
        : path_(std::filesystem::path(testing::TempDir()) /
                (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".toml")) {
        std::ofstream(path_, std::ios::binary) << text;
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() { std::filesystem::remove(path_); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

inline EffectiveConfig load_text(std::string_view text, std::span<const std::string> sets = {}) {
    const TemporaryFile file(text);
    return load_config("default", file.path(), sets);
}

inline std::string error_of_text(std::string_view text) {
    return error_of([&] { (void)load_text(text); });
}

}  // namespace rtu::sim::test
