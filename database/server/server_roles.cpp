#include "database/server/server_roles.h"

#include <QFile>
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "database/disk/server_note.h"
#include "database/server/server_connection.h"
#include "database/server/server_rights.h"
#include "database/server/server_scripts.h"
#include "database/server/station_store.h"
#include "protocols/files/errors.h"
#include "protocols/process/owner_only.h"
#include "protocols/secrets/secret_key.h"

namespace database {

namespace {

constexpr std::array<const char*, 4> roleNames{"experimenter", "monitor", "analyst", "display"};

/// What PostgreSQL 15 can write of a statement into its log, and the value that prevents it. Only a superuser may set them.
/// Without track_activities the server has no statement to name when one of its processes is killed.
constexpr std::array<std::pair<const char*, const char*>, 7> quietLog{{{"log_min_error_statement", "panic"},
                                                                       {"log_statement", "none"},
                                                                       {"log_min_duration_statement", "-1"},
                                                                       {"log_min_duration_sample", "-1"},
                                                                       {"log_transaction_sample_rate", "0"},
                                                                       {"log_error_verbosity", "terse"},
                                                                       {"track_activities", "off"}}};

/// Settings of a name that databases and logins have, with the value as PostgreSQL shows it.
constexpr const char* settingsOf =
    "WITH own AS (SELECT s.setrole, s.setdatabase, CASE lower(split_part(pair, '=', 2)) WHEN 'false' THEN 'off' WHEN 'no' THEN "
    "'off' ELSE lower(split_part(pair, '=', 2)) END AS value FROM pg_db_role_setting s, unnest(s.setconfig) pair "
    "WHERE split_part(pair, '=', 1) = ? AND s.setdatabase IN (0, (SELECT oid FROM pg_database WHERE datname = "
    "current_database()))) ";

/// Whether sessions of the database have the value, by a setting of the database or of the whole server. What the present login
/// has for itself says nothing of the others.
bool isQuiet(const ServerConnection& server, const QString& name, const QString& wanted)
{
    return server
        .value(QLatin1String(settingsOf) +
                   QStringLiteral("SELECT coalesce("
                                  "(SELECT value FROM own WHERE setrole = 0 AND setdatabase <> 0), "
                                  "(SELECT value FROM own WHERE setrole = 0 AND setdatabase = 0), "
                                  "(SELECT reset_val FROM pg_settings WHERE name = ? AND NOT EXISTS (SELECT FROM own WHERE "
                                  "setrole = (SELECT oid FROM pg_roles WHERE rolname = session_user))), '') = ?"),
               {name, name, wanted})
        .toBool();
}

/// Logins with another value of their own, which goes before that of the database.
std::vector<std::string> loudLogins(const ServerConnection& server, const QString& name, const QString& wanted)
{
    std::vector<std::string> logins;
    QSqlQuery row = server.run(
        QLatin1String(settingsOf) +
            QStringLiteral(
                "SELECT r.rolname FROM pg_roles r CROSS JOIN LATERAL (SELECT o.value FROM own o WHERE o.setrole = r.oid "
                "ORDER BY o.setdatabase = 0 LIMIT 1) its WHERE its.value <> ? ORDER BY r.rolname"),
        {name, wanted});
    while (row.next()) logins.push_back(fromQt(row.value(0)));
    server.requireRead(row);
    return logins;
}

void requireKnown(const ServerConnection& server, const std::string& login, const std::string& role)
{
    if (std::ranges::find(roleNames, role) == roleNames.end())
        throw protocols::badInput({"there is no role \"" + role + "\"", login, "experimenter, monitor, analyst or display", ""});
    if (server.value(QStringLiteral("SELECT COUNT(*) FROM pg_roles WHERE rolname = ?"), {toQt(login)}).toInt() == 0)
        throw protocols::badInput({"the server knows no login \"" + login + "\"", server.address().text, "",
                                   "make it first: CREATE ROLE \"" + login + "\" LOGIN PASSWORD '…'"});
}

/// An earlier version may have moved the study there. The rights of each function stay. A function that is new belongs to the
/// login that makes it, so only the owner's may.
void renewFunctions(const ServerConnection& server)
{
    const bool isOwner = server
                             .value(QStringLiteral("SELECT nspowner = (SELECT oid FROM pg_roles WHERE rolname = current_user) "
                                                   "FROM pg_namespace WHERE oid = '@schema@'::regnamespace"))
                             .toBool();
    if (!isOwner) return;
    if (server.value(QStringLiteral("SELECT to_regclass('@schema@.server_owed') IS NULL")).toBool())
        throw protocols::badInput({"the study has the tables of an earlier version", server.address().text,
                                   "a study that this version moved there",
                                   "move the study back with the version that moved it, and there again with this one"});
    server.runScript(serverScript("functions"));
}

QString quoted(const std::string& name)
{
    return QLatin1Char('"') + toQt(name).replace(QLatin1Char('"'), QStringLiteral("\"\"")) + QLatin1Char('"');
}

}  // namespace

std::vector<std::string> makeRoles(const ServerAddress& address, const std::vector<std::pair<std::string, std::string>>& logins)
{
    ServerConnection server(address);
    server.chooseStudy();
    for (const auto& [login, role] : logins) requireKnown(server, login, role);
    ServerTransaction transaction(server);
    renewFunctions(server);
    server.runScript(serverScript("roles"));
    for (const auto& [login, role] : logins)
        server.run(QStringLiteral("GRANT \"@prefix@_%1\" TO %2").arg(toQt(role), quoted(login)));
    transaction.commit();
    std::vector<std::string> lines;
    for (const char* role : roleNames) {
        QSqlQuery row = server.run(
            QStringLiteral(
                "SELECT member.rolname FROM pg_auth_members m JOIN pg_roles g ON g.oid = m.roleid JOIN pg_roles member "
                "ON member.oid = m.member WHERE g.rolname = ? ORDER BY member.rolname"),
            {QStringLiteral("vis2hap_%1_%2").arg(toQt(server.address().study), QLatin1String(role))});
        std::string members;
        while (row.next()) members += (members.empty() ? "" : ", ") + fromQt(row.value(0));
        server.requireRead(row);
        lines.push_back("vis2hap_" + server.address().study + "_" + role + ": " + (members.empty() ? "nobody yet" : members));
    }
    return lines;
}

void giveImagesTo(const ServerAddress& address, const std::string& place)
{
    ServerConnection server(address);
    server.chooseStudy();
    server.run(QStringLiteral("SELECT @schema@.give_images_to(?)"), {toQt(place)});
}

std::vector<std::string> closeReadCounters(const ServerAddress& address)
{
    const ServerConnection server(address);
    const bool isSuperuser = server.value(QStringLiteral("SELECT rolsuper FROM pg_roles WHERE rolname = session_user")).toBool();
    std::vector<std::string> missing;
    for (const std::string& counter : readCounters()) {
        const QString isOpen = QStringLiteral("SELECT has_function_privilege('public', ?, 'EXECUTE')");
        if (!server.value(isOpen, {toQt(counter)}).toBool()) continue;
        const std::string command = "REVOKE EXECUTE ON FUNCTION " + counter + " FROM PUBLIC";
        if (isSuperuser)
            server.run(QString::fromStdString(command));
        else
            missing.push_back(command);
    }
    return missing;
}

std::vector<std::string> releaseHeld(const ServerAddress& address)
{
    ServerConnection server(address);
    server.chooseStudy();
    std::vector<std::string> lines;
    for (const auto& one : server.call("release_held", {})) {
        const auto count = [&](const char* field) { return std::to_string(one.at(field).get<int>()); };
        const bool isSlot = one.at("state") == "withdrawn";
        const auto& logins = one.at("logins");
        lines.push_back((isSlot ? "slot " + count("slot") + " is free again, after " : "the next presentation is due for ") +
                        one.at("participant").get<std::string>() + " (presentations: " + count("presentations") +
                        ", answers: " + count("answers") + ", voids: " + count("voids") + ", login " +
                        (logins.is_string() ? logins.get<std::string>() : "unknown") + ")");
    }
    return lines;
}

std::vector<std::string> keepLogQuiet(const ServerAddress& address)
{
    const ServerConnection server(address);
    const std::string database = quoted(server.address().database).toStdString();
    const bool isSuperuser = server.value(QStringLiteral("SELECT rolsuper FROM pg_roles WHERE rolname = session_user")).toBool();
    std::vector<std::string> missing;
    const auto runOrName = [&](const std::string& command, bool isAllowed) {
        if (isAllowed)
            server.run(QString::fromStdString(command));
        else
            missing.push_back(command);
    };
    for (const auto& [name, wanted] : quietLog) {
        const std::string setting = std::string(" SET ") + name + " = " + wanted;
        if (!isQuiet(server, QLatin1String(name), QLatin1String(wanted)))
            runOrName("ALTER DATABASE " + database + setting,
                      server
                          .value(QStringLiteral("SELECT has_parameter_privilege(?, 'SET') AND (SELECT pg_has_role(datdba, "
                                                "'MEMBER') FROM pg_database WHERE datname = current_database())"),
                                 {QString(QLatin1String(name))})
                          .toBool());
        for (const std::string& login : loudLogins(server, QLatin1String(name), QLatin1String(wanted)))
            runOrName("ALTER ROLE " + quoted(login).toStdString() + " IN DATABASE " + database + setting, isSuperuser);
    }
    return missing;
}

JoinedStudy joinStudy(const ServerAddress& address, const std::filesystem::path& folder, const std::string& station)
{
    ServerAddress found = address;
    {
        ServerConnection server(address);
        server.chooseStudy();
        found = server.address();
    }
    const std::filesystem::path place = folder.empty() ? std::filesystem::path(found.study) : folder;
    std::error_code ignored;
    if (std::filesystem::exists(place, ignored) && !std::filesystem::is_empty(place, ignored))
        throw protocols::badInput({"the folder is not empty", place.string(), "a new folder", "choose another name"});
    const bool isNew = std::filesystem::create_directories(place, ignored);
    if (ignored)
        throw protocols::environmentFault({"the folder cannot be made (" + ignored.message() + ")", place.string(), "", ""});
    protocols::closeFolderToOthers(place);
    const StudyFolder made{place};
    try {
        writeServerNote(made.folder, {found.text, station, protocols::drawHex(32), false});
        const StationStore store(made);
        return {place, store.facts().name, station};
    } catch (...) {
        // Nothing half-made: what stands in the folder was written just now.
        for (const auto& file : {serverNoteOf(made.folder), made.queue(), made.protocol(), made.lock()})
            for (const char* ending : {"", "-wal", "-shm"}) std::filesystem::remove(file.string() + ending, ignored);
        if (isNew) std::filesystem::remove(place, ignored);
        throw;
    }
}

}  // namespace database
