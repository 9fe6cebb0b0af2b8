#pragma once

#include <gtkwave/fstapi.h>
#include <verilated_fst_c.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "model/error.hpp"
#include "rtl_ref/harness/rtl_machine.hpp"

namespace rtu::rtl {

/// A Verilated class that can record itself.
template <class Top>
concept TracesFst = requires(Top& top, VerilatedFstC* file) {
    top.trace(file, 99);
};

/// A new folder beside a file, which goes with all that is in it.
class FolderBeside {
  public:
    /// Throws rtu::Error when there can be none.
    explicit FolderBeside(const std::filesystem::path& file) {
        std::string name = file.string() + ".XXXXXX";
        if (::mkdtemp(name.data()) == nullptr) throw Error("{}: cannot be written", file.string());
        path_ = name;
    }
    ~FolderBeside() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    FolderBeside(const FolderBeside&) = delete;
    FolderBeside& operator=(const FolderBeside&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Writes all changes in an FST file as VCD. Throws rtu::Error when either file fails.
inline void write_vcd(const std::filesystem::path& fst, const std::filesystem::path& vcd) {
    const std::unique_ptr<void, void (*)(void*)> reader(fstReaderOpen(fst.c_str()), fstReaderClose);
    if (!reader) throw Error("{}: cannot be read back", fst.string());
    std::FILE* file = std::fopen(vcd.c_str(), "w");
    if (file == nullptr) throw Error("{}: cannot be written", vcd.string());
    fstReaderProcessHier(reader.get(), file);
    fstReaderSetFacProcessMaskAll(reader.get());
    fstReaderIterBlocks(reader.get(), nullptr, nullptr, file);
    const bool is_broken = std::ferror(file) != 0;
    if (std::fclose(file) != 0 || is_broken) throw Error("{}: cannot be written", vcd.string());
}

/// The signals of a Verilated unit, cycle by cycle, in a file: whole, or what was there before. A window of
/// cycles is recorded in a folder of its own, as FST needs more than one file on the way.
template <TracesFst Top>
class WaveFile {
  public:
    /// Throws rtu::Error when nothing can be written beside the file.
    WaveFile(Top& unit, const Waves& waves) : waves_(waves), folder_(waves.file) {
        unit.trace(&file_, 99);
        file_.open(fst().c_str());
        if (!file_.isOpen()) throw Error("{}: cannot be written", waves.file.string());
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
    /// reached.
    void finish(std::uint64_t cycles) {
        file_.close();
        if (!has_recorded_) {
            throw Error("{}: nothing to record from cycle {} on: the run ended after {}",
                        waves_.file.string(), waves_.first_cycle, cycles);
        }
        const bool is_vcd = waves_.file.extension() == ".vcd";
        if (is_vcd) write_vcd(fst(), vcd());
        std::error_code failure;
        std::filesystem::rename(is_vcd ? vcd() : fst(), waves_.file, failure);
        if (failure) throw Error("{}: cannot be written: {}", waves_.file.string(), failure.message());
    }

  private:
    [[nodiscard]] std::filesystem::path fst() const { return folder_.path() / "waves.fst"; }
    [[nodiscard]] std::filesystem::path vcd() const { return folder_.path() / "waves.vcd"; }

    Waves waves_;
    FolderBeside folder_;
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
