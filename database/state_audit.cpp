#include "database/state_audit.h"

#include <nlohmann/json.hpp>
#include <set>

#include "database/disk/payload_fields.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/protocol.h"
#include "protocols/protocol_json.h"

namespace database {

namespace {

using nlohmann::json;

/// What the log says about one participant.
struct Told {
    std::string state = "started";
    int protocolVersion = 1;
    /// Commitments of the facts that no erasure removed; empty for facts from before an upgrade that committed to none.
    std::map<std::string, std::string> facts;
};

/// Entries from before an upgrade name the facts without commitments. Any other fact has one.
void takeFactsBeforeUpgrade(const LogEntry& entry, const json& payload, Told& told)
{
    if (const auto given = payload.find("given"); given != payload.end() && given->is_array())
        for (const json& fact : *given)
            if (fact.is_string()) told.facts[fact.get<std::string>()];
    if (entry.event.kind == "debriefed") told.facts["debriefing"];
}

/// `hashes`: an object of commitments by fact; anything else holds none.
void takeHashes(const json& hashes, Told& told)
{
    if (!hashes.is_object()) return;
    for (const auto& [fact, hash] : hashes.items()) told.facts[fact] = hash.is_string() ? hash.get<std::string>() : "?";
}

void takeFacts(const json& payload, Told& told)
{
    if (const auto hashes = payload.find("facts_sha256"); hashes != payload.end()) takeHashes(*hashes, told);
}

void takeStates(const json& payload, std::map<std::string, Told>& all)
{
    const auto states = payload.find("states");
    if (states == payload.end() || !states->is_object()) return;
    for (const auto& [participant, state] : states->items())
        if (const auto told = all.find(participant); told != all.end() && state.is_string()) told->second.state = state;
}

/// What the facts were that entries before the upgrade name without their hashes. Upgrades of development versions do not say it.
void takeFactsOfUpgrade(const json& payload, std::map<std::string, Told>& all)
{
    const auto facts = payload.find("facts_sha256");
    if (facts == payload.end() || !facts->is_object()) return;
    for (auto& [participant, told] : all) {
        Told atUpgrade;
        if (const auto hashes = facts->find(participant); hashes != facts->end()) takeHashes(*hashes, atUpgrade);
        std::erase_if(told.facts, [&](const auto& fact) { return !atUpgrade.facts.contains(fact.first); });
        for (auto& [fact, hash] : told.facts) hash = atUpgrade.facts.at(fact);
    }
}

void takeActOnStudy(const LogEntry& entry, const json& payload, std::map<std::string, Told>& all)
{
    const std::string participant = textIn(payload, "participant");
    if (entry.event.kind == "enrolled") all[participant].protocolVersion = numberIn(payload, "protocol_version", 1);
    if (entry.event.kind == upgradedKind) {
        takeStates(payload, all);
        takeFactsOfUpgrade(payload, all);
    }
    const auto told = all.find(participant);
    if (told == all.end()) return;
    if (entry.event.kind == "slot_state_set") told->second.state = textIn(payload, "state");
    if (entry.event.kind == "erased") {
        told->second.facts.clear();
        if (yesIn(payload, "answers_too")) told->second.state = "withdrawn";
    }
}

/// The number of the last upgrade's entry; 0 where there was none.
std::int64_t lastUpgradeIn(const Log& log)
{
    std::int64_t last = 0;
    for (const auto& [sequence, entry] : log)
        if (entry.event.kind == upgradedKind && entry.event.participant.empty()) last = sequence;
    return last;
}

std::map<std::string, Told> toldBy(const Log& log)
{
    std::map<std::string, Told> all;
    const std::int64_t upgrade = lastUpgradeIn(log);
    for (const auto& [sequence, entry] : log) {
        const json payload = payloadIn(entry.event.payloadJson);
        if (entry.event.participant.empty()) {
            takeActOnStudy(entry, payload, all);
            continue;
        }
        Told& told = all[entry.event.participant.value];
        if (entry.event.kind == "debriefed") told.state = "finished";
        if (entry.event.kind == "withdrawn") told.state = "withdrawn";
        if (sequence < upgrade) takeFactsBeforeUpgrade(entry, payload, told);
        takeFacts(payload, told);
    }
    return all;
}

void checkParticipants(const SqliteConnection& sqlite, const std::map<std::string, Told>& all, std::vector<std::string>& faults)
{
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT id, state, protocol_version FROM participants"));
    while (row.next()) {
        const std::string id = fromQt(row.value(0)), state = fromQt(row.value(1));
        const auto told = all.find(id);
        if (told == all.end()) continue;  // the audit of the places reports it
        if (state != told->second.state)
            faults.push_back("participant " + id + " is " + state + " in the table and " + told->second.state + " in the log");
        if (row.value(2).toInt() != told->second.protocolVersion)
            faults.push_back("participant " + id + " follows version " + fromQt(row.value(2)) +
                             " of the protocol in the table and version " + std::to_string(told->second.protocolVersion) +
                             " in the log");
    }
}

/// Null for a fact that the log does not know.
const std::string* commitmentIn(const std::map<std::string, Told>& all, const std::string& participant, const std::string& fact)
{
    const auto told = all.find(participant);
    if (told == all.end()) return nullptr;
    const auto found = told->second.facts.find(fact);
    return found == told->second.facts.end() ? nullptr : &found->second;
}

void checkFacts(const SqliteConnection& sqlite, const std::map<std::string, Told>& all, std::vector<std::string>& faults)
{
    std::set<std::pair<std::string, std::string>> stored;
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT participant, fact, CAST(value AS BLOB), salt FROM participant_facts"));
    while (row.next()) {
        const std::string id = fromQt(row.value(0)), name = fromQt(row.value(1));
        stored.emplace(id, name);
        const std::string* commitment = commitmentIn(all, id, name);
        if (commitment == nullptr)
            faults.push_back("the fact \"" + name + "\" of participant " + id + " is not in the log");
        else if (!commitment->empty() &&
                 *commitment != commitmentOfFact(fromQt(row.value(3)), name, row.value(2).toByteArray().toStdString()))
            faults.push_back("the fact \"" + name + "\" of participant " + id + " was altered");
    }
    for (const auto& [id, told] : all)
        for (const auto& [name, hash] : told.facts)
            if (!hash.empty() && !stored.contains({id, name}))
                faults.push_back("the fact \"" + name + "\" of participant " + id + " is missing, and no erasure is recorded");
}

using Rows = std::set<std::vector<std::string>>;

Rows rowsOf(const SqliteConnection& sqlite, const char* select, int columns)
{
    Rows rows;
    QSqlQuery row = sqlite.run(QString::fromLatin1(select));
    while (row.next()) {
        std::vector<std::string> cells;
        for (int column = 0; column < columns; ++column) cells.push_back(fromQt(row.value(column)));
        rows.insert(std::move(cells));
    }
    return rows;
}

/// Reports the rows of the table that the log does not know, and the acts of the log that are not in the table.
void compareActs(const std::string& what, const Rows& table, const Rows& log, std::vector<std::string>& faults)
{
    for (const auto& cells : table)
        if (!log.contains(cells)) faults.push_back(what + " " + cells[1] + " (entry " + cells[0] + ") is not in the log");
    for (const auto& cells : log)
        if (!table.contains(cells)) faults.push_back(what + " " + cells[1] + " (entry " + cells[0] + ") is in the log only");
}

void checkErasures(const SqliteConnection& sqlite, const Log& log, std::vector<std::string>& faults)
{
    Rows expected;
    for (const auto& [sequence, entry] : log) {
        if (entry.event.kind != "erased" || !entry.event.participant.empty()) continue;
        const json payload = payloadIn(entry.event.payloadJson);
        expected.insert({std::to_string(sequence), textIn(payload, "participant"), yesIn(payload, "answers_too") ? "1" : "0",
                         textIn(payload, "who"), textIn(payload, "why"), entry.event.wallTime});
    }
    compareActs("the erasure of", rowsOf(sqlite, "SELECT event, participant, answers_too, who, why, wall_time FROM erasures", 6),
                expected, faults);
}

void checkProtocols(const SqliteConnection& sqlite, const Log& log, std::vector<std::string>& faults)
{
    Rows expected;
    for (const auto& [sequence, entry] : log) {
        if (entry.event.kind != "protocol_taken" || !entry.event.participant.empty()) continue;
        const json payload = payloadIn(entry.event.payloadJson);
        expected.insert({std::to_string(sequence), std::to_string(numberIn(payload, "version", 0)), textIn(payload, "sha256"),
                         textIn(payload, "who"), textIn(payload, "why"), entry.event.wallTime});
    }
    compareActs("the protocol's version",
                rowsOf(sqlite, "SELECT event, version, sha256, who, why, wall_time FROM protocol_versions", 6), expected, faults);
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT version, CAST(json AS BLOB), sha256 FROM protocol_versions"));
    while (row.next())
        if (protocols::sha256(row.value(1).toByteArray().toStdString()) != fromQt(row.value(2)))
            faults.push_back("version " + fromQt(row.value(0)) + " of the protocol was altered after it was taken over");
}

/// An upgrade commits to the fixed tables anew and trusts facts without commitments. So it counts only where the study had an
/// older schema before.
void checkUpgradeSteps(const Log& log, std::vector<std::string>& faults)
{
    int present = 1;  // the first schema was not named
    for (const auto& [sequence, entry] : log) {
        if (!entry.event.participant.empty()) continue;
        const bool isUpgrade = entry.event.kind == upgradedKind;
        if (!isUpgrade && entry.event.kind != "created") continue;
        const int schema = numberIn(payloadIn(entry.event.payloadJson), "schema", 1);
        if (isUpgrade && schema <= present)
            faults.push_back("log entry " + std::to_string(sequence) + " (upgraded): the study had schema " +
                             std::to_string(present) + " before, so it was not upgraded");
        present = schema;
    }
}

/// What a question cannot have as its answer, in SQL.
QString impossibleFor(const protocols::AnswerKind& kind)
{
    return std::visit(
        protocols::Overloaded{
            [](const protocols::ForcedChoice&) {
                return QStringLiteral("(rating_tenths IS NOT NULL OR instr(alternatives, json_quote(choice)) = 0)");
            },
            [](const protocols::Rating& rating) {
                const protocols::RatingScale& scale = rating.scale;
                return QStringLiteral(
                           "(choice IS NOT NULL OR rating_tenths NOT BETWEEN %1 AND %2 OR (rating_tenths - %1) % %3 <> 0)")
                    .arg(scale.min.value)
                    .arg(scale.max.value)
                    .arg(scale.step.value);
            },
            [](const protocols::SameDifferent&) {
                return QStringLiteral("(rating_tenths IS NOT NULL OR choice NOT IN ('same', 'different'))");
            },
            [](const protocols::FreeText&) { return QStringLiteral("rating_tenths IS NOT NULL"); },
        },
        kind);
}

/// The field of a payload that tells an answer of this kind (study/session).
const char* fieldOfKind(const protocols::AnswerKind& kind)
{
    return std::visit(protocols::Overloaded{[](const protocols::ForcedChoice&) { return "fabric"; },
                                            [](const protocols::Rating&) { return "tenths"; },
                                            [](const protocols::SameDifferent&) { return "same"; },
                                            [](const protocols::FreeText&) { return "words"; }},
                      kind);
}

/// The questions of every version of the protocol, phase by phase. Empty where a version cannot be read, which is a fault of its
/// own.
std::vector<protocols::Question> questionsEver(const SqliteConnection& sqlite)
{
    std::vector<protocols::Question> questions;
    try {
        QSqlQuery row =
            sqlite.run(QStringLiteral("SELECT protocol_json, program_version FROM study UNION ALL "
                                      "SELECT json, program_version FROM protocol_versions, study"));
        while (row.next())
            for (const protocols::Phase& phase :
                 protocols::keptProtocolFromJson(fromQt(row.value(0)), "the study's protocol", fromQt(row.value(1))).phases)
                questions.insert(questions.end(), phase.questions.begin(), phase.questions.end());
    } catch (const protocols::Error&) {
        return {};
    }
    return questions;
}

/// By question: what no version of the protocol allows.
std::map<std::string, QString> impossibleAnswers(const SqliteConnection& sqlite)
{
    std::map<std::string, QString> impossible;
    for (const protocols::Question& question : questionsEver(sqlite)) {
        QString& rule = impossible[question.id.value];
        rule += (rule.isEmpty() ? QString() : QStringLiteral(" AND ")) + impossibleFor(question.kind);
    }
    return impossible;
}

/// The program stores no answer that the question cannot have; a login of a server that sends what it likes may.
void checkAnswers(const SqliteConnection& sqlite, std::vector<std::string>& faults)
{
    for (const auto& [question, impossible] : impossibleAnswers(sqlite)) {
        QSqlQuery row =
            sqlite.run(QStringLiteral("SELECT participant, trial FROM responses WHERE question = ? AND (%1) ORDER BY id LIMIT 20")
                           .arg(impossible),
                       {toQt(question)});
        while (row.next())
            faults.push_back(fromQt(row.value(0)) + ", trial " + std::to_string(row.value(1).toInt()) + ": the answer to " +
                             question + " is none that the question can have");
    }
}

/// A presentation has the code of its list; one that is presented again after a void draws another of the same letters.
void checkPresentationCodes(const SqliteConnection& sqlite, std::vector<std::string>& faults)
{
    QSqlQuery row = sqlite.run(
        QStringLiteral("SELECT r.participant, r.trial, r.question FROM responses r JOIN participants p ON p.id = r.participant "
                       "JOIN trials t ON t.slot = p.slot AND t.number = r.trial WHERE CASE r.attempt WHEN 1 "
                       "THEN r.presentation_code <> t.presentation_code "
                       "ELSE r.presentation_code = '' OR r.presentation_code GLOB '*[^A-Z0-9]*' END ORDER BY r.id LIMIT 20"));
    while (row.next())
        faults.push_back(fromQt(row.value(0)) + ", trial " + std::to_string(row.value(1).toInt()) + ": the answer to " +
                         fromQt(row.value(2)) + " stands under a code that the presentation does not have");
}

/// The questions of each phase. Amendments change none. Empty where the protocol cannot be read, which is a fault of its own.
std::vector<std::vector<std::string>> questionsByPhase(const SqliteConnection& sqlite)
{
    std::vector<std::vector<std::string>> questions;
    try {
        QSqlQuery row = sqlite.run(QStringLiteral("SELECT protocol_json, program_version FROM study"));
        if (!row.next()) return {};
        for (const protocols::Phase& phase :
             protocols::keptProtocolFromJson(fromQt(row.value(0)), "the study's protocol", fromQt(row.value(1))).phases) {
            questions.emplace_back();
            for (const protocols::Question& question : phase.questions) questions.back().push_back(question.id.value);
        }
    } catch (const protocols::Error&) {
        return {};
    }
    return questions;
}

/// A session ends when every trial has all its answers, in a presentation that is not void. A station that sends what it likes
/// may end one before.
void checkFinished(const SqliteConnection& sqlite, std::vector<std::string>& faults)
{
    std::map<std::string, int> missing;
    int phase = 0;
    for (const auto& questions : questionsByPhase(sqlite)) {
        for (const std::string& question : questions) {
            QSqlQuery row = sqlite.run(
                QStringLiteral(
                    "SELECT p.id, COUNT(*) FROM participants p JOIN trials t ON t.slot = p.slot "
                    "WHERE p.state = 'finished' AND t.phase = ? AND NOT EXISTS (SELECT 1 FROM responses r "
                    "WHERE r.participant = p.id AND r.trial = t.number AND r.question = ? AND NOT EXISTS (SELECT 1 "
                    "FROM voids v WHERE v.participant = r.participant AND v.trial = r.trial AND v.attempt = r.attempt)) "
                    "GROUP BY p.id"),
                {phase, toQt(question)});
            while (row.next()) missing[fromQt(row.value(0))] += row.value(1).toInt();
        }
        ++phase;
    }
    for (const auto& [participant, answers] : missing)
        faults.push_back("participant " + participant + " is finished without " + std::to_string(answers) +
                         (answers == 1 ? " answer" : " answers") + " of the list");
}

}  // namespace

StateFaults faultsOfStates(const SqliteConnection& sqlite, const Log& log)
{
    StateFaults faults;
    const std::map<std::string, Told> all = toldBy(log);
    checkParticipants(sqlite, all, faults.ofActs);
    checkFacts(sqlite, all, faults.ofFacts);
    checkErasures(sqlite, log, faults.ofActs);
    checkProtocols(sqlite, log, faults.ofActs);
    checkUpgradeSteps(log, faults.ofActs);
    return faults;
}

std::vector<std::string> faultsOfNamedActs(const SqliteConnection& sqlite, const Log& log)
{
    std::vector<std::string> faults;
    std::map<std::int64_t, std::string> hashes;
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT number, hash FROM acts"));
    while (row.next()) hashes[row.value(0).toLongLong()] = fromQt(row.value(1));
    std::set<int> reported;
    for (const auto& [sequence, entry] : log) {
        const json payload = payloadIn(entry.event.payloadJson);
        const auto named = payload.find("acts");
        if (named == payload.end() || !named->is_object()) continue;
        const int number = numberIn(*named, "number", 0);
        const auto found = hashes.find(number);
        if (found != hashes.end() && found->second == textIn(*named, "sha256")) continue;
        if (reported.insert(number).second)
            faults.push_back("act " + std::to_string(number) + ", which entry " + std::to_string(sequence) +
                             " of the log names, is not among the acts: they were cut off or written anew");
    }
    return faults;
}

TellingFields fieldsOfAnswers(const SqliteConnection& sqlite)
{
    TellingFields fields;
    std::set<std::string> ambiguous;
    for (const protocols::Question& question : questionsEver(sqlite)) {
        const char* field = fieldOfKind(question.kind);
        if (fields.emplace(question.id.value, field).first->second != field) ambiguous.insert(question.id.value);
    }
    for (const std::string& question : ambiguous) fields.erase(question);
    return fields;
}

std::vector<std::string> faultsOfAnswers(const SqliteConnection& sqlite)
{
    std::vector<std::string> faults;
    checkAnswers(sqlite, faults);
    checkPresentationCodes(sqlite, faults);
    checkFinished(sqlite, faults);
    return faults;
}

}  // namespace database
