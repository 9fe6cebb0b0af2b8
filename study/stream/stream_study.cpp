#include "study/stream/stream_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "model/error.hpp"
#include "study/scene_steps.hpp"
#include "study/stream/stream_balance.hpp"
#include "study/stream/stream_input.hpp"
#include "study/stream/stream_published.hpp"
#include "study/version.hpp"

namespace rtu::study {
namespace {

using sim::StreamJob;
using sim::StreamMode;

void tell(const StreamOptions& options, const std::string& phase) {
    if (options.progress) options.progress(phase);
}

// 1, 4, 16 ... and all.
std::vector<std::uint64_t> usual_batches(std::uint64_t test_count) {
    std::vector<std::uint64_t> batches;
    for (std::uint64_t batch = 1; batch < test_count; batch *= 4) batches.push_back(batch);
    batches.push_back(test_count);
    return batches;
}

class Study {
  public:
    Study(const StreamOptions& options, StreamReport& report, const StreamInput& input)
        : options_(options), report_(report), runner_(input) {}

    void run() {
        const StreamInput& input = runner_.input();
        std::vector<std::uint64_t> batches = options_.batches;
        if (batches.empty()) batches = usual_batches(input.rays.size() * input.pairs.size());
        for (const StreamMode mode : options_.modes) {
            for (const LinkedMachine& machine : options_.machines) {
                tell(options_, fmt::format("{} over {}", to_string(mode), machine.link));
                run_link(mode, machine, mode == StreamMode::Direct ? std::vector<std::uint64_t>{1} : batches);
            }
        }
        report_.hit_count = runner_.hit_count();
    }

  private:
    void run_link(StreamMode mode, const LinkedMachine& machine, const std::vector<std::uint64_t>& batches) {
        const auto read_back = options_.read_back.value_or(usual_read_back(mode));
        for (const std::uint64_t batch : batches)
            report_.rows.push_back(runner_.run(machine, mode, read_back, batch));
        const StreamRow& last = report_.rows.back();
        const double test_cycles = double(last.result.tests.tester_cycles) /
                                   double(last.tester_count * last.result.tests.pair_tests);
        const std::optional<std::uint64_t> balance =
            machine.config.link.count == 0
                ? std::optional<std::uint64_t>(1)
                : balance_batch(machine.config, runner_.job(machine, mode, read_back, 1), test_cycles);
        report_.balances.push_back({last.mode, last.link, balance});
        if (!balance || std::ranges::find(batches, *balance) != batches.end() || mode == StreamMode::Direct)
            return;
        StreamRow row = runner_.run(machine, mode, read_back, *balance);
        row.is_balance = true;
        report_.rows.push_back(std::move(row));
    }

    const StreamOptions& options_;
    StreamReport& report_;
    StreamRunner runner_;
};

}  // namespace

double StreamRow::tests_per_second() const {
    return double(result.tests.triangle_tests) / double(result.cycles) * clock_mhz * 1e6;
}
double StreamRow::alone_tests_per_second() const {
    return double(result.tests.triangle_tests) / double(alone_cycles) * clock_mhz * 1e6;
}
double StreamRow::mrps() const { return double(ray_count) / double(result.cycles) * clock_mhz; }
double StreamRow::alone_mrps() const { return double(ray_count) / double(alone_cycles) * clock_mhz; }
double StreamRow::tester_percent() const {
    return 100.0 * double(result.tests.tester_cycles) / (double(result.cycles) * double(tester_count));
}
std::string_view StreamRow::limit() const {
    const std::array<std::pair<double, std::string_view>, 4> parts{{{tester_percent(), "testers"},
                                                                    {down_percent, "read-back"},
                                                                    {up_percent, "upload"},
                                                                    {host_percent, "host"}}};
    return std::ranges::max_element(parts, {}, &std::pair<double, std::string_view>::first)->second;
}

sim::ReadBack usual_read_back(StreamMode mode) {
    return mode == StreamMode::Resident ? sim::ReadBack::Rays : sim::ReadBack::Tests;
}

StreamReport run_stream_study(const StreamOptions& options) {
    StreamReport report;
    report.version = version();
    report.preset = options.preset;
    report.seed = options.seed;
    report.workload = to_string(options.workload);
    for (const LinkedMachine& machine : options.machines) report.links.push_back(machine.link);
    tell(options, "reading the scene");
    const StreamInput input = make_stream_input(options);
    report.scene = input.scene;
    report.input_hash = input.input_hash;
    report.pairing = input.pairing;
    report.clock_mhz = options.machines.front().config.clock_mhz;
    report.ray_count = input.rays.size();
    report.pair_count = input.pairs.size();
    for (const model::LeafPair& pair : input.pairs) report.triangle_count += pair.has_second() ? 2 : 1;
    Study(options, report, input).run();
    if (options.has_published) {
        const StreamOptions theirs = published_options(options);
        report.published =
            published_streams(make_stream_input(theirs), theirs.machines.front(), options.progress);
    }
    return report;
}

}  // namespace rtu::study
