#include "study/simulation/memory_session.h"

#include <algorithm>
#include <numeric>

#include "database/study_rows.h"
#include "protocols/files/errors.h"
#include "study/session/session_entry.h"

namespace study::simulation {

using database::AnswerRecord;
using database::CurrentAnswer;
using namespace session;

MemorySession::MemorySession(const Plan& plan, protocols::ParticipantId participant, const Clock& clock)
    : m_plan(plan), m_participant(std::move(participant)), m_clock(clock)
{
    const auto deadTimeNs = static_cast<std::int64_t>(plan.protocol.deadTimeSeconds * 1e9);
    if (const auto refusal = perform(SittingStarted{deadTimeNs}))
        throw protocols::workFailed({"the session cannot be opened: " + refusal->reason, m_participant.value, "", ""});
}

std::optional<Refusal> MemorySession::perform(const EventBody& event)
{
    const std::int64_t atNs = m_clock.monotonicNs();
    auto outcome = apply(m_plan, m_state, {event, atNs});
    if (auto* refusal = std::get_if<Refusal>(&outcome)) {
        ++m_refusals;
        return std::move(*refusal);
    }
    State& next = std::get<SessionStep>(outcome).next;
    const auto entry = entryOf(m_plan, m_state, next, event, atNs);
    m_state = std::move(next);
    ++m_events;
    keep(entry);
    return std::nullopt;
}

int MemorySession::attemptOf(int trial) const
{
    const auto voids = m_voids.find(trial);
    return voids == m_voids.end() ? 1 : 1 + voids->second;
}

void MemorySession::keep(const database::StudyStore::Append& entry)
{
    for (const AnswerRecord& record : entry.answers) keepAnswer(record);
    if (entry.note)
        m_remarks.push_back({entry.note->trial.value, entry.note->attempt.value_or(attemptOf(entry.note->trial.value)),
                             std::nullopt, entry.note->text});
    if (entry.voids) ++m_voids[entry.voids->value];
}

void MemorySession::keepAnswer(const AnswerRecord& record)
{
    const int attempt = attemptOf(record.trial.value);
    if (!record.note.empty()) m_remarks.push_back({record.trial.value, attempt, record.question, record.note});
    if (!record.isCorrection) {
        CurrentAnswer& row = m_rows.emplace_back();
        row.participant = m_participant;
        row.record = record;
        row.event = m_events;
        row.sitting = m_state.sitting;
        row.attempt = attempt;
        row.storedAtNs = m_clock.monotonicNs();
        row.seconds = database::secondsOf(record);
        row.responseSeconds = database::responseSecondsOf(record);
        row.wallTime = m_clock.wallTime();
        return;
    }
    // A correction changes the answer, not its time.
    const auto first = std::find_if(m_rows.rbegin(), m_rows.rend(), [&](const CurrentAnswer& row) {
        return row.record.trial == record.trial && row.record.question == record.question && row.attempt == attempt;
    });
    if (first == m_rows.rend()) throw protocols::workFailed({"there is no answer to correct", m_participant.value, "", ""});
    first->record.answer = record.answer;
    first->record.rating = record.rating;
    first->record.isCorrection = true;
    ++first->corrections;
    first->storedAtNs = m_clock.monotonicNs();
    first->wallTime = m_clock.wallTime();
}

int MemorySession::voidedPresentations() const
{
    return std::accumulate(m_voids.begin(), m_voids.end(), 0, [](int sum, const auto& voids) { return sum + voids.second; });
}

std::string MemorySession::remarksOn(const CurrentAnswer& answer) const
{
    std::string text;
    bool isFirst = true;
    for (const Remark& remark : m_remarks) {
        const bool isOnAnswer = remark.trial == answer.record.trial.value && remark.attempt == answer.attempt &&
                                (!remark.question || *remark.question == answer.record.question);
        if (!isOnAnswer) continue;
        if (!isFirst) text += "; ";
        text += remark.text;
        isFirst = false;
    }
    return text;
}

std::vector<CurrentAnswer> MemorySession::answers() const
{
    std::vector<CurrentAnswer> rows = m_rows;
    for (CurrentAnswer& row : rows) {
        row.record.note = remarksOn(row);
        row.voided = row.attempt < attemptOf(row.record.trial.value);
    }
    std::stable_sort(rows.begin(), rows.end(),
                     [](const CurrentAnswer& a, const CurrentAnswer& b) { return a.record.trial < b.record.trial; });
    return rows;
}

}  // namespace study::simulation
