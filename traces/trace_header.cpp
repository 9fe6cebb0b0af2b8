#include "traces/trace_header.hpp"

#include <algorithm>
#include <utility>

#include "model/memory_image.hpp"
#include "traces/ray_chunk.hpp"

namespace rtu::traces {
namespace {

constexpr std::uint8_t has_scene_bit = 1, has_picture_bit = 2;
constexpr std::uint32_t most_workloads = 1024;

void write_vec3(ByteWriter& out, model::Vec3 v) {
    for (std::size_t axis = 0; axis < 3; ++axis) out.number(v[axis]);
}

model::Vec3 read_vec3(ByteReader& in) {
    model::Vec3 v;
    for (std::size_t axis = 0; axis < 3; ++axis) v[axis] = in.real();
    return v;
}

void write_picture(ByteWriter& out, const PictureFacts& picture) {
    out.number(picture.seed);
    out.number(picture.resolution.width);
    out.number(picture.resolution.height);
    write_vec3(out, picture.camera.eye);
    write_vec3(out, picture.camera.target);
    write_vec3(out, picture.camera.up);
    out.number(picture.camera.tan_half_fov);
    out.text(picture.camera_source);
}

PictureFacts read_picture(ByteReader& in) {
    PictureFacts picture;
    picture.seed = in.number<std::uint64_t>();
    picture.resolution.width = in.number<std::uint32_t>();
    picture.resolution.height = in.number<std::uint32_t>();
    picture.camera.eye = read_vec3(in);
    picture.camera.target = read_vec3(in);
    picture.camera.up = read_vec3(in);
    picture.camera.tan_half_fov = in.real();
    picture.camera_source = in.text();
    return picture;
}

void write_image(ByteWriter& out, const TraceHeader& header) {
    out.number(header.image->fingerprint);
    out.number(header.image->size_bytes);
    out.number(header.image->node_count);
    out.number(std::uint32_t(header.image->width | std::uint32_t(header.image->node_format) << 8));
    out.text(header.image_text);
}

void read_image(ByteReader& in, TraceHeader& header) {
    ImageFacts image;
    image.fingerprint = in.number<std::uint64_t>();
    image.size_bytes = in.number<std::uint64_t>();
    image.node_count = in.number<std::uint64_t>();
    const auto shape = in.number<std::uint32_t>();
    image.width = shape & 255;
    if (shape >> 8 > std::uint32_t(model::NodeFormat::Quantised)) {
        throw Error("expected nodes of format 0 (full) or 1 (quantised), got {}", shape >> 8);
    }
    image.node_format = model::NodeFormat(shape >> 8);
    if (image.width < 2 || image.width > model::max_bvh_width || image.width % 2 != 0) {
        throw Error("expected a tree 2, 4, 6 or 8 wide, got {}", image.width);
    }
    if (image.size_bytes > model::max_image_bytes || image.size_bytes % model::image_block_bytes != 0 ||
        image.node_count >
            image.size_bytes / model::MemoryImage::node_bytes(image.width, image.node_format)) {
        throw Error("expected nodes that fit into their image, got {} in {} bytes", image.node_count,
                    image.size_bytes);
    }
    header.image = image;
    header.image_text = in.text();
}

void write_header(ByteWriter& out, const TraceHeader& header) {
    out.number(std::uint8_t(header.content));
    out.number(
        std::uint8_t((header.scene_hash ? has_scene_bit : 0) | (header.picture ? has_picture_bit : 0)));
    out.number(std::uint16_t{0});
    out.number(std::uint32_t{0});
    out.number(header.scene_hash.value_or(0));
    out.text(header.scene_name);
    out.text(header.generator);
    if (header.picture) write_picture(out, *header.picture);
    if (header.content == TraceContent::Visits) write_image(out, header);
}

TraceHeader read_header(ByteReader& in) {
    TraceHeader header;
    const auto content = in.number<std::uint8_t>();
    if (content != 1 && content != 2) throw Error("expected content 1 (rays) or 2 (visits), got {}", content);
    header.content = TraceContent(content);
    const auto flags = in.number<std::uint8_t>();
    if (flags > (has_scene_bit | has_picture_bit)) throw Error("expected flags 0 to 3, got {}", flags);
    in.zeros(6);
    const auto scene_hash = in.number<std::uint64_t>();
    if ((flags & has_scene_bit) != 0) header.scene_hash = scene_hash;
    header.scene_name = in.text();
    header.generator = in.text();
    if ((flags & has_picture_bit) != 0) header.picture = read_picture(in);
    if (header.content == TraceContent::Visits) read_image(in, header);
    return header;
}

}  // namespace

TraceHeader header_of_rays(std::string generator) {
    TraceHeader header;
    header.generator = std::move(generator);
    return header;
}

std::string encode(const TraceHeader& header) {
    ByteWriter out;
    write_header(out, header);
    return std::move(out.bytes());
}

TraceHeader decode_header(std::string_view payload) {
    ByteReader in(payload);
    TraceHeader header = read_header(in);
    in.end();
    return header;
}

std::string encode(const TraceEnd& end) {
    ByteWriter out;
    write_header(out, end.header);
    out.number(end.block_count);
    out.number(std::uint32_t(end.workloads.size()));
    for (const WorkloadCount& workload : end.workloads) {
        out.padded(workload.name, name_bytes);
        out.number(std::uint64_t(workload.kind));
        out.number(workload.ray_count);
    }
    return std::move(out.bytes());
}

TraceEnd decode_end(std::string_view payload) {
    ByteReader in(payload);
    TraceEnd end{read_header(in), in.number<std::uint64_t>(), {}};
    const auto count = in.number<std::uint32_t>();
    if (count > most_workloads) throw Error("expected at most {} workloads, got {}", most_workloads, count);
    for (std::uint32_t i = 0; i < count; ++i) {
        WorkloadCount& workload = end.workloads.emplace_back();
        workload.name = in.padded(name_bytes);
        const auto kind = in.number<std::uint64_t>();
        if (kind > 1) throw Error("expected ray kind 0 (closest) or 1 (any), got {}", kind);
        workload.kind = model::RayKind(kind);
        workload.ray_count = in.number<std::uint64_t>();
    }
    in.end();
    return end;
}

void WorkloadTally::add(const std::string& name, model::RayKind kind, std::uint64_t first_ray,
                        std::uint64_t ray_count) {
    if (counts_.empty() || counts_.back().name != name) {
        const bool is_known =
            std::any_of(counts_.begin(), counts_.end(), [&](const auto& w) { return w.name == name; });
        if (is_known) throw Error("workload '{}' comes again after another", name);
        if (counts_.size() == most_workloads) throw Error("expected at most {} workloads", most_workloads);
        counts_.push_back({name, kind, 0});
    }
    WorkloadCount& workload = counts_.back();
    if (workload.kind != kind) throw Error("workload '{}' has rays of both kinds", name);
    if (workload.ray_count != first_ray) {
        throw Error("workload '{}': expected ray {} next, got {}", name, workload.ray_count, first_ray);
    }
    if (ray_count > ~std::uint64_t{0} - first_ray) throw Error("workload '{}' has too many rays", name);
    workload.ray_count += ray_count;
}

}  // namespace rtu::traces
