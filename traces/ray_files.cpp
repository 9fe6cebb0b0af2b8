#include "traces/ray_files.hpp"

#include <array>

#include "model/error.hpp"
#include "traces/csv_rays.hpp"
#include "traces/json_rays.hpp"
#include "traces/npy_header.hpp"
#include "traces/raw_rays.hpp"
#include "traces/trace_reader.hpp"
#include "traces/trace_writer.hpp"

namespace rtu::traces {
namespace {

namespace fs = std::filesystem;

struct FormatName {
    RayFormat format;
    std::string_view name;
    std::string_view extension;
};

constexpr std::array<FormatName, 6> format_names{{{RayFormat::Trace, "trace", ".rtutrace"},
                                                  {RayFormat::Rays7, "rays7", ".rays7"},
                                                  {RayFormat::Rays8, "rays8", ".rays8"},
                                                  {RayFormat::Csv, "csv", ".csv"},
                                                  {RayFormat::JsonLines, "jsonl", ".jsonl"},
                                                  {RayFormat::Npy, "npy", ".npy"}}};

class TraceRays final : public RayReader {
  public:
    explicit TraceRays(const fs::path& path) : reader_(path) {
        if (reader_.header().content != TraceContent::Rays) {
            throw Error("{}: expected a trace of rays, got one of visits", path.string());
        }
    }
    [[nodiscard]] const TraceHeader& header() const override { return reader_.header(); }
    [[nodiscard]] std::optional<RayChunk> next() override { return reader_.next_rays(); }
    [[nodiscard]] double share() const override { return reader_.share(); }

  private:
    TraceReader reader_;
};

class TraceOutput final : public RayWriter {
  public:
    TraceOutput(const fs::path& path, const TraceHeader& header) : writer_(path, header) {}
    void add(const RayChunk& chunk) override { writer_.add(chunk); }
    void finish() override { writer_.finish(); }

  private:
    TraceWriter writer_;
};

}  // namespace

RayFormat parse_ray_format(std::string_view name) {
    for (const FormatName& format : format_names) {
        if (format.name == name) return format.format;
    }
    throw Error("format of rays: expected trace, rays7, rays8, csv, jsonl or npy, got '{}'", name);
}

RayFormat format_of_input(const fs::path& path) {
    if (is_trace(path)) return RayFormat::Trace;
    return format_of_output(path);
}

RayFormat format_of_output(const fs::path& path) {
    const std::string extension = path.extension().string();
    for (const FormatName& format : format_names) {
        if (format.extension == extension) return format.format;
    }
    throw Error(
        "{}: expected a name that ends in .rtutrace, .rays7, .rays8, .csv, .jsonl or .npy, or the format by "
        "an "
        "option",
        path.string());
}

std::unique_ptr<RayReader> open_rays(const fs::path& path, RayFormat format, const ImportOptions& options) {
    switch (format) {
        case RayFormat::Trace:
            return std::make_unique<TraceRays>(path);
        case RayFormat::Rays7:
            return open_raw_rays(path, RawLayout{7, 0, std::nullopt}, options);
        case RayFormat::Rays8:
            return open_raw_rays(path, RawLayout{8, 0, std::nullopt}, options);
        case RayFormat::Npy:
            return open_raw_rays(path, read_npy_header(path), options);
        case RayFormat::Csv:
            return open_csv_rays(path, options);
        default:
            return open_json_rays(path, options);
    }
}

std::unique_ptr<RayWriter> create_rays(const fs::path& path, RayFormat format, const TraceHeader& header) {
    switch (format) {
        case RayFormat::Trace:
            return std::make_unique<TraceOutput>(path, header);
        case RayFormat::Rays7:
            return create_raw_rays(path, 7, RawHeader::None);
        case RayFormat::Rays8:
            return create_raw_rays(path, 8, RawHeader::None);
        case RayFormat::Npy:
            return create_raw_rays(path, 8, RawHeader::Npy);
        case RayFormat::Csv:
            return create_csv_rays(path);
        default:
            return create_json_rays(path);
    }
}

}  // namespace rtu::traces
