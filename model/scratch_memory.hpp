#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

#include "model/error.hpp"
#include "model/huge_pages.hpp"

namespace rtu::model {

/// A stack of uninitialised arrays in one block. Short passes over large arrays spend as much time on the
/// first touch of fresh pages as on their work, so the passes of one computation share the same pages.
class ScratchMemory {
  public:
    /// Only what is touched takes memory, so a generous capacity costs nothing.
    explicit ScratchMemory(std::size_t capacity_bytes)
        : block_(static_cast<std::byte*>(allocate_array(capacity_bytes)), Free{capacity_bytes}),
          capacity_bytes_(capacity_bytes) {}

    /// An array of `count` indeterminate values, until the innermost scope ends. Throws std::logic_error
    /// beyond the capacity.
    template <class T>
    [[nodiscard]] std::span<T> take(std::size_t count) {
        static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
        static_assert(alignof(T) <= alignment);
        const std::size_t size_bytes = (count * sizeof(T) + alignment - 1) / alignment * alignment;
        RTU_CHECK(size_bytes <= capacity_bytes_ - used_bytes_, "scratch memory of {} bytes is full",
                  capacity_bytes_);
        std::byte* const begin = block_.get() + used_bytes_;
        used_bytes_ += size_bytes;
        return {reinterpret_cast<T*>(begin), count};
    }

    /// Gives back, at its end, what was taken since its beginning.
    class Scope {
      public:
        explicit Scope(ScratchMemory& memory) : memory_(memory), used_bytes_(memory.used_bytes_) {}
        ~Scope() { memory_.used_bytes_ = used_bytes_; }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

      private:
        ScratchMemory& memory_;
        std::size_t used_bytes_;
    };

  private:
    static constexpr std::size_t alignment = __STDCPP_DEFAULT_NEW_ALIGNMENT__;
    struct Free {
        std::size_t size_bytes;
        void operator()(std::byte* block) const { free_array(block, size_bytes); }
    };

    std::unique_ptr<std::byte[], Free> block_;
    std::size_t capacity_bytes_;
    std::size_t used_bytes_ = 0;
};

}  // namespace rtu::model
