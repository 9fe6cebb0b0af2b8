#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

// SQLite, as far as this project needs it. Every function throws Error, naming the file, for what the library
// refuses: a full disk, a file that is no database, a file that another process holds.

namespace rtu::study {

/// A cell: nothing, an integer, a real number or text.
using SqlValue = std::variant<std::monostate, std::int64_t, double, std::string>;

/// A statement under way. Parameters are numbered from 1, columns from 0.
class SqlStatement {
  public:
    SqlStatement(sqlite3* connection, std::string file, std::string_view sql);

    SqlStatement& bind(int parameter, std::int64_t value);
    SqlStatement& bind(int parameter, double value);
    SqlStatement& bind(int parameter, std::string_view value);
    SqlStatement& bind_null(int parameter);

    /// Goes to the next row; false: there is none, and the statement can be run again with other parameters.
    [[nodiscard]] bool next();
    /// Runs a statement that gives no row.
    void run();

    [[nodiscard]] int column_count() const;
    [[nodiscard]] std::string column_name(int column) const;
    /// The type that the column has in its table, as there; empty for an expression.
    [[nodiscard]] std::string column_type(int column) const;
    [[nodiscard]] std::int64_t integer(int column) const;
    [[nodiscard]] double real(int column) const;
    [[nodiscard]] std::string text(int column) const;
    [[nodiscard]] SqlValue value(int column) const;

  private:
    void check(int code) const;

    struct Finalize {
        void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
    };
    sqlite3* connection_;
    std::string file_;
    std::map<int, std::string> texts_;  // bound: they must outlive the step
    std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// A connection to one database file.
class SqlDatabase {
  public:
    enum class Mode : std::uint8_t { ReadOnly, ReadWrite };  ///< ReadWrite makes the file when it is missing
    SqlDatabase(const std::filesystem::path& path, Mode mode);

    [[nodiscard]] SqlStatement prepare(std::string_view sql) const;
    /// Runs statements that give no rows.
    void execute(const std::string& sql) const;
    [[nodiscard]] const std::string& file() const { return file_; }

  private:
    struct Close {
        void operator()(sqlite3* connection) const { sqlite3_close(connection); }
    };
    std::string file_;
    std::unique_ptr<sqlite3, Close> connection_;
};

/// All or nothing: what is done before commit() is undone when that is not reached.
class SqlTransaction {
  public:
    explicit SqlTransaction(const SqlDatabase& database);
    SqlTransaction(const SqlTransaction&) = delete;
    SqlTransaction& operator=(const SqlTransaction&) = delete;
    ~SqlTransaction();
    void commit();

  private:
    const SqlDatabase& database_;
    bool is_open_ = true;
};

/// An identifier in quotes, for names with dots.
[[nodiscard]] std::string sql_name(std::string_view name);

}  // namespace rtu::study
