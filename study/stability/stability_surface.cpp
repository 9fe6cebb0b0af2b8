#include "study/stability/stability_surface.hpp"

#include "model/bvh.hpp"
#include "model/pairing.hpp"

namespace rtu::study {
namespace {

model::Pairing pairing_of(const model::TriangleMesh& mesh) {
    return model::pair_triangles(mesh, {model::PairingKind::EdgeBbsa, 0}, model::EdgeIdentity::Position);
}

}  // namespace

Surface::Surface(model::TriangleMesh triangles)
    : mesh(std::move(triangles)),
      embree(mesh, EmbreeMode::Default, true),
      embree_robust(mesh, EmbreeMode::Robust, true) {
    for (const auto& [a, b, c] : mesh.triangles) {
        corners.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c]});
    }
    const model::Pairing pairing = pairing_of(mesh);
    for (const model::TrianglePair& pair : pairing.pairs) {
        pairs.push_back(model::make_leaf_pair(pair, mesh.positions));
    }
    image = model::build_bvh(mesh, pairing, {});
}

}  // namespace rtu::study
