#include "study/fingerprint.hpp"

#include <fmt/format.h>

#include <bit>

namespace rtu::study {
namespace {

// FNV-1a, 64 bits (Fowler, Noll, Vo): the offset basis and the prime are the published ones.
constexpr std::uint64_t fnv_basis = 0xcbf29ce484222325;
constexpr std::uint64_t fnv_prime = 0x100000001b3;

// Whole words instead of bytes: four times as fast on a large mesh, and independent of the byte order.
constexpr std::uint64_t mix(std::uint64_t hash, std::uint64_t word) { return (hash ^ word) * fnv_prime; }

}  // namespace

std::string fingerprint(std::string_view bytes) {
    std::uint64_t hash = fnv_basis;
    for (const char c : bytes) hash = mix(hash, static_cast<unsigned char>(c));
    return fmt::format("{:016x}", hash);
}

std::string fingerprint(const model::TriangleMesh& mesh) {
    std::uint64_t hash = mix(mix(fnv_basis, mesh.triangles.size()), mesh.positions.size());
    for (const model::Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t index : triangle) hash = mix(hash, index);
    }
    for (const model::Vec3 p : mesh.positions) {
        for (const float value : {p.x, p.y, p.z}) hash = mix(hash, std::bit_cast<std::uint32_t>(value));
    }
    return fmt::format("{:016x}", hash);
}

}  // namespace rtu::study
