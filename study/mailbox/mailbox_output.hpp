#pragma once

#include <string>
#include <vector>

#include "study/chart/any_chart.hpp"
#include "study/mailbox/mailbox_study.hpp"

namespace rtu::study {

/// For people: what pairing, splits and mailbox are each worth with and without the others, and the rows.
[[nodiscard]] std::string mailbox_text(const MailboxReport& report);

/// Everything: `rows`; keys in docs/mailbox.md.
[[nodiscard]] std::string mailbox_json(const MailboxReport& report);

/// The rows.
[[nodiscard]] std::string mailbox_csv(const MailboxReport& report);

/// Of each scene: pair tests a ray, MRPS, and gates against the entries of the mailbox, a panel a workload.
[[nodiscard]] std::vector<AnyChart> mailbox_charts(const MailboxReport& report);

}  // namespace rtu::study
