#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "study/text_table.hpp"

// The parts of a self-contained HTML page: no scripts, nothing from a network, light or dark as the reader's
// system says, and black on white on paper.

namespace rtu::study {

/// `text` with &, <, >, " and ' written so that they show as themselves.
[[nodiscard]] std::string html_escaped(std::string_view text);

/// A table; an empty row is a rule. Cells and headers are escaped.
[[nodiscard]] std::string html_table(const std::vector<TextTable::Column>& columns,
                                     const std::vector<std::vector<std::string>>& rows);

/// An SVG file of gnuplot as a figure within the page; its black becomes the page's colour of text. `name`
/// (letters, digits, underscores; once a page) sets its ids apart.
[[nodiscard]] std::string html_figure(std::string_view svg, std::string_view name);

/// The page around `body`, which is HTML; `title` is escaped.
[[nodiscard]] std::string html_page(std::string_view title, std::string_view body);

}  // namespace rtu::study
