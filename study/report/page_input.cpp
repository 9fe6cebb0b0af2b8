#include "study/report/page_input.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "model/regular_file.hpp"
#include "study/report/loaded_run.hpp"
#include "study/report/page_sections.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t max_result_bytes = 1U << 30;

// An object is of the first kind all of whose keys it has.
struct PageKind {
    const char* name;
    std::vector<const char*> keys;
    PageSection (*section)(const Json& json);
};

const std::vector<PageKind>& object_kinds() {
    static const std::vector<PageKind> kinds{
        {"pairing", {"baseline", "averages", "studies", "rows"}, pairing_section},
        {"stability", {"compiler", "cases", "methods", "rows"}, stability_section},
        {"methods", {"instruction_set", "operations", "rows"}, methods_section},
        {"precision", {"answers", "filters", "rows"}, precision_section},
        {"area", {"gate_counter", "machine", "presets", "modes", "rows"}, area_section},
        {"validate", {"summary", "difference", "configs", "rows"}, validate_section},
        {"stream", {"balances", "published", "rows"}, stream_section},
        {"box tests", {"scene", "width", "height", "box_tests"}, box_tests_section},
        {"fidelity", {"rows"}, fidelity_section},
    };
    return kinds;
}

bool has_all(const Json& json, const std::vector<const char*>& keys) {
    return json.is_object() && std::ranges::all_of(keys, [&](const char* key) { return json.contains(key); });
}

bool is_run(const Json& json) { return has_all(json, {"scene", "config", "workloads", "total", "check"}); }
bool is_point(const Json& json) { return has_all(json, {"point", "design", "workload", "mrps"}); }
bool is_estimate(const Json& json) {
    return std::ranges::all_of(json.at("rows"), [](const Json& row) {
        return has_all(row, {"level", "mrps_low"});
    });
}

PageInput run_input(const Json& json, const std::string& file, const std::string& place) {
    PageInput input{file, "run", {}, {}};
    for (const Json& one : json.is_array() ? json : Json::array({json})) {
        input.runs.push_back(report_of_json(one));
        static_cast<void>(machine_of(input.runs.back(), place));
    }
    return input;
}

// Nothing when it is of no kind. `place` begins errors.
std::optional<PageInput> recognised(const Json& json, const std::string& file, const std::string& place) {
    if (is_run(json) || (json.is_array() && !json.empty() && std::ranges::all_of(json, is_run)))
        return run_input(json, file, place);
    if (json.is_array() && !json.empty() && is_point(json.front()))
        return PageInput{file, "sweep", {}, sweep_section(json)};
    for (const PageKind& kind : object_kinds()) {
        if (!has_all(json, kind.keys)) continue;
        if (kind.section == fidelity_section && !is_estimate(json)) continue;
        try {
            return PageInput{file, kind.name, {}, kind.section(json)};
        } catch (const Error& error) {
            throw Error("{}: {}", place, error.what());
        }
    }
    return std::nullopt;
}

std::string content(const std::filesystem::path& path) {
    model::RegularFile file(path);
    if (file.size_bytes() > max_result_bytes)
        throw Error("{}: expected a result of at most 1 GiB, got {} bytes", path.string(), file.size_bytes());
    std::string text(file.size_bytes(), '\0');
    file.read(text.data(), text.size());
    return text;
}

// What went wrong, without the library's number of it.
std::string reason(const Json::exception& error) {
    const std::string_view text = error.what();
    const std::size_t end = text.find("] ");
    return model::one_line(end == std::string_view::npos ? text : text.substr(end + 2));
}

}  // namespace

PageInput load_page_input(const std::filesystem::path& path) try {
    const std::string text = content(path), file = path.filename().string();
    if (text.starts_with("SQLite format 3")) return {file, "sweep", {}, sweep_database_section(path)};
    const Json json = Json::parse(text);
    if (auto input = recognised(json, file, path.string())) return std::move(*input);
    throw Error(
        "{}: expected a result of run, pairing, fidelity, stability, methods, precision, area, validate, "
        "stream or "
        "sweep, got other JSON",
        path.string());
} catch (const Json::parse_error& error) {
    throw Error("{}: expected a result in JSON or a database of sweeps: {}", path.string(), reason(error));
} catch (const Json::exception& error) {
    throw Error("{}: expected a whole result: {}", path.string(), reason(error));
}

}  // namespace rtu::study
