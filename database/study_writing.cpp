#include "database/study_writing.h"

#include <nlohmann/json.hpp>

#include "database/disk/finger_text.h"
#include "database/event_chain.h"
#include "database/stored_texts.h"
#include "database/study_rows.h"
#include "protocols/files/errors.h"
#include "protocols/files/id_rule.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/secrets/secret_key.h"

namespace database {

namespace {

constexpr std::size_t factSaltBytes = 32;

/// Number of the present attempt at a trial: one more than its voids.
int attemptOf(const SqliteConnection& sqlite, const std::string& participant, int trial)
{
    return 1 + sqlite
                   .keptValue(QStringLiteral("SELECT COUNT(*) FROM voids WHERE participant = ? AND trial = ?"),
                              {toQt(participant), trial})
                   .toInt();
}

std::string placeOf(const std::string& participant, int trial, const std::string& question)
{
    return participant + ", trial " + std::to_string(trial) + ", " + question;
}

bool hasAnswer(const SqliteConnection& sqlite, const ResponseRow& row)
{
    return sqlite
               .keptValue(
                   QStringLiteral(
                       "SELECT COUNT(*) FROM responses WHERE participant = ? AND trial = ? AND attempt = ? AND question = ?"),
                   {toQt(row.participant), row.trial, row.attempt, toQt(row.question)})
               .toInt() > 0;
}

/// A correction changes the answer, not its time.
void takeStampsOfFirst(const SqliteConnection& sqlite, ResponseRow& row)
{
    QSqlQuery query =
        sqlite.run(QStringLiteral("SELECT %1 FROM responses WHERE participant = ? AND trial = ? AND attempt = ? AND "
                                  "question = ? ORDER BY id LIMIT 1")
                       .arg(namesOf(ResponseColumns::OfTable)),
                   {toQt(row.participant), row.trial, row.attempt, toQt(row.question)});
    if (!query.next())
        throw protocols::workFailed({"there is no answer to correct", placeOf(row.participant, row.trial, row.question), "", ""});
    const ResponseRow first = rowFrom(query, ResponseColumns::OfTable, 0);
    row.readyAt = first.readyAt;
    row.touchedAt = first.touchedAt;
    row.touchEndedAt = first.touchEndedAt;
    row.answerBegunAt = first.answerBegunAt;
    row.answerBegunBy = first.answerBegunBy;
    row.answeredAt = first.answeredAt;
}

ResponseRow rowOf(const SqliteConnection& sqlite, const StudyStore::Append& entry, const AnswerRecord& answer)
{
    ResponseRow row;
    row.participant = entry.event.participant.value;
    row.trial = answer.trial.value;
    row.attempt = attemptOf(sqlite, row.participant, row.trial);
    row.question = answer.question.value;
    row.presentationCode = answer.presentationCode.value;
    row.alternatives = jsonOf(answer.alternatives);
    row.choice = answer.answer;
    row.ratingTenths = answer.rating ? std::optional<int>(answer.rating->value) : std::nullopt;
    row.readyAt = answer.readyAtNs;
    row.touchedAt = answer.touchedAtNs;
    if (!answer.touchedBy.empty()) row.touchedBy = answer.touchedBy;
    row.touchEndedAt = answer.touchEndedAtNs;
    row.answerBegunAt = answer.answerBegunAtNs;
    if (!answer.answerBegunBy.empty()) row.answerBegunBy = answer.answerBegunBy;
    row.answeredAt = answer.answeredAtNs;
    row.entries = answer.entries;
    row.storedAt = entry.storedAtNs;
    row.isCorrection = answer.isCorrection;
    if (row.isCorrection)
        takeStampsOfFirst(sqlite, row);
    else if (hasAnswer(sqlite, row))
        throw protocols::workFailed(
            {"this answer is stored already", placeOf(row.participant, row.trial, row.question), "one answer to a question", ""});
    return row;
}

FingerRow fingerRowOf(const SqliteConnection& sqlite, const std::string& participant, const StudyStore::FingerStretch& stretch)
{
    FingerRow row{participant, stretch.trial.value, attemptOf(sqlite, participant, stretch.trial.value)};
    row.beganAt = stretch.samples.front().atNs;
    row.count = static_cast<int>(stretch.samples.size());
    row.leftOut = stretch.leftOut;
    row.samples = fingerTextOf(stretch.samples);
    row.samplesSha256 = protocols::sha256(row.samples);
    return row;
}

LogEntry logEntryOf(const SqliteConnection& sqlite, const StudyStore::Append& entry)
{
    LogEntry log;
    log.event = entry.event;
    const std::string& participant = entry.event.participant.value;
    for (const AnswerRecord& answer : entry.answers) {
        log.responses.push_back(rowOf(sqlite, entry, answer));
        if (!answer.note.empty())
            log.notes.push_back(
                {participant, answer.trial.value, log.responses.back().attempt, answer.question.value, answer.note, false});
    }
    if (entry.note)
        log.notes.push_back({participant, entry.note->trial.value,
                             entry.note->attempt.value_or(attemptOf(sqlite, participant, entry.note->trial.value)), std::nullopt,
                             entry.note->text, entry.note->isFlag});
    if (entry.finger) log.finger.push_back(fingerRowOf(sqlite, participant, *entry.finger));
    if (entry.voids) log.voids.push_back({participant, entry.voids->value, attemptOf(sqlite, participant, entry.voids->value)});
    return log;
}

/// Stores the facts outside the log, and their commitments in the payload of the event.
void storeFacts(const SqliteConnection& sqlite, const StudyStore::Append& entry, EventRecord& event)
{
    const std::vector<SaltedFact> facts = salted(entry.facts);
    event.payloadJson = withCommitments(event.payloadJson, facts);
    for (const auto& [fact, value, salt] : facts)
        sqlite.run(QStringLiteral("INSERT OR REPLACE INTO participant_facts(participant, fact, value, salt) VALUES (?, ?, ?, ?)"),
                   {toQt(event.participant.value), toQt(fact), toQt(value), toQt(salt)});
}

void moveState(const SqliteConnection& sqlite, const protocols::ParticipantId& participant, SlotState state)
{
    if (state == SlotState::Free)
        throw protocols::workFailed({"a slot that was taken cannot become free again", participant.value, "", ""});
    QSqlQuery changed = sqlite.run(QStringLiteral("UPDATE participants SET state = ? WHERE id = ?"),
                                   {toQt(nameOf(state)), toQt(participant.value)});
    if (changed.numRowsAffected() != 1)
        throw protocols::badInput(
            {"unknown participant", participant.value, "an enrolled participant", "enrol the participant first"});
}

}  // namespace

std::vector<SaltedFact> salted(const std::vector<std::pair<std::string, std::string>>& facts)
{
    std::vector<SaltedFact> all;
    for (const auto& [fact, value] : facts) all.push_back({fact, value, protocols::drawHex(factSaltBytes)});
    return all;
}

std::string withCommitments(const std::string& payloadJson, const std::vector<SaltedFact>& facts)
{
    if (facts.empty()) return payloadJson;
    nlohmann::ordered_json payload = protocols::storedOrderedJson(payloadJson);
    if (!payload.is_object()) payload = nlohmann::ordered_json::object();
    for (const auto& [fact, value, salt] : facts) payload["facts_sha256"][fact] = commitmentOfFact(salt, fact, value);
    return payload.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Slot enrolIn(const SqliteConnection& sqlite, const protocols::ParticipantId& participant, ParticipantKind kind,
             std::optional<int> wanted)
{
    Transaction transaction(sqlite);
    for (const Erasure& erasure : erasuresIn(sqlite))
        if (erasure.participant == participant && erasure.answersToo)
            throw protocols::badInput(
                {"participant " + participant.value + " was erased", sqlite.folder(), "another id", "choose another id"});
    // Single rows, not whole tables: a large study enrols as fast as a small one.
    QSqlQuery known =
        sqlite.run(QStringLiteral("SELECT slot, kind, state FROM participants WHERE id = ?"), {toQt(participant.value)});
    if (known.next()) {
        const Slot taken{known.value(0).toInt(), stateNamed(fromQt(known.value(2))), participant,
                         kindNamed(fromQt(known.value(1)))};
        if (taken.kind != kind)
            throw protocols::badInput({"participant " + participant.value + " is " + nameOf(taken.kind) + ", not " + nameOf(kind),
                                       sqlite.folder(), "another id", ""});
        known.finish();
        transaction.commit();
        return taken;
    }
    protocols::requireGoodNewId(participant.value, "a participant", sqlite.folder());
    const QVariant place = sqlite.value(
        QStringLiteral("SELECT s.number FROM slots s WHERE (s.number = ? OR ? = 0) AND NOT EXISTS (SELECT 1 FROM participants p "
                       "WHERE p.slot = s.number AND p.state <> 'withdrawn') ORDER BY s.number LIMIT 1"),
        {wanted.value_or(0), wanted.value_or(0)});
    if (!place.isValid() && wanted)
        throw protocols::badInput({"running order " + std::to_string(*wanted) + " is taken, or the study has none of this number",
                                   sqlite.folder(),
                                   "a free running order " + std::to_string(*wanted) + " for " + participant.value,
                                   "use a study without other participants"});
    if (!place.isValid())
        throw protocols::workFailed({"all slots of the study are taken", sqlite.folder(), "a free slot for " + participant.value,
                                     "make a study with more participants"});
    const Slot free{place.toInt(), SlotState::Started, participant, kind};
    const int version = protocolVersionsIn(sqlite).back().version;
    sqlite.run(QStringLiteral("INSERT INTO participants(id, slot, kind, state, protocol_version) VALUES (?, ?, ?, ?, ?)"),
               {toQt(participant.value), free.number, toQt(nameOf(kind)), toQt(nameOf(free.state)), version});
    nlohmann::ordered_json payload{{"slot", free.number}, {"participant", participant.value}, {"kind", nameOf(kind)}};
    if (version > 1) payload["protocol_version"] = version;
    store(sqlite, actOnStudy("enrolled", payload, wallTimeNow()));
    transaction.commit();
    return free;
}

void appendTo(const SqliteConnection& sqlite, const StudyStore::Append& entry)
{
    Transaction transaction(sqlite);
    LogEntry log = logEntryOf(sqlite, entry);
    storeFacts(sqlite, entry, log.event);
    store(sqlite, log);
    if (entry.slotState) moveState(sqlite, entry.event.participant, *entry.slotState);
    transaction.commit();
}

void takeProtocolInto(const SqliteConnection& sqlite, const std::string& json, const std::string& who, const std::string& why)
{
    if (who.empty() || why.empty())
        throw protocols::badInput(
            {"a change of the protocol needs a name and a reason", sqlite.folder(), "--who NAME --why TEXT", "add both"});
    Transaction transaction(sqlite);
    const int version = protocolVersionsIn(sqlite).back().version + 1;
    const std::string hash = protocols::sha256(json), wallTime = wallTimeNow();
    const std::int64_t event = store(
        sqlite, actOnStudy("protocol_taken", {{"version", version}, {"sha256", hash}, {"who", who}, {"why", why}}, wallTime));
    sqlite.run(QStringLiteral("INSERT INTO protocol_versions(version, event, json, sha256, who, why, wall_time) "
                              "VALUES (?, ?, ?, ?, ?, ?, ?)"),
               {version, qlonglong(event), toQt(json), toQt(hash), toQt(who), toQt(why), toQt(wallTime)});
    transaction.commit();
}

void recordUnblindingIn(const SqliteConnection& sqlite, const UnblindingRecord& record)
{
    if (record.who.empty() || record.why.empty())
        throw protocols::badInput(
            {"an unblinding needs a name and a reason", sqlite.folder(), "--who NAME --why TEXT", "add both"});
    Transaction transaction(sqlite);
    LogEntry entry = actOnStudy("unblinded", {{"who", record.who}, {"why", record.why}}, record.wallTime);
    entry.unblinding = record;
    store(sqlite, entry);
    transaction.commit();
}

}  // namespace database
