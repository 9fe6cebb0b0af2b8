#include "traces/trace_writer.hpp"

#include <algorithm>
#include <utility>

#include "model/error.hpp"

namespace rtu::traces {
namespace {

// 576 KiB before compression: large enough for zstd, small enough to lose.
constexpr std::size_t rays_of_chunk = 1 << 14;

}  // namespace

TraceWriter::TraceWriter(const std::filesystem::path& path, TraceHeader header,
                         std::string_view partial_suffix)
    : file_(path, PartialFile::OnFullDisk::Keep, partial_suffix), header_(std::move(header)) {
    file_.write(preamble());
    write_block(BlockKind::Header, encode(header_));
}

void TraceWriter::write_block(BlockKind kind, std::string_view payload) {
    file_.write(encode_block(kind, block_count_, payload));
    ++block_count_;
}

void TraceWriter::flush() {
    if (!has_pending_) return;
    tally_.add(pending_.workload, pending_.kind, pending_.first_ray, pending_.rays.size());
    write_block(BlockKind::Rays, encode(pending_));
    has_pending_ = false;
}

void TraceWriter::add(const RayChunk& chunk) {
    RTU_CHECK(header_.content == TraceContent::Rays, "rays in a trace of visits");
    const bool is_same_workload = has_pending_ && pending_.workload == chunk.workload;
    if (!is_same_workload || pending_.kind != chunk.kind || pending_.id_kind != chunk.id_kind) {
        const std::uint64_t first = is_same_workload ? pending_.first_ray + pending_.rays.size() : 0;
        flush();
        pending_ = {chunk.workload, chunk.kind, chunk.id_kind, first, {}, {}};
        has_pending_ = true;
    }
    for (std::size_t i = 0; i < chunk.rays.size(); ++i) {
        if (pending_.rays.size() == rays_of_chunk) {
            flush();
            pending_.first_ray += pending_.rays.size();
            pending_.rays.clear();
            pending_.ids.clear();
            has_pending_ = true;
        }
        pending_.rays.push_back(chunk.rays[i]);
        if (chunk.id_kind != IdKind::None) pending_.ids.push_back(chunk.ids[i]);
    }
}

void TraceWriter::add(const VisitChunk& chunk) {
    RTU_CHECK(header_.content == TraceContent::Visits, "visits in a trace of rays");
    tally_.add(chunk.workload, chunk.kind, chunk.first_ray, chunk.rays.size());
    write_block(BlockKind::Visits, encode(chunk));
}

void TraceWriter::finish() {
    flush();
    write_block(BlockKind::End, encode(TraceEnd{header_, block_count_ + 1, tally_.counts()}));
    file_.commit();
}

}  // namespace rtu::traces
