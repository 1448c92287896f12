// A presentation that is due, in two steps: the server puts the release on record and gives a ticket, then the image of the
// ticket.
#pragma once

#include <chrono>

#include "database/server/server_link.h"
#include "protocols/ids.h"

namespace database {

/// The trial as JSON, with its sealed image and key; with the ticket as the image and no key where `givesTickets`. Throws what
/// ServerLink throws. `patience`: of each step.
ServerReply presentedTrial(ServerLink& link, protocols::TrialNumber number, bool givesTickets,
                           std::chrono::milliseconds patience);

}  // namespace database
