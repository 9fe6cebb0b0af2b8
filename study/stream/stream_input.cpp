#include "study/stream/stream_input.hpp"

#include <algorithm>
#include <utility>

#include "model/error.hpp"
#include "study/fidelity/spread_sample.hpp"
#include "study/scene_steps.hpp"

namespace rtu::study {
namespace {

// They tell these random numbers from those of workloads and other studies.
constexpr std::uint32_t ray_purpose = 18, pair_purpose = 19;

// The picture whose rays are sampled.
constexpr model::Resolution picture{256, 256};

const model::LeafPair& leaf_pair(const model::MemoryImage& image, std::size_t index) {
    const std::uint64_t leaves = image.node_count * image.node_bytes();
    return image.leaf_pair(model::NodeRef::leaf(leaves + index * model::image_block_bytes, 1), 0);
}

double percent(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }

}  // namespace

StreamInput make_stream_input(const StreamOptions& options) {
    const LoadedScene loaded = load_scene(options.scene);
    const BuiltScene built =
        build_scene(loaded.mesh, options.pairing, options.edge_identity, options.machines.front().config.bvh);
    const ChosenCamera camera = choose_camera(loaded.mesh, built.image, options.scene, options.camera_file);
    const model::Workload workload = model::make_workload(options.workload, loaded.mesh, built.image,
                                                          camera.camera, picture, options.seed);
    if (workload.rays.empty())
        throw Error("{}: no ray hits it, so it has no {} rays", loaded.facts.name, workload.name);
    StreamInput input{loaded.facts, loaded.input_hash, built.pairing, {}, {}};
    for (const std::size_t i :
         spread_sample(workload.rays.size(), options.ray_count, options.seed, ray_purpose))
        input.rays.push_back(workload.rays[i]);
    for (const std::size_t i :
         spread_sample(built.image.pair_count, options.pair_count, options.seed, pair_purpose))
        input.pairs.push_back(leaf_pair(built.image, i));
    return input;
}

sim::StreamJob StreamRunner::job(const LinkedMachine& machine, sim::StreamMode mode, sim::ReadBack read_back,
                                 std::uint64_t batch_tests) const {
    return {input_.rays, input_.pairs, mode, read_back, batch_tests, machine.config.link.buffer_bytes};
}

// Links that differ in nothing but speed share it.
std::uint64_t StreamRunner::alone_cycles(const LinkedMachine& machine, const sim::StreamJob& job) {
    const sim::Config::Link& link = machine.config.link;
    const auto [entry, is_new] = alone_.try_emplace(
        {job.mode, job.read_back, job.batch_tests, link.buffers, link.outstanding, job.buffer_bytes});
    if (is_new) {
        sim::Config config = machine.config;
        config.link.count = 0;
        entry->second = sim::simulate_stream(config, job).cycles;
    }
    return entry->second;
}

StreamRow StreamRunner::run(const LinkedMachine& machine, sim::StreamMode mode, sim::ReadBack read_back,
                            std::uint64_t batch_tests) {
    const sim::StreamJob job = this->job(machine, mode, read_back, batch_tests);
    const sim::Config& config = machine.config;
    StreamRow row;
    row.mode = to_string(mode);
    row.link = machine.link;
    row.read_back = to_string(read_back);
    row.batch_tests = batch_tests;
    row.ray_count = input_.rays.size();
    row.clock_mhz = config.clock_mhz;
    row.tester_count = std::uint64_t(config.rtu.count) * config.rtu.pair.testers;
    row.result = sim::simulate_stream(config, job);
    RTU_CHECK(!hits_ || *hits_ == row.result.hits, "{} over {}: the hits differ from those of other streams",
              row.mode, row.link);
    hits_ = std::exchange(row.result.hits, {});
    row.alone_cycles = alone_cycles(machine, job);
    if (config.link.count > 0) {
        const auto cycles = double(row.result.cycles), mhz = double(config.clock_mhz);
        row.up_percent =
            percent(double(row.result.link.up_bytes) * mhz / config.link.up_mb_per_second, cycles);
        row.down_percent =
            percent(double(row.result.link.down_bytes) * mhz / config.link.down_mb_per_second, cycles);
        row.host_percent = percent(double(row.result.link.overhead_cycles), cycles);
    }
    return row;
}

std::uint64_t StreamRunner::hit_count() const {
    if (!hits_) return 0;
    return std::uint64_t(std::ranges::count_if(*hits_, [](const auto& hit) { return hit.has_value(); }));
}

}  // namespace rtu::study
