#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <optional>

#include "model/error.hpp"
#include "study/sweep/child_process.hpp"
#include "study/sweep/sweep_executor.hpp"
#include "study/sweep/sweep_journal.hpp"

namespace rtu::study {
namespace {

namespace fs = std::filesystem;

constexpr int most_attempts = 3;
constexpr int look_interval_ms = 250;
// Every simulation leaves its kernel behind in the process (sim/kernel.cpp).
constexpr std::size_t points_of_process = 500;

// No two journals have one name, whatever processes there were before.
std::string new_journal_name() {
    static std::atomic<unsigned> count{0};
    const auto now = std::chrono::system_clock::now().time_since_epoch().count();
    return fmt::format("{:x}-{}-{}.journal", now, ::getpid(), count++);
}

struct Worker {
    explicit Worker(const SweepWork& work)
        : process({work.program.string(), "sweep-worker", work.list.string(), "--journal",
                   (work.folder / new_journal_name()).string(), "--parent", fmt::format("{}", ::getpid())}) {}
    ChildProcess process;
    std::optional<std::size_t> point;  // under way
    std::size_t started = 0;
    std::string said;  // of a line that is not whole
};

class Pool {
  public:
    explicit Pool(const SweepWork& work) : work_(work), queue_(work.waiting.begin(), work.waiting.end()) {}

    void run(unsigned worker_count) {
        for (unsigned i = 0; i < worker_count && !queue_.empty(); ++i) add_worker();
        while (!workers_.empty()) {
            wait_for_workers();
            work_.look();
        }
    }

  private:
    using Clock = std::chrono::steady_clock;

    void add_worker() {
        workers_.push_back(std::make_unique<Worker>(work_));
        hand_out(*workers_.back());
    }

    // The next point for a worker, or the end of its input when there is none or it has had enough.
    void hand_out(Worker& worker) {
        worker.point.reset();
        if (queue_.empty() || worker.started == points_of_process) {
            worker.process.close_input();
            return;
        }
        worker.point = queue_.front();
        queue_.pop_front();
        ++worker.started;
        // A worker that has gone is found by the end of its output.
        static_cast<void>(worker.process.write(fmt::format("{}\n", *worker.point)));
    }

    // Until it is time to look at the journals, or no worker is left.
    void wait_for_workers() {
        const auto end = Clock::now() + std::chrono::milliseconds(look_interval_ms);
        while (!workers_.empty()) {
            const auto left =
                std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
            if (left <= 0) return;
            std::vector<pollfd> files;
            for (const auto& worker : workers_) files.push_back({worker->process.output(), POLLIN, 0});
            if (::poll(files.data(), files.size(), int(left)) <= 0) continue;
            for (std::size_t i = files.size(); i > 0; --i) {
                if (files[i - 1].revents != 0 && !listen(*workers_[i - 1])) replace(i - 1);
            }
        }
    }

    // Takes what a worker said; false when it has come to its end.
    bool listen(Worker& worker) {
        if (!worker.process.read(worker.said)) return false;
        for (std::size_t end = worker.said.find('\n'); end != std::string::npos;
             end = worker.said.find('\n')) {
            const std::string line = worker.said.substr(0, end);
            worker.said.erase(0, end + 1);
            if (line.starts_with("error ")) throw Error("{}", line.substr(6));
            if (line.starts_with("failed ")) worker.started = points_of_process;  // and so ends it
            hand_out(worker);
        }
        return true;
    }

    // A worker has ended: of itself, after a point that failed or as many as it may do, or killed within one.
    void replace(std::size_t index) {
        const std::string end = describe_end(workers_[index]->process.wait());
        const std::optional<std::size_t> point = workers_[index]->point;
        workers_.erase(workers_.begin() + std::ptrdiff_t(index));
        if (point) take_back(*point, end);
        if (!queue_.empty()) add_worker();
    }

    void take_back(std::size_t point, const std::string& end) {
        work_.look();
        if (!std::ranges::binary_search(work_.still_waiting(), point)) return;
        if (++attempts_[point] < most_attempts) {
            queue_.push_front(point);
        } else {
            work_.give_up(point, fmt::format("its process {}, {} times", end, most_attempts));
        }
    }

    const SweepWork& work_;
    std::deque<std::size_t> queue_;
    std::vector<std::unique_ptr<Worker>> workers_;
    std::map<std::size_t, int> attempts_;
};

}  // namespace

void run_local(const SweepWork& work, unsigned workers) { Pool(work).run(workers); }

}  // namespace rtu::study
