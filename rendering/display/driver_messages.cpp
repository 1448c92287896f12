#include "rendering/display/driver_messages.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace rendering {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct KindRow {
    MessageKind kind;
    const char* name;
};
constexpr KindRow kinds[] = {{MessageKind::Hello, "hello"},     {MessageKind::Shown, "shown"},
                             {MessageKind::Cleared, "cleared"}, {MessageKind::Status, "status"},
                             {MessageKind::Touched, "touched"}, {MessageKind::Released, "released"},
                             {MessageKind::Finger, "finger"},   {MessageKind::Failed, "failed"}};

std::optional<MessageKind> kindNamed(const json& name)
{
    for (const KindRow& row : kinds)
        if (name == row.name) return row.kind;
    return std::nullopt;
}

/// Reads a field into `target`. A missing or null field leaves it; a field of the wrong type makes the message invalid.
template <class Value>
bool take(const json& message, const char* field, bool (json::*isRight)() const noexcept, Value& target)
{
    const auto found = message.find(field);
    if (found == message.end() || found->is_null()) return true;
    if (!((*found).*isRight)()) return false;
    target = found->template get<std::decay_t<decltype(target)>>();
    return true;
}

/// Reads a whole number. Drivers in languages without integers write 7.0.
bool takeCount(const json& message, const char* field, std::optional<std::int64_t>& target)
{
    constexpr double most = 9e15;
    double value = -1;
    if (!take(message, field, &json::is_number, value)) return false;
    const bool isThere = message.contains(field) && !message.at(field).is_null();
    if (!isThere) return true;
    if (!(value >= 0 && value <= most) || value != std::floor(value)) return false;
    target = static_cast<std::int64_t>(value);
    return true;
}

/// Reads a measured value. One beyond `most` in size comes from no sensor and makes the message invalid.
bool takeMeasured(const json& message, const char* field, double most, std::optional<double>& target)
{
    const auto found = message.find(field);
    if (found == message.end() || found->is_null()) return true;
    double value = 0;
    if (!take(message, field, &json::is_number, value) || !(std::abs(value) <= most)) return false;
    target = value;
    return true;
}

bool takeFinger(const json& message, DriverMessage& result)
{
    constexpr double mostMm = 1e4, mostN = 1e3;
    return takeMeasured(message, "x_mm", mostMm, result.xMm) && takeMeasured(message, "y_mm", mostMm, result.yMm) &&
           takeMeasured(message, "force_n", mostN, result.forceN);
}

bool takeFields(const json& message, DriverMessage& result)
{
    std::optional<std::int64_t> id, width, height;
    double deviceS = std::nan("");
    const bool isWhole =
        takeCount(message, "id", id) && takeCount(message, "width", width) && takeCount(message, "height", height) &&
        takeCount(message, "showing", result.showing) && take(message, "at_s", &json::is_number, deviceS) &&
        take(message, "schema", &json::is_string, result.schema) && take(message, "name", &json::is_string, result.name) &&
        take(message, "why", &json::is_string, result.why) && take(message, "touches", &json::is_boolean, result.touches) &&
        take(message, "fetches", &json::is_boolean, result.fetches);
    if (!isWhole || !id) return false;
    result.id = *id;
    constexpr std::int64_t widest = 1 << 14;
    result.widthPx = static_cast<int>(std::min(width.value_or(0), widest));
    result.heightPx = static_cast<int>(std::min(height.value_or(0), widest));
    constexpr double latest = 4e9;  // Larger than any clock in seconds, while differences still fit into nanoseconds.
    if (std::abs(deviceS) <= latest) result.deviceS = deviceS;
    return true;
}

std::string lineOf(const ordered_json& request) { return request.dump() + "\n"; }

}  // namespace

const char* nameOf(MessageKind kind)
{
    for (const KindRow& row : kinds)
        if (row.kind == kind) return row.name;
    return "";
}

bool isReply(MessageKind kind)
{
    return kind != MessageKind::Touched && kind != MessageKind::Released && kind != MessageKind::Finger;
}

std::optional<DriverMessage> driverMessageFrom(std::string_view line)
{
    // Not in the order of the text: that reader compares each key with all before it, and a driver may send thousands.
    const json message = json::parse(line, nullptr, false);
    if (!message.is_object() || !message.contains("type")) return std::nullopt;
    const auto kind = kindNamed(message.at("type"));
    DriverMessage result;
    if (!kind || !takeFields(message, result)) return std::nullopt;
    if (*kind == MessageKind::Finger && !takeFinger(message, result)) return std::nullopt;
    result.kind = *kind;
    return result;
}

std::string helloLine(std::int64_t id, std::string_view schema)
{
    return lineOf({{"type", "hello"}, {"id", id}, {"schema", schema}});
}

std::string showLine(std::int64_t id, int widthPx, int heightPx, std::size_t bytes)
{
    return lineOf({{"type", "show"}, {"id", id}, {"width", widthPx}, {"height", heightPx}, {"bytes", bytes}});
}

std::string clearLine(std::int64_t id) { return lineOf({{"type", "clear"}, {"id", id}}); }

std::string statusLine(std::int64_t id) { return lineOf({{"type", "status"}, {"id", id}}); }

}  // namespace rendering
