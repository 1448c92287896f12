// Which presentations of a stored list are anchors. Nothing in the list marks one, so that it shows in no file and on no page;
// it follows from what the key says of the images.
#pragma once

#include <set>
#include <tuple>

#include "protocols/orders/allocation.h"
#include "protocols/protocol.h"

namespace protocols {

/// Goes through one participant's list from its beginning. A presentation of a phase of ratings is mismatched if the tray does
/// not hold the fabric of its image. One that shows an image for the second time in its phase, under the same instruction, is
/// repeated. Phases without such anchors have none.
class AnchorFinder {
public:
    explicit AnchorFinder(const Protocol& protocol) : m_protocol(protocol) {}

    /// `shown`: what the key says of the presentation. Throws workFailed where the protocol has no such phase.
    AnchorKind next(const BlindedTrial& trial, const AllocationKey::Entry& shown);

private:
    const Protocol& m_protocol;
    std::set<std::tuple<int, InstructionId, ConditionId, FabricId>> m_seen;
};

}  // namespace protocols
