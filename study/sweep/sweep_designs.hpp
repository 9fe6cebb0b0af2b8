#pragma once

#include <string>
#include <vector>

#include "study/sweep/sweep_file.hpp"

namespace rtu::study {

/// One machine with one way of pairing.
struct SweepDesign {
    std::string id;  ///< fingerprint of everything in it, 16 hex digits
    std::string preset;
    model::PairingMethod pairing;
    sim::Config config;
    std::vector<std::string> sets;  ///< KEY=VALUE of each key that differs from the preset
};

/// What a machine takes: all RTUs with their L1s, without the L2.
struct DesignArea {
    double mgates = 0;      ///< million NAND2 equivalents, as study/area counts them
    double sram_mbits = 0;  ///< million bits in arrays of memory cells, which are in no gate count
};
[[nodiscard]] DesignArea design_area(const sim::Config& config);

/// Every design of the grid presets x pairings x axes that meets all constraints, or the subset of them that
/// the file asks for; in the order of the grid, the last axis fastest. Designs that are equal come once.
/// Throws Error, with the file and line of a value of it, for a design that no machine can be; and when
/// nothing is left, there are more than a million, or a subset is not found.
[[nodiscard]] std::vector<SweepDesign> sweep_designs(const SweepFile& file);

/// The designs of the grid before constraints and subset; 2^64 - 1 for all that are more.
[[nodiscard]] std::uint64_t grid_size(const SweepFile& file);

}  // namespace rtu::study
