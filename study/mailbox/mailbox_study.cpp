#include "study/mailbox/mailbox_study.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "model/all_hits.hpp"
#include "model/error.hpp"
#include "sim/config_keys.hpp"
#include "sim/machine.hpp"
#include "study/area/area_report.hpp"
#include "study/scene_steps.hpp"
#include "study/version.hpp"

namespace rtu::study {
namespace {

using sim::MailboxKind;
using sim::SplitKind;

constexpr std::size_t all_hits_stride = 32;  // of an any-hit workload's rays, every so manieth
constexpr std::uint32_t hashed_entries = 8;

std::uint64_t scheduler_counter(const sim::MachineResult& result, std::string_view name) {
    std::uint64_t sum = 0;
    for (const sim::UnitResult& unit : result.units) {
        if (!unit.name.ends_with("scheduler")) continue;
        for (const sim::CounterValue& counter : unit.counters) {
            sum += counter.name == name ? counter.value : 0;
        }
    }
    return sum;
}

// Where every pair is in one leaf a mailbox finds nothing.
std::vector<model::MailboxOptions> mailboxes_for(SplitKind splits, const MailboxStudyOptions& options) {
    std::vector<model::MailboxOptions> all{{}};
    if (splits == SplitKind::Object) return all;
    for (const std::uint32_t entries : options.entries) all.push_back({MailboxKind::Recent, entries});
    all.push_back({MailboxKind::Hashed, hashed_entries});
    all.push_back({MailboxKind::PerPair, 0});
    return all;
}

class SceneMailboxStudy {
  public:
    SceneMailboxStudy(const MailboxStudyOptions& options, const SceneSource& source, MailboxReport& report)
        : options_(options), source_(source), report_(report), loaded_(load_scene(source)) {}

    void run() {
        for (const model::PairingMethod pairing : options_.pairings) {
            for (const SplitKind splits : {SplitKind::Object, SplitKind::Spatial}) run_tree(pairing, splits);
        }
    }

  private:
    void tell(const std::string& phase) const {
        if (options_.progress) options_.progress(source_.name(), phase);
    }

    void run_tree(model::PairingMethod pairing, SplitKind splits) {
        tell(fmt::format("{}: building", to_string(pairing)));
        sim::Config config = options_.config;
        config.bvh.splits = splits;
        const BuiltScene built =
            build_scene(loaded_.mesh, pairing, model::EdgeIdentity::Position, config.bvh);
        for (const model::WorkloadKind kind : options_.workloads) {
            const model::Workload& rays = workload(kind, built.image);
            for (const model::MailboxOptions& mailbox : mailboxes_for(splits, options_)) {
                config.rtu.mailbox = mailbox;
                tell(fmt::format("{}, {}, {}", to_string(pairing), rays.name, mailbox_name(mailbox)));
                report_.rows.push_back(measured(config, built, rays));
            }
        }
    }

    // The rays depend on the hits only, and so on no tree.
    const model::Workload& workload(model::WorkloadKind kind, const model::MemoryImage& image) {
        auto& made = workloads_[kind];
        if (!made) {
            if (!camera_) camera_ = choose_camera(loaded_.mesh, image, source_, options_.camera_file);
            made =
                make_workload(kind, loaded_.mesh, image, camera_->camera, options_.resolution, options_.seed);
        }
        return *made;
    }

    MailboxRow measured(const sim::Config& config, const BuiltScene& built, const model::Workload& rays) {
        const sim::MachineResult result = sim::simulate(config, built.image, rays.rays, rays.ray_kind);
        check_hits(rays, result);
        const AreaTotal area = total(rtu_area(config));
        MailboxRow row{.scene = source_.name(),
                       .workload = rays.name,
                       .pairing = built.pairing.method,
                       .splits = config.bvh.splits,
                       .mailbox = config.rtu.mailbox,
                       .image_bytes = built.image.size_bytes(),
                       .rays = result.ray_count,
                       .cycles = result.cycles,
                       .box_tests = result.counts.box_tests,
                       .pair_tests = result.counts.pair_tests,
                       .duplicate_tests = result.counts.duplicate_tests,
                       .lookups = scheduler_counter(result, "mailbox_lookups"),
                       .mailbox_hits = result.counts.mailbox_hits,
                       .bytes_saved = scheduler_counter(result, "mailbox_bytes_saved"),
                       .bytes_moved = scheduler_counter(result, "mailbox_bytes_read") +
                                      scheduler_counter(result, "mailbox_bytes_written"),
                       .mrps = mrps(result.ray_count, result.cycles, config.clock_mhz),
                       .gates = area.gates.gates * config.rtu.count,
                       .sram_bits = area.sram_bits * config.rtu.count};
        row.extra_leaf_percent = 100 * double(built.image.reference_count - built.image.pair_count) /
                                 double(built.image.pair_count);
        if (rays.ray_kind == model::RayKind::AnyHit) add_reports(row, built.image, rays);
        return row;
    }

    // A closest hit is the same whatever the tree, and so is whether there is any.
    void check_hits(const model::Workload& rays, const sim::MachineResult& result) {
        auto& expected = hits_[rays.name];
        if (expected.empty()) expected = result.hits;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const bool is_same = rays.ray_kind == model::RayKind::AnyHit
                                     ? expected[i].has_value() == result.hits[i].has_value()
                                     : expected[i] == result.hits[i];
            RTU_CHECK(is_same, "{}: ray {} of '{}' hits something else in another tree or with a mailbox",
                      source_.name(), i, rays.name);
        }
    }

    static void add_reports(MailboxRow& row, const model::MemoryImage& image, const model::Workload& rays) {
        for (std::size_t i = 0; i < rays.rays.size(); i += all_hits_stride) {
            const model::AllHits all =
                find_all_hits(image, rays.rays[i], row.mailbox, model::DuplicateRule::Allowed);
            row.all_hits += all.hits.size() - all.duplicates;
            row.reported_twice += all.duplicates;
        }
    }

    const MailboxStudyOptions& options_;
    const SceneSource& source_;
    MailboxReport& report_;
    LoadedScene loaded_;
    std::optional<ChosenCamera> camera_;
    std::map<model::WorkloadKind, std::optional<model::Workload>> workloads_;
    std::map<std::string, std::vector<std::optional<model::Hit>>> hits_;
};

}  // namespace

std::string mailbox_name(const model::MailboxOptions& mailbox) {
    if (!mailbox.is_on()) return "none";
    if (mailbox.kind == MailboxKind::PerPair) return "per_pair";
    return fmt::format("{} {}", mailbox.kind == MailboxKind::Recent ? "recent" : "hashed", mailbox.entries);
}

MailboxReport run_mailbox_study(const MailboxStudyOptions& options) {
    MailboxReport report;
    report.version = version();
    report.seed = options.seed;
    report.clock_mhz = options.config.clock_mhz;
    report.split_budget_percent = options.config.bvh.split_budget_percent;
    for (const SceneSource& source : options.scenes) SceneMailboxStudy(options, source, report).run();
    return report;
}

}  // namespace rtu::study
