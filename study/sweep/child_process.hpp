#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace rtu::study {

/// A child process whose standard input and output are pipes to this one; its standard error is this one's.
class ChildProcess {
  public:
    /// Starts `arguments`, the first of which is a program's path or a name in PATH. Throws Error when it
    /// cannot.
    explicit ChildProcess(const std::vector<std::string>& arguments);
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    /// Kills the process if it is still there.
    ~ChildProcess();

    [[nodiscard]] pid_t id() const { return id_; }
    /// To be polled: the child's standard output.
    [[nodiscard]] int output() const { return output_; }
    /// Writes to the child's standard input; false when that is closed.
    [[nodiscard]] bool write(const std::string& text);
    void close_input();
    /// Appends what the child wrote, waiting for something; false at the end of its output.
    [[nodiscard]] bool read(std::string& text);
    /// Waits for its end; returns how it ended as waitpid() says.
    [[nodiscard]] int wait();

  private:
    pid_t id_ = -1;
    int input_ = -1;
    int output_ = -1;
    bool is_waited_for_ = false;
};

/// "ended with exit code 1", or "was ended by signal 11 (Segmentation fault)".
[[nodiscard]] std::string describe_end(int status);

/// Runs a command to its end and returns its standard output. Throws Error with its name and end unless it
/// ended with exit code 0; what it said is on standard error.
[[nodiscard]] std::string output_of(const std::vector<std::string>& arguments);

}  // namespace rtu::study
