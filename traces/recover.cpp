#include "traces/recover.hpp"

#include <algorithm>
#include <string_view>

#include "model/error.hpp"
#include "model/regular_file.hpp"
#include "traces/block.hpp"
#include "traces/trace_reader.hpp"
#include "traces/trace_writer.hpp"

namespace rtu::traces {
namespace {

namespace fs = std::filesystem;

// A block whose checksums are right.
struct FoundBlock {
    std::uint64_t offset = 0;
    BlockFrame frame;
};

// Finds blocks anywhere in a file.
class Scanner {
  public:
    explicit Scanner(const fs::path& path) : file_(path) {}

    std::vector<FoundBlock> blocks() {
        std::vector<FoundBlock> found;
        std::uint64_t offset = 0;
        while (const std::optional<std::uint64_t> candidate = find_magic(offset)) {
            if (const std::optional<FoundBlock> block = block_at(*candidate)) {
                found.push_back(*block);
                offset = *candidate + frame_bytes + block->frame.stored_bytes;
            } else {
                offset = *candidate + 1;
            }
        }
        return found;
    }
    std::string payload(const FoundBlock& block) {
        return decode_payload(block.frame, bytes(block.offset + frame_bytes, block.frame.stored_bytes));
    }

  private:
    static constexpr std::uint64_t window_bytes = 1 << 16;

    std::string bytes(std::uint64_t offset, std::uint64_t size) {
        std::string result(size, '\0');
        file_.seek(offset);
        file_.read(result.data(), size);
        return result;
    }
    std::optional<std::uint64_t> find_magic(std::uint64_t offset) {
        while (file_.size_bytes() >= offset + frame_bytes) {
            const std::string window = bytes(offset, std::min(window_bytes, file_.size_bytes() - offset));
            const std::size_t at = window.find(frame_magic);
            if (at != std::string::npos) return offset + at;
            offset += window.size() - (frame_magic.size() - 1);  // it may lie across the windows' border
        }
        return std::nullopt;
    }
    std::optional<FoundBlock> block_at(std::uint64_t offset) {
        try {
            if (file_.size_bytes() - offset < frame_bytes) return std::nullopt;
            const FoundBlock block{offset, decode_frame(bytes(offset, frame_bytes))};
            if (file_.size_bytes() - offset - frame_bytes < block.frame.stored_bytes) return std::nullopt;
            static_cast<void>(payload(block));
            return block;
        } catch (const Error&) {
            return std::nullopt;  // not a block, or a damaged one
        }
    }

    model::RegularFile file_;
};

// The header, from the block of that name or from the end; and what the end promises.
struct Facts {
    std::optional<TraceHeader> header;
    std::optional<std::vector<WorkloadCount>> expected;
};

Facts find_facts(Scanner& scanner, const std::vector<FoundBlock>& blocks) {
    Facts facts;
    for (const FoundBlock& block : blocks) {
        if (block.frame.kind == BlockKind::Header && !facts.header) {
            facts.header = decode_header(scanner.payload(block));
        } else if (block.frame.kind == BlockKind::End) {
            const TraceEnd end = decode_end(scanner.payload(block));
            if (!facts.header) facts.header = end.header;
            facts.expected = end.workloads;
        }
    }
    return facts;
}

std::uint64_t rays_so_far(const TraceWriter& writer, const std::string& workload) {
    const auto& counts = writer.counts();
    return !counts.empty() && counts.back().name == workload ? counts.back().ray_count : 0;
}

TraceSurvey survey(TraceReader& reader) {
    TraceSurvey result{reader.header(), {}, 0, 0, {}};
    try {
        if (reader.header().content == TraceContent::Rays) {
            while (reader.next_rays()) continue;
        } else {
            while (reader.next_visits()) continue;
        }
    } catch (const Error& error) {
        result.fault = error.what();
    }
    result.workloads = reader.counts();
    result.block_count = reader.block_count();
    return result;
}

}  // namespace

TraceSurvey survey_trace(const fs::path& path) {
    TraceReader reader(path);
    TraceSurvey result = survey(reader);
    result.size_bytes = model::RegularFile(path).size_bytes();
    return result;
}

Recovery recover_trace(const fs::path& path, const fs::path& output) {
    Scanner scanner(path);
    const std::vector<FoundBlock> blocks = scanner.blocks();
    Facts facts = find_facts(scanner, blocks);
    const auto has = [&](BlockKind kind) {
        return std::any_of(blocks.begin(), blocks.end(), [&](const auto& b) { return b.frame.kind == kind; });
    };
    if (!has(BlockKind::Rays) && !has(BlockKind::Visits)) {
        throw Error("{}: expected a trace with at least one whole chunk, found none", path.string());
    }
    if (!facts.header && !has(BlockKind::Rays)) {
        throw Error("{}: neither header nor end is left, which a traversal trace needs", path.string());
    }
    Recovery recovery{{}, facts.expected, facts.header.has_value()};
    TraceHeader header = facts.header.value_or(header_of_rays("unknown"));
    header.generator += ", recovered";
    TraceWriter writer(output, header, ".recovered.partial");  // FILE.partial may be what is read
    for (const FoundBlock& block : blocks) {
        if (block.frame.kind == BlockKind::Rays && header.content == TraceContent::Rays) {
            writer.add(decode_ray_chunk(scanner.payload(block)));
        } else if (block.frame.kind == BlockKind::Visits && header.content == TraceContent::Visits) {
            VisitChunk chunk = decode_visit_chunk(scanner.payload(block), *header.image);
            chunk.first_ray = rays_so_far(writer, chunk.workload);
            writer.add(chunk);
        }
    }
    writer.finish();
    recovery.workloads = writer.counts();
    return recovery;
}

}  // namespace rtu::traces
