#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "study/timeline/timeline_output.hpp"

// The format: "Trace Event Format", N. Duca, D. Sinclair, Google, 2016. Used of it: M (names), X (complete
// events, `ts` and `dur`), b and e (asynchronous, one `id` for both), n (asynchronous, an instant).

namespace rtu::study {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t units_pid = 1;
constexpr std::uint32_t first_rtu_pid = 2;

std::uint32_t slots_pid(std::uint32_t rtu) { return first_rtu_pid + 2 * rtu; }
std::uint32_t memory_pid(std::uint32_t rtu) { return slots_pid(rtu) + 1; }

// An event and what orders it: its time, then its length, longer first; at one time an end comes first.
struct Event {
    sim::Cycle cycle = 0;
    int rank = 0;
    sim::Cycle length = 0;
    Json json;
};

class EventWriter {
  public:
    explicit EventWriter(const Timeline& timeline) : timeline_(timeline) {
        name_all();
        for (const UnitSpan& span : timeline.unit_spans) {
            complete(units_pid, span.unit + 1, unit_state_names[std::size_t(span.state)], "unit", span);
        }
        for (const RaySpan& span : timeline.ray_spans) {
            complete(slots_pid(span.rtu), span.slot + 1, fmt::format("ray {}", span.ray), "ray", span);
        }
        for (const SlotSpan& span : timeline.slot_spans) {
            complete(slots_pid(span.rtu), span.slot + 1, slot_wait_names[std::size_t(span.wait)], "wait",
                     span);
        }
        for (const RequestSpan& span : timeline.requests) request(span);
    }

    std::string text() {
        const auto key = [](const Event& e) { return std::tuple(e.cycle, e.rank, ~e.length); };
        std::ranges::stable_sort(events_, {}, key);
        std::vector<std::string> lines;
        for (const Json& name : names_) lines.push_back(dump(name));
        for (const Event& event : events_) lines.push_back(dump(event.json));
        const Json other{{"scene", timeline_.scene},          {"workload", timeline_.workload},
                         {"version", timeline_.version},      {"clock_mhz", timeline_.clock_mhz},
                         {"microsecond", "1 cycle"},          {"from_cycle", timeline_.window.from},
                         {"cycles", timeline_.window.cycles}, {"run_cycles", timeline_.run_cycles}};
        return fmt::format(
            "{{\"displayTimeUnit\": \"ns\",\n\"otherData\": {},\n\"traceEvents\": [\n{}\n]}}\n", dump(other),
            fmt::join(lines, ",\n"));
    }

  private:
    static std::string dump(const Json& json) {
        return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }

    void name(const char* what, std::uint32_t pid, std::uint32_t tid, const std::string& text) {
        names_.push_back(
            {{"ph", "M"}, {"name", what}, {"pid", pid}, {"tid", tid}, {"args", {{"name", text}}}});
    }

    void name_all() {
        name("process_name", units_pid, 0, "units");
        for (std::uint32_t i = 0; i < timeline_.units.size(); ++i) {
            name("thread_name", units_pid, i + 1, timeline_.units[i]);
        }
        for (std::uint32_t rtu = 0; rtu < timeline_.rtu_count; ++rtu) {
            name("process_name", slots_pid(rtu), 0, fmt::format("rtu{} ray slots", rtu));
            for (std::uint32_t slot = 0; slot < timeline_.slots_per_rtu; ++slot) {
                name("thread_name", slots_pid(rtu), slot + 1, fmt::format("slot {}", slot));
            }
            name("process_name", memory_pid(rtu), 0, fmt::format("rtu{} memory requests", rtu));
            name("thread_name", memory_pid(rtu), 1, "requests");
        }
    }

    template <class Span>
    void complete(std::uint32_t pid, std::uint32_t tid, std::string_view name, std::string_view category,
                  const Span& span) {
        const sim::Cycle length = span.end - span.begin;
        // Ranks: ends of asynchronous events, then rays before their waits of the same length, then
        // beginnings.
        events_.push_back({span.begin,
                           category == "wait" ? 2 : 1,
                           length,
                           {{"ph", "X"},
                            {"name", name},
                            {"cat", category},
                            {"pid", pid},
                            {"tid", tid},
                            {"ts", span.begin},
                            {"dur", length}}});
    }

    void request(const RequestSpan& span) {
        const std::uint64_t id = ++request_count_;
        const auto event = [&](const char* phase, sim::Cycle cycle, int rank) {
            Json json{{"ph", phase},
                      {"name", request_names[std::size_t(span.kind)]},
                      {"cat", span.is_write ? "write" : "read"},
                      {"pid", memory_pid(span.rtu)},
                      {"tid", 1},
                      {"id", id},
                      {"ts", cycle}};
            if (rank != 0) {
                json["args"] = {{"address", fmt::format("0x{:x}", span.address)}, {"bytes", span.size_bytes}};
                if (span.slot) json["args"]["slot"] = *span.slot;
            }
            events_.push_back({cycle, rank, 0, std::move(json)});
        };
        if (span.is_write) return event("n", span.begin, 3);
        event("b", span.begin, 3);
        event("e", span.end, 0);
    }

    const Timeline& timeline_;
    std::vector<Json> names_;
    std::vector<Event> events_;
    std::uint64_t request_count_ = 0;
};

}  // namespace

std::string timeline_json(const Timeline& timeline) { return EventWriter(timeline).text(); }

}  // namespace rtu::study
