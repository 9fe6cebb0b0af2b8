#pragma once

#include <cstddef>
#include <cstdint>

namespace rtu::sim {

/// A read or write on its way to memory. [address, address + size_bytes) may span several lines at an L1's
/// input; below an L1 it lies within one line and covers whole sectors.
struct MemoryRequest {
    std::uint64_t address = 0;
    std::uint32_t size_bytes = 0;
    std::uint32_t tag = 0;    ///< the requester's own; comes back with the reply
    std::uint8_t source = 0;  ///< which of the memory's clients asks; picks the reply channel
    bool is_write = false;    ///< writes are posted: no reply
    friend bool operator==(const MemoryRequest&, const MemoryRequest&) = default;
};

/// The data of a read has arrived.
struct MemoryReply {
    std::uint64_t address = 0;
    std::uint32_t tag = 0;
    friend bool operator==(const MemoryReply&, const MemoryReply&) = default;
};

/// Entries of the channel that carries requests to the last level of memory: several misses and write-backs
/// of a cycle. Assumed.
inline constexpr std::size_t memory_request_depth = 8;
/// Entries of the channel that carries a flat memory's replies to an L1; the memory keeps the others.
/// Assumed.
inline constexpr std::size_t flat_fill_depth = 4;

}  // namespace rtu::sim
