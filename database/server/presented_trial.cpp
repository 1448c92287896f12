#include "database/server/presented_trial.h"

#include "database/sqlite_connection.h"

namespace database {

ServerReply presentedTrial(ServerLink& link, protocols::TrialNumber number, bool givesTickets, std::chrono::milliseconds patience)
{
    ServerReply reply = link.callForImage("presentation", {number.value}, patience);
    if (givesTickets) return reply;
    // A statement of its own: the release has been committed, and cannot be taken back.
    ServerReply shown = link.callForImage("presented_image", {toQt(reply.image)}, patience);
    return {std::move(reply.json), std::move(shown.image), std::move(shown.key)};
}

}  // namespace database
