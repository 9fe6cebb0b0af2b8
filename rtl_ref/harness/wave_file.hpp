#pragma once

#include <gtkwave/fstapi.h>
#include <verilated_fst_c.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "model/error.hpp"
#include "rtl_ref/harness/rtl_machine.hpp"

namespace rtu::rtl {

/// A Verilated class that can record itself.
template <class Top>
concept TracesFst = requires(Top& top, VerilatedFstC* file) {
    top.trace(file, 99);
};

/// Writes all changes in an FST file as VCD. Throws rtu::Error when either file fails, and leaves no VCD
/// then.
inline void write_vcd(const std::filesystem::path& fst, const std::filesystem::path& vcd) {
    const std::unique_ptr<void, void (*)(void*)> reader(fstReaderOpen(fst.c_str()), fstReaderClose);
    if (!reader) throw Error("{}: cannot be read back", fst.string());
    std::FILE* file = std::fopen(vcd.c_str(), "w");
    if (file == nullptr) throw Error("{}: cannot be written", vcd.string());
    fstReaderProcessHier(reader.get(), file);
    fstReaderSetFacProcessMaskAll(reader.get());
    fstReaderIterBlocks(reader.get(), nullptr, nullptr, file);
    const bool is_broken = std::ferror(file) != 0;
    if (std::fclose(file) == 0 && !is_broken) return;
    std::filesystem::remove(vcd);
    throw Error("{}: cannot be written", vcd.string());
}

/// The signals of a Verilated unit, cycle by cycle, in a file.
template <TracesFst Top>
class WaveFile {
  public:
    /// Throws rtu::Error when the file cannot be written.
    WaveFile(Top& unit, const Waves& waves) : waves_(waves), fst_(waves.file) {
        if (waves.file.extension() == ".vcd") fst_ += ".fst";  // of which a VCD is made
        unit.trace(&file_, 99);
        file_.open(fst_.c_str());
        if (!file_.isOpen()) throw Error("{}: cannot be written", fst_.string());
    }
    ~WaveFile() {
        std::error_code ignored;
        if (fst_ != waves_.file) std::filesystem::remove(fst_, ignored);
    }
    WaveFile(const WaveFile&) = delete;
    WaveFile& operator=(const WaveFile&) = delete;

    /// Records the signals at the beginning of a cycle (settled, before its clock edge) or after the edge.
    void dump(std::uint64_t cycle, bool is_after_edge) {
        if (cycle < waves_.first_cycle || cycle >= waves_.end_cycle) return;
        file_.dump(2 * cycle + (is_after_edge ? 1 : 0));
        has_recorded_ = true;
    }

    /// At the end of a run. Throws rtu::Error when the file cannot be written or the window was never
    /// reached, and leaves no file then.
    void finish(std::uint64_t cycles) {
        file_.close();
        if (!has_recorded_) {
            std::filesystem::remove(fst_);
            throw Error("{}: nothing to record from cycle {} on: the run ended after {}",
                        waves_.file.string(), waves_.first_cycle, cycles);
        }
        if (fst_ != waves_.file) write_vcd(fst_, waves_.file);
    }

  private:
    Waves waves_;
    std::filesystem::path fst_;
    VerilatedFstC file_;
    bool has_recorded_ = false;
};

/// Of a unit that cannot record itself.
class NoWaveFile {
  public:
    template <class Top>
    NoWaveFile(Top& /*unit*/, const Waves& waves) {
        throw Error("{}: this RTU was Verilated without waves", waves.file.string());
    }
    void dump(std::uint64_t /*cycle*/, bool /*is_after_edge*/) {}
    void finish(std::uint64_t /*cycles*/) {}
};

template <class Top>
struct WaveFileOf {
    using Type = NoWaveFile;
};
template <TracesFst Top>
struct WaveFileOf<Top> {
    using Type = WaveFile<Top>;
};

}  // namespace rtu::rtl
