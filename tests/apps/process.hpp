#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace rtu::test {

/// A program built with the sanitizers that stands in for this build's; null: none does.
inline const char* sanitized_program() { return std::getenv("RTUSIM_SANITIZED_PROGRAM"); }

/// The program that is tested.
inline std::string program_path() {
    return sanitized_program() != nullptr ? sanitized_program() : RTUSIM_EXECUTABLE;
}

/// What a finished program left.
struct ProcessResult {
    int exit_code = -1;  ///< -1: ended by a signal
    std::string out;
    std::string err;
};

inline std::string read_file(const std::filesystem::path& path) {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

/// A child process whose output goes to two files in `folder`; its working directory is `folder`.
class Process {
  public:
    Process(const std::filesystem::path& folder, std::vector<std::string> arguments)
        : out_(folder.parent_path() / (folder.filename().string() + ".out")),
          err_(folder.parent_path() / (folder.filename().string() + ".err")),
          child_(::fork()) {
        if (child_ != 0) return;
        std::vector<char*> argv;
        argv.reserve(arguments.size() + 1);
        for (std::string& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        const bool is_ready = ::chdir(folder.c_str()) == 0 &&
                              std::freopen(out_.c_str(), "w", stdout) != nullptr &&
                              std::freopen(err_.c_str(), "w", stderr) != nullptr;
        if (is_ready) ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    [[nodiscard]] pid_t id() const { return child_; }

    [[nodiscard]] ProcessResult wait() {
        int status = 0;
        EXPECT_EQ(::waitpid(child_, &status, 0), child_);
        ProcessResult result{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out_), read_file(err_)};
        std::filesystem::remove(out_);
        std::filesystem::remove(err_);
        return result;
    }

  private:
    std::filesystem::path out_, err_;
    pid_t child_;
};

}  // namespace rtu::test
