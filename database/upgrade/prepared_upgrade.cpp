#include "database/upgrade/prepared_upgrade.h"

#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "database/keys.h"
#include "database/schema.h"
#include "database/stored_texts.h"
#include "database/study_creation.h"
#include "database/upgrade/older_study.h"
#include "database/upgrade/upgrade_files.h"
#include "protocols/files/disk_sync.h"
#include "protocols/files/errors.h"
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

}  // namespace

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

}  // namespace database
