#include "study/commands/server/server_work.h"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "database/disk/server_note.h"
#include "database/server/server_progress.h"
#include "database/server/server_rights.h"
#include "database/server/server_roles.h"
#include "database/server/station_folders.h"
#include "database/server/station_store.h"
#include "database/server/study_move.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/secrets/secret_key.h"
#include "study/commands/parts/version_text.h"
#include "study/session/operated_by.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;
using database::StudyFolder;

std::string stationName(const std::string& given)
{
    const std::string host = session::operatedBy("", "").host;
    return !given.empty() ? given : host.empty() ? "station" : host;
}

database::ServerAddress addressWithStudy(const std::string& text)
{
    auto address = database::serverAddressFrom(text);
    if (address.study.empty())
        throw protocols::badInput({"the address names no study", text, "?study=NAME at its end", "add the name"});
    return address;
}

/// Keeps answers out of the server's log, or says who can.
void quietTheLog(const database::ServerAddress& address)
{
    const auto missing = keepLogQuiet(address);
    if (missing.empty()) {
        std::printf("server's log: holds no statement of this database, whose texts would be answers and facts\n");
        return;
    }
    std::printf(
        "server's log: may hold texts of statements, so answers, notes and facts. An administrator of the server prevents "
        "it:\n");
    for (const std::string& command : missing)
        std::printf("  sudo -u postgres psql -c %s\n", protocols::shellWord(protocols::printable(command)).c_str());
}

/// Keeps logins from telling images apart by how they are read, or says who can.
void closeCounters(const database::ServerAddress& address)
{
    const auto missing = closeReadCounters(address);
    if (missing.empty()) return;
    std::printf(
        "counters of reading: every login may see how many blocks are read, which tells the same image again.\n"
        "  An administrator of the server prevents it:\n");
    for (const std::string& command : missing)
        std::printf("  sudo -u postgres psql -d '%s' -c '%s'\n", protocols::printable(address.database).c_str(),
                    protocols::printable(command).c_str());
}

int toServer(const std::string& folder, const std::string& address, const std::string& station)
{
    const auto head = moveToServer(StudyFolder{folder}, addressWithStudy(address), stationName(station));
    std::printf("%s: the answers are on the server now, every row compared\n", protocols::printable(folder).c_str());
    std::printf("  log head %s\n", protocols::printable(textOf(head)).c_str());
    std::printf("  keys, protocol and images stay in the folder: keep it, and let nobody at a station read it\n");
    quietTheLog(addressWithStudy(address));
    std::printf("next: `vis2hap server roles '%s'` makes the roles of stations, monitors and analysts\n", address.c_str());
    return 0;
}

int toFolder(const std::string& address, const std::string& folder, const std::vector<std::string>& givenUp)
{
    const auto by = session::operatedBy("", versionText());
    database::Act move;
    move.who = by.operatorName;
    move.program = by.program;
    move.host = by.host;
    const auto head = moveToFolder(database::serverAddressFrom(address), StudyFolder{folder}, move, givenUp);
    std::printf("%s: the study is back, and the server's tables are gone\n", protocols::printable(folder).c_str());
    std::printf("  log head %s\n", protocols::printable(textOf(head)).c_str());
    std::printf(
        "  answers, notes and facts may still stand in the server's log, write-ahead log and backups. An administrator of "
        "the server removes them:\n%s",
        database::removalFromServer);
    return 0;
}

/// What a login without a right too many still gets.
const char* reachOf(const database::ServerRights& rights)
{
    if (rights.imagesTo == "display")
        return "no table, no key, nothing ahead and no image. It may take up each participant who is at no other station, and "
               "reads "
               "that participant's log";
    return "no table, no key, nothing ahead. It may take up each participant who is at no other station, and gets the log and "
           "the "
           "presentations that this participant has had. Whoever keeps the images of the "
           "presentations can tell which of them were the same; `vis2hap server roles ADDRESS --images display` closes this.";
}

std::string listOf(const std::vector<std::string>& texts)
{
    std::string list;
    for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + text;
    return list.empty() ? "none" : list;
}

}  // namespace

int moveStudy(const std::string& from, const std::string& to, const std::string& station, const std::vector<std::string>& givenUp)
{
    if (database::isServerAddress(from) == database::isServerAddress(to))
        throw protocols::badInput({"a study moves between a folder and a server",
                                   database::withoutPassword(from) + " to " + database::withoutPassword(to),
                                   "one folder and one address (postgresql://USER@HOST/DATABASE?study=NAME)", "name both"});
    if (!givenUp.empty() && !database::isServerAddress(from))
        throw protocols::badInput({"a study on its way to a server has no answers at stations", "--lose-answers-at",
                                   "a study that comes back from a server", "leave the option out"});
    if (!station.empty() && database::isServerAddress(from))
        throw protocols::badInput({"a study on its way to a folder needs no station", "--station",
                                   "a study that moves to a server", "leave the option out"});
    return database::isServerAddress(from) ? toFolder(from, to, givenUp) : toServer(from, to, station);
}

int joinAsStation(const std::string& address, const std::string& given, const std::string& station)
{
    const auto note = given.empty() ? std::nullopt : database::readServerNote(given);
    if (note && !note->isOwner) {
        if (!station.empty())
            throw protocols::badInput({"this folder is that of station " + note->station + " already", given,
                                       "a new folder for station " + station, "leave out --station, or name a new folder"});
        takeAddress(database::serverAddressFrom(address), {given});
        std::printf("%s: this station uses the new address\n", protocols::printable(given).c_str());
        return 0;
    }
    const database::JoinedStudy joined =
        joinStudy(database::serverAddressFrom(address), given.empty() ? fs::path() : fs::path(given), stationName(station));
    std::printf("%s: this is station %s of the study %s\n", protocols::printable(joined.folder.string()).c_str(),
                joined.station.c_str(), joined.name.c_str());
    std::printf("next: `vis2hap %s` opens it\n", protocols::shellWord(joined.folder.string()).c_str());
    return 0;
}

int grantRoles(const std::string& address, const std::vector<std::string>& grants, const std::string& imagesTo, bool releasesHeld)
{
    std::vector<std::pair<std::string, std::string>> logins;
    for (const std::string& text : grants) {
        const auto equals = text.find('=');
        if (equals == std::string::npos)
            throw protocols::badInput(
                {"\"" + text + "\" gives no role", "--grant", "LOGIN=experimenter, =monitor, =analyst or =display", "name both"});
        logins.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    for (const std::string& line : makeRoles(database::serverAddressFrom(address), logins))
        std::printf("%s\n", protocols::printable(line).c_str());
    quietTheLog(database::serverAddressFrom(address));
    if (releasesHeld) {
        const auto released = database::releaseHeld(database::serverAddressFrom(address));
        for (const std::string& line : released) std::printf("%s\n", protocols::printable(line).c_str());
        if (released.empty()) std::printf("the server holds back no slot and no presentation\n");
    }
    if (imagesTo.empty()) return 0;
    giveImagesTo(database::serverAddressFrom(address), imagesTo);
    if (imagesTo == "display") closeCounters(database::serverAddressFrom(address));
    std::printf(imagesTo == "display" ? "images: to the display's own login; stations get tickets\n"
                                      : "images: to the stations\n");
    return 0;
}

int showServer(const std::string& address)
{
    const database::ServerProgress seen = progressOf(database::serverAddressFrom(address));
    std::printf("places: %d free, %d started, %d finished; participants who withdrew: %d; answers: %d\n", seen.free, seen.started,
                seen.finished, seen.withdrawn, seen.answers);
    if (const auto held = heldPlaces(seen); !held.empty())
        std::printf(
            "places of participants who withdrew wait for the owner: %zu; `vis2hap server roles ADDRESS --release-held`\n",
            held.size());
    std::printf("log head %s\n", protocols::printable(seen.head).c_str());
    if (seen.stations.empty()) std::printf("no station has joined lately\n");
    for (const auto& one : seen.stations)
        std::printf("  %-20s %-12s %-10s entries that wait: %s, last sign of life %d s ago, by %s\n",
                    protocols::printable(one.station).c_str(), one.isLive ? "connected" : "away",
                    one.participant.empty() ? "-" : protocols::printable(one.participant).c_str(),
                    one.isLive ? std::to_string(one.waiting).c_str() : "unknown", one.lastSeenSeconds,
                    protocols::printable(one.login).c_str());
    for (const auto& one : seen.owed)
        std::printf("  %-20s answers of an earlier connection may wait there%s%s\n", protocols::printable(one.station).c_str(),
                    one.participant.empty() ? "" : ": ", protocols::printable(one.participant).c_str());
    return 0;
}

int checkLogin(const std::string& address, const JsonTarget& target)
{
    const database::ServerRights rights = rightsOf(database::serverAddressFrom(address));
    const bool isOperator = rights.learns.empty();
    if (target) {
        writeJson(target, {{"schema", "vis2hap.login-check/1"},
                           {"study", rights.study},
                           {"login", rights.login},
                           {"roles", rights.roles},
                           {"may_call", rights.may},
                           {"images_to", rights.imagesTo},
                           {"learns", rights.learns},
                           {"refused", rights.refused}});
    } else {
        std::printf("login %s of the study %s\n", protocols::printable(rights.login).c_str(),
                    protocols::printable(rights.study).c_str());
        std::printf("  roles: %s\n  may call: %s\n", protocols::printable(listOf(rights.roles)).c_str(),
                    protocols::printable(listOf(rights.may)).c_str());
        for (const std::string& line : rights.refused) std::printf("  refused: %s\n", protocols::printable(line).c_str());
        for (const std::string& line : rights.learns) std::printf("  LEARNS: %s\n", protocols::printable(line).c_str());
        std::printf("%s\n",
                    isOperator ? reachOf(rights) : "more than a station may: give this login to nobody who runs sessions");
    }
    return static_cast<int>(isOperator ? protocols::ExitCode::Done : protocols::ExitCode::WorkFailed);
}

int moveNewStudy(const std::string& folder, const std::string& address) { return toServer(folder, address, {}); }

std::string folderOfNewStudy(const std::string& address)
{
    const auto whole = addressWithStudy(address);
    requireFreeName(whole);
    return whole.study;
}

}  // namespace study::commands
