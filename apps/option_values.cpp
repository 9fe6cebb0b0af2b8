#include "apps/option_values.hpp"

#include <algorithm>
#include <charconv>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "model/regular_file.hpp"
#include "study/output_file.hpp"

namespace rtu::apps {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::optional<std::uint64_t> parse_count(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::optional<fs::path> optional_path(const std::string& text) {
    return text.empty() ? std::nullopt : std::optional<fs::path>(text);
}

std::vector<std::string_view> split(std::string_view text) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

std::vector<std::string> parse_list(std::string_view option, std::string_view text) {
    std::vector<std::string> parts;
    if (text.empty()) return parts;
    for (const std::string_view part : split(text)) {
        if (std::ranges::find(parts, part) != parts.end())
            throw Error("{}: '{}' is given twice", option, model::one_line(part));
        parts.emplace_back(part);
    }
    return parts;
}

std::uint64_t parse_seed(std::string_view text) {
    const auto seed = parse_count(text);
    if (!seed) throw Error("--seed: expected a number from 0 to 2^64 - 1, got '{}'", text);
    return *seed;
}

model::Resolution parse_resolution(std::string_view text) {
    const std::size_t cross = std::min(text.find('x'), text.size());
    const auto width = parse_count(text.substr(0, cross));
    const auto height = parse_count(text.substr(std::min(cross + 1, text.size())));
    constexpr std::uint64_t most_pixels = 1 << 26;  // each costs about 100 bytes of host memory
    const auto is_side = [](auto side) { return side && *side >= 1 && *side <= 16384; };
    if (!is_side(width) || !is_side(height) || *width * *height > most_pixels) {
        throw Error(
            "--resolution: expected WIDTHxHEIGHT with sides of 1 to 16384 pixels, {} in all, got '{}'",
            most_pixels, text);
    }
    return {std::uint32_t(*width), std::uint32_t(*height)};
}

std::vector<model::WorkloadKind> parse_workloads(std::string_view text) {
    std::vector<model::WorkloadKind> kinds;
    for (const std::string_view name : split(text)) {
        const model::WorkloadKind kind = model::parse_workload_kind(name);
        if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) {
            throw Error("--workload: '{}' is given twice", to_string(kind));
        }
        kinds.push_back(kind);
    }
    return kinds;
}

std::vector<study::SceneSource> parse_scenes(const std::vector<std::string>& names) {
    std::vector<study::SceneSource> scenes;
    for (const std::string& name : names) {
        const model::RegularFile probe{name};  // throws for what is not there or no file
        scenes.push_back({name});
    }
    if (scenes.empty()) scenes.emplace_back();  // the built-in one
    return scenes;
}

std::vector<study::SceneSource> parse_scenes_or_builtin(const std::vector<std::string>& names) {
    std::vector<study::SceneSource> scenes;
    for (const std::string& name : names) {
        scenes.push_back(name == "builtin" ? study::SceneSource{} : parse_scenes({name}).front());
    }
    return scenes;
}

study::RayInput parse_ray_input(const std::string& file, const std::string& format, const std::string& kind,
                                bool is_forced) {
    const model::RegularFile probe{file};  // throws for what is not there or no file
    study::RayInput input;
    input.file = file;
    input.import.kind = traces::parse_ray_kind(kind);
    input.format = format.empty() ? traces::format_of_input(file) : traces::parse_ray_format(format);
    input.is_forced = is_forced;
    return input;
}

study::FidelityLevel parse_fidelity(std::string_view text) {
    try {
        return study::parse_fidelity_level(text);
    } catch (const Error& error) {
        throw Error("--fidelity: {}", error.what());
    }
}

double parse_tolerance(std::string_view text) {
    constexpr double least = 0.6, most = 50;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !(value >= least && value <= most)) {
        throw Error("--tolerance: expected a number of percent from {} to {}, got '{}'", least, most, text);
    }
    return value / 100;
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error)) return true;
    const auto full = [&error](const fs::path& path) {
        return fs::weakly_canonical(fs::absolute(path), error);
    };
    return full(a) == full(b);
}

void check_cameras(const std::optional<fs::path>& file, const std::vector<study::SceneSource>& scenes) {
    if (!file) return;
    for (const study::SceneSource& scene : scenes) {
        static_cast<void>(model::load_camera(*file, scene.name()));  // for its errors
    }
}

void check_output(const fs::path& output, const std::vector<fs::path>& inputs) {
    if (output == "-")
        throw Error("-: only --json can go to standard output; for a file of that name, say ./-");
    study::check_writable(output);
    for (const fs::path& input : inputs) {
        if (is_same_file(input, output)) {
            throw Error("{}: is an input of this run, and would be overwritten", output.string());
        }
    }
}

}  // namespace rtu::apps
