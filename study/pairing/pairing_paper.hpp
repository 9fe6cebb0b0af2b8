#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rtu::study {

/// One row of the results table of [AF]: A. Aman, S. Fenney, "Fast Triangle Pairing for Ray Tracing",
/// Imagination Technologies. Old: window:2. New: edge_bbsa. Its camera, rays and machine are not published.
struct PublishedRow {
    std::string_view scene;
    std::optional<double> seconds;  ///< of pairing; nothing where their pre-scan left the pairing out
    double old_paired_percent = 0;
    double new_paired_percent = 0;
    double delta_box_percent = 0;
    double delta_tri_percent = 0;  ///< "Tri Tests" of the paper are pair tests
    double delta_mrps_percent = 0;
};

/// The whole table, in the paper's order.
[[nodiscard]] std::span<const PublishedRow> published_rows();

/// The published row of the scene of that name, or nothing.
[[nodiscard]] const PublishedRow* find_published(std::string_view scene);

/// What is known about a mesh of a published name: whether it is the one of [AF].
struct MeshIdentity {
    bool is_papers_mesh = false;
    std::string_view note;  ///< why, in one line
};

/// Judged by name and triangle count: [AF] publishes neither, so it rests on the percentages that agree.
[[nodiscard]] MeshIdentity mesh_identity(std::string_view scene, std::uint64_t triangle_count);

}  // namespace rtu::study
