#include "database/server/server_progress.h"

#include <nlohmann/json.hpp>

#include "database/server/server_connection.h"
#include "database/stored_texts.h"

namespace database {

namespace {

using namespace std::chrono_literals;

constexpr auto progressPatience = 4000ms;

void countPlace(ServerProgress& progress, const PlaceSeen& place)
{
    progress.answers += place.answers;
    switch (place.state) {
        case SlotState::Free:
            ++progress.free;
            break;
        case SlotState::Started:
            ++progress.started;
            break;
        case SlotState::Finished:
            ++progress.finished;
            break;
        case SlotState::Withdrawn:
            ++progress.withdrawn;
            break;
    }
}

ServerProgress progressIn(const nlohmann::json& seen)
{
    ServerProgress progress;
    for (const auto& one : seen.at("places")) {
        PlaceSeen place{one.at("slot").get<int>(), stateNamed(one.at("state").get<std::string>()),
                        one.at("participant").get<std::string>(), ParticipantKind::Human, one.at("answers").get<int>()};
        if (place.state != SlotState::Free) place.kind = kindNamed(one.at("kind").get<std::string>());
        countPlace(progress, place);
        progress.places.push_back(place);
    }
    for (const auto& one : seen.at("stations"))
        progress.stations.push_back({one.at("station").get<std::string>(), one.at("login").get<std::string>(),
                                     one.at("participant").is_null() ? "" : one.at("participant").get<std::string>(),
                                     one.at("live").get<bool>(), one.at("queue_length").get<int>(),
                                     one.at("last_seen_seconds").get<int>(), one.value("program", std::string())});
    progress.head =
        textOf(LogHead{seen.at("head").at("sequence").get<std::int64_t>(), seen.at("head").at("hash").get<std::string>()});
    return progress;
}

/// A reply of another form comes from another version of this program.
ServerProgress progressFrom(const nlohmann::json& reply, const std::string& address)
{
    try {
        return progressIn(reply);
    } catch (const nlohmann::json::exception& fault) {
        throw protocols::workFailed({"the server's reply cannot be read: " + std::string(fault.what()), address, "",
                                     "use the version of this program that moved the study there"});
    }
}

}  // namespace

ServerProgress progressOf(const ServerAddress& address)
{
    ServerConnection server(address);
    server.chooseStudy();
    return progressFrom(server.call("progress", {}), address.text);
}

void ProgressWatch::ask()
{
    if (m_reply.valid()) return;
    if (!m_link) m_link = std::make_unique<ServerLink>(m_address);
    m_reply = m_link->start("progress", {});
    m_askedAt = std::chrono::steady_clock::now();
}

bool ProgressWatch::take()
{
    if (!m_reply.valid()) return false;
    const auto now = std::chrono::steady_clock::now();
    if (m_reply.wait_for(0ms) != std::future_status::ready) {
        if (now - m_askedAt < progressPatience) return false;
        lose(ServerAway({"the server does not answer", m_address.text, "", "check the network and the server"}).what(), true);
        return true;
    }
    try {
        m_seen = progressFrom(m_reply.get().json, m_address.text);
        m_seenAt = now;
        m_fault.clear();
        m_isAway = false;
    } catch (const ServerAway& fault) {
        lose(fault.what(), true);
    } catch (const std::exception& fault) {
        lose(fault.what(), false);
    }
    return true;
}

std::chrono::seconds ProgressWatch::age() const
{
    return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - m_seenAt);
}

void ProgressWatch::lose(const std::string& why, bool isAway)
{
    m_reply = {};
    m_link.reset();  // a connection that was lost does not come back
    m_fault = why;
    m_isAway = isAway;
}

}  // namespace database
