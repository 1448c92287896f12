// One connection to a SQLite file through Qt SQL with WAL, synchronous FULL and foreign keys. A failing statement throws a
// protocols::Error. Qt loads its SQLite driver as a plug-in by the library paths of QCoreApplication, so main() must make one
// before the first connection. A connection belongs to the thread that made it.
#pragma once

#include <QSqlDatabase>
#include <QSqlError>
#include <QSqlQuery>
#include <QVariant>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

struct sqlite3;

namespace database {

/// A statement that its connection keeps prepared for the next time, and the rows of this time, which end with this value.
class KeptQuery {
public:
    /// `kept`: where the statement `sql` waits for its next use.
    KeptQuery(QSqlQuery query, std::map<QString, QSqlQuery>& kept, const QString& sql);
    ~KeptQuery();
    KeptQuery(const KeptQuery&) = delete;
    KeptQuery& operator=(const KeptQuery&) = delete;

    bool next() { return m_query.next(); }
    QVariant value(int column) const { return m_query.value(column); }

private:
    QSqlQuery m_query;
    std::map<QString, QSqlQuery>& m_kept;
    QString m_sql;
};

class Transaction;

class SqliteConnection {
public:
    enum class Mode {
        Create,  ///< makes the file
        Write,
        Read,    ///< works in a read-only folder, too
        Kept,    ///< reads a file that nobody writes any more, and makes no file beside it
        Memory,  ///< no file: a database of its own that ends with the connection
    };

    /// Throws environmentFault if it cannot be opened, badInput if it is no SQLite database.
    SqliteConnection(std::filesystem::path file, Mode mode);
    ~SqliteConnection();
    SqliteConnection(const SqliteConnection&) = delete;
    SqliteConnection& operator=(const SqliteConnection&) = delete;

    /// Executes the statement with its values bound in order.
    QSqlQuery run(const QString& sql, const QVariantList& values = {}) const;

    /// As run(), for a statement that every answer needs: it stays prepared, because preparing takes longer than executing.
    KeptQuery runKept(const QString& sql, const QVariantList& values = {}) const;

    /// The first value of the first row; invalid if there is no row.
    QVariant value(const QString& sql, const QVariantList& values = {}) const;
    QVariant keptValue(const QString& sql, const QVariantList& values = {}) const;  ///< by runKept()

    /// SQLite's own handle; null where Qt's driver brings another SQLite than this program is linked with.
    sqlite3* handle() const;

    const std::filesystem::path& file() const { return m_file; }
    std::string folder() const { return m_file.parent_path().string(); }  ///< of the study, for messages

private:
    friend class Transaction;
    friend class ReadSnapshot;
    void open(const QString& name, const QString& options);
    void openForReading();
    void openKept();
    void applyPragmas(Mode mode);
    QSqlQuery prepared(const QString& sql) const;
    void requireKept(const QVariant& value) const;
    void execute(QSqlQuery& query, const QVariantList& values) const;
    [[noreturn]] void fail(const QSqlError& error) const;

    std::filesystem::path m_file;
    QString m_name;
    mutable bool m_hasSnapshot = false;  ///< a ReadSnapshot is open
    QSqlDatabase m_connection;
    mutable std::map<QString, QSqlQuery> m_kept;   ///< by their text; without those that are in use
    mutable Transaction* m_transaction = nullptr;  ///< the open one
};

/// BEGIN IMMEDIATE; rolls back unless commit() was called. A transaction within another is a part of it: it is stored with the
/// whole, and where it ends without commit() the whole cannot be committed.
class Transaction {
public:
    explicit Transaction(const SqliteConnection& connection);
    ~Transaction();
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;

    /// Returns after the transaction is synced to the disk.
    void commit();

private:
    const SqliteConnection& m_connection;
    Transaction* m_whole;  ///< null for the outermost
    bool m_committed = false;
    bool m_isSpoilt = false;  ///< a part of it failed
};

/// Lets several statements read one state of the database while a writer may change it. Within another one it does nothing.
class ReadSnapshot {
public:
    explicit ReadSnapshot(const SqliteConnection& connection);
    ~ReadSnapshot();
    ReadSnapshot(const ReadSnapshot&) = delete;
    ReadSnapshot& operator=(const ReadSnapshot&) = delete;

private:
    const SqliteConnection& m_connection;
    bool m_isOwn = false;
};

/// The version of the SQLite library, such as "3.40.1".
std::string sqliteVersion();

/// Each "?" outside quotes as the name of its place, counted from 0.
QString withPlaceholders(const QString& sql, const std::function<QString(qsizetype)>& nameOf);

QString toQt(const std::string& text);
std::string fromQt(const QVariant& text);

}  // namespace database
