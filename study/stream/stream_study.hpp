#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/pairing.hpp"
#include "model/workload.hpp"
#include "sim/effective_config.hpp"
#include "sim/stream_machine.hpp"
#include "study/report/run_report.hpp"
#include "study/run_options.hpp"

namespace rtu::study {

/// A link, and the machine behind it with all changes that were asked for.
struct LinkedMachine {
    std::string link;  ///< as on the command line
    sim::Config config;
};

/// What to stream. Everything is validated by whoever fills this in.
struct StreamOptions {
    SceneSource scene;
    model::PairingMethod pairing{model::PairingKind::EdgeBbsa, 0};
    model::EdgeIdentity edge_identity = model::EdgeIdentity::Position;
    model::WorkloadKind workload = model::WorkloadKind::Primary;
    std::optional<std::filesystem::path> camera_file;  ///< as in RunOptions
    std::uint64_t seed = 1;
    std::uint32_t ray_count = 512;   ///< at most so many of the workload's rays
    std::uint32_t pair_count = 512;  ///< and so many of the scene's pairs and lone triangles
    std::vector<sim::StreamMode> modes;
    std::optional<sim::ReadBack> read_back;  ///< none: what is usual in each mode
    std::vector<std::uint64_t> batches;      ///< pair tests in a batch; empty: powers of 4 up to all
    std::string preset = "default";
    std::vector<LinkedMachine> machines;
    bool has_published =
        false;  ///< also compare with Robert and Schweri: see study/stream/stream_published.hpp
    std::function<void(std::string_view phase)> progress;  ///< may be empty
};

/// One stream on one link.
struct StreamRow {
    std::string mode;
    std::string link;
    std::string read_back;
    std::uint64_t batch_tests = 0;  ///< asked for
    bool is_balance = false;        ///< the batch at which testers and link balance
    std::uint64_t ray_count = 0;
    std::uint32_t clock_mhz = 0;
    std::uint64_t tester_count = 0;
    std::uint64_t alone_cycles = 0;  ///< of the same batches over a link that costs nothing
    double up_percent = 0, down_percent = 0, host_percent = 0;  ///< wires and host in use, of all cycles
    sim::StreamResult result;                                   ///< without hits

    /// Tests of single triangles.
    [[nodiscard]] double tests_per_second() const;
    [[nodiscard]] double alone_tests_per_second() const;
    /// Million rays that met all pairs, a second; of the same batches over a link that costs nothing.
    [[nodiscard]] double mrps() const;
    [[nodiscard]] double alone_mrps() const;
    [[nodiscard]] double tester_percent() const;
    /// The part in use the longest: testers, upload, read-back or host.
    [[nodiscard]] std::string_view limit() const;
};

/// The smallest batch at which a link is not the limit, and what is reached there.
struct StreamBalance {
    std::string mode;
    std::string link;
    std::optional<std::uint64_t> batch_tests;  ///< none: the link is the limit at every batch
};

/// A rate that Robert and Schweri published, and the simulated one.
struct PublishedStream {
    std::string what;
    double published_tests_per_second = 0;
    bool is_fitted = false;  ///< a parameter was chosen to meet it
    StreamRow row;
};

/// Everything that a stream reports; deterministic.
struct StreamReport {
    std::string version;
    std::string preset;
    std::uint64_t seed = 0;
    SceneFacts scene;
    std::string input_hash;
    PairingFacts pairing;
    std::string workload;
    std::uint32_t clock_mhz = 0;
    std::uint64_t ray_count = 0, pair_count = 0, triangle_count = 0, hit_count = 0;
    std::vector<std::string> links;
    std::vector<StreamRow> rows;  ///< mode by mode, link by link, by batch
    std::vector<StreamBalance> balances;
    std::vector<PublishedStream> published;
};

/// Streams every ray against every pair in every mode over every link with every batch size, and once more
/// over a link that costs nothing. Checks that the hits of all are equal; throws std::logic_error if they are
/// not, and Error as load_scene() and sim::StreamPlan do.
[[nodiscard]] StreamReport run_stream_study(const StreamOptions& options);

/// What is read back when nothing is said: every test's result where rays and pairs come together, one hit a
/// ray where the scene stays.
[[nodiscard]] sim::ReadBack usual_read_back(sim::StreamMode mode);

}  // namespace rtu::study
