#include "traces/text_rays.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "model/regular_file.hpp"
#include "traces/partial_file.hpp"

namespace rtu::traces {
namespace {

namespace fs = std::filesystem;

// Lines of a file that is read in pieces, so that neither a long file nor a long line fills the memory.
class Lines {
  public:
    explicit Lines(const fs::path& path) : path_(path), file_(path) {}

    std::optional<std::string> next() {
        std::size_t end = buffer_.find('\n', position_);
        while (end == std::string::npos && read_ < file_.size_bytes()) {
            if (buffer_.size() - position_ > longest_line) {
                throw Error("{}:{}: expected lines of at most {} bytes", path_.string(), number_ + 1,
                            longest_line);
            }
            refill();
            end = buffer_.find('\n');
        }
        if (position_ == buffer_.size()) return std::nullopt;
        ++number_;
        std::string line = buffer_.substr(position_, end == std::string::npos ? end : end - position_);
        position_ = end == std::string::npos ? buffer_.size() : end + 1;
        if (line.ends_with('\r')) line.pop_back();
        return line;
    }
    [[nodiscard]] std::uint64_t number() const { return number_; }
    [[nodiscard]] double share() const {
        return file_.size_bytes() == 0 ? 1.0 : double(read_) / double(file_.size_bytes());
    }

  private:
    static constexpr std::size_t longest_line = 1 << 16;

    void refill() {
        buffer_.erase(0, position_);
        position_ = 0;
        const std::size_t old = buffer_.size();
        const std::uint64_t more = std::min<std::uint64_t>(longest_line, file_.size_bytes() - read_);
        buffer_.resize(old + more);
        file_.read(buffer_.data() + old, more);
        read_ += more;
    }

    fs::path path_;
    model::RegularFile file_;
    std::string buffer_;
    std::size_t position_ = 0;
    std::uint64_t read_ = 0;
    std::uint64_t number_ = 0;
};

class TextRays final : public RayReader {
  public:
    TextRays(const fs::path& path, ParseLine parse)
        : path_(path), lines_(path), parse_(std::move(parse)), row_(next_row()) {}
    [[nodiscard]] const TraceHeader& header() const override { return header_; }
    [[nodiscard]] double share() const override { return lines_.share(); }
    [[nodiscard]] std::optional<RayChunk> next() override {
        if (!row_) return std::nullopt;
        RayChunk chunk{row_->workload, row_->kind, row_->id_kind, 0, {}, {}};
        chunk.first_ray = chunk.workload == workload_ ? ray_count_ : 0;
        while (row_ && chunk.rays.size() < import_chunk_rays && row_->workload == chunk.workload &&
               row_->kind == chunk.kind && row_->id_kind == chunk.id_kind) {
            chunk.rays.push_back(row_->ray);
            if (chunk.id_kind != IdKind::None) chunk.ids.push_back(row_->id);
            row_ = next_row();
        }
        workload_ = chunk.workload;
        ray_count_ = chunk.first_ray + chunk.rays.size();
        return chunk;
    }

  private:
    std::optional<RayRow> next_row() {
        while (const std::optional<std::string> line = lines_.next()) {
            try {
                std::optional<RayRow> row = parse_(*line);
                if (!row) continue;
                if (is_workload_name(row->workload)) return row;
                throw Error("workload: expected 1 to {} letters, digits, '_', '-' and '.', got '{}'",
                            name_bytes, model::one_line(row->workload));
            } catch (const Error& error) {
                throw Error("{}:{}: {}", path_.string(), lines_.number(), error.what());
            }
        }
        return std::nullopt;
    }

    fs::path path_;
    Lines lines_;
    ParseLine parse_;
    TraceHeader header_ = header_of_rays("import");
    std::optional<RayRow> row_;  // the next one
    std::string workload_;
    std::uint64_t ray_count_ = 0;
};

class TextOutput final : public RayWriter {
  public:
    TextOutput(const fs::path& path, const std::string& head, FormatLine format)
        : file_(path, PartialFile::OnFullDisk::Remove), format_(std::move(format)) {
        file_.write(head);
    }
    void add(const RayChunk& chunk) override {
        std::string text;
        RayRow row{{}, chunk.workload, chunk.kind, chunk.id_kind, 0};
        for (std::size_t i = 0; i < chunk.rays.size(); ++i) {
            row.ray = chunk.rays[i];
            if (row.id_kind != IdKind::None) row.id = chunk.ids[i];
            text += format_(row);
        }
        file_.write(text);
    }
    void finish() override { file_.commit(); }

  private:
    PartialFile file_;
    FormatLine format_;
};

template <class Number>
std::optional<Number> parse(std::string_view text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

}  // namespace

std::unique_ptr<RayReader> open_text_rays(const fs::path& path, ParseLine parse) {
    return std::make_unique<TextRays>(path, std::move(parse));
}

std::unique_ptr<RayWriter> create_text_rays(const fs::path& path, std::string head, FormatLine format) {
    return std::make_unique<TextOutput>(path, head, std::move(format));
}

std::optional<float> parse_float(std::string_view text) { return parse<float>(text); }
std::string float_text(float value) { return fmt::format("{}", value); }
std::optional<std::uint32_t> parse_id(std::string_view text) { return parse<std::uint32_t>(text); }

}  // namespace rtu::traces
