#include "tests/promises/durable_answer.h"

#include <sqlite3.h>

#include <QElapsedTimer>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "tests/promises/kept_answers.h"
#include "tests/support/played_session.h"

namespace tests::promises {

namespace {

using support::OpenSession;

struct CloseConnection {
    void operator()(sqlite3* connection) const { sqlite3_close_v2(connection); }
};
struct FinishStatement {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using BareConnection = std::unique_ptr<sqlite3, CloseConnection>;
using BareStatement = std::unique_ptr<sqlite3_stmt, FinishStatement>;

BareConnection openBare(const database::StudyFolder& folder)
{
    sqlite3* connection = nullptr;
    if (sqlite3_open(folder.database().c_str(), &connection) != SQLITE_OK) throw std::runtime_error("cannot open a database");
    sqlite3_exec(connection, "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON", nullptr, nullptr,
                 nullptr);
    return BareConnection(connection);
}

BareStatement prepared(const BareConnection& connection, const char* sql)
{
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(connection.get(), sql, -1, &statement, nullptr) != SQLITE_OK)
        throw std::runtime_error(sqlite3_errmsg(connection.get()));
    return BareStatement(statement);
}

/// "INSERT INTO responses VALUES (?, …)" with one value for each column.
BareStatement insertionInto(const BareConnection& connection, const std::string& table)
{
    const BareStatement columns = prepared(connection, ("SELECT COUNT(*) FROM pragma_table_info('" + table + "')").c_str());
    if (sqlite3_step(columns.get()) != SQLITE_ROW) throw std::runtime_error("no table " + table);
    std::string values = "?";
    for (int column = 1; column < sqlite3_column_int(columns.get(), 0); ++column) values += ", ?";
    return prepared(connection, ("INSERT INTO " + table + " VALUES (" + values + ")").c_str());
}

/// Runs a statement that returns no rows, with the columns of the row that `source` stands on.
void runBare(const BareStatement& statement, const BareStatement& source = nullptr)
{
    const int columns = source ? sqlite3_column_count(source.get()) : 0;
    for (int column = 0; column < columns; ++column)
        sqlite3_bind_value(statement.get(), column + 1, sqlite3_column_value(source.get(), column));
    if (sqlite3_step(statement.get()) != SQLITE_DONE) throw std::runtime_error("a bare statement failed");
    sqlite3_reset(statement.get());
}

bool nextRow(const BareStatement& query) { return sqlite3_step(query.get()) == SQLITE_ROW; }

/// Stores the rows of the answers of `played` in the empty study of the same schema: SQLite's own calls, statements prepared
/// once, the same pragmas and indices.
class BareCommits {
public:
    BareCommits(const database::StudyFolder& empty, const database::StudyFolder& played)
        : m_target(openBare(empty)), m_source(openBare(played))
    {
        const BareStatement people = prepared(m_source, "SELECT * FROM participants");
        const BareStatement insert = insertionInto(m_target, "participants");
        while (nextRow(people)) runBare(insert, people);
        m_begin = prepared(m_target, "BEGIN IMMEDIATE");
        m_commit = prepared(m_target, "COMMIT");
        m_events = prepared(m_source, "SELECT * FROM events WHERE kind = 'answered' ORDER BY sequence");
        m_responses = prepared(m_source, "SELECT * FROM responses ORDER BY event");
        m_insertEvent = insertionInto(m_target, "events");
        m_insertResponse = insertionInto(m_target, "responses");
    }

    /// Commits the rows of the next answer. Milliseconds.
    double next()
    {
        if (!nextRow(m_events) || !nextRow(m_responses)) throw std::runtime_error("no answer is left");
        QElapsedTimer timer;
        timer.start();
        runBare(m_begin);
        runBare(m_insertEvent, m_events);
        runBare(m_insertResponse, m_responses);
        runBare(m_commit);
        return static_cast<double>(timer.nsecsElapsed()) / 1e6;
    }

private:
    BareConnection m_target, m_source;
    BareStatement m_begin, m_commit, m_events, m_responses, m_insertEvent, m_insertResponse;
};

/// Sends the answer that the session waits for. Milliseconds until it is acknowledged.
double answerNext(OpenSession& session)
{
    session.stepUntil("Presenting");
    if (!std::get<study::session::Presenting>(session.driver->state().stage).touchedAtNs) session.send(study::session::Touched{});
    const study::session::Answered answer{support::responseTo(session.driver->view())};
    QElapsedTimer timer;
    timer.start();
    session.driver->send(answer);
    return static_cast<double>(timer.nsecsElapsed()) / 1e6;
}

double medianOf(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<long>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

Promise ofDurableAnswers(const Effort& effort)
{
    SessionStudy study(paperStudy());
    const database::StudyFolder played = study.copy();
    OpenSession(played, "S01").playToEnd();
    std::vector<double> ours, bare;
    while (static_cast<int>(ours.size()) < effort.durableAnswers) {
        const database::StudyFolder folder = study.copy(), bareFolder = study.copy();
        OpenSession session(folder, "S01");
        BareCommits commits(bareFolder, played);
        for (std::size_t answer = 0; answer < study.expected().size(); ++answer) {
            ours.push_back(answerNext(session));
            bare.push_back(commits.next());
        }
    }
    const double ratio = medianOf(ours) / medianOf(bare);
    char found[160];
    std::snprintf(found, sizeof found, "%.2f times (medians %.3f ms and %.3f ms)", ratio, medianOf(ours), medianOf(bare));
    return {"a durable answer beside a bare SQLite commit of its rows",
            withCommas(static_cast<long>(ours.size())) + " answers, in turn", "≤ 1.5 times", found,
            effort.decidesTimes ? std::optional(ratio <= 1.5) : std::nullopt};
}

}  // namespace tests::promises
