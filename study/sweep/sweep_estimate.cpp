#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "model/error.hpp"
#include "study/sweep/sweep_memory.hpp"
#include "study/sweep/sweep_run.hpp"
#include "study/sweep/sweep_tree.hpp"

namespace rtu::study {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t sample_side = 128;  // pixels
constexpr std::size_t sample_designs = 3;

// A folder that is there as long as the object is.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "rtusim-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw Error("{}: cannot make a folder", name);
        path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code error;
        fs::remove_all(path_, error);
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

bool is_simulated(const SweepPoint& point) { return point.level == FidelityLevel::Cycle; }

double pixels(model::Resolution resolution) { return double(resolution.width) * resolution.height; }

}  // namespace

SweepEstimate estimate_sweep(const SweepPlan& plan, unsigned workers) {
    const TemporaryFolder folder;
    SweepEstimate estimate;
    const std::size_t designs = plan.designs.size();
    for (std::size_t scene = 0; scene < plan.scenes.size(); ++scene) {
        double seconds = 0;
        const std::size_t samples = std::min(designs, sample_designs);
        for (std::size_t i = 0; i < samples; ++i) {
            const SweepPoint& point = plan.points[scene * designs + (2 * i + 1) * designs / (2 * samples)];
            RunOptions options = run_options(plan, point);
            const double all = options.rays ? 1.0 : pixels(options.resolution);
            if (is_simulated(point)) {  // an estimate of few rays would take them all
                options.resolution = {std::min(options.resolution.width, sample_side),
                                      std::min(options.resolution.height, sample_side)};
            }
            const double share = options.rays ? 1.0 : pixels(options.resolution) / all;
            prepare_tree(options, plan.file.inputs[scene].scene, content_of(point), folder.path(),
                         point.tree);
            const SweepTree tree(folder.path(), point.tree);
            const SweepResult result = is_simulated(point)
                                           ? simulate_point(point.id, options.config, tree)
                                           : estimate_point(point.id, options.config, tree, point.level,
                                                            {plan.file.tolerance, options.seed});
            seconds += result.cpu_seconds / share;
            const std::uint64_t visits =
                tree_memory_bytes(folder.path(), point.tree) - tree.image().size_bytes();
            estimate.worker_bytes =
                std::max(estimate.worker_bytes, machine_bytes(options.config) + tree.image().size_bytes() +
                                                    std::uint64_t(double(visits) / share));
        }
        estimate.cpu_seconds += seconds / double(samples) * double(designs);
    }
    estimate.workers = worker_count(workers, plan.points.size(), estimate.worker_bytes);
    return estimate;
}

}  // namespace rtu::study
