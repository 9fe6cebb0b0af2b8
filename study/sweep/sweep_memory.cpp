#include "study/sweep/sweep_memory.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <thread>

namespace rtu::study {
namespace {

constexpr std::uint64_t mebibyte = 1 << 20;
constexpr std::uint64_t process_bytes = 48 * mebibyte;  // program, libraries, kernels of earlier simulations
constexpr std::uint64_t line_bytes = 64;                // tags and state of a cache line
constexpr std::uint64_t slot_bytes = 1024;              // a ray under way, its place in every queue

std::uint64_t lines(const sim::Config::Cache& cache) { return cache.size_bytes / cache.line_bytes; }

// What the host can still give; without an answer, one worker's worth is left to its swap.
std::uint64_t available_bytes() {
    std::ifstream stream("/proc/meminfo");
    std::string name;
    for (std::uint64_t kibibytes = 0; stream >> name >> kibibytes; stream.ignore(64, '\n')) {
        if (name == "MemAvailable:") return kibibytes * 1024;
    }
    return 0;
}

}  // namespace

std::uint64_t machine_bytes(const sim::Config& config) {
    return process_bytes + line_bytes * (lines(config.l2) + config.rtu.count * lines(config.l1)) +
           slot_bytes * config.rtu.count * config.rtu.ray_slots;
}

unsigned worker_count(unsigned asked, std::uint64_t points, std::uint64_t bytes) {
    const std::uint64_t cores = std::max(1U, std::thread::hardware_concurrency());
    const std::uint64_t fitting = available_bytes() / 5 * 4 / bytes;
    const std::uint64_t wanted = asked > 0 ? asked : std::min(cores, fitting);
    return unsigned(std::clamp<std::uint64_t>(wanted, 1, std::max<std::uint64_t>(points, 1)));
}

}  // namespace rtu::study
