#pragma once

#include <optional>
#include <string>

#include "study/pairing/pairing_report.hpp"

namespace rtu::study {

/// A cell of a column: a change with its sign ("-13.18"), another number without; "-" for no value.
[[nodiscard]] std::string pairing_cell(const PairingColumn& column, std::optional<double> value);

/// The most used part with its share of the cycles: "box 97 %".
[[nodiscard]] std::string bound_by(const PairingRun& run);

/// What the tables of this report have in common, line by line: machine, rays, inputs.
[[nodiscard]] std::string pairing_facts(const PairingReport& report);

/// The report as plain text: the table of [AF], what the memory sees, what bounds the machine, the published
/// values beside ours, then each study. At most 100 columns as long as names are short, studies 120.
[[nodiscard]] std::string pairing_text(const PairingReport& report);

}  // namespace rtu::study
