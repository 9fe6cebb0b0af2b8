#include "model/weld.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "model/error.hpp"

namespace rtu::model {
namespace {

using PositionBits = std::array<std::uint32_t, 3>;

/// Multiply and fold. The shift to `bits` bits takes the top of the product, which every input bit reaches.
std::size_t hash(const PositionBits& p, int bits) {
    std::uint64_t h = p[0] * 0x9e37'79b9'7f4a'7c15ULL;
    h = ((h >> 32) ^ h ^ p[1]) * 0xd6e8'feb8'6659'fd93ULL;
    h = ((h >> 32) ^ h ^ p[2]) * 0xca5a'8263'9512'1157ULL;
    return h >> (64 - bits);
}

}  // namespace

std::span<std::uint32_t> weld_positions(std::span<const Vec3> positions, ScratchMemory& memory) {
    RTU_CHECK(positions.size() < std::numeric_limits<std::uint32_t>::max(), "{} vertices", positions.size());
    // Open addressing at a load of at most one half. A slot holds 0 when free, else a vertex + 1.
    const int bits = int(std::bit_width(2 * std::max<std::size_t>(positions.size(), 1) - 1));
    const std::size_t mask = (std::size_t{1} << bits) - 1;
    const auto first = memory.take<std::uint32_t>(positions.size());
    const ScratchMemory::Scope scope(memory);
    const auto slots = memory.take<std::uint32_t>(mask + 1);
    std::ranges::fill(slots, 0U);
    for (std::uint32_t vertex = 0; vertex < positions.size(); ++vertex) {
        const auto key = std::bit_cast<PositionBits>(positions[vertex]);
        std::size_t slot = hash(key, bits);
        while (slots[slot] != 0 && std::bit_cast<PositionBits>(positions[slots[slot] - 1]) != key) {
            slot = (slot + 1) & mask;
        }
        if (slots[slot] == 0) slots[slot] = vertex + 1;
        first[vertex] = slots[slot] - 1;
    }
    return first;
}

}  // namespace rtu::model
