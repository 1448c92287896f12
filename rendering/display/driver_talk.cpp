#include "rendering/display/driver_talk.h"

#include <algorithm>

namespace rendering {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using Kind = DriverMessage::Kind;

}  // namespace

std::string seen(const std::optional<DriverMessage>& said)
{
    if (!said) return "no reply";
    std::string text = std::string("\"") + nameOf(said->kind) + "\"";
    if (said->kind == Kind::Failed) text += " (" + said->why + ")";
    if (said->kind == Kind::Status) text += said->showing ? " showing " + std::to_string(*said->showing) : " showing nothing";
    return text;
}

/// A driver that was lost is begun again, so that one fault does not hide the next.
bool DriverTalk::isOpen()
{
    if (m_link && !m_link->isLost()) return true;
    m_link.reset();
    m_open.clear();
    m_said.clear();
    showing.reset();
    m_link = std::make_unique<DriverLink>(m_address, steady_clock::now() + m_patience.reply);
    const std::int64_t id = ++m_id;
    m_open.insert(id);
    const auto said = send(helloLine(id)) ? reply(id, m_patience.start) : std::nullopt;
    if (said && said->kind == Kind::Hello) {
        m_hello = *said;
        return true;
    }
    m_opening = said ? "answers hello with " + seen(said) : lost("no hello");
    m_link.reset();
    return false;
}

std::string DriverTalk::lost(const std::string& what)
{
    return m_link && m_link->isLost() ? what + "; it " + m_link->trouble() : what + " in time";
}

/// Sorts a line: a reply to what was asked, a touch, or a stray that is a fault of its own.
void DriverTalk::take(const std::string& line)
{
    const auto said = driverMessageFrom(line);
    std::string stray;
    if (!said)
        stray = "said what is no message: " + line.substr(0, 60);
    else if (said->kind == Kind::Touched && showing != said->id)
        stray = "told a touch of image " + std::to_string(said->id) + ", which is not shown";
    else if (said->kind == Kind::Touched)
        m_isTouched = true;
    else if (m_open.erase(said->id) == 0)
        stray = "answered " + seen(said) + " to request " + std::to_string(said->id) + ", which was not asked or answered before";
    else
        m_said.push_back(*said);
    if (m_stray.empty()) m_stray = stray;
}

std::optional<DriverMessage> DriverTalk::reply(std::int64_t id, milliseconds patience)
{
    const Instant deadline = steady_clock::now() + patience;
    bool isOver = false;
    while (true) {
        const auto found = std::find_if(m_said.begin(), m_said.end(), [&](const DriverMessage& said) { return said.id == id; });
        if (found != m_said.end()) {
            const DriverMessage said = *found;
            m_said.erase(found);
            return said;
        }
        if (isOver) return std::nullopt;
        const auto line = m_link->receive(deadline);
        isOver = !line || steady_clock::now() >= deadline;
        if (line) take(*line);
    }
}

/// `line` is of the request m_id + 1.
std::optional<DriverMessage> DriverTalk::ask(const std::string& line, std::string_view bytes)
{
    m_open.insert(++m_id);
    if (!send(line) || !send(bytes)) return std::nullopt;
    return reply(m_id, m_patience.reply);
}

void DriverTalk::drop()
{
    if (m_link) m_link->close(steady_clock::now());
    m_link.reset();
}

bool DriverTalk::endInput(Instant deadline) { return m_link->close(deadline); }

void DriverTalk::awaitTouch(Instant deadline)
{
    m_isTouched = false;
    while (!m_isTouched && !m_link->isLost() && steady_clock::now() < deadline)
        if (const auto line = m_link->receive(deadline)) take(*line);
}

}  // namespace rendering
