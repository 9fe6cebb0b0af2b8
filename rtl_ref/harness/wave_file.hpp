#pragma once

#include <verilated_fst_c.h>
#include <verilated_vcd_c.h>

#include <cstdint>
#include <memory>

#include "model/error.hpp"
#include "rtl_ref/harness/rtl_machine.hpp"

namespace rtu::rtl {

/// What a Verilated `Top` can record itself in: nothing, unless it was Verilated with tracing.
template <class Top>
concept TracesVcd = requires(Top& top, VerilatedVcdC* file) {
    top.trace(file, 99);
};
template <class Top>
concept TracesFst = requires(Top& top, VerilatedFstC* file) {
    top.trace(file, 99);
};

/// The signals of a Verilated unit, cycle by cycle, in a file; two time steps a cycle.
template <class Top>
class WaveFile {
  public:
    /// Throws rtu::Error when the file cannot be written or the unit does not trace in its format.
    WaveFile(Top& unit, const Waves& waves) : waves_(waves) {
        const auto suffix = waves.file.extension();
        if constexpr (TracesVcd<Top>) {
            if (suffix == ".vcd") open(unit, vcd_);
        }
        if constexpr (TracesFst<Top>) {
            if (suffix == ".fst") open(unit, fst_);
        }
        if (!vcd_ && !fst_) {
            throw Error("{}: expected {}", waves.file.string(),
                        TracesVcd<Top> ? "a file name that ends in .vcd: this build writes no other waves"
                        : TracesFst<Top>
                            ? "a file name that ends in .fst: this build writes no other waves"
                            : "no waves: the RTL was built without them (cmake -DRTUSIM_RTL_WAVES=fst)");
        }
    }
    ~WaveFile() {
        if constexpr (TracesVcd<Top>) {
            if (vcd_) vcd_->close();
        }
        if constexpr (TracesFst<Top>) {
            if (fst_) fst_->close();
        }
    }
    WaveFile(const WaveFile&) = delete;
    WaveFile& operator=(const WaveFile&) = delete;

    /// Records the signals at the beginning of a cycle (settled, before its clock edge) or after the edge.
    void dump(std::uint64_t cycle, bool is_after_edge) {
        if (cycle < waves_.first_cycle || cycle >= waves_.end_cycle) return;
        const std::uint64_t time = 2 * cycle + (is_after_edge ? 1 : 0);
        if constexpr (TracesVcd<Top>) {
            if (vcd_) vcd_->dump(time);
        }
        if constexpr (TracesFst<Top>) {
            if (fst_) fst_->dump(time);
        }
    }

  private:
    template <class File>
    void open(Top& unit, std::unique_ptr<File>& file) {
        file = std::make_unique<File>();
        unit.trace(file.get(), 99);
        file->open(waves_.file.string().c_str());
        if (!file->isOpen()) throw Error("{}: cannot be written", waves_.file.string());
    }

    Waves waves_;
    std::unique_ptr<VerilatedVcdC> vcd_;
    std::unique_ptr<VerilatedFstC> fst_;
};

}  // namespace rtu::rtl
