#include "study/records/evidence/data_sheet.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "database/disk/server_note.h"
#include "database/evidence/acts.h"
#include "database/evidence/stored_tables.h"
#include "database/server/server_address.h"
#include "database/stored_texts.h"
#include "protocols/process/computer_name.h"
#include "study/records/display_response_record.h"
#include "study/records/evidence/data_words.h"
#include "study/records/log_heads.h"
#include "study/records/stored_study.h"

namespace study::records {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ordered_json peopleOf(const database::StudyStore& store)
{
    std::map<std::string, int> kinds{{"human", 0}, {"scripted", 0}, {"simulated", 0}};
    std::map<std::string, int> states{{"started", 0}, {"finished", 0}, {"withdrawn", 0}};
    for (const auto& enrolment : store.enrolments()) {
        ++kinds[nameOf(enrolment.kind)];
        ++states[nameOf(enrolment.state)];
    }
    return {{"kinds", kinds}, {"states", states}};
}

/// "0700" for the mode of a file.
std::string octal(mode_t mode)
{
    std::string text = "0000";
    for (int digit = 3; digit > 0; --digit, mode >>= 3)
        text[static_cast<std::size_t>(digit)] = static_cast<char>('0' + (mode & 7));
    return text;
}

/// Bytes of a file, or of everything in a folder.
std::uintmax_t bytesBelow(const fs::path& path)
{
    std::error_code gone;
    if (!fs::is_directory(path, gone)) return fs::is_regular_file(path, gone) ? fs::file_size(path, gone) : 0;
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(path, gone))
        if (entry.is_regular_file(gone)) bytes += entry.file_size(gone);
    return bytes;
}

/// `isOlder`: a file of a study of an earlier version, which sealed nothing.
ordered_json sheetFileRow(const fs::path& path, bool isOlder)
{
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) return {};
    const std::string name = path.filename().string();
    ordered_json row{{"name", name}, {"mode", octal(status.st_mode)}, {"bytes", bytesBelow(path)}};
    const auto words = fileWords(name);
    row["what"] = words ? words->words : "does not belong to the study";
    row["protection"] = !words ? "unknown" : isOlder ? "not encrypted: of an earlier version" : words->protection;
    return row;
}

ordered_json fileRows(const fs::path& study, bool isOlder)
{
    std::error_code unreadable;
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(study, unreadable)) paths.push_back(entry.path());
    std::ranges::sort(paths);
    ordered_json rows = ordered_json::array();
    for (const auto& path : paths)
        if (auto row = sheetFileRow(path, isOlder); !row.empty()) rows.push_back(std::move(row));
    return rows;
}

std::string wordsOfTable(const std::string& name)
{
    const auto words = tableWords();
    const auto found = std::ranges::find_if(words, [&](const TableWords& one) { return name == one.table; });
    return found == words.end() ? "" : found->words;
}

ordered_json columnRow(const std::string& table, const std::string& column)
{
    const ColumnWords* words = wordsOf(table, column);
    if (words == nullptr)
        return {{"column", column}, {"what", nullptr}, {"why", {{"what", "this program does not know the column"}}}};
    ordered_json row{{"column", column}, {"what", words->words}, {"personal", words->atErasure != AtErasure::NotPersonal}};
    if (words->atErasure != AtErasure::NotPersonal) row["at_erasure"] = nameOf(words->atErasure);
    return row;
}

ordered_json tableRows(const database::StudyStore& store)
{
    ordered_json rows = ordered_json::array();
    for (const auto& table : storedTables(store)) {
        ordered_json columns = ordered_json::array();
        bool isPersonal = false;
        for (const auto& column : table.columns) {
            columns.push_back(columnRow(table.name, column));
            isPersonal = isPersonal || columns.back().value("personal", true);
        }
        rows.push_back({{"table", table.name},
                        {"what", wordsOfTable(table.name)},
                        {"rows", table.rows},
                        {"personal", isPersonal},
                        {"columns", columns}});
    }
    return rows;
}

/// Who reads what, before the unblinding and after it.
struct Reader {
    const char* who;
    const char* before;
    const char* after;
};

constexpr Reader readers[] = {
    {"operator, in the app", "codes of presentations and pieces, the answers and notes of the session, progress, flags",
     "the same"},
    {"this account and root, in the study folder",
     "facts, answers, notes and times in study.db, under codes; no condition and no true piece, unless they open images with the "
     "station key",
     "everything"},
    {"owner of the passphrase, in the study folder", "everything", "everything"},
    {"readers of exports and reports",
     "progress, balance and flags; with the passphrase also rounded means under masked labels; "
     "with --format script the answers by trial",
     "every answer with fabric and condition under participants' codes; reports sum up the facts"},
    {"the participant, through `vis2hap export --participant`", "everything about them, without fabrics and conditions",
     "everything about them"},
    {"other accounts of the computer", "nothing, as long as the modes are 0600 and 0700", "the same"},
};

/// A study on a server has these readers, too. (database/server/sql/roles.sql)
constexpr Reader readersOnServer[] = {
    {"administrator of the server, and who reads its log or its backups",
     "facts, answers, notes and times, under codes; images and codes of presentations; not the allocation key", "the same"},
    {"stations, by their login",
     "image, tray and code of the present presentation, and what they send; a station may take up each participant who is at no "
     "other station, and gets the whole log and the presentations that this participant has had",
     "the same"},
    {"monitors, by their login", "progress and stations", "the same"},
    {"analysts, by their login", "the rows of the study without facts about people", "the same"},
};

/// What somebody with the files reads before the unblinding; empty where they are sealed.
std::string readOpenly(const database::StudyStore& store, const database::StudyFacts& facts)
{
    if (store.isUpgradedCopy()) return "everything: the files of an earlier version are not sealed before the upgrade";
    return facts.hasPassphrase ? "" : "everything: this study has no passphrase";
}

ordered_json readerRows(const database::StudyStore& store, const database::StudyFacts& facts)
{
    ordered_json rows = ordered_json::array();
    const std::string open = readOpenly(store, facts);
    const auto add = [&](const Reader& reader, bool readsFiles) {
        rows.push_back({{"who", reader.who},
                        {"before_unblinding", readsFiles && !open.empty() ? open : reader.before},
                        {"after_unblinding", reader.after}});
    };
    for (const Reader& reader : readers) add(reader, std::string(reader.who).starts_with("this account"));
    if (!store.serverFolder().empty())
        for (const Reader& reader : readersOnServer) add(reader, false);
    return rows;
}

/// First and last date in the log: how long data have been there.
ordered_json durationOf(const database::StudyStore& store, const database::StudyFacts& facts)
{
    return {{"since", facts.createdAt},
            {"entries", store.head().sequence},
            {"period", nullptr},
            {"why", {{"period", "protocols state none, and the program deletes nothing by itself"}}}};
}

ordered_json erasureOf(const database::StudyStore& store)
{
    ordered_json done = ordered_json::array();
    for (const auto& erasure : store.erasures())
        done.push_back({{"time", erasure.wallTime}, {"answers_too", erasure.answersToo}});
    return {{"does",
             {"`vis2hap erase --participant ID` removes facts and what the participant said after the session.",
              "With --answers it also removes every answer, note and time, and the random salts of the log.",
              "The log keeps number, kind and hash of each entry. Without the salt nobody can guess the content from it.",
              "The program then searches every file of the study for what it removed, and writes a certificate."}},
            {"cannot",
             {"It does not change copies that were made before: backups, exports, reports, copies by hand, backups of the disk.",
              "It does not remove the participant's code and running order, nor the name and reason of the erasure.",
              "It does not wipe what a disk or a journal of the file system keeps of overwritten blocks. Encrypt the disk.",
              "It does not change results that were computed before."}},
            {"done", done}};
}

ordered_json sheetActRows(const database::StudyStore& store)
{
    ordered_json rows = ordered_json::array();
    for (const auto& act : actsOf(store))
        rows.push_back({{"act", act.kind}, {"time", act.wallTime}, {"who", act.who}, {"host", act.host}, {"path", act.path}});
    return rows;
}

std::string sentenceOnKey(const database::StudyStore& store, const database::StudyFacts& facts)
{
    if (store.unblinding()) return "The study is unblinded: the key that names fabrics and conditions lies open.";
    return facts.hasPassphrase ? "A passphrase of the owner seals the key that names fabrics and conditions. Nobody can restore "
                                 "a lost passphrase."
                               : "The study has no passphrase: the key that names fabrics and conditions lies open.";
}

/// How the database and the images are protected where they lie.
ordered_json protectionOf(const database::StudyStore& store, const database::StudyFacts& facts)
{
    return {store.serverFolder().empty()
                ? "The database is not encrypted. File modes keep other accounts out. Use an encrypted disk against theft."
                : "The database on the server is not encrypted. Logins and their rights keep others out. Use encrypted disks "
                  "there and here against theft.",
            store.isUpgradedCopy()
                ? "An earlier version made this study. Its images and keys lie open in the folder and name every condition. The "
                  "app and `vis2hap replay` upgrade it, which seals them."
                : "Images and codes of presentations are encrypted with the station key, which lies in the folder for the "
                  "sessions.",
            sentenceOnKey(store, facts)};
}

/// Where data are besides the study.
ordered_json elsewhereOf(const database::StudyStore& store)
{
    ordered_json sentences{
        "The app keeps the paths of recent studies in the settings of the account.",
        "If somebody removes the open database, the answers lie in a rescue file: in the study folder, beside it, or in the "
        "folder for temporary files.",
        "Over a network the program sends images to a display driver that the operator named.",
        "Where participants use a tablet, the page and what they do on it go over the network of the tablet without encryption. "
        "Everybody in that network can read them: consent, facts, places on the scale."};
    if (store.serverFolder().empty()) return sentences;
    sentences.push_back(
        "Stations send consent, facts, answers and notes to the server over a network. To another computer the program asks for "
        "encryption, unless the address or PGSSLMODE says otherwise.");
    sentences.push_back(
        "The server's log, write-ahead log and backups may keep data after an erasure. The way back to the folder prints the "
        "commands that remove them.");
    sentences.push_back(
        "The folder of a station keeps answers while they wait for the server, and those of a session that could not go on "
        "(not-sent-….json, held-….json). No erasure reaches the latter at a station: delete them there.");
    return sentences;
}

std::vector<std::string> factsOfAllVersions(const database::StudyStore& store)
{
    std::vector<std::string> facts;
    for (const auto& version : store.protocolVersions()) {
        const auto protocol = protocols::keptProtocolFromJson(version.json, "the study's protocol", store.facts().programVersion);
        for (const auto& fact : protocol.facts)
            if (std::ranges::find(facts, fact) == facts.end()) facts.push_back(fact);
    }
    return facts;
}

/// Other texts of consent, by which participants may have agreed; the newest first.
ordered_json consentsBefore(const database::StudyStore& store)
{
    auto rows = ordered_json::array();
    const auto versions = store.protocolVersions();
    std::string later = latestProtocolOf(store).consent;
    for (auto version = versions.rbegin(); version != versions.rend(); ++version) {
        const auto text =
            protocols::keptProtocolFromJson(version->json, "the study's protocol", store.facts().programVersion).consent;
        if (text == later) continue;
        rows.push_back({{"version", version->version}, {"text", text}});
        later = text;
    }
    return rows;
}

}  // namespace

ordered_json dataSheetOf(const database::StudyStore& store)
{
    const auto facts = store.facts();
    const auto protocol = latestProtocolOf(store);
    ordered_json sheet{{"schema", "vis2hap.data-sheet/1"},
                       {"study", facts.name},
                       {"protocol_sha256", store.protocolVersions().back().sha256},
                       {"made_at", database::wallTimeNow()},
                       {"program", facts.programVersion},
                       {"blinded", !store.unblinding().has_value()},
                       {"passphrase", facts.hasPassphrase},
                       {"participants", peopleOf(store)},
                       {"facts_asked", factsOfAllVersions(store)},
                       {"consent", protocol.consent},
                       {"consents_before", consentsBefore(store)},
                       {"display_response", displayResponseSentence(facts)}};
    const fs::path folder = fs::absolute(store.namedFolder()).lexically_normal();
    const auto note = database::readServerNote(folder);
    sheet["place"] = {{"host", protocols::computerName()},
                      {"folder", folder.string()},
                      {"server", note ? ordered_json(database::withoutPassword(note->address)) : ordered_json(nullptr)},
                      {"files", fileRows(folder, store.isUpgradedCopy())}};
    if (!note) sheet["place"]["why"] = {{"server", "the study lies in its folder"}};
    sheet["protection"] = protectionOf(store, facts);
    sheet["tables"] = tableRows(store);
    sheet["readers"] = readerRows(store, facts);
    sheet["duration"] = durationOf(store, facts);
    sheet["erasure"] = erasureOf(store);
    sheet["elsewhere"] = elsewhereOf(store);
    sheet["acts"] = sheetActRows(store);
    sheet["contact"] = nullptr;
    sheet["why"] = {{"contact", "protocols name no contact"}};
    sheet["log_head"] = headTextOf(store);
    return sheet;
}

}  // namespace study::records
