#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "study/csv.hpp"
#include "study/json_output.hpp"
#include "study/stream/stream_output.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

// What is one number or word of a row, for JSON and CSV alike.
Json plain_values(const StreamRow& row) {
    const sim::StreamResult& result = row.result;
    return {{"mode", row.mode},
            {"link", row.link},
            {"read_back", row.read_back},
            {"batch_tests", row.batch_tests},
            {"is_balance", row.is_balance},
            {"batch_count", result.batch_count},
            {"ray_count", row.ray_count},
            {"pair_tests", result.tests.pair_tests},
            {"triangle_tests", result.tests.triangle_tests},
            {"cycles", result.cycles},
            {"clock_mhz", row.clock_mhz},
            {"tests_per_second", row.tests_per_second()},
            {"mrps", row.mrps()},
            {"alone_cycles", row.alone_cycles},
            {"alone_tests_per_second", row.alone_tests_per_second()},
            {"alone_mrps", row.alone_mrps()},
            {"machine_cycles", result.time.machine_cycles},
            {"read_back_cycles", result.time.read_back_cycles},
            {"upload_cycles", result.time.upload_cycles},
            {"waiting_cycles", result.time.waiting_cycles},
            {"tester_percent", row.tester_percent()},
            {"upload_wire_percent", row.up_percent},
            {"read_back_wire_percent", row.down_percent},
            {"host_percent", row.host_percent},
            {"limit", row.limit()}};
}

Json json(const StreamRow& row) {
    Json object = plain_values(row);
    Json units = Json::object();
    for (const sim::UnitResult& unit : row.result.units) {
        Json counters = Json::object();
        for (const sim::CounterValue& counter : unit.counters) counters[counter.name] = counter.value;
        units[unit.name] = {{"busy", unit.cycles.busy},
                            {"starved", unit.cycles.starved},
                            {"blocked", unit.cycles.blocked},
                            {"idle", unit.cycles.idle},
                            {"counters", counters}};
    }
    object["units"] = units;
    return object;
}

Json json(const StreamBalance& balance) {
    return {{"mode", balance.mode},
            {"link", balance.link},
            {"batch_tests", balance.batch_tests ? Json(*balance.batch_tests) : Json(nullptr)}};
}

Json json(const PublishedStream& stream) {
    const double published = stream.published_tests_per_second;
    return {{"setup", stream.what},
            {"published_tests_per_second", published > 0 ? Json(published) : Json(nullptr)},
            {"is_fitted", stream.is_fitted},
            {"row", json(stream.row)}};
}

// Counters of the last two units: the host has only its number of batches.
std::vector<std::string> counter_cells(const StreamRow& row, bool is_header) {
    std::vector<std::string> cells;
    for (const sim::UnitResult& unit : row.result.units) {
        for (const sim::CounterValue& c : unit.counters)
            cells.push_back(is_header ? fmt::format("{}.{} [{}]", unit.name, c.name, c.unit)
                                      : std::to_string(c.value));
    }
    return cells;
}

}  // namespace

std::string stream_json(const StreamReport& report) {
    Json document{{"version", report.version},
                  {"preset", report.preset},
                  {"seed", report.seed},
                  {"scene", report.scene.name},
                  {"input_hash", report.input_hash},
                  {"pairing", report.pairing.method},
                  {"edge_identity", report.pairing.edge_identity},
                  {"workload", report.workload},
                  {"clock_mhz", report.clock_mhz},
                  {"ray_count", report.ray_count},
                  {"pair_count", report.pair_count},
                  {"triangle_count", report.triangle_count},
                  {"hit_count", report.hit_count}};
    for (const char* key : {"rows", "balances", "published"}) document[key] = Json::array();
    for (const StreamRow& row : report.rows) document["rows"].push_back(json(row));
    for (const StreamBalance& balance : report.balances) document["balances"].push_back(json(balance));
    for (const PublishedStream& stream : report.published) document["published"].push_back(json(stream));
    return json_text(document);
}

std::string stream_csv(const StreamReport& report) {
    std::string out;
    for (const StreamRow& row : report.rows) {
        std::vector<std::string> header{"scene", "preset", "pairing"};
        std::vector<std::string> cells{report.scene.name, report.preset, report.pairing.method};
        const Json values = plain_values(row);
        for (const auto& [key, value] : values.items()) {
            header.push_back(key);
            cells.push_back(csv_cell(value));
        }
        for (auto& name : counter_cells(row, true)) header.push_back(std::move(name));
        for (auto& value : counter_cells(row, false)) cells.push_back(std::move(value));
        if (out.empty()) out = csv_line(header);
        out += csv_line(cells);
    }
    return out;
}

}  // namespace rtu::study
