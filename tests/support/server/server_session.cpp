#include "tests/support/server/server_session.h"

namespace tests::support {

ServerSession::ServerSession(const database::StudyFolder& folder, const std::string& participant, database::ParticipantKind kind,
                             bool isFetching, database::ServerPatience patience)
    : store(folder, patience), images(store)
{
    display.isFetching = isFetching;
    driver = std::make_unique<study::session::Driver>(store, protocols::ParticipantId(participant), kind, images, display, clock);
}

}  // namespace tests::support
