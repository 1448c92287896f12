#include "study/session/session_entry.h"

#include "study/session/session_moves.h"
#include "study/session/session_record.h"

namespace study::session {

namespace {

using database::AnswerRecord;
using database::SessionStore;

const protocols::BlindedTrial& trialOf(const Plan& plan, int index) { return plan.trials[static_cast<std::size_t>(index)]; }

AnswerRecord recordOf(const Plan& plan, const State& state, const StoredAnswer& answer)
{
    const protocols::BlindedTrial& trial = trialOf(plan, answer.index);
    AnswerRecord record;
    record.trial = trial.number;
    record.question = questionOf(plan, answer.index, answer.question).id;
    record.presentationCode =
        codeOfAttempt(plan.trials, static_cast<std::size_t>(answer.index), attemptSoFar(state, answer.index));
    record.alternatives = trial.alternatives;
    putInto(record, answer.response);
    return record;
}

/// Ages come from outside. No answer begins before its question, and no touch ends before it began.
void addStamps(AnswerRecord& record, const Presenting& asked, const AnswerStamps& stamps)
{
    const std::int64_t atNs = record.answeredAtNs;
    if (stamps.begunAgoNs) {
        record.answerBegunAtNs = stampOf(atNs, *stamps.begunAgoNs, asked.readyAtNs);
        record.answerBegunBy = nameOf(stamps.begunBy);
    }
    if (stamps.touchEndedAgoNs && asked.touchedAtNs)
        record.touchEndedAtNs = stampOf(atNs, *stamps.touchEndedAgoNs, *asked.touchedAtNs);
    record.entries = stamps.entries;
}

AnswerRecord firstAnswer(const Plan& plan, const State& state, const Presenting& asked, const StoredAnswer& answer,
                         const AnswerStamps& stamps, std::int64_t atNs)
{
    AnswerRecord record = recordOf(plan, state, answer);
    record.readyAtNs = asked.readyAtNs;
    record.touchedAtNs = asked.touchedAtNs;
    if (asked.touchedAtNs) record.touchedBy = asked.touchedBy == TouchSource::Display ? "display" : "operator";
    record.answeredAtNs = atNs;
    addStamps(record, asked, stamps);
    return record;
}

AnswerRecord correction(const Plan& plan, const State& next, const Corrected& event)
{
    AnswerRecord record = recordOf(plan, next, next.answers[*latestAnswerTo(plan, next, event.question)]);
    record.isCorrection = true;
    record.note = event.why;
    return record;
}

/// The trial that was voided: the one that was added to `order`.
int voidedTrial(const State& before, const State& next)
{
    std::size_t place = 0;
    while (place < before.order.size() && before.order[place] == next.order[place]) ++place;
    return next.order[place].index;
}

}  // namespace

SessionStore::Append entryOf(const Plan& plan, const State& before, const State& next, const EventBody& body, std::int64_t atNs)
{
    SessionStore::Append entry;
    if (const auto* answered = std::get_if<Answered>(&body))
        entry.answers.push_back(
            firstAnswer(plan, before, std::get<Presenting>(before.stage), next.answers.back(), answered->stamps, atNs));
    if (const auto* corrected = std::get_if<Corrected>(&body)) entry.answers.push_back(correction(plan, next, *corrected));
    if (const auto* voided = std::get_if<Voided>(&body)) {
        entry.voids = trialOf(plan, voidedTrial(before, next)).number;
        if (!voided->why.empty()) entry.note = {*entry.voids, voided->why, false};
    }
    if (const auto* noted = std::get_if<Noted>(&body))
        if (const auto meant = presentationMeant(before))
            entry.note = {trialOf(plan, meant->index).number, noted->text, noted->isFlag, meant->attempt};
    if (const auto* given = std::get_if<FactsGiven>(&body)) entry.facts.assign(given->facts.begin(), given->facts.end());
    if (const auto* debriefed = std::get_if<Debriefed>(&body))
        if (!debriefed->text.empty()) entry.facts.emplace_back(debriefingFact, debriefed->text);
    if (std::holds_alternative<Finished>(next.stage) && !std::holds_alternative<Finished>(before.stage))
        entry.slotState = database::SlotState::Finished;
    if (std::holds_alternative<Withdrawn>(next.stage) && !std::holds_alternative<Withdrawn>(before.stage))
        entry.slotState = database::SlotState::Withdrawn;
    return entry;
}

}  // namespace study::session
