#include "study/commands/server/station_requests.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"

namespace study::commands {

namespace {

using Kind = StationRequest::Kind;

/// An integer that fits; nullopt for everything else.
std::optional<std::int64_t> integerAt(const nlohmann::ordered_json& message, const char* key)
{
    const auto value = message.find(key);
    if (value == message.end() || !value->is_number_integer()) return std::nullopt;
    if (value->is_number_unsigned() && value->get<std::uint64_t>() > std::uint64_t{std::numeric_limits<std::int64_t>::max()})
        return std::nullopt;
    return value->get<std::int64_t>();
}

}  // namespace

void StationRequests::add(std::string_view bytes)
{
    if (m_isEnded) return;
    m_bytes.append(bytes);
    dropImage();
}

std::optional<StationRequest> StationRequests::next()
{
    if (m_asked) {
        if (m_bytes.size() < m_ticketBytes) return std::nullopt;
        m_asked->ticket = m_bytes.substr(0, m_ticketBytes);
        m_bytes.erase(0, m_ticketBytes);
        return std::exchange(m_asked, std::nullopt);
    }
    const std::size_t end = m_bytes.find('\n', m_searched);
    m_searched = std::min(end, m_bytes.size());
    StationRequest request;
    if (m_searched > longestLine) {
        request.kind = Kind::TooLong;
    } else if (end == std::string::npos) {
        return std::nullopt;
    } else {
        std::string line = m_bytes.substr(0, end + 1);
        m_bytes.erase(0, end + 1);
        m_searched = 0;
        request = read(line);
    }
    m_isEnded = request.kind == Kind::NoTicket || request.kind == Kind::NoMessage || request.kind == Kind::TooLong;
    if (m_isEnded) {
        m_bytes.clear();
        m_searched = 0;
    }
    if (request.kind == Kind::Ticket) {
        m_asked = std::move(request);
        return next();
    }
    dropImage();
    return request;
}

StationRequest StationRequests::read(const std::string& line)
{
    nlohmann::ordered_json message;
    try {
        message = protocols::parseStrictOrderedJson(line, "a message");
    } catch (const protocols::Error&) {
        return {};
    }
    if (!message.is_object() || !message.contains("type")) return {};
    const auto& type = message.at("type");
    const auto id = integerAt(message, "id");
    if (type == "show") {
        const auto bytes = integerAt(message, "bytes");
        return readShow(id, bytes && *bytes >= 0 ? std::optional(static_cast<std::uint64_t>(*bytes)) : std::nullopt);
    }
    return {.kind = Kind::Passed, .id = id, .line = line, .isHello = type == "hello", .isClear = type == "clear", .ticket = {}};
}

StationRequest StationRequests::readShow(std::optional<std::int64_t> id, std::optional<std::uint64_t> bytes)
{
    StationRequest request;
    request.id = id;
    request.kind = Kind::NoTicket;
    if (!id || !bytes || *bytes > largestImage) return request;
    request.kind = *bytes > longestTicket ? Kind::Image : Kind::Ticket;
    (request.kind == Kind::Image ? m_imageLeft : m_ticketBytes) = *bytes;
    return request;
}

void StationRequests::dropImage()
{
    const std::size_t dropped = std::min<std::uint64_t>(m_imageLeft, m_bytes.size());
    m_bytes.erase(0, dropped);
    m_imageLeft -= dropped;
}

}  // namespace study::commands
