#include "study/exports/exported_answers.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "protocols/question_ids.h"
#include "study/exports/codebook.h"
#include "study/exports/public_files.h"

namespace study::exports {

namespace {

using database::CurrentAnswer;
using nlohmann::ordered_json;

/// Throws workFailed for an answer of nobody, or to a presentation that is in no list.
void requireListed(const CurrentAnswer& answer, const records::Naming& naming, const database::StudyStore& store)
{
    if (naming.entries.contains({answer.participant, answer.record.trial})) return;
    throw protocols::workFailed({"an answer of " + answer.participant.value + " names trial " +
                                     std::to_string(answer.record.trial.value) + ", which is not in the participant's list",
                                 store.folder().database().string(), "a trial of the list",
                                 "see `vis2hap verify`; restore the study from a backup"});
}

constexpr std::size_t bytesAtOnce = std::size_t{1} << 20;

template <class T>
ExportedValue valueIfThere(const std::optional<T>& value)
{
    return value ? ExportedValue(*value) : ExportedValue();
}

void addInstruction(std::vector<ExportedField>& row, const records::Naming::Entry& entry, const CurrentAnswer& answer)
{
    row.push_back({"instruction", entry.instruction.empty() ? ExportedValue() : ExportedValue(entry.instruction.value)});
    row.push_back({"deadline_seconds", entry.deadlineMs ? ExportedValue(*entry.deadlineMs / 1000.0) : ExportedValue()});
    const auto late = isLate(entry, answer);
    row.push_back({"late", late ? ExportedValue(std::int64_t{*late}) : ExportedValue()});
}

/// What the presentation is beside those of the list; missing for one of the list.
ExportedField anchorOf(const records::Naming::Entry& entry)
{
    const std::string kind = nameOf(entry.anchor);
    return {"anchor", kind.empty() ? ExportedValue() : ExportedValue(kind)};
}

ordered_json jsonRowOf(const std::vector<ExportedField>& row)
{
    ordered_json json = ordered_json::object();
    for (const auto& [name, value] : row)
        std::visit(protocols::Overloaded{[&, key = name](std::monostate) { json[key] = nullptr; },
                                         [&, key = name](const auto& known) { json[key] = known; }},
                   value);
    return json;
}

/// The text of a CSV cell, not yet quoted. Words of people may begin like a formula.
std::string cell(const ExportedValue& value)
{
    return std::visit(protocols::Overloaded{[](std::monostate) { return std::string(); },
                                            [](std::int64_t number) { return std::to_string(number); },
                                            [](double number) { return protocols::shortest(number); },
                                            [](const std::string& text) { return protocols::safeCell(text); },
                                            [](const std::vector<std::string>& texts) { return ordered_json(texts).dump(); }},
                      value);
}

}  // namespace

ExportedAnswers::ExportedAnswers(const database::StudyStore& store, const protocols::Protocol& protocol,
                                 const records::Naming& naming, bool isPublic)
    : m_store(store), m_protocol(protocol), m_naming(naming), m_isPublic(isPublic)
{
    records::PlacesInTime inTime;
    store.eachAnswer([&](const CurrentAnswer& answer) {
        requireListed(answer, naming, store);
        inTime.add(answer);
        if (!isPublic) return;
        const auto [began, isFirst] = m_beganAtNs.try_emplace({answer.participant, answer.sitting}, answer.record.readyAtNs);
        if (!isFirst) began->second = std::min(began->second, answer.record.readyAtNs);
    });
    m_places = inTime.places();
    for (const auto& enrolment : store.enrolments()) m_enrolments.emplace(enrolment.participant, enrolment);
}

std::vector<std::string> ExportedAnswers::columns() const
{
    std::vector<std::string> columns(protocols::answerColumns().begin(), protocols::answerColumns().end());
    columns.insert(columns.end(), {"place", "attempt", "sitting", "state", "kind"});
    if (hasInstructions(m_protocol)) columns.insert(columns.end(), {"instruction", "deadline_seconds", "late"});
    if (hasAnchors(m_protocol)) columns.emplace_back("anchor");
    if (m_isPublic) std::erase_if(columns, isPrivateColumn);
    return columns;
}

void ExportedAnswers::eachAnswer(const std::function<void(const CurrentAnswer&)>& take) const
{
    m_store.eachAnswer([&](const CurrentAnswer& answer) {
        if (m_places.contains(records::presentationOf(answer)) && !isLeftOut(answer)) take(answer);
    });
}

bool ExportedAnswers::isLeftOut(const CurrentAnswer& answer) const
{
    return m_isPublic && (isWorded(m_protocol, answer.record.question) ||
                          m_enrolments.at(answer.participant).state == database::SlotState::Withdrawn);
}

/// One answer of an unblinded study, in the order of export.json.
std::vector<ExportedField> ExportedAnswers::rowOf(const CurrentAnswer& answer) const
{
    const auto& record = answer.record;
    const auto& entry = m_naming.of(answer.participant, record.trial);
    const database::Enrolment& enrolment = m_enrolments.at(answer.participant);
    std::vector<std::string> alternatives;
    for (const auto& fabric : record.alternatives) alternatives.push_back(fabric.value);
    const auto* question = questionWith(m_protocol, record.question);
    const auto right =
        record.answer && question ? isRight(question->kind, record.alternatives, entry.fabric, *record.answer) : std::nullopt;
    const auto began = m_beganAtNs.find({answer.participant, answer.sitting});
    const std::int64_t zero = began == m_beganAtNs.end() ? 0 : began->second;
    const auto stamp = [zero](std::optional<std::int64_t> atNs) {
        std::int64_t since = 0;
        const bool isKnown = atNs && !__builtin_sub_overflow(*atNs, zero, &since);
        return isKnown ? ExportedValue(since) : ExportedValue();
    };
    const auto ifTouched = [&](const std::string& by) { return record.touchedAtNs ? ExportedValue(by) : ExportedValue(); };
    const auto ifBegun = [&](const std::string& by) { return record.answerBegunAtNs ? ExportedValue(by) : ExportedValue(); };
    // A correction may be of another sitting, whose clock this is not.
    const ExportedValue storedAt = m_isPublic && answer.corrections > 0 ? ExportedValue() : stamp(answer.storedAtNs);
    std::vector<ExportedField> row{{"participant", answer.participant.value},
                                   {"trial", std::int64_t{record.trial.value}},
                                   {"question", record.question.value},
                                   {"fabric", entry.fabric.value},
                                   {"condition", entry.condition},
                                   {"alternatives", std::move(alternatives)},
                                   {"answer", valueIfThere(record.answer)},
                                   {"correct", right ? ExportedValue(std::int64_t{*right}) : ExportedValue()},
                                   {"rating", record.rating ? ExportedValue(record.rating->inScaleUnits()) : ExportedValue()},
                                   {"seconds", answer.seconds},
                                   {"response_seconds", valueIfThere(answer.responseSeconds)},
                                   {"ready_at", stamp(record.readyAtNs)},
                                   {"touched_at", stamp(record.touchedAtNs)},
                                   {"touched_by", ifTouched(record.touchedBy)},
                                   {"touch_ended_at", stamp(record.touchEndedAtNs)},
                                   {"answer_begun_at", stamp(record.answerBegunAtNs)},
                                   {"answer_begun_by", ifBegun(record.answerBegunBy)},
                                   {"answered_at", stamp(record.answeredAtNs)},
                                   {"stored_at", storedAt},
                                   {"corrections", std::int64_t{answer.corrections}},
                                   {"voided", std::int64_t{answer.voided}},
                                   {"wall_time", answer.wallTime},
                                   {"note", record.note},
                                   {"entries", record.entries ? ExportedValue(std::int64_t{*record.entries}) : ExportedValue()},
                                   {"place", std::int64_t{m_places.at(records::presentationOf(answer))}},
                                   {"attempt", std::int64_t{answer.attempt}},
                                   {"sitting", std::int64_t{answer.sitting}},
                                   {"state", nameOf(enrolment.state)},
                                   {"kind", nameOf(enrolment.kind)}};
    if (hasInstructions(m_protocol)) addInstruction(row, entry, answer);
    if (hasAnchors(m_protocol)) row.push_back(anchorOf(entry));
    return row;
}

void ExportedAnswers::writeCsv(const protocols::TakeBytes& take) const
{
    const std::vector<std::string> names = columns();
    take(protocols::csvRow(names));
    std::vector<std::string> cells(names.size());
    std::string rows;
    eachAnswer([&](const CurrentAnswer& answer) {
        for (const auto& [name, value] : rowOf(answer))
            if (const auto column = std::ranges::find(names, name); column != names.end())
                cells[static_cast<std::size_t>(column - names.begin())] = cell(value);
        rows += protocols::csvRow(cells);
        if (rows.size() < bytesAtOnce) return;
        take(rows);
        rows.clear();
    });
    take(rows);
}

void ExportedAnswers::writeJson(const protocols::TakeBytes& take) const
{
    std::string text = "[";
    bool isFirst = true;
    eachAnswer([&](const CurrentAnswer& answer) {
        text += std::exchange(isFirst, false) ? "\n" : ",\n";
        for (const char c : "  " + jsonRowOf(rowOf(answer)).dump(1)) {
            text += c;
            if (c == '\n') text += "  ";
        }
        if (text.size() < bytesAtOnce) return;
        take(text);
        text.clear();
    });
    take(text + (isFirst ? "]" : "\n ]"));
}

}  // namespace study::exports
