#include "study/sweep/sweep_file.hpp"

#include <algorithm>
#include <utility>

#include "model/error.hpp"
#include "model/regular_file.hpp"
#include "sim/presets.hpp"
#include "study/sweep/sweep_axes.hpp"
#include "study/sweep/sweep_chart_parser.hpp"
#include "study/toml_reader.hpp"

namespace rtu::study {
namespace {

// The RTL is one machine, not the many of a sweep.
FidelityLevel parse_level(std::string_view name) {
    using enum FidelityLevel;
    for (const FidelityLevel level : {Counts, Analytic, Sampled, Cycle, Auto}) {
        if (name == to_string(level)) return level;
    }
    throw Error("expected counts, analytic, sampled, cycle or auto, got '{}'", name);
}

namespace fs = std::filesystem;

constexpr std::uint64_t max_file_bytes = 1U << 20;

// Calls f; its errors, which do not say where, get the place.
template <class F>
auto at(const std::string& place, F f) {
    try {
        return f();
    } catch (const Error& error) {
        throw Error("{}: {}", place, error.what());
    }
}

class SweepFileParser {
  public:
    SweepFileParser(std::string_view text, const fs::path& path, const fs::path& scenes)
        : reader_(text, path.string()), path_(path), folder_(path.parent_path()), scenes_(scenes) {}

    SweepFile run() {
        const toml::table& root = reader_.root();
        reader_.check_keys(root, {"scenes", "workloads", "resolution", "camera", "seed", "edge_identity",
                                  "pairings", "presets", "fidelity", "tolerance", "objectives", "constraints",
                                  "subset", "set", "axes", "linked", "charts"});
        file_.name = path_.stem().string();
        read_inputs();
        read_rays();
        read_machines();
        read_fidelity();
        read_space();
        read_charts();
        return std::move(file_);
    }

  private:
    [[nodiscard]] const toml::node* find(std::string_view key) const { return reader_.root().get(key); }

    // Each text of a list, none twice, turned into what it means; `fallback` when there is no list.
    template <class F>
    auto list(std::string_view key, std::vector<std::string> fallback, F meaning) {
        std::vector<decltype(meaning(std::string(), std::string()))> result;
        const toml::node* node = find(key);
        if (node == nullptr) {
            for (const std::string& text : fallback) result.push_back(meaning(text, path_.string()));
            return result;
        }
        std::vector<std::string> seen;
        for (const toml::node& element : reader_.array(*node, std::string(key) + ", a list of names")) {
            const std::string text = reader_.text(element, std::string(key) + ", a list of names");
            const std::string place = reader_.place(element);
            if (std::ranges::find(seen, text) != seen.end())
                throw Error("{}: expected every name once, got '{}' again", place, text);
            seen.push_back(text);
            result.push_back(meaning(text, place));
        }
        if (result.empty() && !fallback.empty())
            throw Error("{}: {}: expected at least one", reader_.place(*node), key);
        return result;
    }

    [[nodiscard]] fs::path existing_file(const std::string& name, const std::string& place) const {
        fs::path path = folder_ / name;
        if (!scenes_.empty() && !fs::exists(path)) path = scenes_ / name;
        at(place, [&] { return model::RegularFile(path).size_bytes(); });
        return path;
    }

    SweepInput input(const toml::node& node) {
        const std::string expected = "a scene, or { scene, rays }";
        SweepInput result;
        result.place = reader_.place(node);
        const toml::table* table = node.as_table();
        const toml::node* scene = &node;
        if (table != nullptr) {
            reader_.check_keys(*table, {"scene", "rays", "format", "kind", "camera", "seed", "name"});
            scene = table->get("scene");
            if (scene == nullptr) throw Error("{}: expected {}, got no scene", result.place, expected);
        }
        const std::string name = reader_.text(*scene, expected);
        if (name != "builtin") result.scene.file = existing_file(name, result.place);
        if (table != nullptr) read_input_table(*table, result);
        return result;
    }

    void read_input_table(const toml::table& table, SweepInput& result) {
        const toml::node* camera = table.get("camera");
        if (camera != nullptr) result.camera_file = existing_camera(*camera, result.scene.name());
        if (const toml::node* seed = table.get("seed"))
            result.seed = reader_.number(*seed, "a seed", 0, INT64_MAX);
        if (const toml::node* label = table.get("name")) result.label = reader_.text(*label, "a name");
        const toml::node* rays = table.get("rays");
        if (rays == nullptr) {
            for (const char* key : {"format", "kind"}) {
                if (table.contains(key)) throw Error("{}: {} is of rays, got no rays", result.place, key);
            }
            return;
        }
        if (camera != nullptr || result.seed)
            throw Error("{}: expected no camera or seed: rays of a file have theirs", result.place);
        result.rays = ray_input(*rays, table, result.place);
    }

    [[nodiscard]] fs::path existing_camera(const toml::node& node, const std::string& scene) const {
        const std::string place = reader_.place(node);
        const fs::path path = existing_file(reader_.text(node, "the name of a file"), place);
        at(place, [&] { return model::load_camera(path, scene); });
        return path;
    }

    RayInput ray_input(const toml::node& rays, const toml::table& table, const std::string& place) {
        RayInput result;
        result.file = existing_file(reader_.text(rays, "the name of a file"), place);
        const auto option = [&](const char* key, const char* fallback) {
            const toml::node* node = table.get(key);
            return node == nullptr ? std::string(fallback) : reader_.text(*node, "a name");
        };
        at(place, [&] {
            const std::string format = option("format", "");
            result.format =
                format.empty() ? traces::format_of_input(result.file) : traces::parse_ray_format(format);
            result.import.kind = traces::parse_ray_kind(option("kind", "closest"));
            return 0;
        });
        return result;
    }

    void read_inputs() {
        const toml::node* scenes = find("scenes");
        if (scenes == nullptr) throw Error("{}:1: expected scenes, a list of files", path_.string());
        for (const toml::node& node : reader_.array(*scenes, "scenes, a list of files")) {
            file_.inputs.push_back(input(node));
            for (std::size_t i = 0; i + 1 < file_.inputs.size(); ++i) {
                if (file_.inputs[i].name() != file_.inputs.back().name()) continue;
                throw Error("{}: two scenes are called '{}'", file_.inputs.back().place,
                            file_.inputs.back().name());
            }
        }
        if (file_.inputs.empty()) throw Error("{}: scenes: expected at least one", reader_.place(*scenes));
    }

    void read_rays() {
        file_.workloads = list("workloads", {"primary", "shadow", "diffuse"},
                               [](const std::string& text, const std::string& place) {
                                   return at(place, [&] { return model::parse_workload_kind(text); });
                               });
        if (const toml::node* node = find("resolution")) file_.resolution = resolution(*node);
        if (const toml::node* node = find("camera")) {
            const std::string place = reader_.place(*node);
            file_.camera_file = existing_file(reader_.text(*node, "the name of a file"), place);
            for (const SweepInput& input : file_.inputs) {
                at(place, [&] { return model::load_camera(*file_.camera_file, input.scene.name()); });
            }
        }
        if (const toml::node* node = find("seed")) {
            file_.seed = reader_.number(*node, "a seed", 0, INT64_MAX);
        }
    }

    [[nodiscard]] model::Resolution resolution(const toml::node& node) const {
        constexpr std::uint64_t most_pixels = 1 << 26;
        const std::string expected = "resolution = [width, height]";
        const toml::array& sides = reader_.array(node, expected);
        if (sides.size() != 2) throw Error("{}: expected {}", reader_.place(node), expected);
        const std::uint64_t width = reader_.number(sides[0], "a width in pixels", 1, 16384);
        const std::uint64_t height = reader_.number(sides[1], "a height in pixels", 1, 16384);
        if (width * height > most_pixels)
            throw Error("{}: expected at most {} pixels", reader_.place(node), most_pixels);
        return {std::uint32_t(width), std::uint32_t(height)};
    }

    void read_machines() {
        file_.pairings =
            list("pairings", {"edge_bbsa"}, [](const std::string& text, const std::string& place) {
                return at(place, [&] { return model::parse_pairing_method(text); });
            });
        file_.presets = list("presets", {"default"}, [](const std::string& text, const std::string& place) {
            return at(place, [&] { return std::string(sim::find_preset(text).name); });
        });
        if (const toml::node* node = find("edge_identity")) {
            file_.edge_identity = at(reader_.place(*node), [&] {
                return model::parse_edge_identity(reader_.text(*node, "position or index"));
            });
        }
    }

    [[nodiscard]] bool is_estimated() const { return file_.fidelity != FidelityLevel::Cycle; }

    void read_fidelity() {
        if (const toml::node* node = find("fidelity")) {
            const std::string text = reader_.text(*node, "fidelity, a name");
            file_.fidelity = at(reader_.place(*node), [&] { return parse_level(text); });
        }
        const toml::node* node = find("tolerance");
        if (node == nullptr) return;
        const std::optional<double> percent = node->value<double>();
        if (!percent || !(*percent >= 0.6) || *percent > 50)
            throw Error("{}: expected tolerance, a number from 0.6 to 50 percent", reader_.place(*node));
        if (file_.fidelity != FidelityLevel::Sampled && file_.fidelity != FidelityLevel::Auto)
            throw Error("{}: a tolerance is of fidelity sampled and auto only", reader_.place(*node));
        file_.tolerance = *percent / 100;
    }

    // Throws for an objective that an estimate does not tell.
    [[nodiscard]] SweepObjective objective(const std::string& text, const std::string& place) const {
        SweepObjective result = parse_sweep_objective(text, place);
        if (is_estimated() && result.needs_counters())
            throw Error("{}: {} needs fidelity cycle: an estimate has no counters", place, result.name());
        return result;
    }

    void read_charts() {
        const toml::node* node = find("charts");
        if (node == nullptr) return;
        for (const toml::node& element : reader_.array(*node, "[[charts]], tables"))
            file_.charts.push_back(
                parse_sweep_chart(reader_, reader_.table(element, "[[charts]], tables"), file_.charts));
    }

    void read_space() {
        if (const toml::node* node = find("set"))
            file_.fixed = parse_settings(reader_, reader_.table(*node, "[set], a table of keys"));
        if (const toml::node* node = find("axes"))
            file_.axes = parse_axes(reader_, reader_.table(*node, "[axes], a table of keys"));
        if (const toml::node* node = find("linked")) {
            for (const toml::node& element : reader_.array(*node, "[[linked]], tables of keys")) {
                file_.axes.push_back(
                    parse_linked_axis(reader_, reader_.table(element, "[[linked]], tables of keys")));
            }
        }
        check_keys_once(file_.fixed, file_.axes);
        file_.constraints = list("constraints", {}, [](const std::string& text, const std::string& place) {
            return SweepConstraint(text, place);
        });
        file_.objectives = list(
            "objectives", {"mrps", is_estimated() ? "mgates" : "bytes_per_ray"},
            [this](const std::string& text, const std::string& place) { return objective(text, place); });
        if (const toml::node* node = find("subset")) file_.subset = subset(*node);
    }

    [[nodiscard]] SweepSubset subset(const toml::node& node) const {
        const std::string expected =
            "subset = { method = \"sobol\" or \"random\", designs = ..., seed = ... }";
        const toml::table& table = reader_.table(node, expected);
        reader_.check_keys(table, {"method", "designs", "seed"});
        const toml::node *method = table.get("method"), *designs = table.get("designs");
        if (method == nullptr || designs == nullptr)
            throw Error("{}: expected {}", reader_.place(node), expected);
        SweepSubset result;
        result.place = reader_.place(node);
        const std::string name = reader_.text(*method, "sobol or random");
        if (name != "sobol" && name != "random")
            throw Error("{}: expected sobol or random, got '{}'", reader_.place(*method), name);
        result.method = name == "sobol" ? SweepSubset::Method::Sobol : SweepSubset::Method::Random;
        result.designs = reader_.number(*designs, "designs", 1, 1'000'000);
        if (const toml::node* seed = table.get("seed"))
            result.seed = reader_.number(*seed, "a seed", 0, INT64_MAX);
        return result;
    }

    TomlReader reader_;
    fs::path path_;
    fs::path folder_;
    fs::path scenes_;
    SweepFile file_;
};

}  // namespace

SweepFile parse_sweep(std::string_view text, const fs::path& path, const fs::path& scenes) {
    SweepFile file = SweepFileParser(text, path, scenes).run();
    file.text = text;
    return file;
}

SweepFile read_sweep_file(const fs::path& path, const fs::path& scenes) {
    model::RegularFile file(path);
    if (file.size_bytes() > max_file_bytes)
        throw Error("{}: expected a sweep of at most {} bytes", path.string(), max_file_bytes);
    std::string text(file.size_bytes(), '\0');
    file.read(text.data(), text.size());
    return parse_sweep(text, path, scenes);
}

}  // namespace rtu::study
