#include "database/server/server_connection.h"

#include <QSqlDriver>
#include <QSqlError>
#include <QStringList>
#include <atomic>
#include <nlohmann/json.hpp>

#include "database/server/client_library.h"
#include "database/server/login_faults.h"
#include "database/server/login_settings.h"
#include "database/server/server_replies.h"
#include "database/sqlite_connection.h"

namespace database {

namespace {

constexpr int majorVersion = 15;

QString nextServerConnectionName()
{
    static std::atomic<int> count = 0;
    return QStringLiteral("vis2hap-server-%1").arg(++count);
}

/// The parts of a server's message in any language: "ERROR:  what\nDETAIL:  …\nHINT:  …".
QStringList partsOf(const QString& message)
{
    QStringList parts;
    for (const QString& line : message.split(QLatin1Char('\n'), Qt::SkipEmptyParts)) {
        const auto colon = line.indexOf(QStringLiteral(":  "));
        parts << (colon < 0 ? line.trimmed() : line.mid(colon + 3).trimmed());
    }
    return parts;
}

std::string partAt(const QStringList& parts, qsizetype place) { return place < parts.size() ? parts[place].toStdString() : ""; }

bool meansAway(const QString& code)
{
    // Class 08: connection; 57P01 to 57P03: the server stops or starts (PostgreSQL manual, appendix A).
    return code.isEmpty() || code.startsWith(QLatin1String("08")) || code.startsWith(QLatin1String("57P0"));
}

ServerRefusal refusalOfRule(const QString& code, const QStringList& parts, const std::string& where)
{
    const auto exitCode = code.startsWith(QLatin1String("VH1"))   ? protocols::ExitCode::BadInput
                          : code.startsWith(QLatin1String("VH3")) ? protocols::ExitCode::Environment
                                                                  : protocols::ExitCode::WorkFailed;
    return {exitCode, {partAt(parts, 0), where, partAt(parts, 1), partAt(parts, 2)}, code.toStdString()};
}

/// What a function returns in place of an error: functions.sql, rules for callers. Else nothing.
const nlohmann::json* refusalIn(const nlohmann::json& reply)
{
    if (!reply.is_object()) return nullptr;
    const auto found = reply.find("refused");
    return found != reply.end() && found->is_object() ? &*found : nullptr;
}

/// Statements of these sessions stay out of the server's log where the login may say so: they hold answers and facts. Defaults
/// of a database or a login that the functions of a study refuse do not hold for these sessions.
constexpr const char* ownSession =
    "SELECT set_config('client_min_messages', 'warning', false), "
    "set_config('default_transaction_isolation', 'read committed', false), "
    "set_config('default_transaction_read_only', 'off', false), "
    "(SELECT count(set_config(name, value, false)) FROM (VALUES ('log_min_error_statement', 'panic'), ('log_statement', 'none'), "
    "('log_min_duration_statement', '-1'), ('log_error_verbosity', 'terse'), ('track_activities', 'off')) quiet(name, value) "
    "WHERE has_parameter_privilege(name, 'SET'))";

/// ":v1", ":v2", ...: QPSQL would rewrite a text that holds another question mark.
QString placeholderFromOne(qsizetype place) { return QStringLiteral(":v%1").arg(place + 1); }

}  // namespace

ServerConnection::ServerConnection(ServerAddress address) : m_address(std::move(address)), m_name(nextServerConnectionName())
{
    if (!QSqlDatabase::isDriverAvailable(QStringLiteral("QPSQL")))
        throw protocols::environmentFault({"Qt's driver for PostgreSQL is missing", m_address.text, "the package libqt6sql6-psql",
                                           "run: apt-get install libqt6sql6-psql"});
    m_connection = QSqlDatabase::addDatabase(QStringLiteral("QPSQL"), m_name);
    try {
        open();
    } catch (...) {
        m_connection = QSqlDatabase();
        QSqlDatabase::removeDatabase(m_name);
        throw;
    }
}

ServerConnection::~ServerConnection()
{
    m_connection.close();
    m_connection = QSqlDatabase();
    QSqlDatabase::removeDatabase(m_name);
}

void ServerConnection::open()
{
    m_connection.setHostName(toQt(m_address.host));
    m_connection.setDatabaseName(toQt(m_address.database));
    m_connection.setUserName(toQt(m_address.user));
    const auto settings = loginSettings(m_address, clientDefaults());
    QStringList options;
    for (const auto& [name, setting] : settings) options << toQt(name + "=" + quotedSetting(setting));
    m_connection.setConnectOptions(options.join(QLatin1Char(';')));
    const EnglishMessages english;
    if (!m_connection.open()) {
        const std::string text = m_connection.lastError().databaseText().trimmed().toStdString();
        // Qt's driver gives words alone, in the server's language.
        failLogin(text, isFromServer(text) ? codeOfRefusal(connectionText(m_address, settings)) : std::string(), m_address.text);
    }
    const int version = value(QStringLiteral("SHOW server_version_num")).toString().toInt() / 10000;
    if (version != majorVersion)
        throw protocols::environmentFault({"the server is PostgreSQL " + std::to_string(version), m_address.text,
                                           "PostgreSQL " + std::to_string(majorVersion), "use a server of this version"});
    requireNoPooler();
    run(QLatin1String(ownSession));
}

/// A pooler gives the statements of one connection to changing processes of the server, and those of two stations to the same.
/// The server knows a station by its process.
void ServerConnection::requireNoPooler() const
{
    const QVariant handle = m_connection.driver()->handle();
    const std::string_view kind = handle.isValid() ? handle.typeName() : "";
    if (kind != "pg_conn*" && kind != "PGconn*") return;  // the same type; Qt 6 names the first
    const int told = toldProcessOf(*static_cast<const void* const*>(handle.constData()));
    if (told == 0 || told == value(QStringLiteral("SELECT pg_backend_pid()")).toInt()) return;
    throw protocols::environmentFault({"a connection pooler stands before the server", m_address.text,
                                       "a connection to the server itself", "name host and port of the server itself"});
}

QStringList ServerConnection::studies() const
{
    QStringList names;
    QSqlQuery row =
        run(QStringLiteral("SELECT substr(nspname, 9) FROM pg_namespace WHERE substr(nspname, 1, 8) = 'vis2hap_' AND "
                           "has_schema_privilege(oid, 'USAGE') ORDER BY nspname"));
    while (row.next()) names << row.value(0).toString();
    requireRead(row);
    return names;
}

void ServerConnection::chooseStudy()
{
    const QStringList known = studies();
    const std::string list = known.isEmpty() ? "none" : known.join(QStringLiteral(", ")).toStdString();
    if (m_address.study.empty() && known.size() == 1) {
        m_address.text = addressOfStudy(m_address, fromQt(known.front()));
        m_address.study = fromQt(known.front());
        return;
    }
    if (m_address.study.empty())
        throw protocols::badInput(
            {known.isEmpty() ? "the database has no study that this login may use" : "the database has several studies",
             m_address.text, "one of: " + list, "add ?study=NAME to the address"});
    if (!known.contains(toQt(m_address.study)))
        throw protocols::badInput({"the database has no study " + m_address.study + " that this login may use", m_address.text,
                                   "one of: " + list, "correct study=NAME, or ask the owner of the study for a role"});
}

QString ServerConnection::schema() const { return QStringLiteral("\"vis2hap_%1\"").arg(toQt(m_address.study)); }

QString ServerConnection::completed(const QString& sql) const
{
    QString text = sql;
    text.replace(QStringLiteral("@schema@"), schema());
    text.replace(QStringLiteral("@prefix@"), QStringLiteral("vis2hap_%1").arg(toQt(m_address.study)));
    return text;
}

QSqlQuery ServerConnection::run(const QString& sql, const QVariantList& values) const
{
    QSqlQuery query(m_connection);
    query.setForwardOnly(true);
    const QString text = completed(sql);
    if (values.isEmpty()) {
        if (!query.exec(text)) fail(query.lastError());
        return query;
    }
    if (!query.prepare(withPlaceholders(text, placeholderFromOne))) fail(query.lastError());
    for (qsizetype place = 0; place < values.size(); ++place)
        query.bindValue(QStringLiteral(":v%1").arg(place + 1), values[place]);
    if (!query.exec()) fail(query.lastError());
    return query;
}

QVariant ServerConnection::value(const QString& sql, const QVariantList& values) const
{
    QSqlQuery query = run(sql, values);
    return query.next() ? query.value(0) : QVariant();
}

nlohmann::json ServerConnection::call(const char* function, const QVariantList& arguments) const
{
    QStringList places;
    for (qsizetype i = 0; i < arguments.size(); ++i) places << QStringLiteral("?");
    const QVariant result = value(
        QStringLiteral("SELECT CAST(@schema@.%1(%2) AS text)").arg(QLatin1String(function), places.join(QStringLiteral(", "))),
        arguments);
    const std::string text = fromQt(result);  // empty where the function returns nothing
    auto reply = text.empty() ? nlohmann::json() : replyFrom(text, m_address.text);
    if (const auto* refusal = refusalIn(reply)) {
        const auto part = [&](const char* name) {
            const auto found = refusal->find(name);
            return found != refusal->end() && found->is_string() ? toQt(found->get<std::string>()) : QString();
        };
        fail(part("code"), {part("message"), part("detail"), part("hint")});
    }
    return reply;
}

void ServerConnection::requireRead(const QSqlQuery& rows) const
{
    if (rows.lastError().isValid()) fail(rows.lastError());
}

void ServerConnection::runScript(const QString& sql) const
{
    QSqlQuery query(m_connection);
    if (!query.exec(completed(sql))) fail(query.lastError());
    while (query.nextResult())
        if (query.lastError().isValid()) fail(query.lastError());
    if (query.lastError().isValid()) fail(query.lastError());
}

void ServerConnection::fail(const QSqlError& error) const { fail(error.nativeErrorCode(), partsOf(error.databaseText())); }

void ServerConnection::fail(const QString& code, const QStringList& parts) const
{
    const std::string what = partAt(parts, 0), where = m_address.text;
    if (code.startsWith(QLatin1String("VH"))) throw refusalOfRule(code, parts, where);
    if (meansAway(code))
        throw ServerAway({"the connection to the server ended (" + what + ")", where, "", "check the network and the server"});
    if (code == QLatin1String("42883"))
        throw protocols::badInput({"the server does not know this step (" + what + ")", where,
                                   "a study that this version moved there",
                                   "move the study back with the version that moved it, and there again with this one"});
    if (code == QLatin1String("3F000"))
        throw protocols::badInput({"the study is no longer on this server (" + what + ")", where, "",
                                   "ask its owner where it is now; entries that wait here stay in the folder"});
    if (code == QLatin1String("25006"))
        throw ServerAway({"the server is a stand-by, which takes no entries (" + what + ")", where, "a server that takes them",
                          "name that one in the address"});
    if (code == QLatin1String("42501"))
        throw protocols::badInput({"this login may not do this (" + what + ")", where, "a login with the role for it",
                                   "ask the owner of the study; see vis2hap server roles"});
    if (code == QLatin1String("53100"))
        throw protocols::environmentFault({"the disk of the server is full; this step was not stored", where, "",
                                           "free some space on the server and do it again"});
    const protocols::Fault refused{"the server refused a step: " + what + " (" + code.toStdString() + ")", where, "", ""};
    if (code == QLatin1String("55P03")) throw ServerLocked(refused);
    throw protocols::workFailed(refused);
}

ServerTransaction::ServerTransaction(const ServerConnection& connection, Kind kind) : m_connection(connection)
{
    m_connection.run(kind == Kind::Write ? QStringLiteral("BEGIN")
                                         : QStringLiteral("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY"));
}

ServerTransaction::~ServerTransaction()
{
    if (m_committed || !m_connection.isOpen()) return;
    try {
        m_connection.run(QStringLiteral("ROLLBACK"));
    } catch (const protocols::Error&) {
        // The server rolls back by itself when the connection ends. Keep the first error.
    }
}

void ServerTransaction::commit()
{
    m_connection.run(QStringLiteral("COMMIT"));
    m_committed = true;
}

}  // namespace database
