#include "database/study_upgrade.h"

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>

#include "database/keys.h"
#include "database/older_study.h"
#include "database/schema.h"
#include "database/stored_texts.h"
#include "database/study_creation.h"
#include "protocols/files/disk_sync.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "protocols/records/key_json.h"
#include "protocols/records/sealed_stimulus.h"

namespace database {

namespace {

namespace fs = std::filesystem;

/// What takes the place of open file codes and keys.
struct NewSeals {
    std::map<protocols::FileCode, protocols::FileCode> codes;  ///< of the older study -> new and drawn in secret
    std::map<protocols::FileCode, std::string> hashes;         ///< of the sealed stimuli; empty for one that was not usable
    protocols::SecretKey stationKey;
    std::string keySha256, stationKeySha256;
};

using BlindedLists = std::vector<std::vector<protocols::BlindedTrial>>;

protocols::SealedCode newlySealed(const protocols::FileCode& image, const NewSeals& seals)
{
    const auto fresh = seals.codes.find(image);
    if (fresh == seals.codes.end())
        throw protocols::workFailed({"a trial shows stimulus " + image.value + ", which the study does not have", "study.db",
                                     "one of the study's stimuli",
                                     "restore the study from a backup; it cannot be upgraded like this"});
    return protocols::sealed(fresh->second, seals.stationKey);
}

StudyFacts upgradedFacts(const OlderStudy& study, const NewSeals& seals)
{
    StudyFacts facts = study.facts;
    facts.keySha256 = seals.keySha256;
    facts.stationKeySha256 = seals.stationKeySha256;
    facts.hasPassphrase = false;
    facts.stamps.emplace_back(noPassphraseStamp);
    facts.plannedBalance = R"({"balance":[]})";  // exact counts would name true pieces
    facts.madeWith = "{}";
    for (const auto& [name, image] : study.familiarisation) facts.familiarisation.push_back({name, newlySealed(image, seals)});
    return facts;
}

BlindedLists upgradedLists(const OlderStudy& study, const NewSeals& seals)
{
    BlindedLists lists;
    for (const auto& slot : study.slots) {
        auto& list = lists.emplace_back();
        for (const OlderTrial& older : slot) {
            list.push_back(older.trial);
            list.back().sealedCode = newlySealed(older.image, seals);
        }
    }
    return lists;
}

/// The list of trials of each participant.
std::map<std::string, const std::vector<protocols::BlindedTrial>*> listsOfParticipants(const SqliteConnection& made,
                                                                                       const BlindedLists& lists)
{
    std::map<std::string, const std::vector<protocols::BlindedTrial>*> found;
    QSqlQuery row = made.run(QStringLiteral("SELECT id, slot FROM participants"));
    while (row.next())
        if (const auto slot = row.value(1).toULongLong(); slot >= 1 && slot <= lists.size())
            found[fromQt(row.value(0))] = &lists[slot - 1];
    return found;
}

/// Answers stand under the code of their presentation, no longer under that of their image.
void renamePresentations(OlderStudy& study, const SqliteConnection& made, const BlindedLists& lists)
{
    const auto byParticipant = listsOfParticipants(made, lists);
    for (auto& one : study.responses) {
        ResponseRow& row = one.row;
        const auto list = byParticipant.find(row.participant);
        const bool isPlanned =
            list != byParticipant.end() && row.trial >= 1 && row.trial <= static_cast<int>(list->second->size());
        row.presentationCode =
            isPlanned ? codeOfAttempt(*list->second, static_cast<std::size_t>(row.trial) - 1, row.attempt).value : std::string();
    }
}

void insertNumberedRows(const SqliteConnection& made, const OlderStudy& study)
{
    const QString response = QStringLiteral("INSERT INTO responses(id, event, %1) VALUES (?, ?, %2)")
                                 .arg(namesOf(ResponseColumns::OfTable), placeholders());
    for (const auto& one : study.responses) made.run(response, QVariantList{one.id, one.event} + valuesOf(one.row));
    for (const auto& [id, event, row] : study.voids)
        made.run(QStringLiteral("INSERT INTO voids(event, participant, trial, attempt) VALUES (?, ?, ?, ?)"),
                 {event, toQt(row.participant), row.trial, row.attempt});
    for (const auto& [id, event, row] : study.notes)
        made.run(QStringLiteral("INSERT INTO notes(id, event, participant, trial, attempt, question, text, is_flag) "
                                "VALUES (?, ?, ?, ?, ?, ?, ?, ?)"),
                 {id, event, toQt(row.participant), row.trial, row.attempt,
                  row.question ? QVariant(toQt(*row.question)) : QVariant(), toQt(row.text), int(row.isFlag)});
    for (const auto& [event, record] : study.unblindings)
        made.run(QStringLiteral("INSERT INTO unblindings(event, who, why, wall_time) VALUES (?, ?, ?, ?)"),
                 {event, toQt(record.who), toQt(record.why), toQt(record.wallTime)});
}

/// Writes the log with new commitments and hashes. An erased entry has no content, and so it gets no salt.
void chainAnew(const SqliteConnection& made, const OlderStudy& study)
{
    const auto erasedBefore = erasuresInOlderLog(study);
    std::string previous;
    for (auto& [sequence, entry] : entriesOf(study)) {
        if (!study.events.contains(sequence)) continue;
        const bool isErased = isErasedInOlderLog(entry, erasedBefore);
        LogEntry chained = entry;
        if (isErased) {
            chained.event.atNs = 0;
            chained.event.wallTime.clear();
        }
        previous = storeUnderItsNumber(made, chained, previous, isErased ? std::string() : drawnSalt());
    }
}

/// The logs of version 0.1.0 do not say that a session is finished, so that the upgrade says it.
std::map<std::string, std::string> statesIn(const SqliteConnection& made)
{
    std::map<std::string, std::string> states;
    QSqlQuery row = made.run(QStringLiteral("SELECT id, state FROM participants"));
    while (row.next()) states[fromQt(row.value(0))] = fromQt(row.value(1));
    return states;
}

/// Gives each fact a salt. The upgrade's entry holds the hashes, because the older log does not.
std::map<std::string, std::map<std::string, std::string>> committedFacts(const SqliteConnection& made)
{
    std::map<std::string, std::map<std::string, std::string>> hashes;  // an ordered object would look through all keys for each
    std::vector<std::array<std::string, 3>> facts;
    QSqlQuery row = made.run(QStringLiteral("SELECT participant, fact, value FROM participant_facts ORDER BY participant, fact"));
    while (row.next()) facts.push_back({fromQt(row.value(0)), fromQt(row.value(1)), fromQt(row.value(2))});
    for (const auto& [participant, fact, value] : facts) {
        const std::string salt = drawnSalt();
        made.run(QStringLiteral("UPDATE participant_facts SET salt = ? WHERE participant = ? AND fact = ?"),
                 {toQt(salt), toQt(participant), toQt(fact)});
        hashes[participant][fact] = commitmentOfFact(salt, fact, value);
    }
    return hashes;
}

void recordUpgrade(const SqliteConnection& made, const OlderStudy& study, const std::vector<std::string>& faults)
{
    const std::string oldHead = study.links.empty() ? std::string() : study.links.rbegin()->second.own;
    store(made, actOnStudy(upgradedKind,
                           {{"from_schema", study.version},
                            {"schema", schemaVersion},
                            {"old_head", oldHead},
                            {"faults_before", faults},
                            {"states", statesIn(made)},
                            {"facts_sha256", committedFacts(made)},
                            {"fixed_sha256", hashOfFixedTables(made)},
                            {"program_version", "vis2hap " VIS2HAP_VERSION}},
                           wallTimeNow()));
}

/// Makes `file` in one transaction, every row with its number and its times. `faults`: what was wrong with the older study.
void makeUpgradedDatabase(const std::filesystem::path& file, const SqliteConnection& older, const OlderStudy& study,
                          const NewSeals& seals, const std::vector<std::string>& faults)
{
    const BlindedLists lists = upgradedLists(study, seals);
    const SqliteConnection made(file, SqliteConnection::Mode::Create);
    // A damaged older study may hold rows that refer to missing ones. They are kept, and `verify` lists them.
    made.run(QStringLiteral("PRAGMA foreign_keys = OFF"));
    {
        Transaction transaction(made);
        makeSchema(made);
        insertFixedRows(made, upgradedFacts(study, seals), lists, seals.hashes);
        for (const char* table : {"participants", "participant_facts", "protocol_versions", "erasures"})
            copyOlderRows(older, made, QLatin1String(table), study.version);
        OlderStudy renamed = study;
        renamePresentations(renamed, made, lists);
        insertNumberedRows(made, renamed);
        chainAnew(made, renamed);
        recordUpgrade(made, renamed, faults);
        transaction.commit();
    }
    made.run(QStringLiteral("PRAGMA wal_checkpoint(TRUNCATE)"));
}

/// Runs steps on files. Throws environmentFault where one fails.
template <class Steps>
auto onFiles(const StudyFolder& folder, Steps steps)
{
    try {
        return steps();
    } catch (const fs::filesystem_error& fault) {
        throw protocols::environmentFault({std::string("the study cannot be upgraded (") + fault.what() + ")",
                                           folder.folder.string(), "a writable folder with room for a copy of the study",
                                           "make room and open the study again; no answer was lost"});
    }
}

/// Mode 0600, or 0700 for a folder. Some sticks and network shares refuse it; `verify` then names who can read the study.
void keepToOwner(const fs::path& place)
{
    std::error_code refused;
    const bool isFolder = fs::is_directory(place, refused);
    fs::permissions(place, isFolder ? fs::perms::owner_all : fs::perms::owner_read | fs::perms::owner_write, refused);
}

/// Copies the database as one consistent file and every file beside it but the lock. A link would bring a file from elsewhere,
/// and so it is left out; the study keeps it, and `verify` names it.
void copyTopFiles(const StudyFolder& folder, const fs::path& to)
{
    SqliteConnection(folder.database(), SqliteConnection::Mode::Read)
        .run(QStringLiteral("VACUUM INTO ?"), {toQt((to / "study.db").string())});
    for (const auto& entry : fs::directory_iterator(folder.folder)) {
        const std::string name = entry.path().filename().string();
        if (entry.symlink_status().type() != fs::file_type::regular || name == ".lock" || name.starts_with("study.db")) continue;
        protocols::copyBytes(entry.path(), to / name);
    }
    for (const auto& entry : fs::directory_iterator(to)) keepToOwner(entry.path());
}

/// A sentence that names what the copy before an upgrade lacks for that reason; empty where it lacks nothing.
std::string namesOfLinks(const StudyFolder& folder)
{
    std::string names;
    for (const auto& entry : fs::directory_iterator(folder.folder))
        if (entry.is_symlink() && entry.path().filename() != "stimuli")
            names += (names.empty() ? "" : ", ") + protocols::printable(entry.path().filename().string());
    return names.empty() ? "" : " It lacks the links of the study: " + names + ".";
}

/// The stimuli need no room of their own: the copy has other names of the same files.
void linkStimuli(const fs::path& stimuli, const fs::path& to)
{
    if (!fs::is_directory(stimuli)) return;
    fs::create_directory(to);
    keepToOwner(to);
    for (const auto& entry : fs::directory_iterator(stimuli)) {
        const fs::path target = to / entry.path().filename();
        std::error_code notLinked;
        fs::create_hard_link(entry.path(), target, notLinked);
        if (!notLinked) continue;
        if (entry.symlink_status().type() == fs::file_type::regular)
            protocols::copyBytes(entry.path(), target);
        else
            fs::copy(entry.path(), target, fs::copy_options::recursive | fs::copy_options::copy_symlinks);
    }
}

fs::path firstFreeName(const fs::path& wanted)
{
    fs::path name = wanted;
    for (int number = 2; fs::exists(name); ++number) name = wanted.string() + "-" + std::to_string(number);
    return name;
}

fs::path backUp(const StudyFolder& folder)
{
    const fs::path place = firstFreeName(folder.beforeUpgrade());
    protocols::FolderDraft draft(place, protocols::Earlier::Refused);
    keepToOwner(draft.path());
    copyTopFiles(folder, draft.path());
    linkStimuli(folder.stimuli(), draft.path() / "stimuli");
    draft.putInPlace();
    return place;
}

/// The entries of the older key. Empty for a bare database, which has neither keys nor stimuli.
OlderKey olderKeyOf(const StudyFolder& folder, const OlderStudy& study)
{
    const fs::path file = folder.allocationKey();
    const auto text = protocols::readIfPossible(file);
    if (!text && !fs::exists(folder.stimuli())) return std::nullopt;
    if (!text || protocols::sha256(*text) != study.facts.keySha256)
        throw protocols::workFailed(
            {text ? "the allocation key is not the one committed in the database" : "the allocation key cannot be read",
             file.string(), "the file that was made with the study",
             "restore it from a backup; the study cannot be upgraded without it"});
    return protocols::olderKeyEntriesFromJson(*text, file.string());
}

NewSeals newSealsOf(const OlderStudy& study, const OlderKey& key, const protocols::SecretKey& secret)
{
    std::set<protocols::FileCode> known;
    for (const auto& [code, hash] : study.stimuli) known.insert(code);
    if (key)
        for (const auto& [code, entry] : *key) known.insert(code);
    const auto drawn = protocols::newFileCodes(known.size(), secret);
    NewSeals seals{{}, {}, stationKeyOf(secret), study.facts.keySha256, {}};
    auto next = drawn.begin();
    for (const auto& code : known) seals.codes[code] = *next++;
    return seals;
}

/// Seals the images that are as the database says. The others are not trusted: they stay in the copy of the older study.
void sealStimuli(const StudyFolder& folder, const OlderStudy& study, NewSeals& seals, std::vector<std::string>& faults)
{
    if (!fs::exists(folder.stimuli())) {
        for (const auto& [code, hash] : study.stimuli) seals.hashes[seals.codes.at(code)] = "";
        return;
    }
    const fs::path sealedFolder = folder.upgrade() / "stimuli";
    fs::create_directory(sealedFolder);
    keepToOwner(sealedFolder);
    for (const auto& [code, hash] : study.stimuli) {
        const auto bytes = protocols::readIfPossible(folder.stimuli() / (code.value + ".pgm"));
        const bool isUsable = bytes && protocols::sha256(*bytes) == hash;
        const auto& fresh = seals.codes.at(code);
        seals.hashes[fresh] = isUsable ? writeSealedStimulus(sealedFolder, fresh, *bytes, seals.stationKey) : std::string();
        if (!isUsable) faults.push_back("stimulus " + code.value + (bytes ? " was altered" : " is missing"));
    }
}

void writeNewKeys(const StudyFolder& folder, const KeyEntries& entries, const protocols::SecretKey& secret, NewSeals& seals)
{
    protocols::AllocationKey key{{}, secret};
    for (const auto& [code, entry] : entries) key.entries[seals.codes.at(code)] = entry;
    const KeyHashes hashes = writeKeys({folder.upgrade()}, key);
    seals.keySha256 = hashes.allocation;
    seals.stationKeySha256 = hashes.station;
}

/// Fills .upgrade/ with all that is new.
void prepareAnew(const StudyFolder& folder)
{
    fs::remove_all(folder.upgrade());
    fs::create_directory(folder.upgrade());
    keepToOwner(folder.upgrade());
    const SqliteConnection older(folder.database(), SqliteConnection::Mode::Read);
    const ReadSnapshot snapshot(older);
    const OlderStudy study = readOlderStudy(older);
    const auto key = olderKeyOf(folder, study);
    auto faults = faultsOfOlderLog(older, study);
    if (key && protocols::sha256(protocols::readIfPossible(folder.maskedKey()).value_or("")) != study.maskedKeySha256)
        faults.emplace_back("masked-key.json was missing or altered");
    const auto secret = protocols::SecretKey::drawn();
    NewSeals seals = newSealsOf(study, key, secret);
    sealStimuli(folder, study, seals, faults);
    if (key) writeNewKeys(folder, *key, secret, seals);
    const fs::path made = folder.upgrade() / "study.db";
    makeUpgradedDatabase(made, older, study, seals, faults);
    keepToOwner(made);
    protocols::syncTree(folder.upgrade());
}

/// SQLite would take the log of the older file for one of the new file, so that the older one must end first.
void replaceDatabase(const StudyFolder& folder)
{
    {
        const SqliteConnection older(folder.database(), SqliteConnection::Mode::Write);
        if (fromQt(older.value(QStringLiteral("PRAGMA journal_mode = DELETE"))) != "delete")
            throw protocols::environmentFault({"another program reads the study", folder.folder.string(), "no other program",
                                               "close it and open the study again"});
    }
    protocols::putFileInPlace(folder.upgrade() / "study.db", folder.database());
}

/// Step 4 may find any part of itself done.
void finish(const StudyFolder& folder, const UpgradeStep& reached)
{
    if (const fs::path made = folder.upgrade() / "stimuli"; fs::exists(made)) {
        fs::remove_all(folder.stimuli());
        reached("open stimuli removed");
        fs::rename(made, folder.stimuli());
        reached("sealed stimuli in place");
    }
    for (const fs::path& key : {folder.allocationKey(), folder.stationKey()})
        if (const fs::path made = folder.upgrade() / key.filename(); fs::exists(made)) {
            fs::rename(made, key);
            reached(key.filename().string() + " in place");
        }
    fs::remove(folder.maskedKey());
    keepToOwner(folder.folder);
    if (fs::exists(folder.protocol())) keepToOwner(folder.protocol());
    protocols::syncFolder(folder.folder);
    reached("masked key removed");
    fs::remove_all(folder.upgrade());
    protocols::syncFolder(folder.folder);
}

/// Whether a copy of an older study names the participant. One that cannot be read counts, because nobody knows what it holds.
bool isAbout(const fs::path& database, const std::string& participant)
{
    try {
        const SqliteConnection older(database, SqliteConnection::Mode::Read);
        checkedVersion(older);
        return older.value(QStringLiteral("SELECT COUNT(*) FROM participants WHERE id = ?"), {toQt(participant)}).toInt() > 0;
    } catch (const protocols::Error&) {
        return true;
    }
}

/// The copy before an upgrade is not sealed, so a failed upgrade leaves none: the older study still lies in its place.
void replaceOrRemove(const StudyFolder& folder, const fs::path& copy)
{
    try {
        replaceDatabase(folder);
    } catch (...) {
        if (isOlder(folder)) fs::remove_all(copy);
        throw;
    }
}

}  // namespace

bool isOlder(const StudyFolder& folder)
{
    return checkedVersion({folder.database(), SqliteConnection::Mode::Read}) < schemaVersion;
}

bool hasUnfinishedUpgrade(const StudyFolder& folder) { return fs::exists(folder.upgrade()); }

std::string upgrade(const StudyFolder& folder, const UpgradeStep& step)
{
    const UpgradeStep reached = step ? step : [](const std::string&) {};
    return onFiles(folder, [&]() -> std::string {
        if (!isOlder(folder)) {
            finish(folder, reached);
            return folder.folder.string() + ": an upgrade that was interrupted is finished";
        }
        prepareAnew(folder);
        reached("prepared");
        const fs::path copy = backUp(folder);
        reached("copied");
        replaceOrRemove(folder, copy);
        reached("database in place");
        finish(folder, reached);
        return folder.folder.string() +
               ": an earlier version of this program made this study. It is upgraded. The study as it was "
               "lies in " +
               copy.string() +
               ". That copy is not sealed: it names the condition of every trial, and answers erased "
               "before can be guessed from it. Delete it when the upgraded study works." +
               namesOfLinks(folder);
    });
}

std::unique_ptr<protocols::TemporaryFolder> upgradedCopy(const StudyFolder& folder)
{
    auto copy = std::make_unique<protocols::TemporaryFolder>();
    const StudyFolder copied{copy->path()};
    return onFiles(copied, [&] {
        copyTopFiles(folder, copied.folder);
        constexpr auto withLinksAsTheyAre = fs::copy_options::recursive | fs::copy_options::copy_symlinks;
        if (fs::exists(folder.upgrade())) fs::copy(folder.upgrade(), copied.upgrade(), withLinksAsTheyAre);
        if (fs::is_directory(folder.stimuli())) linkStimuli(folder.stimuli(), copied.stimuli());
        for (const char* name : {"erasures", "prompts"})
            if (fs::is_directory(folder.folder / name)) fs::copy(folder.folder / name, copied.folder / name, withLinksAsTheyAre);
        if (isOlder(copied)) {
            prepareAnew(copied);
            replaceDatabase(copied);
        }
        finish(copied, [](const std::string&) {});
        return std::move(copy);
    });
}

std::vector<std::string> copiesBeforeUpgradeOf(const std::string& participant, const StudyFolder& folder)
{
    std::vector<std::string> copies;
    const std::string first = folder.beforeUpgrade().filename().string();
    for (const auto& entry : fs::directory_iterator(folder.folder)) {
        const fs::path copy = entry.path() / "study.db";
        if (!entry.path().filename().string().starts_with(first) || !fs::exists(copy)) continue;
        if (isAbout(copy, participant)) copies.push_back((entry.path().filename() / "study.db").string());
    }
    return copies;
}

}  // namespace database
