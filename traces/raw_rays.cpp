#include "traces/raw_rays.hpp"

#include <algorithm>
#include <string>

#include "model/error.hpp"
#include "model/regular_file.hpp"
#include "traces/bytes.hpp"
#include "traces/npy_header.hpp"
#include "traces/partial_file.hpp"
#include "traces/ray_files.hpp"

namespace rtu::traces {
namespace {

namespace fs = std::filesystem;

model::Vec3 read_vec3(ByteReader& in) {
    model::Vec3 v;
    for (std::size_t axis = 0; axis < 3; ++axis) v[axis] = in.real();
    return v;
}

class RawRays final : public RayReader {
  public:
    RawRays(const fs::path& path, const RawLayout& layout, const ImportOptions& options)
        : file_(path), layout_(layout), options_(options) {
        const std::uint64_t ray_bytes = 4 * std::uint64_t(layout.floats_per_ray);
        const std::uint64_t bytes = file_.size_bytes() - layout.offset;
        ray_count_ = bytes / ray_bytes;
        if (bytes % ray_bytes != 0) {
            throw Error("{}: byte {}: expected rays of {} bytes, found {} bytes after the last",
                        path.string(), layout.offset + ray_count_ * ray_bytes, ray_bytes, bytes % ray_bytes);
        }
        if (layout.ray_count && *layout.ray_count != ray_count_) {
            throw Error("{}: byte {}: expected {} rays, found {}", path.string(), layout.offset,
                        *layout.ray_count, ray_count_);
        }
        file_.seek(layout.offset);
    }
    [[nodiscard]] const TraceHeader& header() const override { return header_; }
    [[nodiscard]] double share() const override {
        return ray_count_ == 0 ? 1.0 : double(next_) / double(ray_count_);
    }
    [[nodiscard]] std::optional<RayChunk> next() override {
        if (has_begun_ && next_ == ray_count_) return std::nullopt;
        has_begun_ = true;
        const std::uint64_t count = std::min<std::uint64_t>(import_chunk_rays, ray_count_ - next_);
        std::string bytes(4 * layout_.floats_per_ray * count, '\0');
        file_.read(bytes.data(), bytes.size());
        ByteReader in(bytes);
        RayChunk chunk{options_.workload, options_.kind, IdKind::None, next_, {}, {}};
        chunk.rays.reserve(count);
        for (std::uint64_t i = 0; i < count; ++i) {
            model::Ray ray;
            ray.origin = read_vec3(in);
            if (layout_.floats_per_ray == 8) ray.t_min = in.real();
            ray.direction = read_vec3(in);
            ray.t_max = in.real();
            chunk.rays.push_back(ray);
        }
        next_ += count;
        return chunk;
    }

  private:
    model::RegularFile file_;
    RawLayout layout_;
    ImportOptions options_;
    TraceHeader header_ = header_of_rays("import");
    std::uint64_t ray_count_ = 0;
    std::uint64_t next_ = 0;
    bool has_begun_ = false;
};

class RawOutput final : public RayWriter {
  public:
    RawOutput(const fs::path& path, std::uint32_t floats_per_ray, RawHeader header)
        : path_(path),
          file_(path, PartialFile::OnFullDisk::Remove),
          floats_per_ray_(floats_per_ray),
          header_(header) {
        if (header_ == RawHeader::Npy) file_.write(npy_header(0));
    }
    void add(const RayChunk& chunk) override {
        if (workload_.value_or(chunk.workload) != chunk.workload) {
            throw Error("{}: expected rays of one workload, got '{}' and '{}': choose one by --workload",
                        path_.string(), *workload_, chunk.workload);
        }
        workload_ = chunk.workload;
        ByteWriter out;
        for (const model::Ray& ray : chunk.rays) append(out, ray);
        file_.write(out.bytes());
    }
    void finish() override {
        if (header_ == RawHeader::Npy) file_.rewrite(0, npy_header(ray_count_));
        file_.commit();
    }

  private:
    void append(ByteWriter& out, const model::Ray& ray) {
        for (std::size_t axis = 0; axis < 3; ++axis) out.number(ray.origin[axis]);
        if (floats_per_ray_ == 8) {
            out.number(ray.t_min);
        } else if (ray.t_min != 0) {
            throw Error("{}: ray {} has t_min {}, which this format cannot hold", path_.string(), ray_count_,
                        ray.t_min);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) out.number(ray.direction[axis]);
        out.number(ray.t_max);
        ++ray_count_;
    }

    fs::path path_;
    PartialFile file_;
    std::uint32_t floats_per_ray_;
    RawHeader header_;
    std::optional<std::string> workload_;
    std::uint64_t ray_count_ = 0;
};

}  // namespace

std::unique_ptr<RayReader> open_raw_rays(const fs::path& path, const RawLayout& layout,
                                         const ImportOptions& options) {
    return std::make_unique<RawRays>(path, layout, options);
}

std::unique_ptr<RayWriter> create_raw_rays(const fs::path& path, std::uint32_t floats_per_ray,
                                           RawHeader header) {
    return std::make_unique<RawOutput>(path, floats_per_ray, header);
}

}  // namespace rtu::traces
