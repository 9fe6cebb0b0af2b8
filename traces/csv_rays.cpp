#include "traces/csv_rays.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "traces/text_rays.hpp"

namespace rtu::traces {
namespace {

constexpr std::array<std::string_view, 12> column_names{
    "origin_x",    "origin_y", "origin_z", "t_min", "direction_x", "direction_y",
    "direction_z", "t_max",    "workload", "kind",  "pixel",       "parent"};
constexpr std::size_t number_columns = 8;

std::vector<std::string_view> cells(std::string_view line) {
    std::vector<std::string_view> result;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        result.push_back(line.substr(begin, end - begin));
        begin = end + 1;
    }
    return result;
}

float& number(model::Ray& ray, std::size_t column) {
    if (column < 3) return ray.origin[column];
    if (column == 3) return ray.t_min;
    return column < 7 ? ray.direction[column - 4] : ray.t_max;
}

class CsvParser {
  public:
    explicit CsvParser(const ImportOptions& options) {
        defaults_.workload = options.workload;
        defaults_.kind = options.kind;
        defaults_.ray.t_max = std::numeric_limits<float>::infinity();
    }
    std::optional<RayRow> operator()(std::string_view line) {
        if (columns_.empty()) {
            read_names(line);
            return std::nullopt;
        }
        if (line.empty()) return std::nullopt;
        const std::vector<std::string_view> values = cells(line);
        if (values.size() != columns_.size()) {
            throw Error("expected {} cells, got {}", columns_.size(), values.size());
        }
        RayRow row = defaults_;
        for (std::size_t i = 0; i < values.size(); ++i) read_cell(row, columns_[i], values[i]);
        return row;
    }

  private:
    void read_names(std::string_view line) {
        for (const std::string_view name : cells(line)) {
            const auto found = std::find(column_names.begin(), column_names.end(), name);
            if (found == column_names.end()) throw Error("unknown column '{}'", model::one_line(name));
            const auto column = std::size_t(found - column_names.begin());
            if (has(column)) throw Error("column {} is there twice", name);
            columns_.push_back(column);
        }
        for (std::size_t column = 0; column < number_columns; ++column) {
            const bool is_needed = column != 3 && column != 7;
            if (is_needed && !has(column)) throw Error("expected a column {}", column_names[column]);
        }
        if (has(10) && has(11)) throw Error("expected one column of ids, got pixel and parent");
    }
    [[nodiscard]] bool has(std::size_t column) const {
        return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
    }
    static void read_cell(RayRow& row, std::size_t column, std::string_view text) {
        const auto fail = [&](const char* expected) {
            throw Error("{}: expected {}, got '{}'", column_names[column], expected, model::one_line(text));
        };
        if (column < number_columns) {
            const std::optional<float> value = parse_float(text);
            if (!value) fail("a number");
            number(row.ray, column) = *value;
        } else if (column == 8) {
            row.workload = text;
        } else if (column == 9) {
            row.kind = parse_ray_kind(text);
        } else if (!text.empty()) {
            const std::optional<std::uint32_t> id = parse_id(text);
            if (!id) fail("a number below 2^32");
            row.id = *id;
            row.id_kind = column == 10 ? IdKind::Pixel : IdKind::Parent;
        }
    }

    RayRow defaults_;
    std::vector<std::size_t> columns_;
};

class CsvOutput final : public RayWriter {
  public:
    explicit CsvOutput(const std::filesystem::path& path) : path_(path) {}
    void add(const RayChunk& chunk) override {
        if (chunk.id_kind == IdKind::None && !id_kind_) {
            start(IdKind::Pixel);
        } else if (!id_kind_) {
            start(chunk.id_kind);
        }
        if (chunk.id_kind != IdKind::None && chunk.id_kind != *id_kind_) {
            throw Error("{}: expected ids of one kind, got pixel and parent", path_.string());
        }
        rows_->add(chunk);
    }
    void finish() override {
        if (!id_kind_) start(IdKind::Pixel);
        rows_->finish();
    }

  private:
    void start(IdKind id_kind) {
        id_kind_ = id_kind;
        std::string head;
        for (std::size_t column = 0; column < 10; ++column) head += std::string(column_names[column]) + ',';
        head += std::string(to_string(id_kind)) + '\n';
        rows_ = create_text_rays(path_, head, [](const RayRow& row) {
            std::string line;
            model::Ray ray = row.ray;
            for (std::size_t column = 0; column < number_columns; ++column) {
                line += float_text(number(ray, column)) + ',';
            }
            return line + fmt::format("{},{},{}\n", row.workload, to_string(row.kind),
                                      row.id_kind == IdKind::None ? "" : fmt::format("{}", row.id));
        });
    }

    std::filesystem::path path_;
    std::optional<IdKind> id_kind_;
    std::unique_ptr<RayWriter> rows_;
};

}  // namespace

std::unique_ptr<RayReader> open_csv_rays(const std::filesystem::path& path, const ImportOptions& options) {
    return open_text_rays(path, CsvParser(options));
}

std::unique_ptr<RayWriter> create_csv_rays(const std::filesystem::path& path) {
    return std::make_unique<CsvOutput>(path);
}

}  // namespace rtu::traces
