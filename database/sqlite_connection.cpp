#include "database/sqlite_connection.h"

#include <sqlite3.h>
#include <unistd.h>

#include <QSqlDriver>
#include <QStringList>
#include <QUrl>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <system_error>

#include "protocols/files/errors.h"
#include "protocols/files/open_files.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/utf8.h"

namespace database {

namespace {

// SQLite's primary result codes (https://www.sqlite.org/rescode.html).
enum SqliteCode {
    Permission = 3,
    Busy = 5,
    Locked = 6,
    ReadOnly = 8,
    InputOutput = 10,
    Corrupt = 11,
    Full = 13,
    CannotOpen = 14,
    NotADatabase = 26
};

/// With the bits of its extension; -1 where there is none.
int wholeCode(const QSqlError& error)
{
    bool isNumber = false;
    const int code = error.nativeErrorCode().toInt(&isNumber);
    return isNumber ? code : -1;
}

int primaryCode(const QSqlError& error)
{
    const int code = wholeCode(error);
    return code < 0 ? code : code & 0xff;
}

/// Whether the file system refused the memory that the readers and the writer of a write-ahead log share.
bool isOfSharedMemory(const QSqlError& error)
{
    const int code = wholeCode(error);
    return code == SQLITE_IOERR_SHMMAP || code == SQLITE_IOERR_SHMOPEN || code == SQLITE_IOERR_SHMLOCK;
}

protocols::Error hasNoSharedMemory(const std::string& file)
{
    return protocols::environmentFault({"the file system does not support the write-ahead log of SQLite", file, "a local disk",
                                        "make the study there, or copy the whole folder there and work with the copy"});
}

/// A failed write does not say whether the quota of the account is used up, so a write of about a trial is tried.
protocols::Error diskError(const std::string& detail, const std::string& file)
{
    constexpr std::uintmax_t triedBytes = 1 << 16;
    std::error_code unknown;
    const std::filesystem::path folder = std::filesystem::absolute(file, unknown).parent_path();
    if (protocols::reasonAgainstRoom(folder, triedBytes) == EDQUOT)
        return protocols::environmentFault({"the disk quota of this account is used up; this step was not stored", file,
                                            "room for this account", "delete files of this account and do it again"});
    return protocols::environmentFault(
        {"the disk reported an error (" + detail + "); this step was not stored", file, "", "check the disk"});
}

/// SQLite gives one code for several causes.
protocols::Error cannotOpen(const std::string& detail, const std::filesystem::path& file)
{
    constexpr std::size_t longestPath = 480;  // bytes; SQLite adds the ends of its other files up to 512
    std::error_code unknown;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(file, unknown);
    if (const std::size_t length = (unknown ? file : whole).string().size(); length > longestPath)
        return protocols::environmentFault({"the path has " + std::to_string(length) + " bytes, which is too long for SQLite",
                                            file.string(), "at most " + std::to_string(longestPath) + " bytes",
                                            "move the folder to a shorter path"});
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    if (::access(folder.c_str(), W_OK) != 0 && errno == EROFS)
        return protocols::environmentFault(
            {"the database cannot be opened, because its file system is read-only (" + detail + ")", file.string(),
             "a study that was closed, or a file system that may be written",
             "copy the whole folder, with study.db-wal, to a disk that may be written"});
    return protocols::environmentFault({"the database cannot be opened (" + detail + ")", file.string(), "a readable file",
                                        "check its permissions; if the study was not closed, keep study.db-wal beside it"});
}

protocols::Error faultOf(const QSqlError& error, const std::string& file)
{
    const std::string detail = error.databaseText().toStdString();
    if (protocols::canOpenNoMoreFiles()) return protocols::tooManyOpenFiles(file);
    switch (primaryCode(error)) {
        case Full:
            return protocols::environmentFault({"the disk is full; this step was not stored", file,
                                                "room there and in the folder for temporary files (TMPDIR)",
                                                "free some space and do it again"});
        case ReadOnly:
        case Permission:
            return protocols::environmentFault({"the database cannot be written (" + detail + ")", file,
                                                "a folder that may be written", "check its permissions and its file system"});
        case InputOutput:
            return isOfSharedMemory(error) ? hasNoSharedMemory(file) : diskError(detail, file);
        case Busy:
        case Locked:
            return protocols::environmentFault(
                {"another program uses the database (" + detail + ")", file, "", "close that program and do it again"});
        case CannotOpen:
            return cannotOpen(detail, file);
        case NotADatabase:
            return protocols::badInput({"this is no SQLite database", file, "the study.db of a study folder", "check the path"});
        case Corrupt:
            return protocols::workFailed({"the database is damaged (" + detail + ")", file, "", "restore it from a backup"});
        default:
            return protocols::workFailed({"the database refused a step: " + detail, file, "", "run vis2hap verify on the study"});
    }
}

/// ":v0", ":v1", ... Qt binds values by name in half the time that it needs to bind them by place.
QString placeholderName(qsizetype place)
{
    static const QStringList names = [] {
        QStringList made;
        for (int i = 0; i < 64; ++i) made << QStringLiteral(":v%1").arg(i);
        return made;
    }();
    return names.at(place);
}

/// SQLite would take the log of an empty database for one that is out of date, and delete it.
void requireUsableLog(const std::filesystem::path& file)
{
    std::error_code none;
    for (const char* ending : {"-journal", "-wal", "-shm"})
        if (const std::filesystem::path beside = file.string() + ending;
            std::filesystem::exists(beside, none) && !std::filesystem::is_regular_file(beside, none))
            throw protocols::badInput({"something that is no file stands beside the database", beside.string(),
                                       "a file of SQLite, or nothing", "remove it; nothing was changed"});
    const std::filesystem::path log = file.string() + "-wal";
    if (!std::filesystem::is_regular_file(file, none) || std::filesystem::file_size(file, none) > 0 || none) return;
    if (std::filesystem::file_size(log, none) == 0 || none) return;
    throw protocols::badInput(
        {"the database is empty, but its write-ahead log holds answers", file.string(), "the study.db of a study",
         "keep " + log.filename().string() + "; bring the answers back with vis2hap rescue, or restore a backup"});
}

QString nextConnectionName()
{
    static std::atomic<int> count = 0;  // Qt identifies connections by names in the whole process
    return QStringLiteral("vis2hap-%1").arg(++count);
}

}  // namespace

QString withPlaceholders(const QString& sql, const std::function<QString(qsizetype)>& nameOf)
{
    QString named;
    qsizetype place = 0;
    bool isQuoted = false;
    for (const QChar c : sql) {
        if (c == QLatin1Char('\'')) isQuoted = !isQuoted;
        if (c == QLatin1Char('?') && !isQuoted)
            named += nameOf(place++);
        else
            named += c;
    }
    return named;
}

QString toQt(const std::string& text) { return QString::fromStdString(text); }
std::string fromQt(const QVariant& text) { return text.toString().toStdString(); }

SqliteConnection::SqliteConnection(std::filesystem::path file, Mode mode) : m_file(std::move(file)), m_name(nextConnectionName())
{
    m_connection = QSqlDatabase::addDatabase(QStringLiteral("QSQLITE"), m_name);
    try {
        if (!m_connection.isValid() && protocols::canOpenNoMoreFiles()) throw protocols::tooManyOpenFiles(m_file.string());
        if (!m_connection.isValid())
            throw protocols::environmentFault(
                {"Qt's SQLite driver cannot be loaded", "", "the package libqt6sql6-sqlite", "install it"});
        if (protocols::firstByteThatIsNotUtf8(m_file.string()))
            throw protocols::badInput({"the path is not UTF-8", m_file.string(), "a path of UTF-8", "rename the folder"});
        if (mode == Mode::Read || mode == Mode::Write) requireUsableLog(m_file);
        if (mode == Mode::Read)
            openForReading();
        else if (mode == Mode::Kept)
            openKept();
        else
            open(toQt(m_file.string()), QStringLiteral("QSQLITE_BUSY_TIMEOUT=5000"));
        applyPragmas(mode);
    } catch (...) {
        m_connection = QSqlDatabase();
        QSqlDatabase::removeDatabase(m_name);
        throw;
    }
}

SqliteConnection::~SqliteConnection()
{
    m_kept.clear();  // before the close: a prepared statement would keep the file open
    m_connection.close();
    m_connection = QSqlDatabase();
    QSqlDatabase::removeDatabase(m_name);
}

void SqliteConnection::open(const QString& name, const QString& options)
{
    m_connection.setDatabaseName(name);
    m_connection.setConnectOptions(options);
    if (!m_connection.open()) fail(m_connection.lastError());
}

/// Reading a WAL database needs its -shm file. If the folder is read-only, or its file system shares no memory, and the log is
/// empty, the file is complete by itself, so it is opened as immutable.
void SqliteConnection::openForReading()
{
    const QString plain = toQt(m_file.string());
    open(plain, QStringLiteral("QSQLITE_BUSY_TIMEOUT=5000;QSQLITE_OPEN_READONLY"));
    QSqlQuery probe(m_connection);
    if (probe.exec(QStringLiteral("SELECT COUNT(*) FROM sqlite_master"))) return;
    const QSqlError error = probe.lastError();
    probe.clear();
    std::error_code noLog;
    const auto logBytes = std::filesystem::file_size(m_file.string() + "-wal", noLog);
    const bool lacksSharedMemory = primaryCode(error) == CannotOpen || primaryCode(error) == ReadOnly || isOfSharedMemory(error);
    if (!lacksSharedMemory || (!noLog && logBytes > 0)) fail(error);
    m_connection.close();
    openKept();
}

void SqliteConnection::openKept()
{
    const QString address = QString::fromUtf8(QUrl::fromLocalFile(toQt(m_file.string())).toEncoded());
    open(address + QStringLiteral("?immutable=1"), QStringLiteral("QSQLITE_OPEN_READONLY;QSQLITE_OPEN_URI"));
}

void SqliteConnection::applyPragmas(Mode mode)
{
    const bool isFile = mode == Mode::Create || mode == Mode::Write;
    if (isFile && fromQt(value(QStringLiteral("PRAGMA journal_mode = WAL"))) != "wal") throw hasNoSharedMemory(m_file.string());
    run(QStringLiteral("PRAGMA synchronous = FULL"));
    run(QStringLiteral("PRAGMA foreign_keys = ON"));
    if (value(QStringLiteral("PRAGMA synchronous")).toInt() != 2 || value(QStringLiteral("PRAGMA foreign_keys")).toInt() != 1)
        throw protocols::environmentFault(
            {"this SQLite does not support synchronous FULL and foreign keys", m_file.string(), "", "use Debian's libsqlite3-0"});
}

std::string sqliteVersion()
{
    return fromQt(SqliteConnection(":memory:", SqliteConnection::Mode::Memory).value(QStringLiteral("SELECT sqlite_version()")));
}

QSqlQuery SqliteConnection::prepared(const QString& sql) const
{
    QSqlQuery query(m_connection);
    query.setForwardOnly(true);
    if (!query.prepare(withPlaceholders(sql, placeholderName))) fail(query.lastError());
    return query;
}

/// SQLite would replace these two when it reads, so that hashes of the text never agreed again. (Qt drops a mark of the byte
/// order when a text becomes a QString; who takes in texts refuses it, see isKeptText().)
void SqliteConnection::requireKept(const QVariant& value) const
{
    if (value.typeId() != QMetaType::QString) return;
    const QString text = value.toString();
    if (!text.contains(QChar(0xFFFE)) && !text.contains(QChar(0xFFFF))) return;
    throw protocols::badInput(
        {"the text holds a character that nobody sees and that is not stored as it is (U+FFFE or "
         "U+FFFF)",
         m_file.string(), "text without these characters", "type the text again; nothing was stored"});
}

void SqliteConnection::execute(QSqlQuery& query, const QVariantList& values) const
{
    for (const QVariant& value : values) requireKept(value);
    for (qsizetype place = 0; place < values.size(); ++place) query.bindValue(placeholderName(place), values[place]);
    if (!query.exec()) fail(query.lastError());
}

QSqlQuery SqliteConnection::run(const QString& sql, const QVariantList& values) const
{
    QSqlQuery query = prepared(sql);
    execute(query, values);
    return query;
}

KeptQuery SqliteConnection::runKept(const QString& sql, const QVariantList& values) const
{
    // Taken out while it is in use, so that a second use at the same time prepares a statement of its own.
    auto waiting = m_kept.extract(sql);
    QSqlQuery query = waiting.empty() ? prepared(sql) : std::move(waiting.mapped());
    execute(query, values);
    return {std::move(query), m_kept, sql};
}

KeptQuery::KeptQuery(QSqlQuery query, std::map<QString, QSqlQuery>& kept, const QString& sql)
    : m_query(std::move(query)), m_kept(kept), m_sql(sql)
{
}

KeptQuery::~KeptQuery()
{
    m_query.finish();
    m_kept.insert_or_assign(m_sql, std::move(m_query));
}

QVariant SqliteConnection::value(const QString& sql, const QVariantList& values) const
{
    QSqlQuery query = run(sql, values);
    return query.next() ? query.value(0) : QVariant();
}

QVariant SqliteConnection::keptValue(const QString& sql, const QVariantList& values) const
{
    KeptQuery query = runKept(sql, values);
    return query.next() ? query.value(0) : QVariant();
}

sqlite3* SqliteConnection::handle() const
{
    const QVariant handle = m_connection.driver()->handle();
    const bool isHandle = handle.isValid() && std::strcmp(handle.typeName(), "sqlite3*") == 0;
    if (!isHandle || fromQt(value(QStringLiteral("SELECT sqlite_source_id()"))) != sqlite3_sourceid()) return nullptr;
    return *static_cast<sqlite3* const*>(handle.constData());
}

void SqliteConnection::fail(const QSqlError& error) const { throw faultOf(error, m_file.string()); }

Transaction::Transaction(const SqliteConnection& connection) : m_connection(connection), m_whole(connection.m_transaction)
{
    if (m_whole) return;
    m_connection.runKept(QStringLiteral("BEGIN IMMEDIATE"));
    m_connection.m_transaction = this;
}

Transaction::~Transaction()
{
    if (m_whole) {
        m_whole->m_isSpoilt |= !m_committed;
        return;
    }
    m_connection.m_transaction = nullptr;
    if (m_committed) return;
    try {
        m_connection.run(QStringLiteral("ROLLBACK"));
    } catch (const protocols::Error&) {
        // On a full disk SQLite has rolled back already. Keep the first error.
    }
}

void Transaction::commit()
{
    if (m_isSpoilt)
        throw protocols::workFailed(
            {"a part of these steps failed, so none of them was stored", m_connection.file().string(), "", "do them again"});
    if (!m_whole) m_connection.runKept(QStringLiteral("COMMIT"));
    m_committed = true;
}

ReadSnapshot::ReadSnapshot(const SqliteConnection& connection) : m_connection(connection)
{
    if (m_connection.m_hasSnapshot) return;
    m_connection.run(QStringLiteral("BEGIN"));
    m_isOwn = m_connection.m_hasSnapshot = true;
}

ReadSnapshot::~ReadSnapshot()
{
    if (!m_isOwn) return;
    m_connection.m_hasSnapshot = false;
    try {
        m_connection.run(QStringLiteral("ROLLBACK"));
    } catch (const protocols::Error&) {
        // SQLite has ended the snapshot already.
    }
}

}  // namespace database
