#include "study/ray_origin.hpp"

#include <fmt/format.h>

#include "model/error.hpp"
#include "model/fingerprint.hpp"
#include "study/version.hpp"
#include "traces/generated_rays.hpp"
#include "traces/visit_recorder.hpp"

namespace rtu::study {
namespace {

SceneReport described(const RunOptions& options) {
    SceneReport scene;
    scene.version = version();
    scene.preset = options.preset;
    scene.seed = options.seed;
    scene.resolution = options.resolution;
    scene.clock_mhz = options.config.clock_mhz;
    scene.config = config_entries(options.config);
    return scene;
}

std::string image_text(const SceneReport& report) {
    const bool is_split = report.bvh.extra_leaf_count > 0;
    return fmt::format("pairing {} by {}, tree {} wide{}{}", report.pairing.method,
                       report.pairing.edge_identity, report.bvh.width,
                       report.bvh.node_format == "full" ? "" : ", " + report.bvh.node_format,
                       is_split ? ", spatial splits" : "");
}

// The header of the file of rays; one that says little for a file that is no trace.
traces::TraceHeader read_header(const RayInput& input) {
    if (input.format == traces::RayFormat::Trace) return traces::TraceReader(input.file).header();
    return traces::open_rays(input.file, input.format, input.import)->header();
}

void check_scene(const traces::TraceHeader& header, const RayInput& input, const PreparedScene& scene) {
    const std::uint64_t hash = model::fingerprint(scene.loaded.mesh);
    if (!input.is_forced && header.scene_hash && *header.scene_hash != hash) {
        throw Error(
            "{}: recorded on scene '{}' with hash {}, this is '{}' with hash {} (--force ignores that)",
            input.file.string(), header.scene_name, model::hex_digits(*header.scene_hash),
            scene.report.scene.name, model::hex_digits(hash));
    }
    if (header.image && *header.image != traces::image_facts(scene.built.image)) {
        throw Error("{}: recorded on another memory image, of {}; this is of {}", input.file.string(),
                    header.image_text, image_text(scene.report));
    }
}

// What a run with this file cannot do, before anything is loaded.
void check_wishes(const traces::TraceHeader& header, const RunOptions& options) {
    const std::string file = options.rays->file.string();
    if (options.is_checked && header.content == traces::TraceContent::Visits) {
        throw Error("{}: --check needs rays, and a traversal trace has none", file);
    }
    if (options.wants_pixels && !header.picture) {
        throw Error("{}: --image needs a camera, and these rays come without", file);
    }
}

void take_picture(const traces::TraceHeader& header, SceneReport& report) {
    const traces::PictureFacts picture = header.picture.value_or(traces::PictureFacts{{0, 0}, {}, "none", 0});
    report.resolution = picture.resolution;
    report.camera = picture.camera;
    report.camera_source = picture.camera_source;
    report.seed = picture.seed;
}

}  // namespace

std::unique_ptr<PreparedScene> prepare_scene(const RunOptions& options, const SceneSource& source) {
    auto scene = std::make_unique<PreparedScene>();
    SceneReport& report = scene->report = described(options);
    std::optional<traces::TraceHeader> header;
    if (options.rays) {
        header = read_header(*options.rays);
        check_wishes(*header, options);
    }
    options.tell("loading " + source.name());
    scene->loaded = load_scene(source);
    const model::TriangleMesh& mesh = scene->loaded.mesh;
    report.scene = scene->loaded.facts;
    report.input_hash = scene->loaded.input_hash;
    options.tell("pairing and building the tree");
    scene->built = build_scene(mesh, options.pairing, options.edge_identity, options.config.bvh);
    report.pairing = scene->built.pairing;
    report.bvh = scene->built.bvh;
    if (header) {
        check_scene(*header, *options.rays, *scene);
        take_picture(*header, report);
        report.rays_file = options.rays->file.filename().string();
        return scene;
    }
    const ChosenCamera chosen = choose_camera(mesh, scene->built.image, source, options.camera_file);
    report.camera = chosen.camera;
    report.camera_source = chosen.source;
    return scene;
}

std::shared_ptr<traces::RayReader> make_ray_reader(const RunOptions& options, const PreparedScene& scene) {
    if (options.rays) {
        return traces::open_rays(options.rays->file, options.rays->format, options.rays->import);
    }
    const model::WorkloadSetting setting(scene.loaded.mesh, scene.built.image, scene.report.camera,
                                         options.resolution, options.seed);
    return std::make_shared<traces::GeneratedRays>(options.workloads, setting,
                                                   trace_header(scene, traces::TraceContent::Rays));
}

ChunkSource make_chunk_source(const RunOptions& options, const PreparedScene& scene) {
    if (options.rays && options.rays->format == traces::RayFormat::Trace) {
        auto reader = std::make_shared<traces::TraceReader>(options.rays->file);
        if (reader->header().content == traces::TraceContent::Visits) return chunks_of(reader);
    }
    return chunks_of(make_ray_reader(options, scene));
}

traces::TraceHeader trace_header(const PreparedScene& scene, traces::TraceContent content) {
    const SceneReport& report = scene.report;
    traces::TraceHeader header = traces::header_of_rays(fmt::format("rtusim {}", version()));
    header.content = content;
    header.scene_hash = model::fingerprint(scene.loaded.mesh);
    header.scene_name = report.scene.name;
    if (report.resolution.width > 0) {
        header.picture = {report.resolution, report.camera, report.camera_source, report.seed};
    }
    if (content == traces::TraceContent::Visits) {
        header.image = traces::image_facts(scene.built.image);
        header.image_text = image_text(report);
    }
    return header;
}

}  // namespace rtu::study
