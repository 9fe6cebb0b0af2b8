#include "traces/json_rays.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "traces/text_rays.hpp"

namespace rtu::traces {
namespace {

using Json = nlohmann::json;
using Key = std::string;

[[noreturn]] void fail(const Key& key, const char* expected, const Json& got) {
    throw Error("{}: expected {}, got {}", key, expected,
                model::one_line(got.dump(-1, ' ', false, Json::error_handler_t::replace)));
}

float real(const Key& key, const Json& value) {
    constexpr const char* expected = "a number of binary32, \"inf\", \"-inf\" or \"nan\"";
    if (value.is_string()) {
        const std::optional<float> number = parse_float(value.get_ref<const std::string&>());
        if (!number || std::isfinite(*number)) fail(key, expected, value);
        return *number;
    }
    if (!value.is_number()) fail(key, expected, value);
    const auto number = float(value.get<double>());
    if (!std::isfinite(number)) fail(key, expected, value);
    return number;
}

model::Vec3 vector(const Key& key, const Json& value) {
    if (!value.is_array() || value.size() != 3) fail(key, "an array of three numbers", value);
    return {real(key, value[0]), real(key, value[1]), real(key, value[2])};
}

std::string text(const Key& key, const Json& value) {
    if (!value.is_string()) fail(key, "a string", value);
    return value.get<std::string>();
}

void read_member(RayRow& row, const Key& key, const Json& value) {
    if (key == "origin") {
        row.ray.origin = vector(key, value);
    } else if (key == "direction") {
        row.ray.direction = vector(key, value);
    } else if (key == "t_min") {
        row.ray.t_min = real(key, value);
    } else if (key == "t_max") {
        row.ray.t_max = real(key, value);
    } else if (key == "workload") {
        row.workload = text(key, value);
    } else if (key == "kind") {
        row.kind = parse_ray_kind(text(key, value));
    } else if (key == "pixel" || key == "parent") {
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() > ~std::uint32_t{0}) {
            fail(key, "a whole number below 2^32", value);
        }
        if (row.id_kind != IdKind::None) throw Error("expected one id, got pixel and parent");
        row.id = value.get<std::uint32_t>();
        row.id_kind = key == "pixel" ? IdKind::Pixel : IdKind::Parent;
    } else {
        throw Error("unknown key '{}'", model::one_line(key));
    }
}

// The library would let the last of several members of one name win.
Json parse_object(std::string_view line) {
    std::set<std::string> keys;
    const auto note_key = [&keys](int depth, Json::parse_event_t event, Json& value) {
        if (event == Json::parse_event_t::key && depth == 1 &&
            !keys.insert(value.get<std::string>()).second) {
            throw Error("key '{}' is there twice", model::one_line(value.get<std::string>()));
        }
        return true;
    };
    try {
        return Json::parse(line, note_key);
    } catch (const Json::parse_error& error) {
        throw Error("column {}: not JSON", error.byte);
    } catch (const Json::out_of_range&) {
        throw Error("expected numbers of binary32");
    }
}

RayRow parse(std::string_view line, const ImportOptions& options) {
    const Json object = parse_object(line);
    if (!object.is_object()) throw Error("expected an object {{...}}");
    for (const char* key : {"origin", "direction"}) {
        if (!object.contains(key)) throw Error("expected the key '{}'", key);
    }
    RayRow row;
    row.workload = options.workload;
    row.kind = options.kind;
    row.ray.t_max = std::numeric_limits<float>::infinity();
    for (const auto& [key, value] : object.items()) read_member(row, key, value);
    return row;
}

// The shortest text that becomes the same number again although readers of JSON round it to binary64 first,
// and take "-0" for a whole number, which has no sign.
std::string json_text(float value) {
    if (!std::isfinite(value)) return '"' + float_text(value) + '"';
    std::string text = float_text(value);
    double read = 0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    if (float(read) != value) text = fmt::format("{}", double(value));
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string json_text(model::Vec3 v) {
    return fmt::format("[{}, {}, {}]", json_text(v.x), json_text(v.y), json_text(v.z));
}

std::string line(const RayRow& row) {
    return fmt::format(
        "{{\"origin\": {}, \"t_min\": {}, \"direction\": {}, \"t_max\": {}, \"workload\": \"{}\", \"kind\": "
        "\"{}\"{}}}\n",
        json_text(row.ray.origin), json_text(row.ray.t_min), json_text(row.ray.direction),
        json_text(row.ray.t_max), row.workload, to_string(row.kind),
        row.id_kind == IdKind::None ? "" : fmt::format(", \"{}\": {}", to_string(row.id_kind), row.id));
}

}  // namespace

std::unique_ptr<RayReader> open_json_rays(const std::filesystem::path& path, const ImportOptions& options) {
    return open_text_rays(path, [options](std::string_view text) -> std::optional<RayRow> {
        if (text.find_first_not_of(' ') == std::string_view::npos) return std::nullopt;
        return parse(text, options);
    });
}

std::unique_ptr<RayWriter> create_json_rays(const std::filesystem::path& path) {
    return create_text_rays(path, "", line);
}

}  // namespace rtu::traces
