#include "study/stream/stream_published.hpp"

#include "sim/effective_config.hpp"

namespace rtu::study {
namespace {

using sim::ReadBack;
using sim::StreamMode;

struct Setup {
    std::string what;
    double published = 0;  // 0: shown in a figure without numbers
    bool is_fitted = false;
    StreamMode mode = StreamMode::Batched;
    ReadBack read_back = ReadBack::Tests;
    std::uint64_t batch_tests = 1;
};

std::vector<Setup> setups() {
    std::vector<Setup> result{{"direct passing", 7e4, true, StreamMode::Direct, ReadBack::Tests, 1}};
    for (const std::uint64_t batch : published_texture_sizes()) {
        const bool is_best = batch == 32 * 32;
        std::uint64_t side = 1;
        while (side * side < batch) ++side;
        result.push_back({"textures of " + std::to_string(side) + " x " + std::to_string(side),
                          is_best ? 4e6 : 0, false, StreamMode::Batched, ReadBack::Tests, batch});
    }
    for (const std::uint64_t rays : {64U, 256U, 1024U}) {
        result.push_back({"mixed mode, " + std::to_string(rays) + " rays", 0, false, StreamMode::Mixed,
                          ReadBack::Tests, rays});
    }
    result.push_back(
        {"mixed mode, 1024 rays, no read-back", 8e6, true, StreamMode::Mixed, ReadBack::None, 1024});
    return result;
}

}  // namespace

std::vector<std::uint64_t> published_texture_sizes() {
    std::vector<std::uint64_t> sizes;
    for (std::uint64_t side = 4; side <= 256; side *= 2) sizes.push_back(side * side);
    return sizes;
}

StreamOptions published_options(StreamOptions options) {
    options.pairing = {model::PairingKind::None, 0};
    options.ray_count = options.pair_count = 1024;
    options.machines = {{"agp_8x", sim::load_config("nv35", {}, {}, "agp_8x").config}};
    return options;
}

std::vector<PublishedStream> published_streams(const StreamInput& input, const LinkedMachine& machine,
                                               const std::function<void(std::string_view)>& progress) {
    StreamRunner runner(input);
    std::vector<PublishedStream> result;
    for (const Setup& setup : setups()) {
        if (progress) progress("as published: " + setup.what);
        result.push_back({setup.what, setup.published, setup.is_fitted,
                          runner.run(machine, setup.mode, setup.read_back, setup.batch_tests)});
    }
    return result;
}

}  // namespace rtu::study
