#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/pairing/pairing_bench.hpp"
#include "study/pairing/pairing_options.hpp"
#include "study/pairing/pairing_report.hpp"
#include "study/run_options.hpp"

namespace rtu::study {

/// What a study is called, and what its axis shows.
struct PairingStudyInfo {
    PairingStudyKind kind;
    std::string_view name;     ///< as on the command line
    std::string_view meaning;  ///< one line: what is varied
    std::string_view axis;     ///< label with its unit; empty for named settings
    bool is_logarithmic = false;
};

/// Every study, in the order of PairingStudyKind.
[[nodiscard]] std::span<const PairingStudyInfo> pairing_studies();
[[nodiscard]] const PairingStudyInfo& info(PairingStudyKind kind);
/// Throws Error, listing the known names, for anything else.
[[nodiscard]] PairingStudyKind parse_pairing_study(std::string_view name);

/// One place on a study's axis.
struct StudyPoint {
    std::string setting;      ///< as shown, with its unit
    std::optional<double> x;  ///< on a numeric axis
    PairingSetting under;
    std::optional<model::PairingMethod> method;  ///< study `window`: instead of the methods asked for
};

/// The places of a study, in order. Sizes that the other numbers of the machine do not allow are left out.
/// `camera` tells which way is up: the study `rotation` turns about the axis nearest to that.
[[nodiscard]] std::vector<StudyPoint> study_points(PairingStudyKind kind, const PairingOptions& options,
                                                   const model::Camera& camera);

/// Compares every method with the baseline on every scene, then runs the studies. `on_scene` (may be empty)
/// is told each scene's name before its work begins. Throws as run_scene() does.
[[nodiscard]] PairingReport run_pairing_studies(const PairingOptions& options,
                                                std::span<const SceneSource> scenes,
                                                const std::function<void(const std::string&)>& on_scene = {});

}  // namespace rtu::study
