#include "study/sweep/sweep_tree.hpp"

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "model/error.hpp"
#include "model/regular_file.hpp"
#include "study/output_file.hpp"
#include "study/ray_origin.hpp"
#include "traces/trace_writer.hpp"
#include "traces/visit_recorder.hpp"

namespace rtu::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path trace_path(const fs::path& folder, const std::string& name) { return folder / (name + ".rtutrace"); }
fs::path image_path(const fs::path& folder, const std::string& name) { return folder / (name + ".image"); }
fs::path facts_path(const fs::path& folder, const std::string& name) { return folder / (name + ".json"); }

// What the recorded traversals take in memory, as SweepTree has them.
std::uint64_t memory_bytes(const traces::VisitChunk& chunk) {
    return chunk.rays.size() * sizeof(traces::WalkedRay) + chunk.visits.size() * sizeof(traces::Visit) +
           chunk.pair_tests.size() * sizeof(traces::PairTest);
}

// Writes every chunk by `add`, which returns what it takes in memory.
template <class Add>
std::uint64_t write_trace(const RunOptions& options, const PreparedScene& scene, TreeContent content,
                          const fs::path& path, Add add) {
    std::error_code error;
    fs::remove(path.string() + ".partial", error);  // of a process that was killed
    const std::shared_ptr<traces::RayReader> rays = make_ray_reader(options, scene);
    const bool has_rays = content == TreeContent::Rays;
    traces::TraceHeader header =
        trace_header(scene, has_rays ? traces::TraceContent::Rays : traces::TraceContent::Visits);
    traces::TraceWriter writer(path, header);
    std::uint64_t bytes = 0;
    while (const std::optional<traces::RayChunk> chunk = rays->next()) bytes += add(writer, *chunk);
    writer.finish();
    if (writer.counts().empty()) throw Error("{}: expected rays, found none", options.rays->file.string());
    return bytes;
}

std::uint64_t record_traversals(const RunOptions& options, const PreparedScene& scene, const fs::path& path) {
    const auto add = [&](traces::TraceWriter& writer, const traces::RayChunk& chunk) {
        std::uint64_t bytes = 0;
        for (const traces::VisitChunk& visits : record_visits(chunk, scene.built.image)) {
            bytes += memory_bytes(visits);
            writer.add(visits);
        }
        return bytes;
    };
    return write_trace(options, scene, TreeContent::Traversals, path, add);
}

std::uint64_t record_rays(const RunOptions& options, const PreparedScene& scene, const fs::path& path) {
    const auto add = [](traces::TraceWriter& writer, const traces::RayChunk& chunk) {
        writer.add(chunk);
        return chunk.rays.size() * sizeof(model::Ray);
    };
    return write_trace(options, scene, TreeContent::Rays, path, add);
}

std::string image_bytes(const model::MemoryImage& image) {
    return {reinterpret_cast<const char*>(image.blocks.data()), image.size_bytes()};
}

void read_image(const fs::path& path, model::MemoryImage& image) {
    model::RegularFile file(path);
    if (file.size_bytes() != image.size_bytes())
        throw Error("{}: expected {} bytes, got {}", path.string(), image.size_bytes(), file.size_bytes());
    file.read(reinterpret_cast<char*>(image.blocks.data()), image.size_bytes());
}

bool is_visit_trace(const RunOptions& options) {
    if (!options.rays || options.rays->format != traces::RayFormat::Trace) return false;
    return traces::TraceReader(options.rays->file).header().content == traces::TraceContent::Visits;
}

std::uint64_t survey(const fs::path& path) {
    traces::TraceReader reader(path);
    std::uint64_t bytes = 0;
    while (const auto chunk = reader.next_visits()) bytes += memory_bytes(*chunk);
    return bytes;
}

Json read_facts(const fs::path& folder, const std::string& name) {
    const fs::path path = facts_path(folder, name);
    std::ifstream stream(path);
    Json facts = Json::parse(stream, nullptr, false);
    if (!facts.is_object()) throw Error("{}: expected what a sweep prepared", path.string());
    return facts;
}

}  // namespace

void prepare_tree(const RunOptions& options, const SceneSource& source, TreeContent content,
                  const fs::path& folder, const std::string& name) {
    if (fs::exists(facts_path(folder, name))) return;
    const bool has_rays = content == TreeContent::Rays;
    const bool is_recorded = is_visit_trace(options);
    if (is_recorded && has_rays) {
        throw Error("{}: a traversal trace has no rays, and an estimate needs them; use fidelity cycle",
                    options.rays->file.string());
    }
    const std::unique_ptr<PreparedScene> scene = prepare_scene(options, source);
    const fs::path trace = is_recorded ? fs::absolute(options.rays->file) : trace_path(folder, name);
    const std::uint64_t held_bytes = is_recorded ? survey(trace)
                                     : has_rays  ? record_rays(options, *scene, trace)
                                                 : record_traversals(options, *scene, trace);
    const model::MemoryImage& image = scene->built.image;
    std::vector<OutputFile> files;
    if (has_rays) files.push_back({image_path(folder, name), image_bytes(image)});
    const Json facts{{"trace", is_recorded ? trace.string() : trace.filename().string()},
                     {"has_rays", has_rays},
                     {"held_bytes", held_bytes},
                     {"width", image.width},
                     {"node_format", std::uint32_t(image.format)},
                     {"depth", image.depth},
                     {"bounds",
                      {image.bounds.lo.x, image.bounds.lo.y, image.bounds.lo.z, image.bounds.hi.x,
                       image.bounds.hi.y, image.bounds.hi.z}},
                     {"size_bytes", image.size_bytes()},
                     {"node_count", image.node_count},
                     {"leaf_count", image.leaf_count},
                     {"pair_count", image.pair_count},
                     {"reference_count", image.reference_count},
                     {"paired_percent", scene->report.pairing.paired_percent}};
    files.push_back(
        {facts_path(folder, name), facts.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"});
    write_files(files);
}

std::uint64_t tree_memory_bytes(const fs::path& folder, const std::string& name) {
    const Json facts = read_facts(folder, name);
    return facts.at("held_bytes").get<std::uint64_t>() + facts.at("size_bytes").get<std::uint64_t>();
}

SweepTree::SweepTree(const fs::path& folder, const std::string& name) {
    const Json facts = read_facts(folder, name);
    image_.width = facts.at("width");
    image_.format = model::NodeFormat(facts.at("node_format").get<std::uint32_t>());
    image_.depth = facts.at("depth");
    const auto bounds = facts.at("bounds").get<std::array<float, 6>>();
    image_.bounds = {{bounds[0], bounds[1], bounds[2]}, {bounds[3], bounds[4], bounds[5]}};
    image_.node_count = facts.at("node_count");
    image_.leaf_count = facts.at("leaf_count");
    image_.pair_count = facts.at("pair_count");
    image_.reference_count = facts.at("reference_count");
    image_.blocks.resize(facts.at("size_bytes").get<std::size_t>() / model::image_block_bytes);
    paired_percent_ = facts.at("paired_percent");
    const fs::path trace = folder / facts.at("trace").get<std::string>();
    if (facts.at("has_rays")) {
        read_image(image_path(folder, name), image_);
        populations_ = file_populations(*traces::open_rays(trace, traces::RayFormat::Trace, {}));
        return;
    }
    traces::TraceReader reader(trace);
    while (auto chunk = reader.next_visits()) {
        chunks_.push_back(std::make_shared<const traces::VisitChunk>(std::move(*chunk)));
    }
}

ChunkSource SweepTree::chunks() const {
    const auto next_chunk = std::make_shared<std::size_t>(0);
    const auto next = [this, next_chunk]() -> std::optional<WorkloadChunk> {
        if (*next_chunk == chunks_.size()) return std::nullopt;
        const auto& chunk = chunks_[(*next_chunk)++];
        return WorkloadChunk{chunk->workload, chunk->kind, {}, chunk};
    };
    return {next, [this, next_chunk] { return double(*next_chunk) / double(chunks_.size()); }};
}

}  // namespace rtu::study
