#pragma once

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

}  // namespace rtu::sim
