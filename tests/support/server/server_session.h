// A session of a participant at a station of a study on a server.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "database/server/station_store.h"
#include "study/session/station_images.h"
#include "tests/support/played_session.h"

namespace tests::support {

/// Of tests without a silent network: a busy computer must not look like one.
inline constexpr database::ServerPatience unhurried{std::chrono::seconds(60), std::chrono::seconds(60)};

/// An entry as a station sends it, for the function store().
nlohmann::json sentEntry(const std::string& participant, int before, const std::string& kind,
                         const nlohmann::json& state = nullptr);

struct ServerSession : SessionHands {
    /// `folder`: of a station, or of the study's owner. `isFetching`: the display turns tickets into images.
    ServerSession(const database::StudyFolder& folder, const std::string& participant,
                  database::ParticipantKind kind = database::ParticipantKind::Human, bool isFetching = false,
                  database::ServerPatience patience = unhurried);
    ~ServerSession() { driver.reset(); }

    database::StationStore store;
    study::session::StationImages images;
};

}  // namespace tests::support
