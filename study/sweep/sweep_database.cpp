#include "study/sweep/sweep_database.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "model/error.hpp"
#include "sim/config_keys.hpp"
#include "study/sweep/sweep_journal.hpp"
#include "study/sweep/sweep_schema.hpp"
#include "study/version.hpp"

namespace rtu::study {
namespace {

namespace fs = std::filesystem;

std::int64_t pragma(const SqlDatabase& database, const std::string& name) {
    SqlStatement statement = database.prepare("PRAGMA " + name);
    return statement.next() ? statement.integer(0) : 0;
}

std::string placeholders(std::size_t count) {
    std::string text = "?";
    for (std::size_t i = 1; i < count; ++i) text += ",?";
    return text;
}

void add_designs(const SqlDatabase& database, const SweepPlan& plan) {
    SqlStatement insert = database.prepare(
        fmt::format("INSERT INTO design VALUES({}) ON CONFLICT(id) DO UPDATE SET mgates = excluded.mgates, "
                    "sram_mbits = excluded.sram_mbits",
                    placeholders(6 + sim::config_keys().size())));
    for (const SweepDesign& design : plan.designs) {
        insert.bind(1, design.id).bind(2, design.preset).bind(3, to_string(design.pairing));
        insert.bind(4, model::to_string(plan.file.edge_identity));
        int parameter = 5;
        for (const sim::ConfigKey& key : sim::config_keys()) {
            const sim::ConfigValue value = sim::config_value(design.config, key);
            if (const auto* number = std::get_if<std::uint32_t>(&value)) {
                insert.bind(parameter++, std::int64_t{*number});
            } else {
                insert.bind(parameter++, std::get<std::string_view>(value));
            }
        }
        const DesignArea area = design_area(design.config);
        insert.bind(parameter, area.mgates).bind(parameter + 1, area.sram_mbits);
        insert.run();
    }
}

void insert_points(const SqlDatabase& database, const SweepPlan& plan, std::span<const std::size_t> points) {
    SqlStatement insert = database.prepare(
        "INSERT INTO point(id, number, design, scene, scene_hash, rays, fidelity, tolerance, version)"
        " VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)"
        " ON CONFLICT(id) DO UPDATE SET number = excluded.number, scene = excluded.scene");
    for (const std::size_t index : points) {
        const SweepPoint& point = plan.points[index];
        const SweepScene& scene = plan.scenes[point.scene];
        insert.bind(1, point.id).bind(2, std::int64_t(index)).bind(3, plan.designs[point.design].id);
        insert.bind(4, scene.name).bind(5, scene.hash).bind(6, scene.rays);
        insert.bind(7, to_string(point.level)).bind(9, version());
        if (uses_tolerance(point.level)) {
            insert.bind(8, 100 * plan.file.tolerance);
        } else {
            insert.bind_null(8);
        }
        insert.run();
    }
}

// Takes the results of one transaction's journals.
class Importer {
  public:
    explicit Importer(const SqlDatabase& database)
        : known_(database.prepare("SELECT status FROM point WHERE id = ?")),
          finish_(database.prepare(
              "UPDATE point SET status = ?, error = nullif(?, ''), paired_percent = ? WHERE id = ?")),
          row_(database.prepare(
              fmt::format("INSERT INTO result VALUES({})", placeholders(5 + sweep_counts().size())))),
          host_(database.prepare("INSERT INTO host VALUES(?, 1, ?) ON CONFLICT(point) DO UPDATE SET"
                                 " completions = completions + 1")) {}

    // True when the point was completed by it.
    bool add(const SweepResult& result) {
        if (!known_.bind(1, result.point).next()) return false;  // of a database that was removed
        const std::string status = known_.text(0);
        static_cast<void>(known_.next());
        if (result.error.empty()) host_.bind(1, result.point).bind(2, result.cpu_seconds).run();
        if (status == "done") return false;
        finish_.bind(1, result.error.empty() ? "done" : "failed").bind(2, result.error).bind(4, result.point);
        if (result.error.empty()) {
            finish_.bind(3, result.paired_percent);
        } else {
            finish_.bind_null(3);
        }
        finish_.run();
        for (const SweepRow& row : result.rows) {
            row_.bind(1, result.point).bind(2, row.workload).bind(3, row.level).bind(4, row.cycles_low);
            bind(5, row.cycles_high);
            int parameter = 6;
            for (const auto& count : row.counts)
                bind(parameter++, count ? std::optional(std::int64_t(*count)) : std::nullopt);
            row_.run();
        }
        return true;
    }

  private:
    template <class Number>
    void bind(int parameter, std::optional<Number> value) {
        if (value) {
            row_.bind(parameter, *value);
        } else {
            row_.bind_null(parameter);
        }
    }

    SqlStatement known_, finish_, row_, host_;
};

}  // namespace

SweepDatabase::SweepDatabase(const fs::path& path, SqlDatabase::Mode mode) : database_(path, mode) {
    check_or_make_schema(mode);
}

void SweepDatabase::check_or_make_schema(SqlDatabase::Mode mode) {
    const std::int64_t id = pragma(database_, "application_id");
    const bool is_empty = pragma(database_, "schema_version") == 0;
    if (mode == SqlDatabase::Mode::ReadWrite && (is_empty || id == sweep_application_id)) {
        database_.execute("PRAGMA journal_mode = WAL");
    }
    if (mode == SqlDatabase::Mode::ReadWrite && is_empty) {
        SqlTransaction transaction(database_);
        database_.execute(sweep_schema());
        transaction.commit();
    } else if (id != sweep_application_id) {
        throw Error("{}: expected a database of sweeps, got another one", database_.file());
    }
    const std::int64_t schema = pragma(database_, "user_version");
    if (schema != sweep_schema_version) {
        throw Error("{}: expected a database of version {}, got {}", database_.file(), sweep_schema_version,
                    schema);
    }
    // A commit is in the file when it returns; a machine that stops may lose the last ones, and their points
    // are simulated again.
    if (mode == SqlDatabase::Mode::ReadWrite) database_.execute("PRAGMA synchronous = NORMAL");
}

void SweepDatabase::set_plan(const SweepPlan& plan) {
    SqlTransaction transaction(database_);
    SqlStatement about = database_.prepare("INSERT OR REPLACE INTO sweep VALUES(?, ?)");
    about.bind(1, "name").bind(2, plan.file.name).run();
    about.bind(1, "text").bind(2, plan.file.text).run();
    about.bind(1, "version").bind(2, version()).run();
    std::string objectives;
    for (const SweepObjective& objective : plan.file.objectives) objectives += objective.name() + '\n';
    about.bind(1, "objectives").bind(2, objectives).run();
    add_designs(database_, plan);
    database_.execute("UPDATE point SET number = NULL WHERE number IS NOT NULL");
    std::vector<std::size_t> first(plan.scenes.size() * plan.designs.size());
    std::iota(first.begin(), first.end(), std::size_t{0});
    insert_points(database_, plan, first);
    database_.execute("DELETE FROM front");
    transaction.commit();
}

void SweepDatabase::add_points(const SweepPlan& plan, std::span<const std::size_t> points) {
    SqlTransaction transaction(database_);
    insert_points(database_, plan, points);
    transaction.commit();
}

void SweepDatabase::retry_failed() {
    database_.execute(
        "UPDATE point SET status = 'waiting', error = NULL WHERE status = 'failed' AND number IS NOT NULL");
}

std::vector<std::size_t> SweepDatabase::waiting() const {
    std::vector<std::size_t> result;
    SqlStatement select = database_.prepare(
        "SELECT number FROM point WHERE status = 'waiting' AND number IS NOT NULL ORDER BY number");
    while (select.next()) result.push_back(std::size_t(select.integer(0)));
    return result;
}

SweepCounts SweepDatabase::counts() const {
    SweepCounts counts;
    SqlStatement select = database_.prepare(
        "SELECT sum(status = 'waiting'), sum(status = 'done'), sum(status = 'failed') FROM point"
        " WHERE number IS NOT NULL");
    if (!select.next()) return counts;
    counts.waiting = std::uint64_t(select.integer(0));
    counts.done = std::uint64_t(select.integer(1));
    counts.failed = std::uint64_t(select.integer(2));
    return counts;
}

std::vector<SweepFailure> SweepDatabase::failures() const {
    std::vector<SweepFailure> result;
    SqlStatement select = database_.prepare(
        "SELECT id, scene, design, error FROM point WHERE status = 'failed' AND number IS NOT NULL"
        " ORDER BY number");
    while (select.next()) {
        result.push_back({select.text(0), select.text(1), select.text(2), select.text(3)});
    }
    return result;
}

std::vector<SweepResult> SweepDatabase::import_journals(const fs::path& folder) {
    std::vector<fs::path> journals;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".journal") journals.push_back(entry.path());
    }
    std::ranges::sort(journals);
    std::vector<SweepResult> completed;
    SqlTransaction transaction(database_);
    Importer importer(database_);
    SqlStatement begin = database_.prepare("SELECT bytes FROM journal WHERE name = ?");
    SqlStatement end = database_.prepare("INSERT OR REPLACE INTO journal VALUES(?, ?)");
    for (const fs::path& path : journals) {
        const std::string name = path.filename().string();
        std::uint64_t offset = 0;
        if (begin.bind(1, name).next()) {
            offset = std::uint64_t(begin.integer(0));
            static_cast<void>(begin.next());
        }
        if (fs::file_size(path) == offset) continue;
        const JournalPart part = read_journal(path, offset);
        if (part.lines.empty()) continue;
        for (const std::string& line : part.lines) {
            SweepResult result = parse_sweep_result(line);
            if (importer.add(result)) completed.push_back(std::move(result));
        }
        end.bind(1, name).bind(2, std::int64_t(part.end)).run();
    }
    transaction.commit();
    return completed;
}

void SweepDatabase::forget_journals(const fs::path& folder) {
    std::vector<std::string> gone;
    SqlStatement select = database_.prepare("SELECT name FROM journal");
    while (select.next()) {
        if (!fs::exists(folder / select.text(0))) gone.push_back(select.text(0));
    }
    SqlStatement remove = database_.prepare("DELETE FROM journal WHERE name = ?");
    for (const std::string& name : gone) remove.bind(1, name).run();
}

void SweepDatabase::add_failure(const std::string& point, const std::string& error) {
    SqlStatement update = database_.prepare(
        "UPDATE point SET status = 'failed', error = ? WHERE id = ? AND status = 'waiting'");
    update.bind(1, error).bind(2, point).run();
}

void SweepDatabase::set_front(const std::vector<std::string>& designs) {
    SqlTransaction transaction(database_);
    database_.execute("DELETE FROM front");
    SqlStatement insert = database_.prepare("INSERT INTO front VALUES(?)");
    for (const std::string& design : designs) insert.bind(1, design).run();
    transaction.commit();
}

void SweepDatabase::close_log() {
    try {
        database_.execute("PRAGMA journal_mode = DELETE");
    } catch (const Error&) {  // somebody reads it: then the log stays beside it until the next time
        return;
    }
}

}  // namespace rtu::study
