#include "database/study_creation.h"

#include <nlohmann/json.hpp>
#include <system_error>

#include "database/event_chain.h"
#include "database/keys.h"
#include "database/schema.h"
#include "database/stored_texts.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace database {

namespace {

void insertFacts(const SqliteConnection& sqlite, const StudyFacts& facts)
{
    sqlite.run(
        QStringLiteral("INSERT INTO study(id, name, protocol_json, protocol_sha256, design_seed, key_sha256, station_key_sha256, "
                       "has_passphrase, dataset_path, dataset_sha256, dataset_procedural, model_sha256, stamps, signals_json, "
                       "planned_balance, created_at, program_version, made_with) "
                       "VALUES (1, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
        {toQt(facts.name), toQt(facts.protocolJson), toQt(facts.protocolSha256), toQt(std::to_string(facts.designSeed)),
         toQt(facts.keySha256), toQt(facts.stationKeySha256), int(facts.hasPassphrase), toQt(facts.datasetPath),
         toQt(facts.datasetSha256), int(facts.datasetProcedural), toQt(facts.modelSha256), toQt(jsonOf(facts.stamps)),
         toQt(facts.signalsJson), toQt(facts.plannedBalance), toQt(facts.createdAt), toQt(facts.programVersion),
         toQt(facts.madeWith)});
    int position = 0;
    for (const protocols::FabricId& fabric : facts.fabrics) {
        const auto name = facts.fabricNames.find(fabric);
        sqlite.run(QStringLiteral("INSERT INTO fabrics(position, id, name) VALUES (?, ?, ?)"),
                   {++position, toQt(fabric.value), toQt(name == facts.fabricNames.end() ? fabric.value : name->second)});
    }
}

void insertFamiliarisation(const SqliteConnection& sqlite, const StudyFacts& facts)
{
    int position = 0;
    for (const FamiliarisationItem& item : facts.familiarisation)
        sqlite.run(QStringLiteral("INSERT INTO familiarisation(position, name, sealed_code) VALUES (?, ?, ?)"),
                   {++position, toQt(item.name), toQt(item.sealedCode.value)});
}

void insertSwatches(const SqliteConnection& sqlite, const StudyFacts& facts)
{
    for (std::size_t slot = 0; slot < facts.swatches.size(); ++slot)
        for (const auto& [fabric, code] : facts.swatches[slot])
            sqlite.runKept(QStringLiteral("INSERT INTO swatches(slot, fabric, code) VALUES (?, ?, ?)"),
                           {static_cast<int>(slot) + 1, toQt(fabric.value), toQt(code)});
}

void insertSlot(const SqliteConnection& sqlite, int slot, const std::vector<protocols::BlindedTrial>& trials)
{
    sqlite.runKept(QStringLiteral("INSERT INTO slots(number) VALUES (?)"), {slot});
    for (const protocols::BlindedTrial& trial : trials)
        sqlite.runKept(QStringLiteral("INSERT INTO trials(slot, number, phase, presentation_code, alternatives, sealed_code, "
                                      "instruction, aim, deadline_ms) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)"),
                       {slot, trial.number.value, trial.phase, toQt(trial.presentationCode.value),
                        toQt(jsonOf(trial.alternatives)), toQt(trial.sealedCode.value), toQt(trial.instruction.value),
                        toQt(nameOf(trial.aim)), trial.deadlineMs ? QVariant(*trial.deadlineMs) : QVariant()});
}

void recordCreation(const SqliteConnection& sqlite, const StudyFolder& folder, const StudyFacts& facts)
{
    LogEntry entry;
    entry.event.kind = "created";
    nlohmann::json payload{{"fixed_sha256", hashOfFixedTables(sqlite)}, {"schema", schemaVersion}};
    if (const std::string sealed = sha256OfSealedKey(folder); !sealed.empty()) payload[sealedKeyField] = sealed;
    entry.event.payloadJson = payload.dump();
    entry.event.wallTime = facts.createdAt;
    store(sqlite, entry);
}

/// The database under another name until it is complete, so that study.db is never half a study.
class DraftDatabase {
public:
    explicit DraftDatabase(const StudyFolder& folder) : m_final(folder.database()), m_draft(folder.folder / "study.db.partial")
    {
        removeDraft();
    }
    ~DraftDatabase() { removeDraft(); }
    DraftDatabase(const DraftDatabase&) = delete;
    DraftDatabase& operator=(const DraftDatabase&) = delete;

    const std::filesystem::path& path() const { return m_draft; }
    void putInPlace() const { protocols::putFileInPlace(m_draft, m_final); }

private:
    void removeDraft() const
    {
        std::error_code ignored;
        for (const char* ending : {"", "-wal", "-shm", "-journal"}) std::filesystem::remove(m_draft.string() + ending, ignored);
    }
    std::filesystem::path m_final, m_draft;
};

}  // namespace

void createDatabase(const StudyFolder& folder, const StudyFacts& facts,
                    const std::vector<std::vector<protocols::BlindedTrial>>& slots,
                    const std::map<protocols::FileCode, std::string>& stimulusHashes)
{
    makeDatabase(folder, [&](const SqliteConnection& sqlite) {
        insertFixedRows(sqlite, facts, slots, stimulusHashes);
        recordCreation(sqlite, folder, facts);
    });
}

void makeDatabase(const StudyFolder& folder, const std::function<void(const SqliteConnection&)>& fill)
{
    const DraftDatabase draft(folder);
    {
        const SqliteConnection sqlite(draft.path(), SqliteConnection::Mode::Create);
        Transaction transaction(sqlite);
        makeSchema(sqlite);
        fill(sqlite);
        transaction.commit();
        sqlite.run(QStringLiteral("PRAGMA wal_checkpoint(TRUNCATE)"));
    }
    draft.putInPlace();
}

void insertFixedRows(const SqliteConnection& sqlite, const StudyFacts& facts,
                     const std::vector<std::vector<protocols::BlindedTrial>>& slots,
                     const std::map<protocols::FileCode, std::string>& stimulusHashes)
{
    insertFacts(sqlite, facts);
    for (const auto& [code, hash] : stimulusHashes)
        sqlite.runKept(QStringLiteral("INSERT INTO stimuli(file_code, sha256) VALUES (?, ?)"), {toQt(code.value), toQt(hash)});
    for (std::size_t slot = 0; slot < slots.size(); ++slot) insertSlot(sqlite, static_cast<int>(slot) + 1, slots[slot]);
    insertSwatches(sqlite, facts);
    insertFamiliarisation(sqlite, facts);
}

}  // namespace database
