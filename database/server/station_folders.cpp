#include "database/server/station_folders.h"

#include <QRegularExpression>
#include <QString>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "database/disk/server_note.h"
#include "database/disk/write_lock.h"
#include "database/server/answer_queue.h"
#include "database/server/server_connection.h"
#include "database/server/server_link.h"
#include "database/server/server_replies.h"
#include "database/server/server_roles.h"
#include "database/server/station_note.h"
#include "database/server/station_store.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace database {

namespace {

namespace fs = std::filesystem;

struct StationPlace {
    fs::path folder;
    ServerNote note;
};

bool isNotedAddress(const ServerAddress& address, const ServerNote& note)
{
    if (address.text == note.address) return true;
    return address.study.empty() && addressOfStudy(address, serverAddressFrom(note.address).study) == note.address;
}

void leaveStation(ServerLink& link)
{
    try {
        link.call("leave", {}, ServerPatience().answer);
    } catch (const protocols::Error&) {
        // The server notices the end of the connection.
    }
}

/// Whether a folder is of the study that was found, as far as its note of an earlier version can tell.
bool seemsSameStudy(const StudyFolder& folder, const ServerNote& before, const ServerNote& now, const StudyFacts& found)
{
    return serverAddressFrom(before.address).database == serverAddressFrom(now.address).database &&
           protocols::readIfPossible(folder.protocol()) == found.protocolJson;
}

/// False where the server has another study at the address.
bool followsStudy(const ServerAddress& address, const StudyFolder& folder)
{
    const WriteLock lock(folder);
    const ServerNote before = noteOfStation(folder);
    if (isNotedAddress(address, before)) return true;
    const std::string study = serverAddressFrom(before.address).study;
    if (!address.study.empty() && address.study != study) return false;
    ServerNote note = before;
    note.address = addressOfStudy(address, study);
    ServerLink link(serverAddressFrom(note.address));
    const ServerReply joined =
        link.call("join_study", {toQt(note.station), toQt(note.token), QStringLiteral("vis2hap " VIS2HAP_VERSION)},
                  ServerPatience().presentation);
    const StudyFacts found = studyReplyFrom(joined.json, note.address).facts;
    note.study = identityOf(found);
    const std::size_t waiting = AnswerQueue(folder).size();
    const bool isKnown = !before.study.empty() || waiting == 0 || seemsSameStudy(folder, before, note, found);
    const bool isSame = isKnown && (before.study.empty() || before.study == note.study);
    // The server takes a station that leaves for one that has sent everything.
    if ((isKnown && !isSame) || waiting == 0) leaveStation(link);
    if (!isKnown)
        throw protocols::badInput({std::to_string(waiting) + " entries for another address wait in the folder of this station",
                                   folder.folder.string(), before.address + ", not " + address.text,
                                   "open the folder itself, so that they are sent; if its address is gone, move it elsewhere and "
                                   "give it to the study's owner"});
    if (isSame) writeServerNote(folder.folder, note);
    return isSame;
}

/// Station folders of studies of this name; of any name where it is empty. A note that cannot be read counts only where the name
/// of its folder tells the study: entries may wait there.
std::vector<StationPlace> stationPlaces(const std::string& study, const fs::path& stations)
{
    std::vector<StationPlace> places;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(stations, none)) try {
            const auto note = readServerNote(entry.path());
            if (note && (study.empty() || serverAddressFrom(note->address).study == study))
                places.push_back({entry.path(), *note});
        } catch (const protocols::Error&) {
            if (!study.empty() && entry.path().filename().string().starts_with(study + "-")) throw;
        }
    std::ranges::sort(places, {}, &StationPlace::folder);
    return places;
}

ServerAddress withStudy(const ServerAddress& address, const fs::path& stations)
{
    if (!address.study.empty()) return address;
    std::vector<StationPlace> noted = stationPlaces("", stations);
    std::erase_if(noted, [&](const StationPlace& place) { return !isNotedAddress(address, place.note); });
    if (noted.size() == 1) return serverAddressFrom(noted.front().note.address);
    ServerConnection server(address);
    server.chooseStudy();
    return server.address();
}

fs::path folderNamedAfter(const ServerAddress& address, const fs::path& stations)
{
    const QString name = QString::fromStdString(address.study + "-" + address.database + "-" + address.host);
    return stations /
           QString(name).replace(QRegularExpression(QStringLiteral("[^A-Za-z0-9_.-]")), QStringLiteral("_")).toStdString();
}

/// Whether another program has the folder open; a disk that cannot be written is no such fault.
bool isHeldByAnother(const protocols::Error& fault)
{
    return std::string_view(fault.what()).find(heldByAnotherProgram) != std::string_view::npos;
}

/// `mayBeOpenElsewhere`: a folder that another program has open counts as empty, because that program sends its entries.
bool holdsEntries(const StudyFolder& folder, bool mayBeOpenElsewhere)
{
    try {
        return entriesWaiting(folder) > 0;
    } catch (const protocols::Error& fault) {
        if (mayBeOpenElsewhere && isHeldByAnother(fault)) return false;
        throw;
    }
}

void sendWhatWaits(const StudyFolder& folder)
{
    const StationStore store(folder);
    if (const std::string refused = store.link().setAside; !refused.empty())
        throw protocols::workFailed({refused, "", "", "give the file to the study's owner, then open the address again"});
}

}  // namespace

std::size_t entriesWaiting(const StudyFolder& folder)
{
    const WriteLock lock(folder);
    return AnswerQueue(folder).size();
}

void takeAddress(const ServerAddress& address, const StudyFolder& folder)
{
    if (isNotedAddress(address, readServerNote(folder.folder).value()) || followsStudy(address, folder)) return;
    throw protocols::badInput({"the server has another study at this address", folder.folder.string(),
                               "an address of the same study, not " + address.text, "choose another folder for the other study"});
}

std::filesystem::path stationFolder(const ServerAddress& typed, const fs::path& stations, const std::string& station)
{
    const ServerAddress address = withStudy(typed, stations);
    const fs::path own = folderNamedAfter(address, stations);
    std::vector<StationPlace> places = stationPlaces(address.study, stations);
    const auto rank = [&](const StationPlace& place) {
        return isNotedAddress(address, place.note) ? 0 : place.folder == own ? 1 : 2;
    };
    std::ranges::stable_sort(places, {}, rank);
    std::optional<fs::path> chosen;
    for (const StationPlace& place : places) {
        // An earlier version's folder under another name is of interest for its entries only: nothing else tells its study.
        const bool isCandidate = !chosen && (rank(place) < 2 || !place.note.study.empty());
        if (!isCandidate && !holdsEntries({place.folder}, chosen.has_value())) continue;
        if (rank(place) > 0 && !followsStudy(address, {place.folder})) continue;
        if (chosen)
            sendWhatWaits({place.folder});
        else
            chosen = place.folder;
    }
    if (chosen) return *chosen;
    fs::path made = own;
    for (int number = 2; fs::exists(serverNoteOf(made)); ++number) made = own.string() + "-" + std::to_string(number);
    return joinStudy(address, made, station).folder;
}

}  // namespace database
