#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "traces/trace_header.hpp"

namespace rtu::traces {

/// What a trace holds, and whether all of it can be read.
struct TraceSurvey {
    TraceHeader header;
    std::vector<WorkloadCount> workloads;  ///< up to the fault
    std::uint64_t block_count = 0;         ///< up to the fault
    std::uint64_t size_bytes = 0;          ///< of the file
    std::optional<std::string> fault;      ///< the first: file, offset, expected and got
};

/// Reads a whole trace. Throws Error only when not even its header can be read.
[[nodiscard]] TraceSurvey survey_trace(const std::filesystem::path& path);

/// What was saved of a damaged trace.
struct Recovery {
    std::vector<WorkloadCount> workloads;
    /// What the damaged trace had, when its end block is left.
    std::optional<std::vector<WorkloadCount>> expected;
    bool has_header = true;  ///< false: neither header nor end was left, so the scene is not known
};

/// Writes every chunk of `path` that is whole, wherever it lies, to a new trace `output`; the rays of what is
/// lost are missing in it, and those behind move up. Reads the file twice, and keeps no chunk in memory.
/// Throws Error when there is no whole chunk, or none can be told of a traversal trace without any header.
Recovery recover_trace(const std::filesystem::path& path, const std::filesystem::path& output);

}  // namespace rtu::traces
