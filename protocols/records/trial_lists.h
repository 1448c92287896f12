// Lists of presentations as a study or a server holds them. Somebody may have altered one, so each is compared with its protocol
// before it is used.
#pragma once

#include <string>
#include <vector>

#include "protocols/orders/allocation.h"
#include "protocols/protocol.h"

namespace protocols {

/// The phase of a presentation. Throws workFailed where the protocol has no such phase.
const Phase& requiredPhase(const Protocol& protocol, const BlindedTrial& trial);

/// Throws workFailed, naming `where`, for a presentation without a phase of the protocol, without a code, or, once its image is
/// given out, without a tray of these fabrics.
void requireSoundTrial(const BlindedTrial& trial, const Protocol& protocol, const std::vector<FabricId>& fabrics,
                       const std::string& where);

/// The same for the whole list of a participant, whose numbers run from 1.
void requireSoundList(const std::vector<BlindedTrial>& list, const Protocol& protocol, const std::vector<FabricId>& fabrics,
                      const std::string& where);

}  // namespace protocols
