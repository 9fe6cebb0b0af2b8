#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/report/page_content.hpp"
#include "study/report/run_report.hpp"

namespace rtu::study {

/// A result for the report page: runs, which all inputs share a section for, or a section of its own.
struct PageInput {
    std::string file;  ///< without folders
    std::string kind;  ///< the command that made it: "run", "pairing", ...
    std::vector<SceneReport> runs;
    std::optional<PageSection> section;  ///< only when there are no runs
};

/// Reads a result: JSON of run, pairing, fidelity, stability, methods, precision, area, validate, stream or
/// sweep, box tests of `run --image`, or a database of sweeps. It is known by its keys, never by its name.
/// Throws Error, naming the file, when it cannot be read or is none of these.
[[nodiscard]] PageInput load_page_input(const std::filesystem::path& path);

}  // namespace rtu::study
