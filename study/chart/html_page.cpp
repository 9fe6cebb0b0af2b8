#include "study/chart/html_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace rtu::study {
namespace {

constexpr std::string_view page_style = R"(
:root { color-scheme: light dark; --text: #1a1a1a; --back: #ffffff; --line: #d0d0d0; --quiet: #595959; }
@media (prefers-color-scheme: dark) {
  :root { --text: #e6e6e6; --back: #16181c; --line: #454a52; --quiet: #a6adb8; }
}
@media print { :root { --text: #000; --back: #fff; --line: #999; --quiet: #333; } }
body { font: .95rem/1.45 system-ui, sans-serif; color: var(--text); background: var(--back);
  max-width: 66rem; margin: 1.5rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.1rem; margin: 2rem 0 .5rem; }
p.note, pre { color: var(--quiet); } pre { white-space: pre-wrap; font-size: .85rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .2rem .6rem; text-align: right; white-space: nowrap; }
th { border-bottom: 2px solid var(--line); vertical-align: bottom; }
td { border-bottom: 1px solid var(--line); } tr.rule td { border-top: 2px solid var(--line); }
.left { text-align: left; }
figure { margin: 1rem 0; break-inside: avoid; }
figure svg { width: 100%; max-width: 760px; height: auto; color: var(--text); }
figure.wide svg { max-width: none; }
@media print { html { font-size: 11px; } body { max-width: none; } .scroll { overflow: visible; }
  table { font-size: .8rem; } th, td { padding: .1rem .3rem; } h2 { break-after: avoid; }
  tr { break-inside: avoid; } figure svg { max-width: 480px; } }
)";

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
    return text;
}

// gnuplot says viewBox="0 0 WIDTH HEIGHT" in pixels.
bool is_wide(std::string_view svg) {
    constexpr std::string_view before = "viewBox=\"0 0 ";
    const std::size_t at = svg.find(before);
    if (at == std::string_view::npos) return false;
    const std::string_view number = svg.substr(at + before.size());
    int width = 0;
    std::from_chars(number.data(), number.data() + number.size(), width);
    return width > 960;
}

std::string_view alignment(const TextTable::Column& column) {
    return column.align == TextTable::Align::Left ? " class=\"left\"" : "";
}

}  // namespace

std::string html_escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string html_table(const std::vector<TextTable::Column>& columns,
                       const std::vector<std::vector<std::string>>& rows) {
    std::string out = "<div class=\"scroll\"><table>\n<thead><tr>";
    for (const TextTable::Column& column : columns) {
        out += fmt::format("<th{}>{}</th>", alignment(column),
                           replaced(html_escaped(column.header), "\n", "<br>"));
    }
    out += "</tr></thead>\n<tbody>\n";
    bool is_after_rule = false;
    for (const auto& row : rows) {
        if (!row.empty()) {
            out += is_after_rule ? "<tr class=\"rule\">" : "<tr>";
            for (std::size_t i = 0; i < row.size(); ++i) {
                out += fmt::format("<td{}>{}</td>", alignment(columns[i]), html_escaped(row[i]));
            }
            out += "</tr>\n";
        }
        is_after_rule = row.empty();
    }
    return out + "</tbody></table></div>\n";
}

std::string html_figure(std::string_view svg, std::string_view name) {
    // What stands before the element itself belongs to a file, not into a page.
    std::string drawing(svg.substr(std::min(svg.find("<svg"), svg.size())));
    constexpr std::array changes = std::to_array<std::pair<std::string_view, std::string_view>>({
        {"fill=\"#ffffff\"", "fill=\"none\""},  // the file's background
        {"fill=\"black\"", "fill=\"currentColor\""},
        {"rgb(0,0,0)", "currentColor"},
        {"rgb(  0,   0,   0)", "currentColor"},
        {"color=\"black\"", ""},
    });
    for (const auto& [from, to] : changes) drawing = replaced(std::move(drawing), from, to);
    // Ids are the page's, and every drawing of gnuplot has the same.
    for (const char* id : {"gpDot", "gpPt", "gnuplot_canvas", "textbox", "greybox"}) {
        for (const char* before : {"'", "\"", "#"}) {  // not within the data of a picture
            drawing = replaced(std::move(drawing), fmt::format("{}{}", before, id),
                               fmt::format("{}{}-{}", before, name, id));
        }
    }
    return fmt::format("<figure{}>{}</figure>\n", is_wide(svg) ? " class=\"wide\"" : "", drawing);
}

std::string html_page(std::string_view title, std::string_view body) {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{}</title>\n<style>{}</style>"
        "</head>\n<body>\n<h1>{}</h1>\n{}</body></html>\n",
        html_escaped(title), page_style, html_escaped(title), body);
}

}  // namespace rtu::study
