// The lines that are spoken with a display's driver (display_protocol.md), as values and text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rendering {

inline constexpr const char* displaySchema = "vis2hap.display/1";

/// What a driver says: a reply to the request `id`, or unasked that the image `id` is touched.
struct DriverMessage {
    enum class Kind { Hello, Shown, Cleared, Status, Touched, Failed };
    Kind kind = Kind::Failed;
    std::int64_t id = 0;
    std::optional<double> deviceS;        ///< the device's own clock when it happened, s from any instant
    std::string schema, name;             ///< Hello
    int widthPx = 0, heightPx = 0;        ///< Hello: of its surface
    bool touches = false;                 ///< Hello: it tells touches
    std::optional<std::int64_t> showing;  ///< Status: the image that can be felt
    std::string why;                      ///< Failed
    bool operator==(const DriverMessage&) const = default;
};
const char* nameOf(DriverMessage::Kind kind);

/// None where the line is no message of the protocol.
std::optional<DriverMessage> driverMessageFrom(std::string_view line);

/// The requests, each with its line end; the bytes of an image follow the line of `showLine`.
std::string helloLine(std::int64_t id, std::string_view schema = displaySchema);
std::string showLine(std::int64_t id, int widthPx, int heightPx, std::size_t bytes);
std::string clearLine(std::int64_t id);
std::string statusLine(std::int64_t id);

}  // namespace rendering
