#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "model/camera.hpp"
#include "model/error.hpp"
#include "model/one_line.hpp"
#include "model/regular_file.hpp"
#include "model/sampling.hpp"

namespace rtu::model {
namespace {

// Where a value stands, as errors name it: "cameras.toml:12".
std::string place(const std::filesystem::path& file, const toml::node& node) {
    return fmt::format("{}:{}", file.string(), node.source().begin.line);
}

std::optional<float> read_float(const toml::node& node) {
    const std::optional<double> value = node.value<double>();
    if (!value || !std::isfinite(float(*value))) return std::nullopt;
    return float(*value);
}

Vec3 read_direction(const std::filesystem::path& file, std::string_view key, const toml::node& node) {
    Vec3 result;
    const toml::array* array = node.as_array();
    bool is_good = array != nullptr && array->size() == 3;
    for (std::size_t axis = 0; is_good && axis < 3; ++axis) {
        const std::optional<float> value = read_float((*array)[axis]);
        is_good = value.has_value();
        result[axis] = value.value_or(0.0F);
    }
    if (!is_good) throw Error("{}: {}: expected three finite numbers [x, y, z]", place(file, node), key);
    return result;
}

Vec3 read_point(const std::filesystem::path& file, std::string_view key, const toml::node& node) {
    const Vec3 point = read_direction(file, key, node);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(std::abs(point[axis]) <= max_coordinate)) {
            throw Error("{}: {}: expected coordinates of at most {:g}, got {:g}", place(file, node), key,
                        max_coordinate, point[axis]);
        }
    }
    return point;
}

float read_tan_half_fov(const std::filesystem::path& file, const toml::node& node) {
    const std::optional<float> value = read_float(node);
    if (!value || !(*value > 0 && *value <= 100)) {
        throw Error("{}: tan_half_fov: expected a number above 0 and at most 100", place(file, node));
    }
    return *value;
}

void check_view(const std::filesystem::path& file, const toml::table& table, const Camera& camera) {
    const std::optional<Vec3> forward = direction_between(camera.eye, camera.target);
    if (!forward) throw Error("{}: eye and target are the same point", place(file, table));
    const std::optional<Vec3> up = direction_of(camera.up);
    // Below a millionth the rounding of `up` would decide which way the picture turns.
    if (!up || !(length(cross(*forward, *up)) > 1e-6F)) {
        throw Error("{}: up: expected a direction that is not parallel to the view", place(file, table));
    }
}

Camera read_camera(const std::filesystem::path& file, const toml::table& table) {
    Camera camera;
    for (const auto& [key, node] : table) {
        if (key == "eye") {
            camera.eye = read_point(file, key, node);
        } else if (key == "target") {
            camera.target = read_point(file, key, node);
        } else if (key == "up") {
            camera.up = read_direction(file, key, node);
        } else if (key == "tan_half_fov") {
            camera.tan_half_fov = read_tan_half_fov(file, node);
        } else {
            throw Error("{}: expected eye, target, up or tan_half_fov, got '{}'", place(file, node),
                        key.str());
        }
    }
    for (const char* key : {"eye", "target", "up", "tan_half_fov"}) {
        if (!table.contains(key)) throw Error("{}: camera without the key '{}'", place(file, table), key);
    }
    check_view(file, table, camera);
    return camera;
}

toml::table parse(const std::filesystem::path& file) {
    constexpr std::uint64_t longest = 1 << 20;  // thousands of cameras
    RegularFile stream(file);
    if (stream.size_bytes() > longest)
        throw Error("{}: expected a camera file of at most 1 MiB", file.string());
    std::string text(stream.size_bytes(), '\0');
    stream.read(text.data(), text.size());
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        throw Error("{}:{}: {}", file.string(), error.source().begin.line, one_line(error.description()));
    }
}

}  // namespace

std::optional<Camera> load_camera(const std::filesystem::path& file, std::string_view scene_name) {
    const toml::table root = parse(file);
    const bool has_tables =
        std::any_of(root.begin(), root.end(), [](const auto& entry) { return entry.second.is_table(); });
    if (!has_tables) return read_camera(file, root);
    std::optional<Camera> result;
    for (const auto& [key, node] : root) {  // all of them: a slip in any table is reported, whichever is used
        if (!node.is_table()) throw Error("{}: expected tables only, got '{}'", place(file, node), key.str());
        const Camera camera = read_camera(file, *node.as_table());
        if (key == scene_name) result = camera;
    }
    return result;
}

}  // namespace rtu::model
