#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace rtu::model {

inline constexpr std::size_t huge_page_bytes = std::size_t{1} << 21;

/// Uninitialised memory for a large array. From huge_page_bytes on it asks for huge pages: those of 4 KiB
/// cost a fault each at their first touch, which takes longer than to fill them, and random accesses to tens
/// of MiB miss the address translation's cache. Where there are none the request does nothing. Only what is
/// touched takes memory.
[[nodiscard]] inline void* allocate_array(std::size_t size_bytes) {
    if (size_bytes < huge_page_bytes) return ::operator new(size_bytes);
    void* const block = ::operator new (size_bytes, std::align_val_t{huge_page_bytes});
    madvise(block, size_bytes, MADV_HUGEPAGE);
    return block;
}

/// Frees what allocate_array gave for the same size.
inline void free_array(void* block, std::size_t size_bytes) {
    if (size_bytes < huge_page_bytes) return ::operator delete(block);
    ::operator delete (block, std::align_val_t{huge_page_bytes});
}

/// For a large array that is resized once and then filled on all cores: resizing leaves the new items
/// indeterminate, so that their pages are first touched by who fills them.
template <class T>
class LargeArrayAllocator {
  public:
    using value_type = T;

    LargeArrayAllocator() = default;
    template <class U>
    explicit LargeArrayAllocator(const LargeArrayAllocator<U>&) {}

    [[nodiscard]] T* allocate(std::size_t count) {
        return static_cast<T*>(allocate_array(count * sizeof(T)));
    }
    void deallocate(T* items, std::size_t count) { free_array(items, count * sizeof(T)); }
    /// Without arguments it does nothing: the items, trivially copyable, exist since they were allocated.
    template <class... Arguments>
    void construct(T* item, Arguments&&... arguments) {
        static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
        if constexpr (sizeof...(Arguments) > 0)
            std::construct_at(item, std::forward<Arguments>(arguments)...);
    }
    friend bool operator==(const LargeArrayAllocator&, const LargeArrayAllocator&) { return true; }
};

template <class T>
using LargeArray = std::vector<T, LargeArrayAllocator<T>>;

}  // namespace rtu::model
