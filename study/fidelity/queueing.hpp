#pragma once

#include <cstdint>
#include <span>

namespace rtu::study {

/// A closed queueing network of one class: `customers` go round stations, each of which serves one at a time.
/// `demands`: time at each station, of one round; `delay`: time in which nobody waits for another. Returns
/// the rounds per unit of time by exact mean value analysis [RL80]; 0 when nothing takes time. A fraction of
/// a customer more or less is interpolated.
[[nodiscard]] double closed_network_throughput(std::span<const double> demands, double delay,
                                               std::uint32_t customers);

/// Mean cycles that a unit of `lanes` lanes takes for a node, which takes as many lanes as it has children:
/// nodes are taken in order, whole ones a cycle as long as they fit; one that fits no cycle takes several.
/// `nodes_with[c]`: how often a node has c children (any unit); they follow each other at random. 0 without
/// nodes.
[[nodiscard]] double packed_cycles_per_node(std::span<const double> nodes_with, std::uint32_t lanes);

/// Mean accesses a cycle of an input that sends up to `most` in order to `banks` banks at random, each of
/// which takes one a cycle; the first that finds its bank taken waits for the next cycle.
[[nodiscard]] double in_order_bank_rate(std::uint32_t banks, std::uint32_t most);

}  // namespace rtu::study
