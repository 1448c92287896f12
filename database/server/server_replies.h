// What the functions of a server reply, as values. A reply may come from another version of this program or from a damaged
// server, so every field is checked before it counts.
#pragma once

#include <chrono>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "database/server/server_progress.h"
#include "database/session_store.h"

namespace database {

/// Code of an image for familiarisation at a position, under which a station asks for it.
protocols::SealedCode familiarisationCode(int position);
/// The position; nullopt for codes of presentations.
std::optional<int> familiarisationPosition(const protocols::SealedCode& code);

/// Reply of join_study().
struct StudyReply {
    StudyFacts facts;
    ProtocolVersion protocol;
    LogHead head;
    bool givesTickets = false;  ///< its images go to the display's login
};

/// Reply of claim(): the participant's place and log.
struct ClaimReply {
    int slot = 0;
    SlotState state = SlotState::Free;
    int protocolVersion = 1;
    std::string olderProtocol;  ///< of this version, where it is not the study's present one; else empty
    protocols::SwatchLabels swatches;
    std::vector<protocols::BlindedTrial> trials;  ///< numbered from 1 without a gap
    std::vector<EventRecord> events;
    LogHead head;
};

/// The functions below throw workFailed that names `where` for a reply of another form.
nlohmann::json replyFrom(std::string_view text, const std::string& where);
StudyReply studyReplyFrom(const nlohmann::json& reply, const std::string& where);
ClaimReply claimReplyFrom(const nlohmann::json& reply, const std::string& where, const std::string& participant);
/// Reply of presentation(); also refuses another trial than the one that was asked for.
protocols::BlindedTrial trialFrom(const nlohmann::json& reply, const std::string& where, protocols::TrialNumber asked);
LogHead headFrom(const nlohmann::json& reply, const std::string& where);
/// Number of an entry in the log, in the reply of store().
std::int64_t entryNumberFrom(const nlohmann::json& reply, const std::string& where);
/// Reply of progress().
ServerProgress progressFrom(const nlohmann::json& reply, const std::string& where);
/// Reply of overview() or progress().
std::vector<PlaceSeen> placesFrom(const nlohmann::json& reply, const std::string& where);

/// Clock of this computer minus that of the server, from a sign of life that was asked for and answered at these times of this
/// computer; 0 where the server's time lies between them, or is not given.
std::chrono::seconds clockAheadOf(const nlohmann::json& sign, std::chrono::system_clock::time_point asked,
                                  std::chrono::system_clock::time_point answered);

}  // namespace database
