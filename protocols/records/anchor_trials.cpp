#include "protocols/records/anchor_trials.h"

#include <algorithm>

#include "protocols/condition.h"

namespace protocols {

AnchorKind AnchorFinder::next(const BlindedTrial& trial, const AllocationKey::Entry& shown)
{
    const Phase& phase = m_protocol.phases.at(static_cast<std::size_t>(trial.phase));
    if (phase.anchors.presentations() == 0 || shown.condition == catchTrialId()) return AnchorKind::None;
    const bool liesThere = std::ranges::find(trial.alternatives, shown.fabric) != trial.alternatives.end();
    if (phase.anchors.mismatched > 0 && !liesThere) return AnchorKind::Mismatched;
    const bool isFirst = m_seen.emplace(trial.phase, trial.instruction, shown.condition, shown.fabric).second;
    return phase.anchors.repeated > 0 && !isFirst ? AnchorKind::Repeated : AnchorKind::None;
}

}  // namespace protocols
