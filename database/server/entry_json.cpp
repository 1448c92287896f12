#include "database/server/entry_json.h"

#include <QUuid>
#include <nlohmann/json.hpp>
#include <utility>

#include "database/disk/finger_text.h"
#include "database/stored_texts.h"
#include "database/study_writing.h"

namespace database {

namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json orNull(const std::optional<T>& value)
{
    return value ? Json(*value) : Json();
}

Json textOrNull(const std::string& text) { return text.empty() ? Json() : Json(text); }

Json jsonOf(const AnswerRecord& answer)
{
    return {{"trial", answer.trial.value},
            {"question", answer.question.value},
            {"presentation_code", answer.presentationCode.value},
            {"alternatives", database::jsonOf(answer.alternatives)},
            {"choice", orNull(answer.answer)},
            {"rating_tenths", answer.rating ? Json(answer.rating->value) : Json()},
            {"ready_at", answer.readyAtNs},
            {"touched_at", orNull(answer.touchedAtNs)},
            {"touched_by", textOrNull(answer.touchedBy)},
            {"touch_ended_at", orNull(answer.touchEndedAtNs)},
            {"answer_begun_at", orNull(answer.answerBegunAtNs)},
            {"answer_begun_by", textOrNull(answer.answerBegunBy)},
            {"answered_at", answer.answeredAtNs},
            {"entries", orNull(answer.entries)},
            {"is_correction", answer.isCorrection},
            {"note", answer.note}};
}

Json jsonOf(const SessionStore::FingerStretch& stretch)
{
    return {{"trial", stretch.trial.value},
            {"began_at", stretch.samples.front().atNs},
            {"count", stretch.samples.size()},
            {"left_out", stretch.leftOut},
            {"samples", fingerTextOf(stretch.samples)}};
}

Json jsonOf(const SessionStore::Note& note)
{
    Json json{{"trial", note.trial.value}, {"text", note.text}, {"is_flag", note.isFlag}};
    if (note.attempt) json["attempt"] = *note.attempt;
    return json;
}

}  // namespace

EntryToSend entryToSend(const SessionStore::Append& entry, int before)
{
    const std::vector<SaltedFact> facts = salted(entry.facts);
    std::string payload = withCommitments(entry.event.payloadJson, facts);
    Json json{{"id", QUuid::createUuid().toString(QUuid::WithoutBraces).toStdString()},
              {"after", before},
              {"event",
               {{"participant", entry.event.participant.value},
                {"sitting", entry.event.sitting},
                {"kind", entry.event.kind},
                {"payload", payload},
                {"at_ns", entry.event.atNs},
                {"wall_time", entry.event.wallTime}}},
              {"answers", Json::array()},
              {"finger", entry.finger ? jsonOf(*entry.finger) : Json()},
              {"voids", entry.voids ? Json(entry.voids->value) : Json()},
              {"note", entry.note ? jsonOf(*entry.note) : Json()},
              {"state", entry.slotState ? Json(nameOf(*entry.slotState)) : Json()},
              {"facts", Json::array()},
              {"stored_at", entry.storedAtNs}};
    for (const AnswerRecord& answer : entry.answers) json["answers"].push_back(jsonOf(answer));
    for (const auto& [fact, value, salt] : facts) json["facts"].push_back(Json::array({fact, value, salt}));
    return {json.dump(-1, ' ', false, Json::error_handler_t::replace), std::move(payload)};
}

}  // namespace database
