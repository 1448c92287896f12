#include "database/server/server_progress.h"

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "database/server/server_connection.h"
#include "database/server/server_replies.h"

namespace database {

namespace {

using namespace std::chrono_literals;

constexpr auto progressPatience = 4000ms;

}  // namespace

std::set<int> heldPlaces(const ServerProgress& progress)
{
    std::map<int, SlotState> last;  // a free place comes last
    for (const PlaceSeen& place : progress.places) last[place.slot] = place.state;
    std::set<int> held;
    for (const auto& [place, state] : last)
        if (state == SlotState::Withdrawn) held.insert(place);
    return held;
}

ServerProgress progressOf(const ServerAddress& address)
{
    ServerConnection server(address);
    server.chooseStudy();
    return progressFrom(server.call("progress", {}), address.text);
}

void ProgressWatch::ask()
{
    if (m_reply.valid()) return;
    try {
        if (!m_link) m_link = std::make_unique<ServerLink>(m_address);
    } catch (const ServerAway& fault) {
        lose(fault.what(), false);  // this computer is in need, not the server
        m_isUntold = true;
        return;
    }
    m_reply = m_link->start("progress", {});
    m_askedAt = std::chrono::steady_clock::now();
}

bool ProgressWatch::take()
{
    if (std::exchange(m_isUntold, false)) return true;
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
