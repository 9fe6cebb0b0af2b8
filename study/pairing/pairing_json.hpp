#pragma once

#include <string>

#include "study/pairing/pairing_report.hpp"

namespace rtu::study {

/// The report as JSON (docs/pairing_study.md lists the keys): `rows` and `average` of the comparison, and
/// `studies`. A change from zero is null. Host times are the keys with `seconds` in their names.
[[nodiscard]] std::string pairing_json(const PairingReport& report);

/// The report as CSV (RFC 4180): a row for each comparison, those of studies with their name and setting.
/// Without host times: byte-identical between runs.
[[nodiscard]] std::string pairing_csv(const PairingReport& report);

}  // namespace rtu::study
