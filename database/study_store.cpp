#include "database/study_store.h"

#include <QDateTime>
#include <charconv>
#include <nlohmann/json.hpp>
#include <system_error>

#include "database/event_chain.h"
#include "database/schema.h"
#include "database/store_connection.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace database {

namespace {

void insertFacts(const SqliteConnection& sqlite, const StudyFacts& facts)
{
    sqlite.run(
        QStringLiteral("INSERT INTO study(id, name, protocol_json, protocol_sha256, design_seed, key_sha256, masked_key_sha256, "
                       "dataset_path, dataset_sha256, dataset_procedural, model_sha256, stamps, signals_json, created_at, "
                       "program_version) VALUES (1, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
        {toQt(facts.name), toQt(facts.protocolJson), toQt(facts.protocolSha256), toQt(std::to_string(facts.designSeed)),
         toQt(facts.keySha256), toQt(facts.maskedKeySha256), toQt(facts.datasetPath), toQt(facts.datasetSha256),
         int(facts.datasetProcedural), toQt(facts.modelSha256), toQt(jsonOf(facts.stamps)), toQt(facts.signalsJson),
         toQt(facts.createdAt), toQt(facts.programVersion)});
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
        sqlite.run(QStringLiteral("INSERT INTO familiarisation(position, name, file_code) VALUES (?, ?, ?)"),
                   {++position, toQt(item.name), toQt(item.fileCode.value)});
}

void insertSwatches(const SqliteConnection& sqlite, const StudyFacts& facts)
{
    for (std::size_t slot = 0; slot < facts.swatches.size(); ++slot)
        for (const auto& [fabric, code] : facts.swatches[slot])
            sqlite.run(QStringLiteral("INSERT INTO swatches(slot, fabric, code) VALUES (?, ?, ?)"),
                       {static_cast<int>(slot) + 1, toQt(fabric.value), toQt(code)});
}

void insertSlot(const SqliteConnection& sqlite, int slot, const std::vector<protocols::BlindedTrial>& trials)
{
    sqlite.run(QStringLiteral("INSERT INTO slots(number) VALUES (?)"), {slot});
    for (const protocols::BlindedTrial& trial : trials)
        sqlite.run(QStringLiteral("INSERT INTO trials(slot, number, phase, file_code, presentation_code, alternatives) "
                                  "VALUES (?, ?, ?, ?, ?, ?)"),
                   {slot, trial.number.value, trial.phase, toQt(trial.fileCode.value), toQt(trial.presentationCode.value),
                    toQt(jsonOf(trial.alternatives))});
}

void recordCreation(const SqliteConnection& sqlite, const StudyFacts& facts)
{
    LogEntry entry;
    entry.event.kind = "created";
    entry.event.payloadJson =
        nlohmann::json{{"fixed_sha256", hashOfFixedTables(sqlite, schemaVersion)}, {"schema", schemaVersion}}.dump();
    entry.event.wallTime = facts.createdAt;
    store(sqlite, entry);
}

/// Under another name until it is whole, so that a study.db is never half a study.
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

std::uint64_t seedOf(const std::string& digits)
{
    std::uint64_t seed = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), seed);
    return seed;
}

std::string stateName(const QVariant& stored) { return stored.isNull() ? "free" : fromQt(stored); }

template <class Enum>
Enum namedValue(const std::string& name, std::initializer_list<Enum> values)
{
    for (const Enum value : values)
        if (nameOf(value) == name) return value;
    throw protocols::workFailed(
        {"unknown name \"" + name + "\" in the database", "study.db", "", "run vis2hap verify on the study"});
}

ParticipantKind kindNamed(const std::string& name)
{
    return namedValue(name, {ParticipantKind::Human, ParticipantKind::Scripted, ParticipantKind::Simulated});
}

SlotState stateNamed(const std::string& name)
{
    return namedValue(name, {SlotState::Free, SlotState::Started, SlotState::Finished, SlotState::Withdrawn});
}

}  // namespace

std::string nameOf(ParticipantKind kind)
{
    switch (kind) {
        case ParticipantKind::Human:
            return "human";
        case ParticipantKind::Scripted:
            return "scripted";
        case ParticipantKind::Simulated:
            return "simulated";
    }
    return {};
}

std::string nameOf(SlotState state)
{
    switch (state) {
        case SlotState::Free:
            return "free";
        case SlotState::Started:
            return "started";
        case SlotState::Finished:
            return "finished";
        case SlotState::Withdrawn:
            return "withdrawn";
    }
    return {};
}

std::string jsonOf(const std::vector<std::string>& texts)
{
    return nlohmann::json(texts).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<std::string> textsOf(const std::string& json)
{
    const nlohmann::json parsed = nlohmann::json::parse(json, nullptr, false);
    std::vector<std::string> texts;
    if (!parsed.is_array())
        throw protocols::workFailed(
            {"a stored list cannot be read: " + json, "study.db", "a JSON array of texts", "run vis2hap verify on the study"});
    for (const nlohmann::json& text : parsed) texts.push_back(text.is_string() ? text.get<std::string>() : text.dump());
    return texts;
}

std::string jsonOf(const std::vector<protocols::FabricId>& fabrics)
{
    std::vector<std::string> texts;
    for (const protocols::FabricId& fabric : fabrics) texts.push_back(fabric.value);
    return jsonOf(texts);
}

std::vector<protocols::FabricId> fabricsOf(const std::string& json)
{
    std::vector<protocols::FabricId> fabrics;
    for (const std::string& text : textsOf(json)) fabrics.emplace_back(text);
    return fabrics;
}

std::string wallTimeNow() { return QDateTime::currentDateTimeUtc().toString(Qt::ISODateWithMs).toStdString(); }

void StudyStore::create(const StudyFolder& folder, const StudyFacts& facts,
                        const std::vector<std::vector<protocols::BlindedTrial>>& slots,
                        const std::map<protocols::FileCode, std::string>& stimulusHashes)
{
    if (std::filesystem::exists(folder.database()))
        throw protocols::badInput(
            {"there is a study here already", folder.folder.string(), "a new folder", "choose another name"});
    const WriteLock lock(folder);
    const DraftDatabase draft(folder);
    {
        const SqliteConnection sqlite(draft.path(), SqliteConnection::Mode::Create);
        Transaction transaction(sqlite);
        migrate(sqlite);
        insertFacts(sqlite, facts);
        for (const auto& [code, hash] : stimulusHashes)
            sqlite.run(QStringLiteral("INSERT INTO stimuli(file_code, sha256) VALUES (?, ?)"), {toQt(code.value), toQt(hash)});
        for (std::size_t slot = 0; slot < slots.size(); ++slot) insertSlot(sqlite, static_cast<int>(slot) + 1, slots[slot]);
        insertSwatches(sqlite, facts);
        insertFamiliarisation(sqlite, facts);
        recordCreation(sqlite, facts);
        transaction.commit();
        sqlite.run(QStringLiteral("PRAGMA wal_checkpoint(TRUNCATE)"));
    }
    draft.putInPlace();
}

StudyStore::StudyStore(const StudyFolder& folder, Access access)
{
    std::error_code unreadable;
    if (!std::filesystem::is_regular_file(folder.database(), unreadable))
        throw protocols::badInput({"this is no study folder (no study.db in it)", folder.folder.string(),
                                   "a folder made by vis2hap study new", "check the path"});
    const bool writes = access == Access::Write;
    auto lock = writes ? std::make_unique<WriteLock>(folder) : nullptr;
    const auto mode = writes ? SqliteConnection::Mode::Write : SqliteConnection::Mode::Read;
    m_connection.reset(new Connection{folder, std::move(lock), {folder.database(), mode}});
    const SqliteConnection& sqlite = m_connection->sqlite;
    if (checkedVersion(sqlite) == schemaVersion) return;
    if (!writes)
        throw protocols::badInput({"the study was made by an older version of this program", folder.folder.string(), "",
                                   "open it once in the app, which brings it up to date"});
    sqlite.run(QStringLiteral("PRAGMA foreign_keys = OFF"));
    {
        Transaction transaction(sqlite);
        migrate(sqlite);
        transaction.commit();
    }
    sqlite.run(QStringLiteral("PRAGMA foreign_keys = ON"));
}

StudyStore::~StudyStore() = default;
StudyStore::StudyStore(StudyStore&&) noexcept = default;

const StudyFolder& StudyStore::folder() const { return m_connection->folder; }

StudyFacts StudyStore::facts() const
{
    StudyFacts facts;
    QSqlQuery row = m_connection->sqlite.run(QStringLiteral(
        "SELECT name, protocol_json, protocol_sha256, design_seed, key_sha256, masked_key_sha256, dataset_path, "
        "dataset_sha256, dataset_procedural, model_sha256, stamps, signals_json, created_at, program_version FROM study"));
    if (!row.next())
        throw protocols::workFailed(
            {"the study's facts are missing", folder().database().string(), "one row in table study", "go back to a backup"});
    int column = 0;
    for (std::string* text : {&facts.name, &facts.protocolJson, &facts.protocolSha256}) *text = fromQt(row.value(column++));
    facts.designSeed = seedOf(fromQt(row.value(column++)));
    for (std::string* text : {&facts.keySha256, &facts.maskedKeySha256, &facts.datasetPath, &facts.datasetSha256})
        *text = fromQt(row.value(column++));
    facts.datasetProcedural = row.value(column++).toInt() != 0;
    facts.modelSha256 = fromQt(row.value(column++));
    facts.stamps = textsOf(fromQt(row.value(column++)));
    for (std::string* text : {&facts.signalsJson, &facts.createdAt, &facts.programVersion}) *text = fromQt(row.value(column++));
    QSqlQuery fabric = m_connection->sqlite.run(QStringLiteral("SELECT id, name FROM fabrics ORDER BY position"));
    while (fabric.next()) {
        facts.fabrics.emplace_back(fromQt(fabric.value(0)));
        facts.fabricNames[facts.fabrics.back()] = fromQt(fabric.value(1));
    }
    QSqlQuery swatch = m_connection->sqlite.run(QStringLiteral("SELECT slot, fabric, code FROM swatches ORDER BY slot"));
    while (swatch.next()) {
        facts.swatches.resize(static_cast<std::size_t>(swatch.value(0).toInt()));
        facts.swatches.back()[protocols::FabricId(fromQt(swatch.value(1)))] = fromQt(swatch.value(2));
    }
    QSqlQuery item = m_connection->sqlite.run(QStringLiteral("SELECT name, file_code FROM familiarisation ORDER BY position"));
    while (item.next()) facts.familiarisation.push_back({fromQt(item.value(0)), protocols::FileCode(fromQt(item.value(1)))});
    return facts;
}

std::map<protocols::FileCode, std::string> StudyStore::stimulusHashes() const
{
    std::map<protocols::FileCode, std::string> hashes;
    QSqlQuery row = m_connection->sqlite.run(QStringLiteral("SELECT file_code, sha256 FROM stimuli"));
    while (row.next()) hashes[protocols::FileCode(fromQt(row.value(0)))] = fromQt(row.value(1));
    return hashes;
}

std::vector<Slot> StudyStore::slots() const
{
    std::vector<Slot> slots;
    QSqlQuery row =
        m_connection->sqlite.run(QStringLiteral("SELECT s.number, p.state, p.id, p.kind FROM slots s LEFT JOIN participants p ON "
                                                "p.slot = s.number AND p.state <> 'withdrawn' "
                                                "ORDER BY s.number"));
    while (row.next()) {
        Slot slot;
        slot.number = row.value(0).toInt();
        slot.state = stateNamed(stateName(row.value(1)));
        if (slot.state != SlotState::Free) {
            slot.participant = protocols::ParticipantId(fromQt(row.value(2)));
            slot.kind = kindNamed(fromQt(row.value(3)));
        }
        slots.push_back(slot);
    }
    return slots;
}

std::vector<Enrolment> StudyStore::enrolments() const
{
    std::vector<Enrolment> enrolments;
    QSqlQuery row = m_connection->sqlite.run(
        QStringLiteral("SELECT id, slot, kind, state, protocol_version FROM participants ORDER BY slot, rowid"));
    while (row.next())
        enrolments.push_back({protocols::ParticipantId(fromQt(row.value(0))), row.value(1).toInt(),
                              kindNamed(fromQt(row.value(2))), stateNamed(fromQt(row.value(3))), row.value(4).toInt()});
    return enrolments;
}

std::vector<ProtocolVersion> StudyStore::protocolVersions() const
{
    const StudyFacts known = facts();
    std::vector<ProtocolVersion> versions{{1, known.protocolJson, known.protocolSha256, {}, {}, {}}};
    QSqlQuery row = m_connection->sqlite.run(
        QStringLiteral("SELECT version, json, sha256, who, why, wall_time FROM protocol_versions ORDER BY version"));
    while (row.next())
        versions.push_back({row.value(0).toInt(), fromQt(row.value(1)), fromQt(row.value(2)), fromQt(row.value(3)),
                            fromQt(row.value(4)), fromQt(row.value(5))});
    return versions;
}

std::vector<protocols::BlindedTrial> StudyStore::trials(int slot) const
{
    std::vector<protocols::BlindedTrial> trials;
    QSqlQuery row = m_connection->sqlite.run(
        QStringLiteral(
            "SELECT number, phase, file_code, presentation_code, alternatives FROM trials WHERE slot = ? ORDER BY number"),
        {slot});
    while (row.next())
        trials.push_back({protocols::TrialNumber{row.value(0).toInt()}, row.value(1).toInt(),
                          protocols::FileCode(fromQt(row.value(2))), protocols::PresentationCode(fromQt(row.value(3))),
                          fabricsOf(fromQt(row.value(4)))});
    return trials;
}

}  // namespace database
