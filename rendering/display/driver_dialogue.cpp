#include "rendering/display/driver_dialogue.h"

#include <algorithm>

namespace rendering {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

}  // namespace

std::string inWords(const std::optional<DriverMessage>& reply)
{
    if (!reply) return "no reply";
    std::string text = std::string("\"") + nameOf(reply->kind) + "\"";
    if (reply->kind == MessageKind::Failed) text += " (" + reply->why + ")";
    if (reply->kind == MessageKind::Status)
        text += reply->showing ? " showing " + std::to_string(*reply->showing) : " showing nothing";
    return text;
}

/// A lost driver is started again, so that one fault does not hide the next.
bool DriverDialogue::isOpen()
{
    if (m_link && !m_link->isLost()) return true;
    m_link.reset();
    m_open.clear();
    m_replies.clear();
    showing.reset();
    m_felt.reset();
    m_askedAt.clear();
    m_clock.restart();
    m_link = std::make_unique<DriverLink>(m_address, steady_clock::now() + m_patience.reply);
    open(1);
    const auto hello = send(helloLine(m_id)) ? reply(m_id, m_patience.start) : std::nullopt;
    if (hello && hello->kind == MessageKind::Hello) {
        m_hello = *hello;
        return true;
    }
    m_opening = hello ? "answers hello with " + inWords(hello) : withReason("no hello");
    m_link.reset();
    return false;
}

void DriverDialogue::open(int requests)
{
    for (; requests > 0; --requests) {
        m_open.insert(++m_id);
        m_askedAt[m_id] = steady_clock::now();
    }
}

std::string DriverDialogue::withReason(const std::string& what)
{
    return m_link && m_link->isLost() ? what + "; it " + m_link->trouble() : what + " in time";
}

/// Sorts a line: a reply to a request, a touch, or an unexpected message, which is a fault of its own.
void DriverDialogue::take(const std::string& line)
{
    const auto message = driverMessageFrom(line);
    if (message) takeStamp(*message);
    std::string unexpected;
    if (!message)
        unexpected = "sent a line that is not a message: " + line.substr(0, 60);
    else if (message->kind == MessageKind::Touched && showing != message->id && m_felt != message->id)
        unexpected = "reported a touch of image " + std::to_string(message->id) + ", which is not shown";
    else if (message->kind == MessageKind::Touched)
        m_isTouched = true;
    else if (message->kind == MessageKind::Released || message->kind == MessageKind::Finger) {
        // The finger may move and leave after the image is gone, so any image is allowed here.
    } else if (m_open.erase(message->id) == 0)
        unexpected = "answered " + inWords(message) + " to request " + std::to_string(message->id) +
                     ", which was not sent or was already answered";
    else {
        if (message->kind == MessageKind::Shown) m_felt = message->id;
        if (message->kind == MessageKind::Cleared) m_felt.reset();
        m_replies.push_back(*message);
    }
    if (m_unexpected.empty()) m_unexpected = unexpected;
}

/// An image was felt after it was asked for, so a touch of it came after that, too.
void DriverDialogue::takeStamp(const DriverMessage& message)
{
    const auto asked = m_askedAt.find(message.id);
    if (!message.deviceS || asked == m_askedAt.end()) return;
    m_clock.take({*message.deviceS, steady_clock::now(), asked->second});
}

std::optional<DriverMessage> DriverDialogue::reply(std::int64_t id, milliseconds patience)
{
    const Instant deadline = steady_clock::now() + patience;
    bool isOver = false;
    while (true) {
        const auto found =
            std::find_if(m_replies.begin(), m_replies.end(), [&](const DriverMessage& reply) { return reply.id == id; });
        if (found != m_replies.end()) {
            const DriverMessage reply = *found;
            m_replies.erase(found);
            return reply;
        }
        if (isOver) return std::nullopt;
        const auto line = m_link->receive(deadline);
        isOver = !line || steady_clock::now() >= deadline;
        if (line) take(*line);
    }
}

std::optional<DriverMessage> DriverDialogue::ask(const std::string& line, std::string_view bytes)
{
    open(1);
    if (!send(line) || !send(bytes)) return std::nullopt;
    return reply(m_id, m_patience.reply);
}

void DriverDialogue::drop()
{
    if (m_link) m_link->close(steady_clock::now());
    m_link.reset();
}

bool DriverDialogue::endInput(Instant deadline) { return m_link->close(deadline); }

void DriverDialogue::awaitTouch(Instant deadline)
{
    m_isTouched = false;
    while (!m_isTouched && !m_link->isLost() && steady_clock::now() < deadline)
        if (const auto line = m_link->receive(deadline)) take(*line);
}

}  // namespace rendering
