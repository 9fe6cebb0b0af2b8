#include "model/gltf.hpp"
#include "tests/fuzz/fuzz_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace rtu;
    const test::FuzzFile file(bytes, size);
    test::expect_result_or_error([&] {
        const model::TriangleMesh mesh = model::load_gltf(file.path());
        for (const model::Triangle& triangle : mesh.triangles) {
            for (const std::uint32_t vertex : triangle) {
                if (vertex >= mesh.positions.size()) std::abort();
            }
        }
    });
    return 0;
}
