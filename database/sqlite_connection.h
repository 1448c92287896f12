// One connection to a SQLite file through Qt SQL, set up as this project needs it: WAL, synchronous
// FULL, foreign keys on. Every failing statement throws a named protocols::Error.
// Qt loads its SQLite driver as a plug-in and finds it through QCoreApplication's library paths, so
// one must exist before the first connection is made; whoever owns main() makes it. A connection
// belongs to the thread that made it.
#pragma once

#include <QSqlDatabase>
#include <QSqlError>
#include <QSqlQuery>
#include <QVariant>
#include <filesystem>
#include <string>

namespace database {

class SqliteConnection {
public:
    enum class Mode {
        Create,  ///< the file is made
        Write,
        Read,  ///< also on a folder that cannot be written
    };

    /// Throws environmentFault where it cannot be opened, badInput where it is no SQLite database.
    SqliteConnection(std::filesystem::path file, Mode mode);
    ~SqliteConnection();
    SqliteConnection(const SqliteConnection&) = delete;
    SqliteConnection& operator=(const SqliteConnection&) = delete;

    /// The statement, executed with its values bound in order.
    QSqlQuery run(const QString& sql, const QVariantList& values = {}) const;

    /// The one value of a one-row statement; invalid where there is no row.
    QVariant value(const QString& sql, const QVariantList& values = {}) const;

    const std::filesystem::path& file() const { return m_file; }

private:
    void open(const QString& name, const QString& options);
    void openForReading();
    void applyPragmas(Mode mode);
    [[noreturn]] void fail(const QSqlError& error) const;

    std::filesystem::path m_file;
    QString m_name;
    QSqlDatabase m_connection;
};

/// BEGIN IMMEDIATE; rolled back unless committed.
class Transaction {
public:
    explicit Transaction(const SqliteConnection& connection);
    ~Transaction();
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;

    /// Returns when the transaction is synced.
    void commit();

private:
    const SqliteConnection& m_connection;
    bool m_committed = false;
};

/// Several statements that read one state of the database, whatever a writer does meanwhile.
class ReadSnapshot {
public:
    explicit ReadSnapshot(const SqliteConnection& connection);
    ~ReadSnapshot();
    ReadSnapshot(const ReadSnapshot&) = delete;
    ReadSnapshot& operator=(const ReadSnapshot&) = delete;

private:
    const SqliteConnection& m_connection;
};

QString toQt(const std::string& text);
std::string fromQt(const QVariant& text);

}  // namespace database
