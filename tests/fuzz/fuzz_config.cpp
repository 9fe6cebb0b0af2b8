// A configuration file on top of a preset: parsing, the table of keys and the rules between them; what is
// accepted must print as something that is accepted.
#include "sim/config_file.hpp"
#include "sim/effective_config.hpp"
#include "tests/fuzz/fuzz_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace rtu;
    const test::FuzzFile file(bytes, size);
    test::expect_result_or_error([&] {
        const sim::EffectiveConfig config = sim::load_config("default", file.path(), {});
        const std::string text = sim::describe_config(config);
        const test::FuzzFile again(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
        try {
            static_cast<void>(sim::load_config("default", again.path(), {}));
        } catch (const Error&) {
            std::abort();
        }
    });
    return 0;
}
