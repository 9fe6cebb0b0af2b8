#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <tuple>
#include <vector>

#include "study/timeline/timeline_output.hpp"

// SystemC's own sc_trace() writes such files, too, but of whole runs of the mode in which every cycle wakes
// the kernel, and with the date in them.

namespace rtu::study {

namespace {

struct Signal {
    std::string path;  // like rtu0.requests.valid
    std::uint32_t bits = 1;
    bool is_number = false;  // else a single wire
};

struct Change {
    sim::Cycle cycle = 0;
    std::uint32_t signal = 0;
    std::uint32_t value = 0;
};

// Identifiers of printable characters, shortest first.
std::string identifier(std::uint32_t index) {
    constexpr std::uint32_t first = '!', count = '~' - '!' + 1;
    std::string text;
    do {
        text += char(first + index % count);
        index /= count;
    } while (index-- > 0);
    return text;
}

std::string value_text(const Signal& signal, std::uint32_t value, const std::string& id) {
    if (!signal.is_number) return fmt::format("{}{}\n", value, id);
    return fmt::format("b{:b} {}\n", value, id);
}

class VcdWriter {
  public:
    explicit VcdWriter(const Timeline& timeline) : timeline_(timeline) {
        add_units();
        add_channels();
    }

    std::string text() {
        std::string out = fmt::format(
            "$version rtusim {} $end\n$comment {} {}: one nanosecond is one cycle, of {} MHz $end\n"
            "$timescale 1 ns $end\n",
            timeline_.version, printable(timeline_.scene), timeline_.workload, timeline_.clock_mhz);
        out += definitions() + "$enddefinitions $end\n";
        std::ranges::stable_sort(changes_, {}, [](const Change& c) { return std::tuple(c.cycle, c.signal); });
        std::vector<std::uint32_t> values(signals_.size(), ~0U);
        std::optional<sim::Cycle> at;
        for (const Change& change : changes_) {
            if (values[change.signal] == change.value) continue;
            values[change.signal] = change.value;
            if (at != change.cycle) out += fmt::format("#{}\n", change.cycle);
            at = change.cycle;
            out += value_text(signals_[change.signal], change.value, identifier(change.signal));
        }
        const sim::Cycle end = std::min(timeline_.window.end(), timeline_.run_cycles);
        return out + fmt::format("#{}\n", end);
    }

  private:
    // A name ends at a blank, and a comment at a dollar sign.
    static std::string printable(std::string text) {
        std::ranges::replace_if(
            text, [](char c) { return c <= ' ' || c > '~' || c == '$'; }, '_');
        return text;
    }

    std::uint32_t add_signal(std::string path, std::uint32_t bits, bool is_number) {
        signals_.push_back({std::move(path), bits, is_number});
        return std::uint32_t(signals_.size() - 1);
    }

    void add_units() {
        std::vector<std::uint32_t> signal_of;
        for (const std::string& unit : timeline_.units) {
            signal_of.push_back(add_signal(unit + ".state", 2, true));
        }
        for (const UnitSpan& span : timeline_.unit_spans) {
            changes_.push_back({span.begin, signal_of[span.unit], std::uint32_t(span.state)});
        }
    }

    void add_channels() {
        std::vector<std::uint32_t> first_of;
        for (const TimelineChannel& channel : timeline_.channels) {
            const auto bits = std::uint32_t(std::bit_width(channel.depth));
            first_of.push_back(add_signal(channel.name + ".valid", 1, false));
            add_signal(channel.name + ".ready", 1, false);
            for (const char* name : {".held", ".pushed", ".popped"}) {
                add_signal(channel.name + name, bits, true);
            }
        }
        for (const ChannelSample& sample : timeline_.samples) {
            const std::uint32_t depth = timeline_.channels[sample.channel].depth;
            const std::uint32_t values[] = {sample.held > 0, sample.held < depth, sample.held, sample.pushed,
                                            sample.popped};
            for (std::uint32_t i = 0; i < std::size(values); ++i) {
                changes_.push_back({sample.cycle, first_of[sample.channel] + i, values[i]});
            }
        }
    }

    // Signals by the scopes of their paths.
    struct Scope {
        std::map<std::string, Scope> scopes;
        std::vector<std::pair<std::string, std::uint32_t>> signals;
    };

    std::string definitions() const {
        Scope root;
        for (std::uint32_t i = 0; i < signals_.size(); ++i) {
            Scope* scope = &root;
            std::string_view rest = signals_[i].path;
            for (std::size_t dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
                scope = &scope->scopes[std::string(rest.substr(0, dot))];
                rest.remove_prefix(dot + 1);
            }
            scope->signals.emplace_back(rest, i);
        }
        return definitions(root);
    }

    std::string definitions(const Scope& scope) const {
        std::string out;
        for (const auto& [name, index] : scope.signals) {
            const std::uint32_t bits = signals_[index].bits;
            out += fmt::format("$var wire {} {} {}{} $end\n", bits, identifier(index), name,
                               signals_[index].is_number ? fmt::format(" [{}:0]", bits - 1) : "");
        }
        for (const auto& [name, inner] : scope.scopes) {
            out += fmt::format("$scope module {} $end\n{}$upscope $end\n", name, definitions(inner));
        }
        return out;
    }

    const Timeline& timeline_;
    std::vector<Signal> signals_;
    std::vector<Change> changes_;
};

}  // namespace

std::string timeline_vcd(const Timeline& timeline) { return VcdWriter(timeline).text(); }

}  // namespace rtu::study
