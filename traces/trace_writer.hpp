#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "traces/block.hpp"
#include "traces/partial_file.hpp"
#include "traces/ray_chunk.hpp"
#include "traces/trace_header.hpp"
#include "traces/visit_chunk.hpp"

namespace rtu::traces {

/// Writes a trace chunk by chunk; the format is in traces/trace_reader.hpp. Every chunk is in the file before
/// the next is asked for: an interrupted recording loses what came after the last whole chunk. The bytes
/// depend on the header and the rays only, not on how they were handed over. Without finish() there is no
/// file, see PartialFile. All functions throw Error when the file cannot be written.
class TraceWriter {
  public:
    /// `partial_suffix`: see PartialFile.
    TraceWriter(const std::filesystem::path& path, TraceHeader header,
                std::string_view partial_suffix = ".partial");

    /// More rays; RayChunk::first_ray is not asked for. Requires a header of rays. Throws Error for a
    /// workload that comes again after another or changes its kind.
    void add(const RayChunk& chunk);
    /// More traversals, written as they come. Requires a header of visits.
    void add(const VisitChunk& chunk);
    /// Writes what is left and the end, and gives the file its name.
    void finish();

    [[nodiscard]] const std::vector<WorkloadCount>& counts() const { return tally_.counts(); }
    [[nodiscard]] std::uint64_t size_bytes() const { return file_.size_bytes(); }

  private:
    void write_block(BlockKind kind, std::string_view payload);
    void flush();

    PartialFile file_;
    TraceHeader header_;
    WorkloadTally tally_;
    std::uint64_t block_count_ = 0;
    RayChunk pending_;
    bool has_pending_ = false;
};

}  // namespace rtu::traces
