#include "study/records/stored_study.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <tuple>

#include "database/evidence/finger_records.h"
#include "database/evidence/operator_latency.h"
#include "database/server/study_move.h"
#include "protocols/condition.h"
#include "protocols/files/strict_json.h"
#include "protocols/protocol_json.h"
#include "protocols/records/anchor_trials.h"
#include "protocols/records/trial_lists.h"
#include "reports/cells/finger_motion.h"
#include "reports/data/sitting_stamps.h"
#include "reports/json/prices_json.h"
#include "reports/json/signals_json.h"
#include "reports/text/plain_words.h"
#include "study/records/display_response_record.h"
#include "study/records/followed_versions.h"
#include "study/records/participants_sentence.h"
#include "study/records/places_in_time.h"
#include "study/records/registered_plan.h"
#include "study/records/shown_origin.h"

namespace study::records {

namespace {

std::vector<reports::InstructionInfo> instructionsOf(const protocols::Phase& phase)
{
    std::vector<reports::InstructionInfo> instructions;
    for (const auto& instruction : phase.instructions)
        instructions.push_back({instruction.id.value, instruction.text, instruction.deadlineSeconds});
    return instructions;
}

/// Answers of one participant, without those to catch trials and anchors.
std::size_t answersOf(const protocols::Protocol& protocol)
{
    return static_cast<std::size_t>(protocol.presentationsPerPhase() * protocol.answersPerRendering());
}

void describeProtocol(const protocols::Protocol& protocol, reports::StudyData& data)
{
    for (const auto& phase : protocol.phases)
        data.answersPerCell = std::max(data.answersPerCell, static_cast<std::size_t>(phase.runs()));
    for (const auto& phase : protocol.phases)
        for (const auto& question : phase.questions)
            data.questions.push_back(
                {question.id.value, question.text, question.kind, instructionsOf(phase), static_cast<std::size_t>(phase.runs()),
                 static_cast<std::size_t>((protocol.presentationsPerPhase() + phase.extraPresentations()) * phase.runs())});
}

/// Voided presentations of these participants, answered or not.
std::size_t voidedOf(const std::set<std::string>& participants, const database::StudyStore& store)
{
    std::size_t voided = 0;
    for (const auto& [participant, presentations] : store.voidedPresentations())
        if (participants.contains(participant.value)) voided += static_cast<std::size_t>(presentations);
    return voided;
}

void describeParticipants(const database::StudyStore& store, reports::StudyData& data)
{
    const auto erased = erasedParticipants(store);
    for (const auto& enrolment : store.enrolments()) {
        const bool hasWithdrawn = enrolment.state == database::SlotState::Withdrawn;
        auto& those = !hasWithdrawn ? data.participants : erased.contains(enrolment.participant) ? data.erased : data.withdrawn;
        those.push_back(enrolment.participant.value);
        data.simulated = data.simulated || enrolment.kind == database::ParticipantKind::Simulated;
        data.scripted = data.scripted || enrolment.kind == database::ParticipantKind::Scripted;
    }
    data.voided = voidedOf({data.participants.begin(), data.participants.end()}, store);
    data.participantsSentence = participantsSentence(store);
}

/// Whether every trial of the list has an answer to each question, in a presentation that is not void.
bool hasEveryAnswer(const std::vector<protocols::BlindedTrial>& trials, const protocols::Protocol& protocol,
                    const std::set<std::pair<protocols::TrialNumber, protocols::QuestionId>>& answered)
{
    return std::ranges::all_of(trials, [&](const protocols::BlindedTrial& trial) {
        const auto phase = static_cast<std::size_t>(trial.phase);
        return phase < protocol.phases.size() && std::ranges::all_of(protocol.phases[phase].questions, [&](const auto& question) {
                   return answered.contains({trial.number, question.id});
               });
    });
}

/// Participants whose answers may have been in means that were given out, and who are in none any more: who withdrew, and who was
/// erased with every answer.
std::size_t withdrawnAfterTheEnd(const database::StudyStore& store)
{
    std::set<protocols::ParticipantId> ended;
    for (const auto& event : store.eventsOfKind("debriefed")) ended.insert(event.participant);
    const auto enrolments = store.enrolments();
    return static_cast<std::size_t>(std::ranges::count_if(enrolments, [&](const database::Enrolment& enrolment) {
        return enrolment.state == database::SlotState::Withdrawn && ended.contains(enrolment.participant);
    }));
}

/// Finds the participants who ended their session with every answer, and the running orders that have none. Who withdrew after
/// the end leaves a place open for good, so that no two sets of means differ by one person.
void describeFinished(const database::StudyStore& store, const protocols::Protocol& protocol,
                      const std::vector<database::CurrentAnswer>& answers, reports::StudyData& data)
{
    std::map<protocols::ParticipantId, std::set<std::pair<protocols::TrialNumber, protocols::QuestionId>>> answered;
    for (const auto& answer : answers)
        if (!answer.voided) answered[answer.participant].emplace(answer.record.trial, answer.record.question);
    for (const auto& enrolment : store.enrolments())
        if (enrolment.state == database::SlotState::Finished &&
            hasEveryAnswer(store.trials(enrolment.slot), protocol, answered[enrolment.participant]))
            data.finished.insert(enrolment.participant.value);
    data.openPlaces = store.slots().size() - data.finished.size() + withdrawnAfterTheEnd(store);
}

/// A rating, a choice if answers of this kind are right or wrong, otherwise words.
reports::AnswerContent contentOf(const database::AnswerRecord& record, const protocols::FabricId& truth,
                                 const protocols::AnswerKind& kind)
{
    if (record.rating) return reports::RatedAnswer{record.rating->inScaleUnits()};
    const std::string text = record.answer.value_or("");
    if (const auto correct = isRight(kind, record.alternatives, truth, text))
        return reports::ChosenAnswer{*correct, text, placeAmongAlternatives(kind, record.alternatives, text)};
    return reports::WordedAnswer{text};
}

reports::StudyResponse responseOf(const database::CurrentAnswer& answer, const Naming::Entry& entry,
                                  const protocols::AnswerKind& kind, int place, reports::TimesTaken times)
{
    return {.participant = answer.participant.value,
            .fabric = entry.fabric.value,
            .condition = entry.condition,
            .question = answer.record.question.value,
            .content = contentOf(answer.record, entry.fabric, kind),
            .seconds = times == reports::TimesTaken::ToBeginning ? answer.responseSeconds : answer.seconds,
            .entries = answer.record.entries,
            .touchedBy = answer.record.touchedBy,
            // A cell holds one answer under each instruction.
            .repetition = entry.instruction.value,
            .trial = place,
            .sitting = answer.sitting,
            .instruction = entry.instruction.value,
            .late = isLate(entry, answer)};
}

/// The rule of its export, too: only answers that are analysed decide.
reports::TimesTaken timesOf(const std::vector<database::CurrentAnswer>& answers, const protocols::Protocol& protocol,
                            const std::set<std::string>& analysed)
{
    using Content = reports::SittingStamps::Content;
    reports::SittingStamps stamps;
    for (const auto& answer : answers) {
        if (answer.voided || !analysed.contains(answer.participant.value)) continue;
        const auto* question = questionWith(protocol, answer.record.question);
        const bool isInWords =
            question == nullptr || std::holds_alternative<reports::OpenWords>(reports::scoringOf(question->kind));
        stamps.add(answer.participant.value, std::to_string(answer.sitting), isInWords ? Content::Words : Content::Number,
                   answer.record.answerBegunAtNs.has_value());
    }
    return stamps.times();
}

/// Where the answers to such a presentation are kept.
std::vector<reports::StudyResponse>& responsesTo(const Naming::Entry& shown, reports::StudyData& data)
{
    switch (shown.anchor) {
        case protocols::AnchorKind::Mismatched:
            return data.mismatchedResponses;
        case protocols::AnchorKind::Repeated:
            return data.repeatedResponses;
        case protocols::AnchorKind::None:
            break;
    }
    return shown.condition == protocols::catchTrialId().value ? data.catchResponses : data.responses;
}

/// The trays of choices that came a second time. Some phases have other foils then; those of older studies, and trays with all
/// fabrics, hold the same pieces.
class RepeatedTrays {
public:
    void add(const database::CurrentAnswer& answer, const Naming::Entry& shown)
    {
        const bool isSecond = shown.anchor == protocols::AnchorKind::Repeated;
        const bool isListed = shown.anchor == protocols::AnchorKind::None && shown.condition != protocols::catchTrialId().value;
        if (answer.record.alternatives.size() < 2 || (!isSecond && !isListed)) return;
        auto pieces = answer.record.alternatives;
        std::ranges::sort(pieces);
        m_trays[{answer.participant, answer.record.question, shown.fabric, shown.condition, shown.instruction}].insert(pieces);
    }
    std::set<std::string> questionsAnew() const
    {
        std::set<std::string> questions;
        for (const auto& [presentation, trays] : m_trays)
            if (trays.size() > 1) questions.insert(std::get<protocols::QuestionId>(presentation).value);
        return questions;
    }

private:
    using Presentation =
        std::tuple<protocols::ParticipantId, protocols::QuestionId, protocols::FabricId, std::string, protocols::InstructionId>;
    std::map<Presentation, std::set<std::vector<protocols::FabricId>>> m_trays;
};

/// Sorts the current answers into analysed answers, and answers to blank glass and to anchors.
void readAnswers(const std::vector<database::CurrentAnswer>& answers, const protocols::Protocol& protocol, const Naming& naming,
                 reports::StudyData& data)
{
    const std::set<std::string> analysed(data.participants.begin(), data.participants.end());
    data.times = timesOf(answers, protocol, analysed);
    PlacesInTime inTime;
    for (const auto& answer : answers) inTime.add(answer);
    const Places places = inTime.places();
    RepeatedTrays trays;
    for (const auto& answer : answers) {
        if (!analysed.contains(answer.participant.value)) continue;
        const auto named = naming.entries.find({answer.participant, answer.record.trial});
        if (named == naming.entries.end()) continue;  // in an altered study, a trial of no list
        const auto& entry = named->second;
        const auto* question = questionWith(protocol, answer.record.question);
        if (!answer.voided && question != nullptr)
            responsesTo(entry, data)
                .push_back(responseOf(answer, entry, question->kind, places.at(presentationOf(answer)), data.times));
        if (hasAnchors(protocol)) trays.add(answer, entry);
    }
    data.choicesRepeatedAnew = trays.questionsAnew();
}

/// Adds what was measured later in the same presentation: means over the time in contact.
void addMotion(reports::TouchedPresentation& touch, const reports::FingerMotion& more)
{
    const auto joined = [&](std::optional<double>& mean, const std::optional<double>& other) {
        if (mean && other)
            mean = (*mean * touch.contactSeconds + *other * more.contactSeconds) / (touch.contactSeconds + more.contactSeconds);
        else if (other)
            mean = other;
    };
    joined(touch.speedMmPerS, more.speedMmPerS);
    joined(touch.forceN, more.forceN);
    touch.contactSeconds += more.contactSeconds;
}

/// The samples of each analysed presentation, as speed and force. Damaged ones are told in a stamp.
void readTouches(const database::StudyStore& store, const Naming& naming, reports::StudyData& data)
{
    const std::set<std::string> analysed(data.participants.begin(), data.participants.end());
    std::size_t unreadable = 0;
    std::optional<std::tuple<protocols::ParticipantId, protocols::TrialNumber, int>> before;
    eachFingerRecord(store, {}, [&](const database::FingerRecord& record) {
        const auto named = naming.entries.find({record.participant, record.trial});
        const bool counts = !record.voided && analysed.contains(record.participant.value) && named != naming.entries.end() &&
                            named->second.condition != protocols::catchTrialId().value &&
                            named->second.anchor == protocols::AnchorKind::None;
        if (!counts) return;
        if (record.unreadable > 0) {
            ++unreadable;
            return;
        }
        const reports::FingerMotion motion = reports::motionOf(record.samples);
        const std::tuple presentation(record.participant, record.trial, record.attempt);
        const bool goesOn = before == presentation;  // in another sitting, by another clock
        before = presentation;
        if (goesOn) {
            addMotion(data.touches.back(), motion);
            return;
        }
        data.touches.push_back(
            {record.participant.value, named->second.condition, motion.contactSeconds, motion.speedMmPerS, motion.forceN});
    });
    if (unreadable > 0)
        data.stamps.push_back("The stored samples of the finger are damaged in " + reports::counted(unreadable, "presentation") +
                              ": their speed and force are missing here, and vis2hap verify names them.");
}

void readOperatorTaps(const database::StudyStore& store, reports::StudyData& data)
{
    for (const auto& run : operatorLatenciesOf(store))
        data.operatorTaps.push_back({run.operatorName, run.wallTime, run.signal, run.taps, run.misses, run.anticipations,
                                     run.medianMs, run.q1Ms, run.q3Ms});
}

/// The compared signals, the prices of the renderings, and the warnings about images as sentences of the page.
void readSignals(const std::string& text, reports::StudyData& data)
{
    auto json = protocols::storedOrderedJson(text);
    if (json.is_object() && json.contains(pricesField)) data.prices = reports::pricesFromJson(json[pricesField]);
    if (!json.is_object() || !json.contains(imageWarningsField)) {
        data.signals = reports::signalsFromJson(text);
        return;
    }
    for (const auto& line : json[imageWarningsField])
        if (line.is_string()) data.stamps.push_back("Before the study: " + line.get<std::string>() + ".");
    json.erase(imageWarningsField);
    data.signals = reports::signalsFromJson(json.dump());
}

/// Everything but the answers and their names.
reports::StudyData describedStudy(const database::StudyStore& store, const database::StudyFacts& facts,
                                  const protocols::Protocol& protocol)
{
    reports::StudyData data;
    data.name = facts.name;
    data.protocolSha256 = facts.protocolSha256;
    data.stamps = stampsOf(store, facts);
    data.stamps.push_back(displayResponseSentence(facts));
    describeProtocol(protocol, data);
    data.blinded = !store.unblinding().has_value();  // decides whether the plan may name conditions
    describePlan(store, data);
    describeParticipants(store, data);
    // Only the key tells answers to catch trials and anchors from the others.
    const auto answers = data.blinded ? static_cast<std::size_t>(protocol.answersPerParticipant()) : answersOf(protocol);
    const auto slots = store.slots();
    data.expectedResponses = slots.size() * answers;
    for (const auto& slot : slots) data.expectedOfEmptyPlaces += slot.state == database::SlotState::Free ? answers : 0;
    return data;
}

}  // namespace

database::StudyStore openStudy(const std::filesystem::path& study) { return database::readStudy({study}); }

protocols::Protocol protocolOf(const database::StudyFacts& facts)
{
    return protocols::keptProtocolFromJson(facts.protocolJson, "the study's protocol", facts.programVersion);
}

protocols::Protocol latestProtocolOf(const database::StudyStore& store)
{
    return protocols::keptProtocolFromJson(store.protocolVersions().back().json, "the study's protocol",
                                           store.facts().programVersion);
}

std::set<protocols::ParticipantId> erasedParticipants(const database::StudyStore& store)
{
    std::set<protocols::ParticipantId> erased;
    for (const auto& erasure : store.erasures())
        if (erasure.answersToo) erased.insert(erasure.participant);
    return erased;
}

std::string afterUnblindingSentence(const database::StudyStore& store)
{
    const auto unblinding = store.firstEventOfKind("unblinded");
    if (!unblinding) return {};
    constexpr std::pair<const char*, const char*> kinds[] = {{"answered", "answer"},
                                                             {"corrected", "correction"},
                                                             {"voided", "void"},
                                                             {"withdrawn", "withdrawal"},
                                                             {"erased", "erasure"}};
    std::vector<std::string> counts;
    for (const auto& [kind, word] : kinds)
        if (const auto number = store.eventsAfter(*unblinding, kind); number > 0)
            counts.push_back(reports::counted(number, word));
    if (counts.empty()) return {};
    return "After the unblinding came " + reports::listed(counts) + ": who knew the conditions could steer them.";
}

std::vector<std::string> stampsOf(const database::StudyStore& store, const database::StudyFacts& facts, ProgramFiles files)
{
    std::set<protocols::ParticipantId> seen, people;
    std::size_t withoutDisplay = 0;
    for (const auto& enrolment : store.enrolments())
        if (enrolment.kind == database::ParticipantKind::Human) people.insert(enrolment.participant);
    for (const auto& sitting : store.eventsOfKind("sitting_started")) {
        const auto payload = protocols::storedJson(sitting.payloadJson);
        if (payload.is_object() && payload.contains("plain_images")) seen.insert(sitting.participant);
        if (payload.is_object() && payload.contains("display") && payload["display"] == "none" &&
            people.contains(sitting.participant))
            ++withoutDisplay;
    }
    std::vector<std::string> stamps = facts.stamps;
    for (std::string& sentence : followedSentences(store)) stamps.push_back(std::move(sentence));
    if (auto sentence = afterUnblindingSentence(store); !sentence.empty()) stamps.push_back(std::move(sentence));
    if (!seen.empty())
        stamps.push_back("The display left its images as plain files in sessions of " +
                         reports::counted(seen.size(), "participant") +
                         " (--plain-images): an operator could have seen what was rendered.");
    if (withoutDisplay > 0)
        stamps.push_back(reports::counted(withoutDisplay, "sitting") +
                         " ran without a display: participants of these sittings felt no image on the glass.");
    if (files == ProgramFiles::Named)
        for (std::string& sentence : programSentences(store, facts)) stamps.push_back(std::move(sentence));
    if (auto sentence = otherDisplaySentence(store, facts, files == ProgramFiles::Named); !sentence.empty())
        stamps.push_back(std::move(sentence));
    return stamps;
}

std::optional<bool> isLate(const Naming::Entry& entry, const database::CurrentAnswer& answer)
{
    if (!entry.deadlineMs || !answer.responseSeconds) return std::nullopt;
    return *answer.responseSeconds * 1000 > *entry.deadlineMs;
}

std::optional<Naming> namingOf(const database::StudyStore& store, const protocols::Protocol& protocol,
                               const database::Passphrase& passphrase)
{
    const auto permission = recordedUnblinding(store);
    const auto key = permission ? std::optional(readAllocationKey(store, *permission)) : readKeyForAggregates(store, passphrase);
    if (!key) return std::nullopt;
    Naming naming;
    naming.blinded = !permission;
    const auto fabrics = store.facts().fabrics;
    const std::string lists = store.folder().database().string() + ", list of ";
    for (const auto& enrolment : store.enrolments()) {
        const auto list = store.trials(enrolment.slot);
        requireSoundList(list, protocol, fabrics, lists + enrolment.participant.value);
        protocols::AnchorFinder anchors(protocol);
        for (const auto& trial : list) {
            const auto& entry = key->entryOf(trial);
            const auto anchor = anchors.next(trial, entry);
            const bool isMasked = !permission && anchor == protocols::AnchorKind::Mismatched;
            const std::string condition = permission ? entry.condition.value : isMasked ? "" : entry.label.value;
            naming.entries[{enrolment.participant, trial.number}] = {entry.fabric, condition, trial.instruction, trial.deadlineMs,
                                                                     anchor};
        }
    }
    for (std::size_t k = 0; k < protocol.conditions.size(); ++k)
        naming.conditions.push_back(permission ? protocol.conditions[k].value : "K" + std::to_string(k + 1));
    return naming;
}

std::optional<reports::StudyData> studyData(const database::StudyStore& store, const database::Passphrase& passphrase)
{
    return studyData(store, passphrase, store.answers());
}

std::optional<reports::StudyData> studyData(const database::StudyStore& store, const database::Passphrase& passphrase,
                                            const std::vector<database::CurrentAnswer>& answers)
{
    const auto facts = store.facts();
    const auto protocol = protocolOf(facts);
    const auto naming = namingOf(store, protocol, passphrase);
    if (!naming) return std::nullopt;
    auto data = describedStudy(store, facts, protocol);
    data.conditions = naming->conditions;
    describeWordings(store, answers, data);
    describeFinished(store, protocol, answers, data);
    if (!data.blinded) readSignals(facts.signalsJson, data);
    for (const auto& fabric : facts.fabrics) data.fabrics.push_back(fabric.value);
    readAnswers(answers, protocol, *naming, data);
    readTouches(store, *naming, data);
    readOperatorTaps(store, data);
    return data;
}

reports::StudyData sealedStudyData(const database::StudyStore& store) { return sealedStudyData(store, store.answers()); }

reports::StudyData sealedStudyData(const database::StudyStore& store, const std::vector<database::CurrentAnswer>& answers)
{
    const protocols::FabricId sealed("sealed");
    const auto facts = store.facts();
    const auto protocol = protocolOf(facts);
    auto data = describedStudy(store, facts, protocol);
    data.blinded = true;
    describeWordings(store, answers, data);
    data.conditions = data.fabrics = {sealed.value};
    for (auto& question : data.questions) question.answersPerCell = question.presentations;
    Naming naming;
    for (const auto& enrolment : store.enrolments())
        for (const auto& trial : store.trials(enrolment.slot))
            naming.entries[{enrolment.participant, trial.number}] = {sealed, sealed.value, trial.instruction, trial.deadlineMs};
    readAnswers(answers, protocol, naming, data);
    // All presentations lie in one cell here, so that each is a repetition of its own.
    for (auto& response : data.responses) response.repetition = std::to_string(response.trial.value_or(0));
    data.choicesRepeatedAnew.clear();  // the trays of one cell differ anyway
    return data;
}

}  // namespace study::records
