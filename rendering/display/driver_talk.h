// Asking a driver one thing after another and keeping account of what it says: which requests are open, which image is
// shown, and the first thing that it said unasked. What the check of a display is made of.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "rendering/display/external_display.h"

namespace rendering {

class DriverTalk {
public:
    DriverTalk(const DriverAddress& address, const DriverPatience& patience) : m_address(address), m_patience(patience) {}

    /// Begins the driver, with its hello, where it is not there (any more). False where that fails: see `opening`.
    bool isOpen();
    /// Why it could not be begun.
    const std::string& opening() const { return m_opening; }
    const DriverMessage& hello() const { return m_hello; }

    /// The id of the next request.
    std::int64_t nextId() const { return m_id + 1; }
    /// Counts the next `requests` as asked.
    void open(int requests)
    {
        for (; requests > 0; --requests) m_open.insert(++m_id);
    }
    bool send(std::string_view bytes) { return m_link->send(bytes, std::chrono::steady_clock::now() + m_patience.reply); }
    std::optional<DriverMessage> reply(std::int64_t id) { return reply(id, m_patience.reply); }
    /// `line` is of the request `nextId()`.
    std::optional<DriverMessage> ask(const std::string& line, std::string_view bytes = {});
    bool hasOtherReplies() const { return !m_said.empty(); }

    /// The image whose touches may be told.
    std::optional<std::int64_t> showing;
    bool isTouched() const { return m_isTouched; }
    void awaitTouch(Instant deadline);

    /// Ends the driver, so that late replies confuse nothing that follows.
    void drop();
    /// Gives it its end of file; true where it ended by itself.
    bool endInput(Instant deadline);

    /// The first thing that it said unasked; empty where there was none.
    const std::string& stray() const { return m_stray; }
    /// "no reply in time", or "no reply; it ended with exit code 3".
    std::string lost(const std::string& what);

private:
    std::optional<DriverMessage> reply(std::int64_t id, std::chrono::milliseconds patience);
    void take(const std::string& line);

    DriverAddress m_address;
    DriverPatience m_patience;
    std::unique_ptr<DriverLink> m_link;
    DriverMessage m_hello;
    std::int64_t m_id = 100;
    std::set<std::int64_t> m_open;      ///< requests without a reply yet
    std::vector<DriverMessage> m_said;  ///< replies not asked for yet
    bool m_isTouched = false;
    std::string m_opening, m_stray;
};

/// A reply in words: "\"failed\" (the amplifier is off)".
std::string seen(const std::optional<DriverMessage>& said);

}  // namespace rendering
