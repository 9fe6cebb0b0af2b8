// Traces of rays and of visits: reading, and recovering what is whole. Checksums are not compared (see
// traces/block.cpp), so that the fuzzer comes to what is behind them.
#include "tests/fuzz/fuzz_file.hpp"
#include "traces/recover.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace rtu;
    const test::FuzzFile file(bytes, size);
    test::expect_result_or_error([&] { static_cast<void>(traces::survey_trace(file.path())); });
    test::expect_result_or_error([&] { traces::recover_trace(file.path(), "/dev/null"); });
    return 0;
}
