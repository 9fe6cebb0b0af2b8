#include "study/sweep/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include "model/error.hpp"

namespace rtu::study {
namespace {

struct Pipe {
    Pipe() {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0)
            throw Error("cannot make a pipe: {}", std::generic_category().message(errno));
        read_end = ends[0];
        write_end = ends[1];
    }
    int read_end, write_end;
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments) {
    const Pipe to_child, from_child;
    std::vector<char*> argv;
    argv.reserve(arguments.size() + 1);
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, to_child.read_end, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, from_child.write_end, STDOUT_FILENO);
    const int error = ::posix_spawnp(&id_, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(to_child.read_end);
    ::close(from_child.write_end);
    input_ = to_child.write_end;
    output_ = from_child.read_end;
    if (error == 0) return;
    ::close(input_);
    ::close(output_);
    throw Error("{}: cannot be started: {}", arguments.front(), std::generic_category().message(error));
}

ChildProcess::~ChildProcess() {
    close_input();
    ::close(output_);
    if (is_waited_for_) return;
    ::kill(id_, SIGKILL);
    static_cast<void>(wait());
}

bool ChildProcess::write(const std::string& text) {
    // A child that has gone must not end this process too.
    const auto previous = std::signal(SIGPIPE, SIG_IGN);
    const ssize_t count = ::write(input_, text.data(), text.size());
    std::signal(SIGPIPE, previous);
    return count == ssize_t(text.size());
}

void ChildProcess::close_input() {
    if (input_ >= 0) ::close(input_);
    input_ = -1;
}

bool ChildProcess::read(std::string& text) {
    std::array<char, 4096> bytes{};
    ssize_t count = 0;
    do {
        count = ::read(output_, bytes.data(), bytes.size());
    } while (count < 0 && errno == EINTR);
    if (count <= 0) return false;
    text.append(bytes.data(), std::size_t(count));
    return true;
}

int ChildProcess::wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    is_waited_for_ = true;
    return status;
}

std::string describe_end(int status) {
    if (WIFSIGNALED(status)) {
        return fmt::format("was ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
    }
    return fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

std::string output_of(const std::vector<std::string>& arguments) {
    ChildProcess child(arguments);
    child.close_input();
    std::string text;
    while (child.read(text)) {
    }
    const int status = child.wait();
    if (status != 0) throw Error("{} {}", arguments.front(), describe_end(status));
    return text;
}

}  // namespace rtu::study
