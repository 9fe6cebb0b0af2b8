#include "traces/trace_reader.hpp"

#include <algorithm>

#include "model/error.hpp"

namespace rtu::traces {

// Calls f; its errors get the file and the offset of the block under way.
template <class F>
auto TraceReader::at_block(F f) {
    try {
        return f();
    } catch (const Error& error) {
        throw Error("{}: byte {}: {}", path_.string(), block_offset_, error.what());
    }
}

TraceReader::TraceReader(const std::filesystem::path& path) : path_(path), file_(path) {
    at_block([&] {
        std::string bytes(std::min<std::uint64_t>(preamble_bytes, file_.size_bytes()), '\0');
        file_.read(bytes.data(), bytes.size());
        check_preamble(bytes);
        offset_ = preamble_bytes;
    });
    const Block block = read_block();
    at_block([&] {
        if (block.frame.kind != BlockKind::Header) throw Error("expected the header block");
        header_ = decode_header(block.payload);
    });
}

double TraceReader::share() const { return double(offset_) / double(file_.size_bytes()); }

TraceReader::Block TraceReader::read_block() {
    block_offset_ = offset_;
    return at_block([&] {
        const std::uint64_t left = file_.size_bytes() - offset_;
        if (left == 0) {
            throw Error(
                "expected another block, found the end of the file: an interrupted recording or an "
                "incomplete copy (`rtusim trace verify --recover` saves the blocks before)");
        }
        if (left < frame_bytes) throw Error("expected a frame of {} bytes, found {}", frame_bytes, left);
        std::string bytes(frame_bytes, '\0');
        file_.read(bytes.data(), bytes.size());
        Block block{decode_frame(bytes), {}};
        if (block.frame.index != block_count_) {
            throw Error("expected block {}, got block {}", block_count_, block.frame.index);
        }
        if (block.frame.stored_bytes > left - frame_bytes) {
            throw Error("expected a block of {} bytes, the file ends after {}", block.frame.stored_bytes,
                        left - frame_bytes);
        }
        bytes.resize(block.frame.stored_bytes);
        file_.read(bytes.data(), bytes.size());
        block.payload = decode_payload(block.frame, bytes);
        offset_ += frame_bytes + block.frame.stored_bytes;
        ++block_count_;
        return block;
    });
}

std::optional<std::string> TraceReader::next_chunk(TraceContent content) {
    if (header_.content != content) {
        throw Error("{}: expected a trace of {}", path_.string(),
                    content == TraceContent::Rays ? "rays, got one of visits" : "visits, got one of rays");
    }
    if (is_at_end_) return std::nullopt;
    Block block = read_block();
    return at_block([&]() -> std::optional<std::string> {
        if (block.frame.kind == BlockKind::End) {
            check_end(block.payload);
            return std::nullopt;
        }
        const BlockKind expected = content == TraceContent::Rays ? BlockKind::Rays : BlockKind::Visits;
        if (block.frame.kind != expected) throw Error("expected a chunk of the header's content");
        return std::move(block.payload);
    });
}

void TraceReader::check_end(const std::string& payload) {
    const TraceEnd end = decode_end(payload);
    if (encode(end.header) != encode(header_)) throw Error("expected the header once more, got another");
    if (end.block_count != block_count_) {
        throw Error("expected {} blocks, got {}", end.block_count, block_count_);
    }
    if (end.workloads.size() != counts().size()) {
        throw Error("expected {} workloads, got {}", end.workloads.size(), counts().size());
    }
    for (std::size_t i = 0; i < counts().size(); ++i) {
        if (end.workloads[i] == counts()[i]) continue;
        throw Error("expected {} rays of '{}', got {} of '{}'", end.workloads[i].ray_count,
                    end.workloads[i].name, counts()[i].ray_count, counts()[i].name);
    }
    block_offset_ = offset_;
    if (offset_ != file_.size_bytes()) {
        throw Error("expected the end of the file, found {} more bytes", file_.size_bytes() - offset_);
    }
    is_at_end_ = true;
}

std::optional<RayChunk> TraceReader::next_rays() {
    const std::optional<std::string> payload = next_chunk(TraceContent::Rays);
    if (!payload) return std::nullopt;
    return at_block([&] {
        RayChunk chunk = decode_ray_chunk(*payload);
        tally_.add(chunk.workload, chunk.kind, chunk.first_ray, chunk.rays.size());
        return chunk;
    });
}

std::optional<VisitChunk> TraceReader::next_visits() {
    const std::optional<std::string> payload = next_chunk(TraceContent::Visits);
    if (!payload) return std::nullopt;
    return at_block([&] {
        VisitChunk chunk = decode_visit_chunk(*payload, *header_.image);
        tally_.add(chunk.workload, chunk.kind, chunk.first_ray, chunk.rays.size());
        return chunk;
    });
}

bool is_trace(const std::filesystem::path& path) {
    try {
        model::RegularFile file(path);
        std::string bytes(std::min<std::uint64_t>(file.size_bytes(), 8), '\0');
        file.read(bytes.data(), bytes.size());
        return bytes == preamble().substr(0, 8);
    } catch (const Error&) {
        return false;
    }
}

}  // namespace rtu::traces
