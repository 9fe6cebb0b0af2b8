#pragma once

#include <string>

#include "study/timeline/timeline.hpp"

namespace rtu::study {

/// The timeline in the Trace Event Format, which Perfetto (ui.perfetto.dev) and chrome://tracing read: one
/// microsecond of the viewer is one cycle. A process for the units, one for each RTU's rays with a thread a
/// slot, and one for each RTU's memory requests, which are asynchronous. Events are in the order of their
/// time; of those at one time the longer comes first, so that on a thread they nest.
[[nodiscard]] std::string timeline_json(const Timeline& timeline);

/// The states of the units and the handshakes of the channels as a value change dump (IEEE 1364), which
/// GTKWave and every other viewer of waveforms reads: one nanosecond is one cycle. Of a channel, as it is at
/// the beginning of a cycle: `valid` (the reader sees an item), `ready` (the writer has room), `held` items;
/// and what happens in the cycle: `pushed`, `popped`. Of a unit `state`: 0 idle, 1 starved, 2 blocked, 3
/// busy.
[[nodiscard]] std::string timeline_vcd(const Timeline& timeline);

/// What is in it, for people.
[[nodiscard]] std::string timeline_text(const Timeline& timeline);

}  // namespace rtu::study
