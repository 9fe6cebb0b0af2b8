#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "study/stream/stream_output.hpp"

namespace rtu::study {
namespace {

std::string mega(double per_second) {
    const double value = per_second / 1e6;
    return value >= 100 ? fixed(value, 1) : fixed(value, value >= 1 ? 2 : 4);
}

std::string of_cycles(const StreamRow& row, std::uint64_t cycles) {
    return fixed(100.0 * double(cycles) / double(row.result.cycles), 1);
}

std::vector<std::string> best_cells(const StreamRow& row) {
    const sim::LinkTime& time = row.result.time;
    return {row.mode,
            row.link,
            grouped(row.batch_tests),
            mega(row.tests_per_second()),
            mega(row.alone_tests_per_second()),
            fmt::format("{:.3g}", row.mrps()),
            fmt::format("{:.3g}", row.alone_mrps()),
            of_cycles(row, time.machine_cycles),
            of_cycles(row, time.read_back_cycles),
            of_cycles(row, time.upload_cycles),
            std::string(row.limit())};
}

// The fastest of each mode and link, in the order of the rows.
std::vector<const StreamRow*> best_rows(const StreamReport& report) {
    std::vector<const StreamRow*> best;
    for (const StreamRow& row : report.rows) {
        const auto same = [&](const StreamRow* other) {
            return other->mode == row.mode && other->link == row.link;
        };
        const auto found = std::ranges::find_if(best, same);
        if (found == best.end()) {
            best.push_back(&row);
        } else if (row.tests_per_second() > (*found)->tests_per_second()) {
            *found = &row;
        }
    }
    return best;
}

StudyTable best_table(const StreamReport& report) {
    StudyTable table{"Each mode on each link with its best batch", {}, {}, {}};
    table.columns = {{"Mode", left_aligned},
                     {"Link", left_aligned},
                     {"Batch\ntests"},
                     {"Rate"},
                     {"no link"},
                     {"MRPS"},
                     {"no link"},
                     {"Machine\n%"},
                     {"Read\nback %"},
                     {"Upload\n%"},
                     {"Limit", left_aligned}};
    for (const StreamRow* row : best_rows(report)) table.rows.push_back(best_cells(*row));
    table.note =
        "  Rates in million tests of single triangles a second. A run's time is the machine's as long as a\n"
        "  batch is in it, else the read-back's, else the upload's. Limit: the part in use the longest.";
    return table;
}

StudyTable balance_table(const StreamReport& report) {
    StudyTable table{
        "The batch, in tests, from which on the testers are the limit and not the link", {}, {}, {}};
    table.columns = {{"Mode", left_aligned}};
    for (const std::string& link : report.links) table.columns.push_back({link});
    for (const StreamBalance& balance : report.balances) {
        if (table.rows.empty() || table.rows.back().front() != balance.mode)
            table.rows.push_back({balance.mode});
        table.rows.back().push_back(balance.batch_tests ? grouped(*balance.batch_tests) : "never");
    }
    return table;
}

StudyTable rate_table(const StreamReport& report, const std::string& mode) {
    StudyTable table{fmt::format("Rate by batch size, {}, Mtests/s", mode), {}, {}, {}};
    table.columns = {{"Batch\ntests"}};
    std::map<std::uint64_t, std::map<std::string, const StreamRow*>> rows;
    for (const StreamRow& row : report.rows) {
        if (row.mode == mode && !row.is_balance) rows[row.batch_tests][row.link] = &row;
    }
    for (const std::string& link : report.links) table.columns.push_back({link});
    for (const auto& [batch, by_link] : rows) {
        std::vector<std::string> cells{grouped(batch)};
        for (const std::string& link : report.links)
            cells.push_back(mega(by_link.at(link)->tests_per_second()));
        table.rows.push_back(cells);
    }
    return table;
}

StudyTable published_table(const StreamReport& report) {
    StudyTable table{
        "As published by Robert and Schweri: preset nv35, link agp_8x, lone triangles", {}, {}, {}};
    table.columns = {{"Setup", left_aligned}, {"Published\nMtests/s"}, {"Here\nMtests/s"},
                     {"Here /\npublished"},   {"Machine\n%"},          {"Read-back\n%"},
                     {"Upload\n%"},           {"Limit", left_aligned}};
    for (const PublishedStream& stream : report.published) {
        const StreamRow& row = stream.row;
        const double published = stream.published_tests_per_second;
        table.rows.push_back(
            {stream.what + (stream.is_fitted ? " *" : ""), published > 0 ? mega(published) : "",
             mega(row.tests_per_second()), published > 0 ? fixed(row.tests_per_second() / published, 2) : "",
             of_cycles(row, row.result.time.machine_cycles), of_cycles(row, row.result.time.read_back_cycles),
             of_cycles(row, row.result.time.upload_cycles), std::string(row.limit())});
    }
    table.note =
        "  * fitted: the host's time for a transfer to direct passing, the testers' interval to mixed mode\n"
        "  without read-back. The buffer's size is fitted to 32 x 32 being the best; its rate is not.";
    return table;
}

std::vector<std::string> modes_of(const StreamReport& report) {
    std::vector<std::string> modes;
    for (const StreamRow& row : report.rows)
        if (std::ranges::find(modes, row.mode) == modes.end()) modes.push_back(row.mode);
    return modes;
}

}  // namespace

std::vector<StudyTable> stream_tables(const StreamReport& report) {
    std::vector<StudyTable> tables{best_table(report), balance_table(report)};
    for (const std::string& mode : modes_of(report)) {
        StudyTable table = rate_table(report, mode);
        if (table.rows.size() > 1) tables.push_back(std::move(table));
    }
    if (!report.published.empty()) tables.push_back(published_table(report));
    return tables;
}

std::string stream_facts(const StreamReport& report) {
    return fmt::format(
        "rtusim {}  preset {}, {} MHz, seed {}\n"
        "{}: {} {} rays, each against {} pairs and lone triangles\n"
        "({} triangles, pairing {}); {} rays hit\n",
        report.version, report.preset, grouped(report.clock_mhz), report.seed, report.scene.name,
        grouped(report.ray_count), report.workload, grouped(report.pair_count),
        grouped(report.triangle_count), report.pairing.method, grouped(report.hit_count));
}

std::string stream_text(const StreamReport& report) {
    std::string out = stream_facts(report);
    for (const StudyTable& table : stream_tables(report)) {
        TextTable text(table.columns);
        for (const auto& row : table.rows) text.add_row(row);
        out += fmt::format("\n{}\n{}", table.title, text.text());
        if (!table.note.empty()) out += table.note + "\n";
    }
    return out;
}

}  // namespace rtu::study
