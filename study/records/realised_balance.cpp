#include "study/records/realised_balance.h"

#include <algorithm>
#include <map>
#include <set>

#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/orders/allocation.h"
#include "protocols/records/anchor_trials.h"
#include "protocols/records/trial_lists.h"

namespace study::records {

namespace {

using protocols::DesignTrial;

/// Numbers the names of a key from 0, in their order.
template <class Name>
std::map<Name, int> numbered(const std::set<Name>& names)
{
    std::map<Name, int> numbers;
    for (const Name& name : names) numbers.emplace(name, static_cast<int>(numbers.size()));
    return numbers;
}

struct Numbers {
    const protocols::AllocationKey& key;
    std::map<protocols::ConditionLabel, int> labels;
    std::map<protocols::FabricId, int> fabrics;
};

Numbers numbersOf(const protocols::AllocationKey& key)
{
    Numbers numbers{key, {}, {}};
    std::set<protocols::ConditionLabel> labels;
    std::set<protocols::FabricId> fabrics;
    for (const auto& [code, entry] : numbers.key.entries) {
        fabrics.insert(entry.fabric);
        if (entry.label.value != protocols::catchTrialId().value) labels.insert(entry.label);
    }
    numbers.labels = numbered(labels);
    numbers.fabrics = numbered(fabrics);
    return numbers;
}

DesignTrial designTrialOf(const protocols::BlindedTrial& trial, protocols::AnchorKind anchor, const Numbers& numbers,
                          const protocols::Protocol& protocol)
{
    const auto& entry = numbers.key.entryOf(trial);
    const auto label = numbers.labels.find(entry.label);
    DesignTrial design{trial.phase,
                       label == numbers.labels.end() ? protocols::catchTrialLabel : label->second,
                       numbers.fabrics.at(entry.fabric),
                       {}};
    for (const auto& fabric : trial.alternatives) {
        const auto known = numbers.fabrics.find(fabric);
        if (known == numbers.fabrics.end())
            throw protocols::workFailed(
                {"trial " + std::to_string(trial.number.value) + " has the unknown fabric " + fabric.value, "study.db",
                 "a fabric of the study", "run vis2hap verify on the study"});
        design.alternatives.push_back(known->second);
    }
    if (!trial.instruction.empty()) {
        const auto& instructions = requiredPhase(protocol, trial).instructions;
        const auto found = std::ranges::find(instructions, trial.instruction, &protocols::BlockInstruction::id);
        if (found != instructions.end()) design.instruction = static_cast<int>(found - instructions.begin());
    }
    design.anchor = anchor;
    return design;
}

/// Which presentations of a list are anchors, [place in the list].
std::vector<protocols::AnchorKind> anchorsIn(const std::vector<protocols::BlindedTrial>& list,
                                             const protocols::AllocationKey& key, const protocols::Protocol& protocol)
{
    if (!hasAnchors(protocol)) return std::vector<protocols::AnchorKind>(list.size(), protocols::AnchorKind::None);
    protocols::AnchorFinder finder(protocol);
    std::vector<protocols::AnchorKind> kinds;
    for (const auto& trial : list) kinds.push_back(finder.next(trial, key.entryOf(trial)));
    return kinds;
}

/// Trial numbers of each participant's valid answers, in the order of answering.
std::map<protocols::ParticipantId, std::vector<int>> presentedTrials(const std::vector<database::CurrentAnswer>& answers)
{
    std::map<protocols::ParticipantId, std::map<int, std::int64_t>> lastStored;
    std::map<protocols::ParticipantId, std::vector<std::pair<std::int64_t, int>>> order;
    for (const auto& answer : answers)
        if (!answer.voided) lastStored[answer.participant].emplace(answer.record.trial.value, answer.event);
    std::map<protocols::ParticipantId, std::vector<int>> trials;
    for (const auto& [participant, byTrial] : lastStored) {
        for (const auto& [trial, event] : byTrial) order[participant].emplace_back(event, trial);
        std::sort(order[participant].begin(), order[participant].end());
        for (const auto& [event, trial] : order[participant]) trials[participant].push_back(trial);
    }
    return trials;
}

}  // namespace

protocols::BalanceCertificate realisedBalance(const database::StudyStore& store,
                                              const std::vector<database::CurrentAnswer>& answers,
                                              const protocols::Protocol& protocol, const protocols::AllocationKey& key)
{
    const Numbers numbers = numbersOf(key);
    const auto presented = presentedTrials(answers);
    const auto fabrics = store.facts().fabrics;
    const std::string lists = store.folder().database().string() + ", list of ";
    protocols::Design design;
    for (const auto& enrolment : store.enrolments()) {
        const auto own = presented.find(enrolment.participant);
        if (enrolment.state == database::SlotState::Withdrawn || own == presented.end()) continue;
        const auto list = store.trials(enrolment.slot);
        requireSoundList(list, protocol, fabrics, lists + enrolment.participant.value);
        const auto anchors = anchorsIn(list, key, protocol);
        auto& trials = design.participants.emplace_back();
        for (const int number : own->second) {
            if (number < 1 || static_cast<std::size_t>(number) > list.size())
                throw protocols::workFailed({"an answer of " + enrolment.participant.value + " names trial " +
                                                 std::to_string(number) + ", which is not in the list",
                                             store.folder().database().string(), "1 to " + std::to_string(list.size()),
                                             "run vis2hap verify on the study"});
            const auto at = static_cast<std::size_t>(number) - 1;
            trials.push_back(designTrialOf(list[at], anchors[at], numbers, protocol));
        }
    }
    return design.participants.empty() ? protocols::BalanceCertificate{} : balanceOf(design, protocol);
}

}  // namespace study::records
