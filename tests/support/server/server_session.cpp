#include "tests/support/server/server_session.h"

#include <QUuid>

namespace tests::support {

namespace {

/// The least that the program could read again of an event of this kind.
const char* leastPayload(const std::string& kind)
{
    if (kind == "noted") return R"({"text":""})";
    if (kind == "voided" || kind == "withdrawn") return R"({"why":""})";
    return "{}";
}

}  // namespace

nlohmann::json sentEntry(const std::string& participant, int before, const std::string& kind, const nlohmann::json& state)
{
    return {{"id", QUuid::createUuid().toString(QUuid::WithoutBraces).toStdString()},
            {"after", before},
            {"event",
             {{"participant", participant},
              {"sitting", 1},
              {"kind", kind},
              {"payload", leastPayload(kind)},
              {"at_ns", 1},
              {"wall_time", "2026-01-01T00:00:00Z"}}},
            {"answers", nlohmann::json::array()},
            {"finger", nullptr},
            {"voids", nullptr},
            {"note", nullptr},
            {"state", state},
            {"facts", nlohmann::json::array()},
            {"stored_at", 2}};
}

ServerSession::ServerSession(const database::StudyFolder& folder, const std::string& participant, database::ParticipantKind kind,
                             bool isFetching, database::ServerPatience patience)
    : store(folder, patience), images(store)
{
    display.isFetching = isFetching;
    driver = std::make_unique<study::session::Driver>(store, protocols::ParticipantId(participant), kind, images, display, clock);
}

}  // namespace tests::support
