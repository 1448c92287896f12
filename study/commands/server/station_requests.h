// What a station sends to the relay of a display (rendering/display/display_protocol.md), put together from bytes as they arrive.
// Lines alternate with tickets: after a request to show, as many bytes follow as it states.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace study::commands {

struct StationRequest {
    enum class Kind {
        Passed,     ///< a request that the device itself answers
        Ticket,     ///< a request to show the image of a ticket
        Image,      ///< a request to show an image, whose bytes are dropped: this display takes tickets only
        NoTicket,   ///< a request to show without an id, or without a count of bytes that can be meant; ends the requests
        NoMessage,  ///< a line that is no message, nested too deeply or names a key twice; ends the requests
        TooLong     ///< a line without an end within `longestLine` bytes; ends the requests
    };
    Kind kind = Kind::NoMessage;
    std::optional<std::int64_t> id;  ///< empty where the request has none that fits
    std::string line;                ///< Passed: as it came, with its "\n"
    bool isHello = false, isClear = false;
    std::string ticket;  ///< Ticket: its bytes, which may be none of this program's
    bool operator==(const StationRequest&) const = default;
};

class StationRequests {
public:
    static constexpr std::size_t longestLine = 65536;  ///< bytes without the "\n"
    static constexpr std::uint64_t longestTicket = 1024;
    static constexpr std::uint64_t largestImage = 64U << 20;  ///< that may come in place of a ticket; more cannot be meant

    void add(std::string_view bytes);
    /// The next request; nullopt where it is not whole yet, and after one that ends the requests. What is returned does not
    /// depend on the parts in which the bytes came.
    std::optional<StationRequest> next();

private:
    StationRequest read(const std::string& line);
    StationRequest readShow(std::optional<std::int64_t> id, std::optional<std::uint64_t> bytes);
    void dropImage();

    std::string m_bytes;                    ///< not taken yet
    std::size_t m_searched = 0;             ///< among the first ones there is no line end
    std::uint64_t m_imageLeft = 0;          ///< bytes of a refused image that are still to come
    std::optional<StationRequest> m_asked;  ///< a request to show whose ticket is still to come
    std::uint64_t m_ticketBytes = 0;        ///< of that ticket
    bool m_isEnded = false;
};

}  // namespace study::commands
