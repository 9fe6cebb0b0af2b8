#include "study/pairing/pairing_study.hpp"

#include "study/version.hpp"

namespace rtu::study {
namespace {

// What [AF] published for this comparison; a turned scene is another one.
void add_published(PairingRow& row, const SceneFacts& scene, const PairingSetting& setting) {
    const bool is_papers_comparison =
        row.baseline == "window:2" && row.method == "edge_bbsa" && setting.rotation == RotationDegrees{};
    row.published = is_papers_comparison ? find_published(scene.name) : nullptr;
    if (row.published != nullptr) row.mesh = mesh_identity(scene.name, scene.triangle_count);
}

PairingRow compare(PairingBench& bench, const PairingOptions& options, model::PairingMethod method,
                   const PairingSetting& setting) {
    const SceneFacts& scene = bench.scene().facts;
    PairingRow row;
    row.scene = scene.name;
    row.method = to_string(method);
    row.baseline = to_string(options.baseline);
    row.before = bench.run(options.baseline, setting);
    row.after = bench.run(method, setting);
    add_published(row, scene, setting);
    return row;
}

void add_rows(PairingBench& bench, const PairingOptions& options, std::vector<PairingRow>& rows) {
    const PairingSetting setting{options.machine.config, options.rotation, options.workloads};
    for (const model::PairingMethod& method : options.methods) {
        rows.push_back(compare(bench, options, method, setting));
        if (method.kind != model::PairingKind::EdgeBbsaCompressed) continue;
        rows.back().compression = bench.compression_cost(setting.rotation);
    }
}

void add_study(PairingBench& bench, const PairingOptions& options, PairingStudyTable& table) {
    const std::vector<StudyPoint> points = study_points(table.kind, options, bench.camera().camera);
    // One image at a time: all of the baseline first, then method by method; what was measured is kept.
    for (const StudyPoint& point : points) static_cast<void>(bench.run(options.baseline, point.under));
    if (table.kind == PairingStudyKind::Window) {
        for (const StudyPoint& point : points) {
            table.points.push_back(
                {point.setting, point.x, compare(bench, options, point.method.value(), point.under)});
        }
        return;
    }
    for (const model::PairingMethod& method : options.methods) {
        for (const StudyPoint& point : points) {
            table.points.push_back({point.setting, point.x, compare(bench, options, method, point.under)});
        }
    }
}

PairingReport described(const PairingOptions& options) {
    PairingReport report;
    report.version = version();
    report.preset = options.preset;
    report.config = config_entries(options.machine.config);
    SceneReport for_hash;
    for_hash.config = report.config;
    report.config_hash = config_hash(for_hash);
    report.clock_mhz = options.machine.config.clock_mhz;
    report.seed = options.seed;
    report.resolution = options.resolution;
    for (const model::WorkloadKind kind : options.workloads) report.workloads.emplace_back(to_string(kind));
    report.edge_identity = to_string(options.edge_identity);
    report.baseline = to_string(options.baseline);
    for (const model::PairingMethod& method : options.methods) report.methods.push_back(to_string(method));
    report.rotation = options.rotation;
    for (const PairingStudyKind kind : options.studies) report.studies.push_back({kind, {}});
    return report;
}

}  // namespace

PairingReport run_pairing_studies(const PairingOptions& options, std::span<const SceneSource> scenes,
                                  const std::function<void(const std::string&)>& on_scene) {
    PairingReport report = described(options);
    for (const SceneSource& source : scenes) {
        if (on_scene) on_scene(source.name());
        PairingBench bench(options, source);
        add_rows(bench, options, report.rows);
        for (PairingStudyTable& table : report.studies) add_study(bench, options, table);
        const LoadedScene& scene = bench.scene();
        report.scenes.push_back({scene.facts, scene.input_hash, bench.camera().camera, bench.camera().source,
                                 model::prescan_pairing(scene.mesh, options.edge_identity)});
    }
    return report;
}

}  // namespace rtu::study
