#pragma once

#include <string>
#include <vector>

#include "study/pairing/pairing_report.hpp"
#include "study/text_table.hpp"

namespace rtu::study {

/// A table of finished cells, for text and HTML alike.
struct PairingTable {
    std::string title;
    std::string note;  ///< below the table; may be empty
    std::vector<TextTable::Column> columns;
    std::vector<std::vector<std::string>> rows;  ///< an empty row is a rule
};

/// The tables of the comparison: the paper's, memory, what bounds the machine; where edge_bbsa_compressed is
/// compared, what its compression costs; and, when there is anything published about these scenes, the
/// published values beside ours.
[[nodiscard]] std::vector<PairingTable> comparison_tables(const PairingReport& report);

/// A study's table.
[[nodiscard]] PairingTable study_table(const PairingReport& report, const PairingStudyTable& study);

}  // namespace rtu::study
