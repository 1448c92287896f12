#include "protocols/records/anchor_trials.h"

#include <algorithm>

#include "protocols/condition.h"
#include "protocols/records/trial_lists.h"

namespace protocols {

AnchorKind AnchorFinder::next(const BlindedTrial& trial, const AllocationKey::Entry& shown)
{
    const Phase& phase = requiredPhase(m_protocol, trial);
    if (phase.anchors.presentations() == 0 || shown.condition == catchTrialId()) return AnchorKind::None;
    const bool liesThere = std::ranges::find(trial.alternatives, shown.fabric) != trial.alternatives.end();
    if (phase.anchors.mismatched > 0 && !liesThere) return AnchorKind::Mismatched;
    const bool isFirst = m_seen.emplace(trial.phase, trial.instruction, shown.condition, shown.fabric).second;
    return phase.anchors.repeated > 0 && !isFirst ? AnchorKind::Repeated : AnchorKind::None;
}

}  // namespace protocols
