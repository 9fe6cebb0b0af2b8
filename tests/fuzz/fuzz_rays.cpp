// The other formats of rays; the first byte tells which.
#include "tests/fuzz/fuzz_file.hpp"
#include "traces/ray_files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace rtu;
    using traces::RayFormat;
    if (size == 0) return 0;
    constexpr RayFormat formats[] = {RayFormat::Csv, RayFormat::JsonLines, RayFormat::Npy, RayFormat::Rays7,
                                     RayFormat::Rays8};
    const test::FuzzFile file(bytes + 1, size - 1);
    test::expect_result_or_error([&] {
        const auto reader = traces::open_rays(file.path(), formats[(bytes[0] - '0') % 5U]);
        const auto writer = traces::create_rays("/dev/null", RayFormat::JsonLines, reader->header());
        while (const auto chunk = reader->next()) writer->add(*chunk);
    });
    return 0;
}
