#include "model/camera.hpp"
#include "tests/fuzz/fuzz_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace rtu;
    const test::FuzzFile file(bytes, size);
    test::expect_result_or_error([&] { static_cast<void>(model::load_camera(file.path(), "scene")); });
    return 0;
}
