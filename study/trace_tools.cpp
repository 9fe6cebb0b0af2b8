#include "study/trace_tools.hpp"

#include <fmt/format.h>

#include "model/error.hpp"
#include "model/fingerprint.hpp"
#include "study/ray_origin.hpp"
#include "study/scene_steps.hpp"
#include "study/text_table.hpp"
#include "traces/trace_writer.hpp"
#include "traces/visit_recorder.hpp"

namespace rtu::study {
namespace {

using traces::TraceContent;
using traces::WorkloadCount;

std::uint64_t sum(const std::vector<WorkloadCount>& workloads) {
    std::uint64_t rays = 0;
    for (const WorkloadCount& workload : workloads) rays += workload.ray_count;
    return rays;
}

std::string picture_text(const traces::PictureFacts& picture) {
    const model::Camera& c = picture.camera;
    return fmt::format(
        "{} x {} pixels, seed {}, camera {}: eye ({:.4g}, {:.4g}, {:.4g}), target ({:.4g}, {:.4g}, {:.4g})",
        picture.resolution.width, picture.resolution.height, picture.seed, picture.camera_source, c.eye.x,
        c.eye.y, c.eye.z, c.target.x, c.target.y, c.target.z);
}

}  // namespace

std::vector<WorkloadCount> record_trace(const RunOptions& options, const SceneSource& source,
                                        const std::filesystem::path& output, TraceContent content) {
    const std::unique_ptr<PreparedScene> scene = prepare_scene(options, source);
    const std::shared_ptr<traces::RayReader> rays = make_ray_reader(options, *scene);
    traces::TraceWriter writer(output, trace_header(*scene, content));
    while (const std::optional<traces::RayChunk> chunk = rays->next()) {
        if (options.progress) {
            options.progress(fmt::format("{}: {:.0f} % of all rays", chunk->workload, rays->share() * 100));
        }
        if (content == TraceContent::Rays) {
            writer.add(*chunk);
            continue;
        }
        for (const traces::VisitChunk& visits : record_visits(*chunk, scene->built.image)) writer.add(visits);
    }
    writer.finish();
    return writer.counts();
}

std::vector<WorkloadCount> convert_rays(const Conversion& conversion) {
    const RayInput& input = conversion.input;
    const auto rays = traces::open_rays(input.file, input.format, input.import);
    traces::TraceHeader header = rays->header();
    if (conversion.scene) {
        header.scene_hash = model::fingerprint(load_scene(*conversion.scene).mesh);
        header.scene_name = conversion.scene->name();
    }
    const auto output = traces::create_rays(conversion.output, conversion.output_format, header);
    traces::WorkloadTally tally;
    while (std::optional<traces::RayChunk> chunk = rays->next()) {
        if (conversion.only_workload && *conversion.only_workload != chunk->workload) continue;
        tally.add(chunk->workload, chunk->kind, chunk->first_ray, chunk->rays.size());
        output->add(*chunk);
    }
    if (tally.counts().empty()) {
        throw Error("{}: expected rays{}, found none", input.file.string(),
                    conversion.only_workload ? " of workload '" + *conversion.only_workload + "'" : "");
    }
    output->finish();
    return tally.counts();
}

std::string total_rays(const std::vector<WorkloadCount>& workloads) {
    const std::uint64_t rays = sum(workloads);
    return rays == 1 ? "1 ray" : grouped(rays) + " rays";
}

std::string workload_counts(const std::vector<WorkloadCount>& workloads) {
    TextTable table(
        {{"Workload", TextTable::Align::Left}, {"Hits asked for", TextTable::Align::Left}, {"Rays"}});
    for (const WorkloadCount& workload : workloads) {
        table.add_row(
            {workload.name, std::string(traces::to_string(workload.kind)), grouped(workload.ray_count)});
    }
    table.add_rule();
    table.add_row({"total", "", grouped(sum(workloads))});
    return table.text();
}

std::string describe_trace(const traces::TraceSurvey& survey, const std::string& file) {
    const traces::TraceHeader& header = survey.header;
    std::string out = file + "\n";
    const auto line = [&out](std::string_view label, const std::string& value) {
        out += fmt::format("  {:<10}{}\n", label, value);
    };
    line("Content", header.content == TraceContent::Rays ? "rays" : "traversals: visited nodes and leaves");
    line("Generator", header.generator);
    line("Scene", header.scene_hash
                      ? fmt::format("{}, hash {}", header.scene_name, model::hex_digits(*header.scene_hash))
                      : "any: made for no scene");
    if (header.picture) line("Picture", picture_text(*header.picture));
    if (header.image) {
        line("Image", fmt::format("{} in memory, {}, fingerprint {}", byte_size(header.image->size_bytes),
                                  header.image_text, model::hex_digits(header.image->fingerprint)));
    }
    const std::uint64_t rays = sum(survey.workloads);
    line("File", fmt::format("{} in {} blocks{}", byte_size(survey.size_bytes), grouped(survey.block_count),
                             rays == 0 ? ""
                                       : fmt::format(", {} bytes a ray",
                                                     fixed(double(survey.size_bytes) / double(rays), 1))));
    return out + "\n" + workload_counts(survey.workloads);
}

}  // namespace rtu::study
