// The open database beside its copy in memory, while SQLite moves the log into the database again and again: what SQLite itself
// writes is never taken for somebody else's bytes, and somebody else's bytes never for its own.
#include "database/disk/open_files.h"

#include <QCoreApplication>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include "database/sqlite_connection.h"

using namespace database;

namespace {

constexpr int rowsOfThreeLogs = 1200;  // a log begins again after 1,000 pages

/// A database that grows: each row is a commit of some pages.
class Growing {
public:
    Growing() : m_connection(file(), SqliteConnection::Mode::Create)
    {
        m_connection.run(QStringLiteral("PRAGMA synchronous = OFF"));
        m_connection.run(QStringLiteral("CREATE TABLE rows (number INTEGER PRIMARY KEY, text TEXT UNIQUE)"));
        m_files.emplace(file(), m_connection.handle());
    }

    std::filesystem::path file() const { return m_folder.filePath("grown.db").toStdString(); }
    const SqliteConnection& connection() const { return m_connection; }
    OpenFiles& files() { return *m_files; }

    void addRow()
    {
        ++m_rows;
        const QString text = QString::number((m_rows * 7919) % 10007) + QString(700, QChar('a' + m_rows % 26));
        m_connection.run(QStringLiteral("INSERT INTO rows VALUES (?, ?)"), {m_rows, text});
    }

    std::int64_t backfilled() const { return RawDatabase(m_connection.handle()).logState()->backfilled; }

private:
    QTemporaryDir m_folder;
    SqliteConnection m_connection;
    std::optional<OpenFiles> m_files;
    int m_rows = 0;
};

/// Turns the bytes of one page in place, as another program might.
void overwrite(const std::filesystem::path& file, int page)
{
    std::fstream bytes(file, std::ios::binary | std::ios::in | std::ios::out);
    bytes.seekp(page * 4096 + 2000);
    bytes << std::string(600, '\7');
}

QString textsOf(const std::filesystem::path& file)
{
    const SqliteConnection connection(file, SqliteConnection::Mode::Read);
    return connection.value(QStringLiteral("SELECT group_concat(number || text) FROM rows")).toString();
}

}  // namespace

class OpenFilesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void whatSqliteMovesOutOfTheLogIsItsOwn_data()
    {
        QTest::addColumn<bool>("isRead");
        QTest::newRow("alone") << false;
        QTest::newRow("beside a reader that holds a part of the log back") << true;
    }
    void whatSqliteMovesOutOfTheLogIsItsOwn()
    {
        QFETCH(const bool, isRead);
        Growing growing;
        if (!growing.connection().handle()) QSKIP("Qt brings another SQLite than this program is linked with");
        const SqliteConnection other(growing.file(), SqliteConnection::Mode::Read);
        std::unique_ptr<ReadSnapshot> reader;
        int moves = 0;
        for (int row = 0; row < rowsOfThreeLogs; ++row) {
            const auto before = growing.backfilled();
            growing.addRow();
            if (growing.backfilled() > before) ++moves;
            QCOMPARE(growing.files().state(), OpenFiles::State::InPlace);
            if (isRead && row % 100 == 50) reader = std::make_unique<ReadSnapshot>(other);
            if (isRead && row % 100 == 90) reader.reset();
        }
        QVERIFY2(moves >= 3, qPrintable(QString::number(moves)));
        const std::filesystem::path copy = growing.file().string() + ".copy";
        growing.files().copy()->writeTo(copy);
        QVERIFY(textsOf(copy) == textsOf(growing.file()));
    }

    void otherBytesAreNoticedWhereSqliteHasJustMovedTheLog_data()
    {
        QTest::addColumn<int>("page");
        for (const int page : {0, 1, 2, 40}) QTest::newRow(qPrintable("page " + QString::number(page))) << page;
    }
    /// The row whose commit moves the log into the database writes some of its pages; somebody overwrites one of all.
    void otherBytesAreNoticedWhereSqliteHasJustMovedTheLog()
    {
        QFETCH(const int, page);
        Growing growing;
        if (!growing.connection().handle()) QSKIP("Qt brings another SQLite than this program is linked with");
        for (int row = 0; row < rowsOfThreeLogs; ++row) {
            const auto before = growing.backfilled();
            growing.addRow();
            if (growing.backfilled() > before) break;
            QCOMPARE(growing.files().state(), OpenFiles::State::InPlace);
        }
        overwrite(growing.file(), page);
        QCOMPARE(growing.files().state(), OpenFiles::State::Overwritten);
    }
};

QTEST_GUILESS_MAIN(OpenFilesTest)
#include "open_files_test.moc"
