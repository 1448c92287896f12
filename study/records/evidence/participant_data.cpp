#include "study/records/evidence/participant_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "database/disk/payload_fields.h"
#include "database/evidence/acts.h"
#include "database/evidence/clear_log.h"
#include "database/evidence/finger_records.h"
#include "database/keys.h"
#include "database/stored_texts.h"
#include "database/study_rows.h"
#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "study/records/evidence/exported_samples.h"
#include "study/records/evidence/participant_page.h"
#include "study/records/log_heads.h"
#include "study/records/stored_study.h"

namespace study::records {

namespace {

using nlohmann::ordered_json;

/// The study and the person whose data are read.
struct Person {
    const database::StudyStore& store;
    database::Enrolment enrolment;
    protocols::Protocol protocol;  ///< the version that this person's session follows
    std::optional<Naming> naming;  ///< after the unblinding only
    std::vector<database::EventRecord> events;
};

database::Enrolment enrolmentOf(const database::StudyStore& store, const protocols::ParticipantId& participant)
{
    for (const auto& enrolment : store.enrolments())
        if (enrolment.participant == participant) return enrolment;
    throw protocols::badInput({"unknown participant " + participant.value, store.folder().folder.string(),
                               "an enrolled participant", "see vis2hap study status"});
}

protocols::Protocol protocolFollowedBy(const database::StudyStore& store, const database::Enrolment& enrolment)
{
    const auto versions = store.protocolVersions();
    const auto number = static_cast<std::size_t>(enrolment.protocolVersion);
    return protocols::keptProtocolFromJson(versions.at(std::clamp<std::size_t>(number, 1, versions.size()) - 1).json,
                                           "the study's protocol", store.facts().programVersion);
}

Person personIn(const database::StudyStore& store, const protocols::ParticipantId& participant)
{
    const auto enrolment = enrolmentOf(store, participant);
    Person person{store, enrolment, protocolFollowedBy(store, enrolment), {}, store.events(participant)};
    if (store.unblinding()) person.naming = namingOf(store, person.protocol, {});
    return person;
}

/// The letter of the place on the tray, "same", "different", or the participant's own words.
std::string answerText(const protocols::Question* question, const database::AnswerRecord& record)
{
    const std::string text = record.answer.value_or("");
    const bool isChoice = question == nullptr || std::holds_alternative<protocols::ForcedChoice>(question->kind);
    if (!isChoice) return text;
    const auto place = placeAmongAlternatives(protocols::ForcedChoice{}, record.alternatives, text);
    if (!place) return std::string(pieceElsewhere);
    constexpr int letters = 26;
    return *place < letters ? std::string(1, static_cast<char>('A' + *place))
                            : std::string(pieceNumbered) + std::to_string(*place + 1);
}

/// What only an unblinded study may say about an answer.
void addNames(ordered_json& row, const Person& person, const protocols::Question* question, const database::AnswerRecord& record)
{
    const auto named = person.naming->entries.find({person.enrolment.participant, record.trial});
    if (named == person.naming->entries.end()) return;
    row["fabric"] = named->second.fabric.value;
    row["condition"] = named->second.condition;
    if (question == nullptr || !record.answer) return;
    if (std::holds_alternative<protocols::ForcedChoice>(question->kind)) row["answer_fabric"] = *record.answer;
    if (const auto right = isRight(question->kind, record.alternatives, named->second.fabric, *record.answer))
        row["correct"] = *right;
}

ordered_json answerRow(const Person& person, const database::LoggedAnswer& answer)
{
    const auto& record = answer.record;
    const auto* question = questionWith(person.protocol, record.question);
    ordered_json row{{"entry", answer.event},
                     {"time", answer.wallTime},
                     {"sitting", answer.sitting},
                     {"trial", record.trial.value},
                     {"attempt", answer.attempt},
                     {"presentation_code", record.presentationCode.value},
                     {"question", record.question.value}};
    if (question != nullptr) row["answer_kind"] = protocols::nameOf(question->kind);
    if (record.answer) row["answer"] = answerText(question, record);
    if (record.rating) row["rating"] = record.rating->inScaleUnits();
    row["seconds"] = database::secondsOf(record);
    if (answer.responseSeconds) row["response_seconds"] = *answer.responseSeconds;
    if (record.touchedAtNs) row["touched_by"] = record.touchedBy;
    if (record.touchEndedAtNs && record.touchedAtNs)
        row["touching_seconds"] = database::secondsBetween(*record.touchedAtNs, *record.touchEndedAtNs);
    if (record.answerBegunAtNs) row["answer_begun_by"] = record.answerBegunBy;
    if (record.entries) row["entries"] = *record.entries;
    row["is_correction"] = record.isCorrection;
    row["voided"] = answer.voided;
    if (person.naming) addNames(row, person, question, record);
    return row;
}

ordered_json answerRows(const Person& person)
{
    ordered_json rows = ordered_json::array();
    for (const auto& answer : answersGivenBy(person.store, person.enrolment.participant))
        rows.push_back(answerRow(person, answer));
    return rows;
}

/// Notes from before the first presentation belong to none, so they stand in the log alone.
void addNotesBeforeTrials(const Person& person, const std::set<std::int64_t>& known, ordered_json& rows)
{
    for (const auto& event : person.store.events(person.enrolment.participant)) {
        if (event.kind != "noted" || known.contains(event.sequence)) continue;
        const auto payload = protocols::storedOrderedJson(event.payloadJson);
        if (!payload.is_object() || !payload.contains("text")) continue;
        rows.push_back({{"entry", event.sequence},
                        {"time", event.wallTime},
                        {"trial", nullptr},
                        {"text", payload["text"]},
                        {"flag", payload.value("flag", ordered_json(false))}});
    }
}

ordered_json noteRows(const Person& person)
{
    ordered_json rows = ordered_json::array();
    std::set<std::int64_t> known;
    for (const auto& note : notesAbout(person.store, person.enrolment.participant)) known.insert(note.event);
    addNotesBeforeTrials(person, known, rows);
    for (const auto& note : notesAbout(person.store, person.enrolment.participant)) {
        ordered_json row{{"entry", note.event}, {"time", note.wallTime}, {"trial", note.trial}, {"attempt", note.attempt}};
        if (!note.question.empty()) row["question"] = note.question;
        row["text"] = note.text;
        row["flag"] = note.isFlag;
        rows.push_back(row);
    }
    return rows;
}

/// The fields of a payload that concern the participant, and that say nothing about fabrics or conditions.
ordered_json detailsOf(const database::EventRecord& event)
{
    static const std::set<std::string> shown{"why",    "text",     "flag",     "given",  "shown", "spoken",
                                             "ticked", "readings", "question", "tenths", "same",  "words"};
    ordered_json details = ordered_json::object();
    const auto payload = protocols::storedOrderedJson(event.payloadJson);
    if (!payload.is_object()) return details;
    for (const auto& [key, value] : payload.items())
        if (shown.contains(key)) details[key] = value;
    return details;
}

ordered_json eventRows(const Person& person)
{
    ordered_json rows = ordered_json::array();
    for (const auto& event : person.events) {
        ordered_json row{{"entry", event.sequence}, {"sitting", event.sitting}, {"kind", event.kind}};
        if (!event.wallTime.empty()) row["time"] = event.wallTime;  // an erasure empties it
        if (const auto details = detailsOf(event); !details.empty()) row["details"] = details;
        rows.push_back(row);
    }
    return rows;
}

ordered_json sittingRows(const Person& person)
{
    ordered_json rows = ordered_json::array();
    for (const auto& event : person.events) {
        if (event.sitting == 0 || event.wallTime.empty()) continue;
        if (rows.empty() || rows.back()["sitting"] != event.sitting)
            rows.push_back({{"sitting", event.sitting}, {"from", event.wallTime}, {"until", event.wallTime}});
        rows.back()["until"] = event.wallTime;
    }
    return rows;
}

ordered_json consentOf(const Person& person)
{
    ordered_json consent{{"text", person.protocol.consent}, {"time", nullptr}};
    for (const auto& event : person.events)
        if (event.kind == "consented" && !event.wallTime.empty()) consent["time"] = event.wallTime;
    if (consent["time"].is_null()) consent["why"] = {{"time", "the study stores no consent of this participant"}};
    return consent;
}

ordered_json factRows(const Person& person)
{
    ordered_json rows = ordered_json::array();
    const auto facts = person.store.personalFacts();
    if (const auto own = facts.find(person.enrolment.participant); own != facts.end())
        for (const auto& [fact, value] : own->second) rows.push_back({{"fact", fact}, {"value", value}});
    return rows;
}

ordered_json erasureRows(const Person& person)
{
    ordered_json rows = ordered_json::array();
    for (const auto& event : person.store.eventsOfKind("erased")) {
        const auto act = database::payloadIn(event.payloadJson);
        if (!event.participant.empty() || database::textIn(act, "participant") != person.enrolment.participant.value) continue;
        rows.push_back({{"entry", event.sequence},
                        {"time", event.wallTime},
                        {"answers_too", database::yesIn(act, "answers_too")},
                        {"who", database::textIn(act, "who")},
                        {"why", database::textIn(act, "why")}});
    }
    return rows;
}

ordered_json copyRows(const Person& person)
{
    ordered_json rows = ordered_json::array();
    if (person.events.empty()) return rows;
    for (const auto& act : copiesSince(person.store, person.events.front().sequence, person.enrolment.participant))
        rows.push_back({{"act", act.kind}, {"time", act.wallTime}, {"host", act.host}, {"path", act.path}});
    return rows;
}

void hide(ordered_json& object, const char* key)
{
    if (object.contains(key) && object[key].is_string()) object[key] = "…";
}

/// "…" for what people said, wrote or answered.
ordered_json withoutWords(ordered_json data)
{
    for (auto& fact : data["facts"]) hide(fact, "value");
    for (auto& note : data["notes"]) hide(note, "text");
    for (auto& answer : data["answers"]) hide(answer, "answer");
    for (auto& event : data["events"])
        if (event.contains("details")) event["details"] = ordered_json::object();
    for (auto& act : data["erasures"])
        for (const char* key : {"who", "why"}) hide(act, key);
    return data;
}

/// The text of a CSV cell, not yet quoted.
std::string cellOf(const ordered_json& row, const std::string& column)
{
    if (!row.contains(column) || row[column].is_null()) return "";
    const auto& value = row[column];
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
    return value.is_number_float() ? protocols::shortest(value.get<double>()) : value.dump();
}

std::string answersCsv(const ordered_json& data)
{
    std::vector<std::string> columns{
        "entry",   "time",          "sitting", "trial",      "attempt",          "presentation_code", "question",
        "answer",  "rating",        "seconds", "touched_by", "response_seconds", "touching_seconds",  "answer_begun_by",
        "entries", "is_correction", "voided"};
    if (!data["blinded"].get<bool>()) columns.insert(columns.end(), {"fabric", "condition", "answer_fabric", "correct"});
    std::vector<std::string> head{"participant"};
    head.insert(head.end(), columns.begin(), columns.end());
    std::string text = protocols::csvRow(head);
    for (const auto& row : data["answers"]) {
        std::vector<std::string> cells{protocols::safeCell(data["participant"].get<std::string>())};
        for (const auto& column : columns) {
            const bool isText = row.contains(column) && row[column].is_string();
            cells.push_back(isText ? protocols::safeCell(cellOf(row, column)) : cellOf(row, column));
        }
        text += protocols::csvRow(cells);
    }
    return text;
}

}  // namespace

ordered_json participantData(const database::StudyStore& store, const protocols::ParticipantId& participant)
{
    const Person person = personIn(store, participant);
    return {{"schema", "vis2hap.participant/1"},
            {"study", store.facts().name},
            {"language", person.protocol.language},
            {"participant", participant.value},
            {"made_at", database::wallTimeNow()},
            {"blinded", !person.naming.has_value()},
            {"kind", nameOf(person.enrolment.kind)},
            {"state", nameOf(person.enrolment.state)},
            {"slot", person.enrolment.slot},
            {"protocol_version", person.enrolment.protocolVersion},
            {"erasures", erasureRows(person)},
            {"consent", consentOf(person)},
            {"facts", factRows(person)},
            {"sittings", sittingRows(person)},
            {"answers", answerRows(person)},
            {"finger_samples", fingerSampleCount(store, participant)},
            {"notes", noteRows(person)},
            {"events", eventRows(person)},
            {"copies", copyRows(person)},
            {"log_head", headTextOf(store)}};
}

void writeParticipantData(const database::StudyStore& store, const ordered_json& data, const std::filesystem::path& folder)
{
    const auto write = [&](const std::string& name, const std::string& text) {
        protocols::writeWholeFile(folder / name, text, protocols::Sync::Later);
    };
    write("your-data.html", participantPage(data));
    write("your-data.json", data.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n");
    write("your-answers.csv", answersCsv(data));
    if (!data["blinded"].get<bool>() && data["finger_samples"].get<std::int64_t>() > 0)
        write("your-finger-samples.csv",
              fingerSamplesCsv(store, protocols::ParticipantId(data["participant"].get<std::string>()), std::nullopt));
    for (const auto& act : data["erasures"]) {
        const std::string name = "erasure-" + std::to_string(act["entry"].get<std::int64_t>()) + ".txt";
        if (const auto text = protocols::readIfPossible(store.folder().folder / "erasures" / name)) write(name, *text);
    }
}

void writeEveryParticipant(const database::StudyStore& store, const std::filesystem::path& folder)
{
    ordered_json joined;
    std::size_t number = 0;
    for (const auto& enrolment : store.enrolments()) {
        const auto data = withoutWords(participantData(store, enrolment.participant));
        protocols::writeWholeFile(folder / (std::to_string(++number) + ".html"), participantPage(data), protocols::Sync::Later);
        for (const char* rows : {"facts", "sittings", "answers", "notes", "events"})
            for (ordered_json row : data[rows]) {
                row["participant"] = enrolment.participant.value;
                joined[rows].push_back(std::move(row));
            }
    }
    if (number > 0) protocols::writeWholeFile(folder / "joined.json", joined.dump(1), protocols::Sync::Later);
}

}  // namespace study::records
