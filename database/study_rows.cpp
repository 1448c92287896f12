#include "database/study_rows.h"

#include <charconv>
#include <limits>

#include "database/response_columns.h"
#include "database/schema.h"
#include "database/stored_texts.h"
#include "protocols/files/errors.h"

namespace database {

namespace {

std::uint64_t seedOf(const std::string& digits)
{
    std::uint64_t seed = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), seed);
    return seed;
}

std::string stateName(const QVariant& stored) { return stored.isNull() ? "free" : fromQt(stored); }

/// The trays of many answers are the same few texts, so each is read once.
class KnownTrays {
public:
    const std::vector<protocols::FabricId>& of(const std::string& json)
    {
        const auto [entry, isNew] = m_trays.try_emplace(json);
        if (isNew) entry->second = fabricsOf(json);
        return entry->second;
    }

private:
    std::map<std::string, std::vector<protocols::FabricId>> m_trays;
};

CurrentAnswer currentAnswerOf(const QSqlQuery& query, KnownTrays& trays)
{
    const ResponseRow row = rowFrom(query, ResponseColumns::OfCurrentAnswers, firstResponseColumn);
    CurrentAnswer answer;
    answer.participant = protocols::ParticipantId(row.participant);
    answer.record = answerRecordOf(row, trays.of(row.alternatives));
    answer.attempt = row.attempt;
    answer.storedAtNs = row.storedAt;
    answer.event = query.value(0).toLongLong();
    answer.corrections = query.value(1).toInt();
    answer.voided = query.value(2).toInt() != 0;
    answer.wallTime = fromQt(query.value(3));
    answer.record.note = fromQt(query.value(4));
    answer.sitting = query.value(5).toInt();
    answer.record.isCorrection = answer.corrections > 0;
    answer.seconds = secondsOf(answer.record);
    answer.responseSeconds = responseSecondsOf(answer.record);
    return answer;
}

protocols::Error damagedSwatches(const SqliteConnection& sqlite, const std::string& fault)
{
    return protocols::workFailed({"a code on the pieces of fabric " + fault, sqlite.file().string(),
                                  "a code for each fabric in each slot of the study", "restore the study from a backup"});
}

}  // namespace

AnswerRecord answerRecordOf(const ResponseRow& row, std::vector<protocols::FabricId> alternatives)
{
    AnswerRecord record;
    record.trial = {row.trial};
    record.question = protocols::QuestionId(row.question);
    record.presentationCode = protocols::PresentationCode(row.presentationCode);
    record.alternatives = std::move(alternatives);
    record.answer = row.choice;
    if (row.ratingTenths) record.rating = protocols::Tenths{*row.ratingTenths};
    record.readyAtNs = row.readyAt;
    record.touchedAtNs = row.touchedAt;
    record.touchedBy = row.touchedBy.value_or("");
    record.touchEndedAtNs = row.touchEndedAt;
    record.answerBegunAtNs = row.answerBegunAt;
    record.answerBegunBy = row.answerBegunBy.value_or("");
    record.answeredAtNs = row.answeredAt;
    record.entries = row.entries;
    record.isCorrection = row.isCorrection;
    return record;
}

double secondsBetween(std::int64_t fromNs, std::int64_t toNs)
{
    using Limits = std::numeric_limits<std::int64_t>;
    std::int64_t ns = 0;
    if (__builtin_sub_overflow(toNs, fromNs, &ns)) ns = toNs < fromNs ? Limits::min() : Limits::max();
    return static_cast<double>(ns) / 1e9;
}

std::optional<double> responseSecondsOf(const ResponseRow& row) { return responseSecondsOf(answerRecordOf(row, {})); }

std::optional<double> responseSecondsOf(const AnswerRecord& record)
{
    const bool isScripted = record.answerBegunBy == "script";
    if (!record.answerBegunAtNs || (!record.touchedAtNs && !isScripted)) return std::nullopt;
    const std::int64_t from = record.touchedAtNs.value_or(record.readyAtNs);
    // An operator who stamps the touch late, after the first key, has not measured this time.
    if (*record.answerBegunAtNs < from) return std::nullopt;
    return secondsBetween(from, *record.answerBegunAtNs);
}

double secondsOf(const AnswerRecord& record)
{
    return secondsBetween(record.touchedAtNs.value_or(record.readyAtNs), record.answeredAtNs);
}

StudyFacts factsIn(const SqliteConnection& sqlite)
{
    StudyFacts facts;
    QSqlQuery row = sqlite.run(QStringLiteral(
        "SELECT name, protocol_json, protocol_sha256, design_seed, key_sha256, station_key_sha256, has_passphrase, "
        "dataset_path, dataset_sha256, dataset_procedural, model_sha256, stamps, signals_json, planned_balance, created_at, "
        "program_version, made_with FROM study"));
    if (!row.next())
        throw protocols::workFailed(
            {"the study's facts are missing", sqlite.file().string(), "one row in the table study", "restore it from a backup"});
    int column = 0;
    for (std::string* text : {&facts.name, &facts.protocolJson, &facts.protocolSha256}) *text = fromQt(row.value(column++));
    facts.designSeed = seedOf(fromQt(row.value(column++)));
    for (std::string* text : {&facts.keySha256, &facts.stationKeySha256}) *text = fromQt(row.value(column++));
    facts.hasPassphrase = row.value(column++).toInt() != 0;
    for (std::string* text : {&facts.datasetPath, &facts.datasetSha256}) *text = fromQt(row.value(column++));
    facts.datasetProcedural = row.value(column++).toInt() != 0;
    facts.modelSha256 = fromQt(row.value(column++));
    facts.stamps = textsOf(fromQt(row.value(column++)));
    for (std::string* text :
         {&facts.signalsJson, &facts.plannedBalance, &facts.createdAt, &facts.programVersion, &facts.madeWith})
        *text = fromQt(row.value(column++));
    QSqlQuery fabric = sqlite.run(QStringLiteral("SELECT id, name FROM fabrics ORDER BY position"));
    while (fabric.next()) {
        facts.fabrics.emplace_back(fromQt(fabric.value(0)));
        facts.fabricNames[facts.fabrics.back()] = fromQt(fabric.value(1));
    }
    facts.swatches = swatchesIn(sqlite, facts.fabrics);
    QSqlQuery item = sqlite.run(QStringLiteral("SELECT name, sealed_code FROM familiarisation ORDER BY position"));
    while (item.next()) facts.familiarisation.push_back({fromQt(item.value(0)), protocols::SealedCode(fromQt(item.value(1)))});
    return facts;
}

std::vector<protocols::SwatchLabels> swatchesIn(const SqliteConnection& sqlite, const std::vector<protocols::FabricId>& fabrics)
{
    const qlonglong slots = sqlite.value(QStringLiteral("SELECT COUNT(*) FROM slots")).toLongLong();
    std::vector<protocols::SwatchLabels> swatches;
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT slot, fabric, code FROM swatches ORDER BY slot"));
    while (row.next()) {
        const qlonglong slot = row.value(0).toLongLong();
        if (slot < 1 || slot > slots) throw damagedSwatches(sqlite, "stands in slot " + std::to_string(slot));
        swatches.resize(static_cast<std::size_t>(slots));
        swatches[static_cast<std::size_t>(slot) - 1][protocols::FabricId(fromQt(row.value(1)))] = fromQt(row.value(2));
    }
    for (const protocols::SwatchLabels& labels : swatches)
        for (const protocols::FabricId& fabric : fabrics)
            if (!labels.contains(fabric)) throw damagedSwatches(sqlite, "is missing for fabric " + fabric.value);
    return swatches;
}

std::map<protocols::FileCode, std::string> stimulusHashesIn(const SqliteConnection& sqlite)
{
    std::map<protocols::FileCode, std::string> hashes;
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT file_code, sha256 FROM stimuli"));
    while (row.next()) hashes[protocols::FileCode(fromQt(row.value(0)))] = fromQt(row.value(1));
    return hashes;
}

std::vector<Slot> slotsIn(const SqliteConnection& sqlite)
{
    std::vector<Slot> slots;
    QSqlQuery row =
        sqlite.run(QStringLiteral("SELECT s.number, p.state, p.id, p.kind FROM slots s LEFT JOIN participants p ON "
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

std::vector<protocols::BlindedTrial> trialsIn(const SqliteConnection& sqlite, int slot)
{
    std::vector<protocols::BlindedTrial> trials;
    QSqlQuery row = sqlite.run(
        QStringLiteral("SELECT number, phase, sealed_code, presentation_code, alternatives, instruction, aim, deadline_ms "
                       "FROM trials WHERE slot = ? ORDER BY number"),
        {slot});
    while (row.next()) {
        protocols::BlindedTrial trial{protocols::TrialNumber{row.value(0).toInt()}, row.value(1).toInt(),
                                      protocols::SealedCode(fromQt(row.value(2))),
                                      protocols::PresentationCode(fromQt(row.value(3))), fabricsOf(fromQt(row.value(4)))};
        trial.instruction = protocols::InstructionId(fromQt(row.value(5)));
        trial.aim = protocols::speedAimNamed(fromQt(row.value(6)));
        if (!row.value(7).isNull()) trial.deadlineMs = row.value(7).toInt();
        trials.push_back(std::move(trial));
    }
    return trials;
}

std::vector<Enrolment> enrolmentsIn(const SqliteConnection& sqlite)
{
    std::vector<Enrolment> enrolments;
    QSqlQuery row =
        sqlite.run(QStringLiteral("SELECT id, slot, kind, state, protocol_version FROM participants ORDER BY slot, rowid"));
    while (row.next())
        enrolments.push_back({protocols::ParticipantId(fromQt(row.value(0))), row.value(1).toInt(),
                              kindNamed(fromQt(row.value(2))), stateNamed(fromQt(row.value(3))), row.value(4).toInt()});
    return enrolments;
}

std::vector<ProtocolVersion> protocolVersionsIn(const SqliteConnection& sqlite)
{
    QSqlQuery known = sqlite.run(QStringLiteral("SELECT protocol_json, protocol_sha256 FROM study"));
    if (!known.next()) (void)factsIn(sqlite);  // throws
    std::vector<ProtocolVersion> versions{{1, fromQt(known.value(0)), fromQt(known.value(1)), {}, {}, {}}};
    QSqlQuery row = sqlite.run(
        QStringLiteral("SELECT version, json, sha256, who, why, wall_time, event FROM protocol_versions ORDER BY version"));
    while (row.next())
        versions.push_back({row.value(0).toInt(), fromQt(row.value(1)), fromQt(row.value(2)), fromQt(row.value(3)),
                            fromQt(row.value(4)), fromQt(row.value(5)), row.value(6).toLongLong()});
    return versions;
}

namespace {

std::vector<EventRecord> eventsWhere(const SqliteConnection& sqlite, const char* column, const std::string& value)
{
    std::vector<EventRecord> events;
    QSqlQuery row =
        sqlite.run(QStringLiteral("SELECT sequence, participant, sitting, kind, payload, at_ns, wall_time FROM events "
                                  "WHERE %1 = ? ORDER BY sequence")
                       .arg(QLatin1String(column)),
                   {toQt(value)});
    while (row.next())
        events.push_back({row.value(0).toLongLong(), protocols::ParticipantId(fromQt(row.value(1))), row.value(2).toInt(),
                          fromQt(row.value(3)), fromQt(row.value(4)), row.value(5).toLongLong(), fromQt(row.value(6))});
    return events;
}

}  // namespace

std::vector<EventRecord> eventsIn(const SqliteConnection& sqlite, const protocols::ParticipantId& participant)
{
    return eventsWhere(sqlite, "participant", participant.value);
}

std::vector<EventRecord> eventsOfKindIn(const SqliteConnection& sqlite, const std::string& kind)
{
    return eventsWhere(sqlite, "kind", kind);
}

std::optional<std::int64_t> firstEventOfKindIn(const SqliteConnection& sqlite, const std::string& kind)
{
    const QVariant first = sqlite.value(QStringLiteral("SELECT MIN(sequence) FROM events WHERE kind = ?"), {toQt(kind)});
    return first.isNull() ? std::nullopt : std::optional<std::int64_t>(first.toLongLong());
}

void eachAnswerIn(const SqliteConnection& sqlite, const std::function<void(CurrentAnswer)>& take)
{
    KnownTrays trays;
    QSqlQuery query = sqlite.run(currentAnswersQuery());
    while (query.next()) take(currentAnswerOf(query, trays));
}

std::vector<StudyStore::Flag> flagsIn(const SqliteConnection& sqlite)
{
    std::vector<StudyStore::Flag> flags;
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT participant, trial, text FROM notes WHERE is_flag = 1 ORDER BY id"));
    while (row.next())
        flags.push_back({protocols::ParticipantId(fromQt(row.value(0))), {row.value(1).toInt()}, fromQt(row.value(2))});
    return flags;
}

std::optional<UnblindingRecord> unblindingIn(const SqliteConnection& sqlite)
{
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT who, why, wall_time FROM unblindings ORDER BY event LIMIT 1"));
    if (!row.next()) return std::nullopt;
    return UnblindingRecord{fromQt(row.value(0)), fromQt(row.value(1)), fromQt(row.value(2))};
}

LogHead headIn(const SqliteConnection& sqlite)
{
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT sequence, hash FROM events ORDER BY sequence DESC LIMIT 1"));
    return row.next() ? LogHead{row.value(0).toLongLong(), fromQt(row.value(1))} : LogHead{};
}

std::vector<Erasure> erasuresIn(const SqliteConnection& sqlite)
{
    std::vector<Erasure> erasures;
    QSqlQuery row =
        sqlite.run(QStringLiteral("SELECT participant, answers_too, who, why, wall_time FROM erasures ORDER BY event"));
    while (row.next())
        erasures.push_back({protocols::ParticipantId(fromQt(row.value(0))), row.value(1).toInt() != 0, fromQt(row.value(2)),
                            fromQt(row.value(3)), fromQt(row.value(4))});
    return erasures;
}

std::map<protocols::ParticipantId, std::map<std::string, std::string>> personalFactsIn(const SqliteConnection& sqlite)
{
    std::map<protocols::ParticipantId, std::map<std::string, std::string>> facts;
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT participant, fact, value FROM participant_facts"));
    while (row.next()) facts[protocols::ParticipantId(fromQt(row.value(0)))][fromQt(row.value(1))] = fromQt(row.value(2));
    return facts;
}

std::map<protocols::ParticipantId, int> voidedPresentationsIn(const SqliteConnection& sqlite)
{
    std::map<protocols::ParticipantId, int> counts;
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT participant, COUNT(*) FROM voids GROUP BY participant"));
    while (row.next()) counts[protocols::ParticipantId(fromQt(row.value(0)))] = row.value(1).toInt();
    return counts;
}

}  // namespace database
