#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/pairing.hpp"
#include "model/pairing_prescan.hpp"
#include "study/pairing/pairing_options.hpp"
#include "study/pairing/pairing_paper.hpp"
#include "study/pairing/pairing_run.hpp"

namespace rtu::study {

/// One pairing compared with the baseline, on the same rays and machine.
struct PairingRow {
    std::string scene;
    std::string method;
    std::string baseline;
    PairingRun before;                        ///< with the baseline
    PairingRun after;                         ///< with the method
    const PublishedRow* published = nullptr;  ///< of this scene, method and baseline in [AF], or none
    MeshIdentity mesh;                        ///< only with `published`
    std::optional<model::CompressionCost> compression;  ///< of edge_bbsa_compressed, in the comparison itself
};

/// (after - before) / before in percent; 0 for two zeros, nothing for a change from zero.
[[nodiscard]] std::optional<double> change_percent(double before, double after);

/// One column of the comparison: a number of a row, and what it is called.
struct PairingColumn {
    std::string_view key;     ///< in JSON and CSV
    std::string_view header;  ///< of a text table, two lines
    bool is_change = false;   ///< a change in percent, written with its sign
    bool is_host_time = false;
    std::optional<double> (*value)(const PairingRow&) = nullptr;
};

/// Every column, those of the table in [AF] first and in its order.
[[nodiscard]] std::span<const PairingColumn> pairing_columns();
/// Throws std::logic_error for a key that is none.
[[nodiscard]] const PairingColumn& pairing_column(std::string_view key);

/// The arithmetic mean of a column over the rows of one method that have a value; nothing when none has.
[[nodiscard]] std::optional<double> average(std::span<const PairingRow> rows, std::string_view method,
                                            const PairingColumn& column);

/// One row of a study: where on its axis, and what came out.
struct PairingPoint {
    std::string setting;      ///< as shown, with its unit
    std::optional<double> x;  ///< on a numeric axis; nothing for a name, or for a method without a number
    PairingRow row;
};

/// A study's rows: scene by scene, then method by method, then along the axis.
struct PairingStudyTable {
    PairingStudyKind kind = PairingStudyKind::Window;
    std::vector<PairingPoint> points;
};

/// A scene that was measured.
struct PairingScene {
    SceneFacts facts;
    std::string input_hash;
    model::Camera camera;  ///< before the rotation
    std::string camera_source;
    model::PairingPrescan prescan;  ///< whether [AF] would run its pairing at all
};

/// Everything that a comparison reports. Deterministic outside the columns of host time.
struct PairingReport {
    std::string version;
    std::string preset;
    std::string config_hash;
    std::vector<ConfigEntry> config;
    std::uint32_t clock_mhz = 0;
    std::uint64_t seed = 0;
    model::Resolution resolution;
    std::vector<std::string> workloads;
    std::string edge_identity;
    std::string baseline;
    std::vector<std::string> methods;
    RotationDegrees rotation{};
    std::vector<PairingScene> scenes;
    std::vector<PairingRow> rows;  ///< scene by scene, then method by method
    std::vector<PairingStudyTable> studies;
};

}  // namespace rtu::study
