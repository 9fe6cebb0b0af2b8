#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rtu::study {

/// What a circuit is made of. Gates are NAND2 equivalents; multipliers and adders are binary32 ones and are
/// part of the gates, as are the registers.
struct GateCounts {
    double gates = 0;
    double register_bits = 0;
    double register_gates = 0;  ///< of the gates, those of the registers
    double multipliers = 0;
    double adders = 0;
    double depth = 0;  ///< gates between two registers, at most

    /// Both side by side: the greater depth.
    GateCounts& operator+=(const GateCounts& other);
    friend GateCounts operator+(GateCounts a, const GateCounts& b) { return a += b; }
    friend bool operator==(const GateCounts&, const GateCounts&) = default;
};

/// `count` of them side by side.
[[nodiscard]] GateCounts times(double count, const GateCounts& one);

/// a without its part b; the depth is a's.
[[nodiscard]] GateCounts minus(const GateCounts& a, const GateCounts& b);

/// A unit of the RTL reference, synthesised and counted.
struct CountedUnit {
    std::string name;  ///< module, or module:parameter=value
    GateCounts counts;
};

/// The rows of a file as rtl_ref/gates/count_gates.sh writes it. Throws std::logic_error for anything else:
/// the file is part of the program.
[[nodiscard]] std::vector<CountedUnit> parse_gates_csv(std::string_view text);

/// Every row of rtl_ref/gates/gates.csv as it was when this was built.
[[nodiscard]] std::span<const CountedUnit> counted_units();

/// The counts of a row; throws std::logic_error when there is none.
[[nodiscard]] const GateCounts& gate_counts(std::string_view unit);

/// What counted them: "Yosys 0.23".
[[nodiscard]] std::string_view gate_counter();

}  // namespace rtu::study
