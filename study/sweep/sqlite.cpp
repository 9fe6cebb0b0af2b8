#include "study/sweep/sqlite.hpp"

#include "model/error.hpp"

namespace rtu::study {
namespace {

constexpr int patience_ms = 10'000;  // for a reader or a checkpoint of another process

[[noreturn]] void fail(const std::string& file, sqlite3* connection) {
    throw Error("{}: {}", file, connection == nullptr ? "not enough memory" : sqlite3_errmsg(connection));
}

}  // namespace

SqlStatement::SqlStatement(sqlite3* connection, std::string file, std::string_view sql)
    : connection_(connection), file_(std::move(file)) {
    sqlite3_stmt* statement = nullptr;
    check(sqlite3_prepare_v2(connection, sql.data(), int(sql.size()), &statement, nullptr));
    statement_.reset(statement);
}

void SqlStatement::check(int code) const {
    if (code != SQLITE_OK) fail(file_, connection_);
}

SqlStatement& SqlStatement::bind(int parameter, std::int64_t value) {
    check(sqlite3_bind_int64(statement_.get(), parameter, value));
    return *this;
}

SqlStatement& SqlStatement::bind(int parameter, double value) {
    check(sqlite3_bind_double(statement_.get(), parameter, value));
    return *this;
}

SqlStatement& SqlStatement::bind(int parameter, std::string_view value) {
    const std::string& text = texts_.insert_or_assign(parameter, std::string(value)).first->second;
    check(sqlite3_bind_text64(statement_.get(), parameter, text.data(), text.size(), SQLITE_STATIC,
                              SQLITE_UTF8));
    return *this;
}

SqlStatement& SqlStatement::bind_null(int parameter) {
    check(sqlite3_bind_null(statement_.get(), parameter));
    return *this;
}

bool SqlStatement::next() {
    const int code = sqlite3_step(statement_.get());
    if (code == SQLITE_ROW) return true;
    check(sqlite3_reset(statement_.get()));  // repeats the error of the step
    return false;
}

void SqlStatement::run() { RTU_CHECK(!next(), "{}: a row where none was expected", file_); }

int SqlStatement::column_count() const { return sqlite3_column_count(statement_.get()); }

std::string SqlStatement::column_name(int column) const {
    return sqlite3_column_name(statement_.get(), column);
}

std::string SqlStatement::column_type(int column) const {
    const char* type = sqlite3_column_decltype(statement_.get(), column);
    return type == nullptr ? std::string() : type;
}

std::int64_t SqlStatement::integer(int column) const {
    return sqlite3_column_int64(statement_.get(), column);
}

double SqlStatement::real(int column) const { return sqlite3_column_double(statement_.get(), column); }

std::string SqlStatement::text(int column) const {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
    return bytes == nullptr ? std::string()
                            : std::string(bytes, std::size_t(sqlite3_column_bytes(statement_.get(), column)));
}

SqlValue SqlStatement::value(int column) const {
    switch (sqlite3_column_type(statement_.get(), column)) {
        case SQLITE_INTEGER:
            return integer(column);
        case SQLITE_FLOAT:
            return real(column);
        case SQLITE_NULL:
            return std::monostate();
        default:
            return text(column);
    }
}

SqlDatabase::SqlDatabase(const std::filesystem::path& path, Mode mode) : file_(path.string()) {
    sqlite3* connection = nullptr;
    const int flags =
        mode == Mode::ReadOnly ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    const int code = sqlite3_open_v2(file_.c_str(), &connection, flags, nullptr);
    connection_.reset(connection);
    if (code != SQLITE_OK) fail(file_, connection);
    sqlite3_busy_timeout(connection, patience_ms);
}

SqlStatement SqlDatabase::prepare(std::string_view sql) const { return {connection_.get(), file_, sql}; }

void SqlDatabase::execute(const std::string& sql) const {
    if (sqlite3_exec(connection_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
        fail(file_, connection_.get());
    }
}

SqlTransaction::SqlTransaction(const SqlDatabase& database) : database_(database) {
    database.execute("BEGIN IMMEDIATE");
}

SqlTransaction::~SqlTransaction() {
    if (!is_open_) return;
    try {
        database_.execute("ROLLBACK");
    } catch (const Error&) {  // a full disk rolls back by itself
        is_open_ = false;
    }
}

void SqlTransaction::commit() {
    database_.execute("COMMIT");
    is_open_ = false;
}

std::string sql_name(std::string_view name) { return fmt::format("\"{}\"", name); }

}  // namespace rtu::study
