// Dialogue with a driver for the check of a display. It sends requests and records the open requests, the shown image and
// the first unexpected message.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "rendering/display/external_display.h"

namespace rendering {

class DriverDialogue {
public:
    DriverDialogue(const DriverAddress& address, const DriverPatience& patience) : m_address(address), m_patience(patience) {}

    /// Starts the driver and waits for its hello, unless it is already running. Returns false where that fails; see `opening`.
    bool isOpen();
    /// Reason why the driver could not be started.
    const std::string& opening() const { return m_opening; }
    const DriverMessage& hello() const { return m_hello; }

    /// Id of the next request.
    std::int64_t nextId() const { return m_id + 1; }
    /// Records the next `requests` requests as open.
    void open(int requests);
    bool send(std::string_view bytes) { return m_link->send(bytes, std::chrono::steady_clock::now() + m_patience.reply); }
    std::optional<DriverMessage> reply(std::int64_t id) { return reply(id, m_patience.reply); }
    /// Sends a request and waits for its reply; `line` must have the id nextId().
    std::optional<DriverMessage> ask(const std::string& line, std::string_view bytes = {});
    bool hasOtherReplies() const { return !m_replies.empty(); }

    /// Requested image. The driver may report its touches, and those of the image before until it replies: a finger can come
    /// down while the request is on its way.
    std::optional<std::int64_t> showing;
    bool isTouched() const { return m_isTouched; }
    void awaitTouch(Instant deadline);

    /// The device's clock by all its time stamps so far.
    const DeviceClockCheck& clock() const { return m_clock; }

    /// Ends the driver, so that late replies do not disturb the next request.
    void drop();
    /// Closes the driver's input; true where the driver ended by itself.
    bool endInput(Instant deadline);

    /// First unexpected message; empty where there was none.
    const std::string& unexpected() const { return m_unexpected; }
    /// `what` with the reason: "no reply in time" or "no reply; it ended with exit code 3".
    std::string withReason(const std::string& what);

private:
    std::optional<DriverMessage> reply(std::int64_t id, std::chrono::milliseconds patience);
    void take(const std::string& line);
    void takeStamp(const DriverMessage& message);

    DriverAddress m_address;
    DriverPatience m_patience;
    std::unique_ptr<DriverLink> m_link;
    DriverMessage m_hello;
    std::int64_t m_id = 100;
    std::set<std::int64_t> m_open;              ///< requests without a reply
    std::map<std::int64_t, Instant> m_askedAt;  ///< when the requests of this connection were sent
    DeviceClockCheck m_clock;
    std::vector<DriverMessage> m_replies;  ///< replies that no request has taken yet
    std::optional<std::int64_t> m_felt;    ///< image of the last reply `shown`, until a reply `cleared`
    bool m_isTouched = false;
    std::string m_opening, m_unexpected;
};

/// Text of a reply, such as "\"failed\" (the amplifier is off)".
std::string inWords(const std::optional<DriverMessage>& reply);

}  // namespace rendering
