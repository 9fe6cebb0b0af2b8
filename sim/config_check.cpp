#include <bit>
#include <initializer_list>

#include "model/error.hpp"
#include "sim/cache_tags.hpp"
#include "sim/effective_config.hpp"

namespace rtu::sim {
namespace {

/// One rule between keys: when `holds` is false, the error names the keys with their values and places.
void require(const EffectiveConfig& effective, bool holds, std::string_view expected,
             std::initializer_list<std::string_view> names) {
    if (holds) return;
    std::string place = "configuration";
    std::string found;
    for (const std::string_view name : names) {
        const std::size_t index = config_key_index(name, "configuration");
        const std::string& set_at = effective.origins[index].place;
        if (!set_at.empty()) place = set_at;
        found += fmt::format("{}{} = {}", found.empty() ? "" : ", ", name,
                             config_value_text(effective.config, config_keys()[index]));
    }
    throw Error("{}: expected {}, got {}", place, expected, found);
}

static_assert(max_sectors_per_line == 32, "the rule below says 32");

void check_cache(const EffectiveConfig& effective, const Config::Cache& cache, const std::string& name) {
    const std::string size = name + ".size_bytes", line = name + ".line_bytes", ways = name + ".ways";
    const std::string sector = name + ".sector_bytes", banks = name + ".banks", mshrs = name + ".mshrs";
    require(effective, cache.sector_bytes <= cache.line_bytes, "a sector no larger than its line",
            {line, sector});
    require(effective, cache.line_bytes / cache.sector_bytes <= max_sectors_per_line,
            "at most 32 sectors a line", {line, sector});
    const std::uint64_t set_bytes = std::uint64_t(cache.line_bytes) * cache.ways;
    require(effective, cache.size_bytes % set_bytes == 0 && std::has_single_bit(cache.size_bytes / set_bytes),
            "a capacity of a power of two sets (size / line / ways)", {size, line, ways});
    require(effective, cache.banks <= cache.size_bytes / set_bytes, "at least one set a bank",
            {size, line, ways, banks});
    require(effective, cache.mshrs <= cache.size_bytes / cache.line_bytes,
            "no more outstanding lines than lines", {size, line, mshrs});
}

/// A range can only be broken by code that fills in Config itself.
void check_ranges(const EffectiveConfig& effective) {
    EffectiveConfig copy = effective;
    for (std::size_t i = 0; i < config_keys().size(); ++i) {
        const ConfigKey& key = config_keys()[i];
        const ConfigValue value = config_value(effective.config, key);
        const auto* number = std::get_if<std::uint32_t>(&value);
        if (number == nullptr) continue;
        const std::string& place = effective.origins[i].place;
        copy = assign(
            std::move(copy),
            {std::string(key.name), std::int64_t(*number), {}, place.empty() ? "configuration" : place});
    }
}

}  // namespace

void validate(const EffectiveConfig& effective) {
    check_ranges(effective);
    const Config& config = effective.config;
    check_cache(effective, config.l1, "l1");
    require(effective, config.bvh.splits == SplitKind::Object || config.bvh.max_leaf_pairs == 1,
            "one pair a leaf where leaves share pairs", {"bvh.splits", "bvh.max_leaf_pairs"});
    require(effective,
            config.bvh.splits == SplitKind::Object || config.bvh.node_format == model::NodeFormat::Full,
            "full nodes where leaves share pairs", {"bvh.splits", "bvh.node_format"});
    require(effective, config.bvh.splits == SplitKind::Object || config.bvh.builder == BvhBuilder::Sah,
            "the builder that can cut pairs", {"bvh.splits", "bvh.builder"});
    require(effective,
            config.rtu.mailbox.kind != MailboxKind::Hashed || config.rtu.mailbox.entries == 0 ||
                std::has_single_bit(config.rtu.mailbox.entries),
            "a power of two places", {"rtu.mailbox.kind", "rtu.mailbox.entries"});
    if (config.memory.model == MemoryModel::Flat) return;  // there is no L2 and no DRAM to check
    check_cache(effective, config.l2, "l2");
    require(effective, config.l1.line_bytes <= config.l2.line_bytes,
            "lines that do not shrink towards memory", {"l1.line_bytes", "l2.line_bytes"});
    require(effective, config.l2.line_bytes <= config.dram.row_bytes, "an L2 line within one DRAM row",
            {"l2.line_bytes", "dram.row_bytes"});
}

}  // namespace rtu::sim
