// Messages between this program and a display's driver (display_protocol.md), as values and as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rendering {

inline constexpr const char* displaySchema = "vis2hap.display/1";

enum class MessageKind { Hello, Shown, Cleared, Status, Touched, Released, Finger, Failed };

/// Message of a driver: the reply to the request `id`, or what a finger does on the image `id`.
struct DriverMessage {
    MessageKind kind = MessageKind::Failed;
    std::int64_t id = 0;
    std::optional<double> deviceS;        ///< time of the event on the device's own clock, s
    std::string schema, name;             ///< Hello
    int widthPx = 0, heightPx = 0;        ///< Hello: size of the device's surface
    bool touches = false;                 ///< Hello: whether it reports touches
    bool fetches = false;                 ///< Hello: whether it turns tickets into images
    std::optional<std::int64_t> showing;  ///< Status: id of the image that can be felt
    std::string why;                      ///< Failed
    std::optional<double> xMm, yMm;       ///< Finger: position from the upper left corner; at most 10 m
    std::optional<double> forceN;         ///< Finger: normal force; at most 1 kN
    bool operator==(const DriverMessage&) const = default;
};
const char* nameOf(MessageKind kind);
/// Whether such a message replies to a request; the others tell of the finger.
bool isReply(MessageKind kind);

/// Returns nullopt where the line is not a message of the protocol.
std::optional<DriverMessage> driverMessageFrom(std::string_view line);

/// Requests, each with its line end; the bytes of an image follow the line of showLine().
std::string helloLine(std::int64_t id, std::string_view schema = displaySchema);
std::string showLine(std::int64_t id, int widthPx, int heightPx, std::size_t bytes);
std::string clearLine(std::int64_t id);
std::string statusLine(std::int64_t id);

}  // namespace rendering
