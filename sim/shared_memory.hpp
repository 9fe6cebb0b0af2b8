#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/config.hpp"
#include "sim/fifo.hpp"
#include "sim/machine.hpp"
#include "sim/memory_message.hpp"

namespace rtu::sim {

/// What lies below the L1s and is shared by all RTUs: L2 and DRAM, or a flat memory.
class SharedMemory {
  public:
    virtual ~SharedMemory() = default;

    /// Where RTU `index` sends its requests; to be connected before the machine runs.
    virtual void connect(std::size_t index, Fifo<MemoryRequest>& requests, PushIf<MemoryReply>& replies) = 0;
    /// Leaves in its cache, if it has one, what a read of `size_bytes` at `address` would, at no cost in
    /// cycles.
    virtual void warm(std::uint64_t address, std::uint32_t size_bytes) = 0;
    /// Line accesses so far that the L2 had to ask the DRAM for; 0 without an L2.
    [[nodiscard]] virtual std::uint64_t l2_misses() const = 0;
    /// The units, from the RTUs down.
    [[nodiscard]] virtual std::vector<UnitResult> results() const = 0;
    /// Throws std::logic_error unless every read was answered and every counter adds up.
    virtual void check_drained() const = 0;
};

/// The memory that `config` describes.
[[nodiscard]] std::unique_ptr<SharedMemory> make_shared_memory(const Config& config, ClockDomain& domain);

}  // namespace rtu::sim
