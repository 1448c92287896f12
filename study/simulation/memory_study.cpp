#include "study/simulation/memory_study.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "protocols/condition.h"
#include "protocols/protocol_json.h"
#include "protocols/random.h"
#include "protocols/records/anchor_trials.h"
#include "protocols/records/trial_lists.h"

namespace study::simulation {

namespace {

using protocols::BlindedTrial;
using protocols::FileCode;
using protocols::SealedCode;

/// Exchanges names of one kind, each for another or itself.
template <class Name>
using Exchange = std::map<Name, Name>;

template <class Name>
Exchange<Name> drawExchange(const std::vector<Name>& names, protocols::Random& random)
{
    std::vector<Name> drawn = names;
    random.shuffle(drawn);
    Exchange<Name> exchange;
    for (std::size_t i = 0; i < names.size(); ++i) exchange[names[i]] = drawn[i];
    return exchange;
}

/// One exchange of conditions, fabrics and slots for a whole set of orders, so that what was balanced stays balanced.
class ExchangedSet {
public:
    ExchangedSet(const MemoryStudy& study, std::size_t set, std::uint64_t seed)
        : m_study(study), m_random(protocols::Random::stream(seed, "orders of set " + std::to_string(set)))
    {
        m_conditions = drawExchange(study.protocol.conditions, m_random);
        m_conditions[protocols::catchTrialId()] = protocols::catchTrialId();
        m_fabrics = drawExchange(study.fabrics, m_random);
        for (const auto& [code, entry] : study.images) m_codes[{entry.condition, entry.fabric}] = code;
    }

    BlindedTrial of(BlindedTrial trial)
    {
        const auto& shown = m_study.images.at(FileCode(trial.sealedCode.value));
        // The protocol says the condition of mismatched images; without anchors before it, a trial can be no repetition.
        const bool isMismatched =
            protocols::AnchorFinder(m_study.protocol).next(trial, shown) == protocols::AnchorKind::Mismatched;
        const auto& condition = isMismatched ? shown.condition : m_conditions.at(shown.condition);
        trial.sealedCode = SealedCode(m_codes.at({condition, m_fabrics.at(shown.fabric)}).value);
        std::vector<protocols::FabricId> tray(trial.alternatives.size());
        const auto& slots = slotsFor(tray.size());
        for (std::size_t slot = 0; slot < tray.size(); ++slot) tray[slots[slot]] = m_fabrics.at(trial.alternatives[slot]);
        trial.alternatives = std::move(tray);
        return trial;
    }

private:
    const std::vector<std::size_t>& slotsFor(std::size_t size)
    {
        const auto [known, isNew] = m_slots.try_emplace(size);
        if (isNew) {
            known->second.resize(size);
            std::iota(known->second.begin(), known->second.end(), std::size_t{0});
            // A stream of its own: the order in which sizes of trays come must change nothing.
            auto random = m_random;
            for (std::size_t skipped = 0; skipped < size; ++skipped) random.next();
            random.shuffle(known->second);
        }
        return known->second;
    }

    const MemoryStudy& m_study;
    protocols::Random m_random;
    Exchange<protocols::ConditionId> m_conditions;
    Exchange<protocols::FabricId> m_fabrics;
    std::map<std::pair<protocols::ConditionId, protocols::FabricId>, FileCode> m_codes;
    std::map<std::size_t, std::vector<std::size_t>> m_slots;  ///< [size of the tray][slot]
};

std::vector<BlindedTrial> openedList(std::vector<BlindedTrial> list, const protocols::SecretKey& stationKey)
{
    for (BlindedTrial& trial : list) trial.sealedCode = SealedCode(opened(trial.sealedCode, stationKey).value);
    return list;
}

/// What both kinds of study have in common.
MemoryStudy studyOf(const protocols::AllocationKey& key, players::Percepts percepts)
{
    MemoryStudy study;
    study.images = key.entries;
    study.percepts = std::move(percepts);
    study.percepts.codesAreOpen = true;
    return study;
}

}  // namespace

MemoryStudy memoryStudyOf(const database::StudyStore& store, const protocols::AllocationKey& key, players::Percepts percepts)
{
    const auto& facts = store.facts();
    const auto versions = store.protocolVersions();
    MemoryStudy study = studyOf(key, std::move(percepts));
    study.name = facts.name;
    study.protocolSha256 = versions.back().sha256;
    study.protocol =
        protocols::keptProtocolFromJson(versions.back().json, store.folder().protocol().string(), facts.programVersion);
    study.fabrics = facts.fabrics;
    study.fabricNames = facts.fabricNames;
    study.swatches = facts.swatches;
    const auto station = stationKeyOf(key.secret);
    const std::string lists = store.folder().database().string() + ", list of slot ";
    for (const auto& slot : store.slots()) {
        auto list = store.trials(slot.number);
        requireSoundList(list, study.protocol, study.fabrics, lists + std::to_string(slot.number));
        study.places.push_back(openedList(std::move(list), station));
    }
    return study;
}

MemoryStudy memoryStudyOf(const protocols::Protocol& protocol, const protocols::Allocation& allocation,
                          const std::vector<protocols::FabricId>& fabrics, players::Percepts percepts)
{
    MemoryStudy study = studyOf(allocation.key, std::move(percepts));
    study.name = protocol.name;
    study.protocol = protocol;
    study.fabrics = fabrics;
    for (const auto& fabric : fabrics) study.fabricNames[fabric] = fabric.value;
    study.swatches = allocation.swatches;
    const auto station = stationKeyOf(allocation.key.secret);
    for (const auto& list : allocation.participants) study.places.push_back(openedList(list, station));
    return study;
}

std::vector<BlindedTrial> listOf(const MemoryStudy& study, std::size_t place, std::uint64_t seed)
{
    const std::size_t set = place / study.places.size();
    std::vector<BlindedTrial> list = study.places[place % study.places.size()];
    if (set == 0) return list;
    ExchangedSet exchanged(study, set, seed);
    for (BlindedTrial& trial : list) trial = exchanged.of(std::move(trial));
    return list;
}

session::Plan planWithoutList(const MemoryStudy& study) { return {study.protocol, {}, study.fabricNames, {}}; }

session::PieceNames pieceNamesOf(const MemoryStudy& study, std::size_t place)
{
    if (study.swatches.empty()) return study.fabricNames;
    return study.swatches[place % study.swatches.size()];
}

}  // namespace study::simulation
