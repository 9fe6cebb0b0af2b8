#include "rtl_ref/harness/rtl_machine.hpp"

#include <Vrtu_2_2.h>
#include <Vrtu_4_0.h>
#include <Vrtu_4_1.h>
#include <Vrtu_4_2.h>
#include <Vrtu_8_2.h>
#include <Vrtu_waves.h>

#include <algorithm>
#include <bit>
#include <string_view>
#include <utility>

#include "rtl_ref/harness/rtl_run.hpp"

namespace rtu::rtl {

namespace {

constexpr std::uint32_t built_hit_units = 8;

struct Build {
    std::uint32_t width;
    TesterMode mode;
    std::uint32_t mailbox_entries;  // at most
    RtlResult (*run)(const model::MemoryImage&, std::span<const model::Ray>, model::RayKind, const RtlConfig&,
                     const Waves*, const Disturbance*);
};

template <class Top>
RtlResult run_on(const model::MemoryImage& image, std::span<const model::Ray> rays, model::RayKind kind,
                 const RtlConfig& config, const Waves* waves, const Disturbance* disturbance) {
    return RtlRun<Top>(image, rays, kind, config, waves, disturbance).run();
}

// As listed in rtl_ref/CMakeLists.txt.
constexpr std::array builds{Build{4, TesterMode::DualShared, 16, run_on<Vrtu_4_2>},
                            Build{4, TesterMode::Single, 0, run_on<Vrtu_4_0>},
                            Build{4, TesterMode::DualIndependent, 0, run_on<Vrtu_4_1>},
                            Build{2, TesterMode::DualShared, 0, run_on<Vrtu_2_2>},
                            Build{8, TesterMode::DualShared, 0, run_on<Vrtu_8_2>}};

constexpr Build recording{4, TesterMode::DualShared, 16, run_on<Vrtu_waves>};

const Build* find_build(const RtlConfig& config) {
    if (config.hit_units != built_hit_units) return nullptr;
    const auto found = std::ranges::find_if(builds, [&](const Build& build) {
        return std::pair(build.width, build.mode) == std::pair(config.width, config.mode) &&
               config.mailbox_entries <= build.mailbox_entries;
    });
    return found == builds.end() ? nullptr : &*found;
}

void require(std::string_view name, std::uint32_t value, std::uint32_t least, std::uint32_t most) {
    if (value < least || value > most) {
        throw Error("rtl: {}: expected a number from {} to {}, got {}", name, least, most, value);
    }
}

void require_power_of_two(std::string_view name, std::uint32_t value) {
    if (!std::has_single_bit(value)) throw Error("rtl: {}: expected a power of two, got {}", name, value);
}

void check(const RtlConfig& config) {
    require("slots", config.slots, 1, 128);
    require("stack entries", config.stack_entries, 1, 16);
    require("mailbox entries", config.mailbox_entries, 0, 16);
    require("cache banks", config.cache.banks, 1, 4);
    require_power_of_two("cache banks", config.cache.banks);
    require("cache sets", config.cache.sets, config.cache.banks, 32);
    require_power_of_two("cache sets", config.cache.sets);
    require("cache ways", config.cache.ways, 1, 16);
    require("cache mshrs", config.cache.mshrs, 1, 64);
    require("cache targets an mshr", config.cache.targets_per_mshr, 1, 16);
    require("cache latency", config.cache.latency_cycles, 1, 32);
    require("memory latency", config.memory.latency_cycles, 1, 10'000);
    require("memory bytes a cycle", config.memory.bytes_per_cycle, 1, 1024);
}

void check(const model::MemoryImage& image, const RtlConfig& config) {
    if (image.width != config.width) {
        throw Error("rtl: expected a tree of width {}, got {}", config.width, image.width);
    }
    if (image.format != model::NodeFormat::Full) throw Error("rtl: expected full nodes, got quantised ones");
    if (image.reference_count != image.leaf_count) {
        throw Error("rtl: expected leaves of one pair, got {} pairs in {} leaves", image.reference_count,
                    image.leaf_count);
    }
    const model::StackRegion stacks =
        model::stack_region(image, config.stack_entries, FlatMemory::line_bytes);
    if (stacks.slot_bytes > 0xffffU ||
        stacks.base_address + stacks.slot_bytes * config.slots > 0xffff'ffffU) {
        throw Error(
            "rtl: expected an image with its stacks below 4 GiB, and 64 KiB a stack; got {} bytes and {}",
            image.size_bytes(), stacks.slot_bytes);
    }
}

void check(const Waves& waves) {
    const auto suffix = waves.file.extension();
    if (suffix != ".fst" && suffix != ".vcd") {
        throw Error("{}: expected a file name that ends in .fst or .vcd", waves.file.string());
    }
}

}  // namespace

bool has_build(const RtlConfig& config) { return find_build(config) != nullptr; }

RtlResult run_rtl(const model::MemoryImage& image, std::span<const model::Ray> rays, model::RayKind kind,
                  const RtlConfig& config, const Waves* waves, const Disturbance* disturbance) {
    const Build* build = find_build(config);
    if (build == nullptr) {
        throw Error(
            "rtl: an RTU of width {}, pair mode {}, {} hit units and {} mailbox entries was not built",
            config.width, std::uint32_t(config.mode), config.hit_units, config.mailbox_entries);
    }
    check(config);
    check(image, config);
    if (waves != nullptr) {
        check(*waves);
        if (std::pair(config.width, config.mode) != std::pair(recording.width, recording.mode)) {
            throw Error("rtl: waves are those of an RTU of width {} and pair mode {}, got {} and {}",
                        recording.width, std::uint32_t(recording.mode), config.width,
                        std::uint32_t(config.mode));
        }
        build = &recording;
    }
    return build->run(image, rays, kind, config, waves, disturbance);
}

}  // namespace rtu::rtl
