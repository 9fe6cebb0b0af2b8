#include "model/weld.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <vector>

#include "model/distribute.hpp"
#include "model/error.hpp"

namespace rtu::model {
namespace {

using PositionBits = std::array<std::uint32_t, 3>;

struct VertexRecord {
    PositionBits position;
    std::uint32_t vertex;
};

/// Multiply and fold. Every input bit reaches the top bits of the product.
std::uint64_t hash(const PositionBits& p) {
    std::uint64_t h = p[0] * 0x9e37'79b9'7f4a'7c15ULL;
    h = ((h >> 32) ^ h ^ p[1]) * 0xd6e8'feb8'6659'fd93ULL;
    return ((h >> 32) ^ h ^ p[2]) * 0xca5a'8263'9512'1157ULL;
}

/// Inline, unlike the library's comparison of arrays.
bool is_equal(const PositionBits& p, const PositionBits& q) {
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

/// The top bits of a hash, from 0 to 63 of them.
std::size_t top_bits(std::uint64_t h, std::uint32_t bits) { return h >> 1 >> (63 - bits); }

/// Welds vertices in ascending order whose hashes have their top `used_bits` in common.
class Welder {
  public:
    explicit Welder(std::uint32_t used_bits) : used_bits_(used_bits) {}

    void weld(std::span<const VertexRecord> vertices, std::span<std::uint32_t> first) {
        // Open addressing at a load of at most one half. A slot holds 0 when free, else an index + 1.
        const auto bits = std::uint32_t(std::bit_width(2 * std::max<std::size_t>(vertices.size(), 1) - 1));
        const std::size_t mask = (std::size_t{1} << bits) - 1;
        slots_.assign(mask + 1, 0U);
        const std::span<std::uint32_t> slots = slots_;
        const std::uint32_t used_bits = used_bits_;
        for (std::uint32_t i = 0; i < vertices.size(); ++i) {
            const auto& [position, vertex] = vertices[i];
            std::size_t slot = top_bits(hash(position) << used_bits, bits);
            while (slots[slot] != 0 && !is_equal(vertices[slots[slot] - 1].position, position)) {
                slot = (slot + 1) & mask;
            }
            if (slots[slot] == 0) slots[slot] = i + 1;
            first[vertex] = vertices[slots[slot] - 1].vertex;
        }
    }

  private:
    std::uint32_t used_bits_;
    std::vector<std::uint32_t> slots_;
};

}  // namespace

std::span<std::uint32_t> weld_positions(std::span<const Vec3> positions, ScratchMemory& memory) {
    RTU_CHECK(positions.size() < std::numeric_limits<std::uint32_t>::max(), "{} vertices", positions.size());
    // By the top bits of the hash into parts whose records and slots fit the second-level cache.
    constexpr std::size_t part_size = 8192;
    constexpr std::uint32_t most_part_bits = 11;
    const std::uint32_t part_bits =
        std::min(std::uint32_t(std::bit_width(positions.size() / part_size)), most_part_bits);
    const auto first = memory.take<std::uint32_t>(positions.size());
    const ScratchMemory::Scope scope(memory);
    const auto records = memory.take<VertexRecord>(positions.size());
    const auto generate = [&](std::size_t begin, std::size_t end, const auto& visit) {
        const std::uint32_t bits = part_bits;  // a copy that no write can change
        for (auto vertex = std::uint32_t(begin); vertex < end; ++vertex) {
            const auto position = std::bit_cast<PositionBits>(positions[vertex]);
            visit(std::uint32_t(top_bits(hash(position), bits)), VertexRecord{position, vertex});
        }
    };
    const auto begins = distribute(Blocks::of_items(positions.size()), 1U << part_bits, records, generate);
    Blocks::of_groups(begins.size() - 1)
        .for_each([&](std::size_t, std::size_t begin_part, std::size_t end_part) {
            Welder welder(part_bits);
            for (std::size_t part = begin_part; part < end_part; ++part) {
                welder.weld(records.subspan(begins[part], begins[part + 1] - begins[part]), first);
            }
        });
    return first;
}

}  // namespace rtu::model
