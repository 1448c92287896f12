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
constexpr std::array<std::pair<const char*, const char*>, 6> quietLog{{{"log_min_error_statement", "panic"},
                                                                       {"log_statement", "none"},
                                                                       {"log_min_duration_statement", "-1"},
                                                                       {"log_min_duration_sample", "-1"},
                                                                       {"log_transaction_sample_rate", "0"},
                                                                       {"log_error_verbosity", "terse"}}};

/// Whether sessions of the database have the value, by a setting of the database or of the whole server.
bool isQuiet(const ServerConnection& server, const QString& name, const QString& wanted)
{
    return server
        .value(QStringLiteral("SELECT coalesce("
                              "(SELECT split_part(pair, '=', 2) FROM pg_db_role_setting s, unnest(s.setconfig) pair "
                              "WHERE s.setrole = 0 AND s.setdatabase = (SELECT oid FROM pg_database WHERE datname = "
                              "current_database()) AND split_part(pair, '=', 1) = ?), "
                              "(SELECT reset_val FROM pg_settings WHERE name = ?)) = ?"),
               {name, name, wanted})
        .toBool();
}

void requireKnown(const ServerConnection& server, const std::string& login, const std::string& role)
{
    if (std::ranges::find(roleNames, role) == roleNames.end())
        throw protocols::badInput({"there is no role \"" + role + "\"", login, "experimenter, monitor, analyst or display", ""});
    if (server.value(QStringLiteral("SELECT COUNT(*) FROM pg_roles WHERE rolname = ?"), {toQt(login)}).toInt() == 0)
        throw protocols::badInput({"the server knows no login \"" + login + "\"", server.address().text, "",
                                   "make it first: CREATE ROLE \"" + login + "\" LOGIN PASSWORD '…'"});
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
    std::vector<std::string> missing;
    for (const auto& [name, wanted] : quietLog) {
        if (isQuiet(server, QLatin1String(name), QLatin1String(wanted))) continue;
        const std::string command = "ALTER DATABASE " + database + " SET " + name + " = " + wanted;
        const bool isAllowed =
            server
                .value(QStringLiteral("SELECT has_parameter_privilege(?, 'SET') AND (SELECT pg_has_role(datdba, 'MEMBER') FROM "
                                      "pg_database WHERE datname = current_database())"),
                       {QString(QLatin1String(name))})
                .toBool();
        if (isAllowed)
            server.run(QString::fromStdString(command));
        else
            missing.push_back(command);
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

void takeAddress(const ServerAddress& address, const StudyFolder& folder)
{
    const ServerNote before = readServerNote(folder.folder).value();
    const ServerAddress known = serverAddressFrom(before.address);
    if (address.text == before.address || (address.study.empty() && addressOfStudy(address, known.study) == before.address))
        return;
    const bool isElsewhere = address.host != known.host || address.port != known.port || address.database != known.database;
    if (const std::size_t waiting = isElsewhere ? StationStore::waitingIn(folder) : 0; waiting > 0)
        throw protocols::badInput({std::to_string(waiting) + " entries wait in the folder of this station for another address",
                                   folder.folder.string(), before.address + ", not " + address.text,
                                   "open the folder itself first, so that they are sent; then use the new address"});
    ServerNote note = before;
    note.address = addressOfStudy(address, known.study);
    writeServerNote(folder.folder, note);
    try {
        const StationStore store(folder);
    } catch (...) {
        writeServerNote(folder.folder, before);
        throw;
    }
}

}  // namespace database
