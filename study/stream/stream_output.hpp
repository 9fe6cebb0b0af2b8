#pragma once

#include <string>
#include <vector>

#include "study/chart/any_chart.hpp"
#include "study/stream/stream_study.hpp"
#include "study/study_table.hpp"

namespace rtu::study {

/// What was streamed, on a few lines.
[[nodiscard]] std::string stream_facts(const StreamReport& report);

/// The best of each mode and link, then rates by batch size, then the published rates if they were asked for.
[[nodiscard]] std::vector<StudyTable> stream_tables(const StreamReport& report);

/// For people: facts and tables.
[[nodiscard]] std::string stream_text(const StreamReport& report);

/// Everything: `rows` with all counters, `balances`, `published`; keys in docs/host_link.md.
[[nodiscard]] std::string stream_json(const StreamReport& report);

/// The rows, with the counters of link and testers.
[[nodiscard]] std::string stream_csv(const StreamReport& report);

/// Rate against batch size, one panel a mode (direct passing has no batches), where more than one batch size
/// was streamed.
[[nodiscard]] std::vector<AnyChart> stream_charts(const StreamReport& report);

/// One page with tables and charts; needs gnuplot.
[[nodiscard]] std::string stream_html(const StreamReport& report);

}  // namespace rtu::study
