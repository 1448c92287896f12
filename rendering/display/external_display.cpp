#include "rendering/display/external_display.h"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <opencv2/core.hpp>
#include <thread>
#include <utility>

namespace rendering {

namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::steady_clock;
using Kind = DriverMessage::Kind;

constexpr std::size_t stampsKept = 8;  // few, so that clocks that run apart do not add up
constexpr nanoseconds oldestTouch = std::chrono::seconds(2);
constexpr milliseconds restBeforeNextTry(250);
constexpr int linesAtOnce = 1000;  // a driver that babbles must not hold the window
constexpr std::size_t noiseKept = 80;

std::string secondsText(milliseconds duration)
{
    const auto tenths = (duration.count() + 50) / 100;
    return std::to_string(tenths / 10) + (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10)) + " s";
}

void watch(int set, int descriptor)
{
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.fd = descriptor;
    if (descriptor >= 0) ::epoll_ctl(set, EPOLL_CTL_ADD, descriptor, &event);
}

/// As part of a message: short, and nothing but characters that can be read.
std::string readable(const std::string& line)
{
    std::string text = line.substr(0, noiseKept);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return text;
}

}  // namespace

ExternalDisplay::ExternalDisplay(const DriverAddress& address, const DriverPatience& patience)
    : m_address(address),
      m_patience(patience),
      m_watched(::epoll_create1(EPOLL_CLOEXEC)),
      m_bell(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK))
{
    watch(m_watched, m_bell);
    try {
        m_isGivenUp = true;  // one try: a wrong command is not better the third time
        clear();             // what an earlier session left there must not be felt
    } catch (...) {
        ::close(m_bell);
        ::close(m_watched);
        throw;
    }
}

ExternalDisplay::~ExternalDisplay()
{
    m_link.reset();
    ::close(m_bell);
    ::close(m_watched);
}

std::string ExternalDisplay::name() const
{
    return m_hello.name.empty() ? m_address.text() : m_hello.name + " (" + m_address.text() + ")";
}

void ExternalDisplay::show(const cv::Mat& frictionImage)
{
    assert(frictionImage.type() == CV_8UC1 && "friction images have one byte a pixel");
    const cv::Mat whole = frictionImage.isContinuous() ? frictionImage : frictionImage.clone();
    const std::string_view bytes(reinterpret_cast<const char*>(whole.data), whole.total());
    const auto line = [&](std::int64_t id) { return showLine(id, whole.cols, whole.rows, bytes.size()); };
    m_showing.reset();
    ask({Kind::Shown, line, bytes}, m_patience.tries);
    m_showing = m_lastId;
}

void ExternalDisplay::clear()
{
    m_showing.reset();
    // A driver that was given up just now is asked once more, not three times again.
    ask({Kind::Cleared, clearLine, {}}, m_isGivenUp ? 1 : m_patience.tries);
}

void ExternalDisplay::ask(const Request& request, int tries)
{
    int tried = 0;
    Begun begun = Begun::Yes;
    while (tried < tries && begun != Begun::Never) {
        if (tried++ > 0) std::this_thread::sleep_for(restBeforeNextTry);
        begun = m_link ? Begun::Yes : begin();
        const auto reply = begun == Begun::Yes ? exchange(request, m_patience.reply) : std::nullopt;
        if (!reply) continue;
        m_isGivenUp = false;
        ringIfSomethingWaits();
        if (reply->kind == Kind::Failed) throw protocols::workFailed(fault("the display refuses: " + readable(reply->why)));
        return;
    }
    m_isGivenUp = true;
    const std::string often = tried > 1 ? " (tried " + std::to_string(tried) + " times)" : "";
    throw protocols::workFailed(fault("the display's driver " + m_trouble + often));
}

ExternalDisplay::Begun ExternalDisplay::begin()
{
    m_link = std::make_unique<DriverLink>(m_address, steady_clock::now() + m_patience.reply);
    if (m_link->isLost()) {
        lose(m_link->trouble());
        return Begun::NotNow;
    }
    watch(m_watched, m_link->socket());
    watch(m_watched, m_link->errorStream());
    const auto reply = exchange({Kind::Hello, [](std::int64_t id) { return helloLine(id); }, {}}, m_patience.start);
    if (!reply) return m_isTimedOut ? Begun::Never : Begun::NotNow;
    if (reply->kind == Kind::Hello && reply->schema == displaySchema) return Begun::Yes;
    if (reply->kind == Kind::Failed)
        lose("does not begin: " + readable(reply->why));
    else
        lose("speaks \"" + readable(m_hello.schema) + "\", this program " + displaySchema);
    return Begun::Never;
}

std::optional<DriverMessage> ExternalDisplay::exchange(const Request& request, milliseconds patience)
{
    const std::int64_t id = ++m_lastId;
    const Instant deadline = steady_clock::now() + patience;
    m_noise.clear();
    bool isWaiting = m_link->send(request.line(id), deadline) && m_link->send(request.bytes, deadline);
    while (isWaiting) {
        const auto line = m_link->receive(deadline);
        const auto said = line ? heard(*line) : std::nullopt;
        if (said && said->id == id && (said->kind == request.reply || said->kind == Kind::Failed)) return said;
        isWaiting = line && steady_clock::now() < deadline;  // a driver that babbles on does not answer either
    }
    m_isTimedOut = !m_link->isLost();
    const std::string noise = m_noise.empty() ? "" : "; heard instead: " + m_noise;
    lose(m_isTimedOut ? std::string("does not answer \"") + nameOf(request.reply) + "\" within " + secondsText(patience) + noise
                      : m_link->trouble());
    return std::nullopt;
}

/// Whatever comes, whether it was asked for or not; a reply to an old request means nothing any more.
std::optional<DriverMessage> ExternalDisplay::heard(const std::string& line)
{
    const auto said = driverMessageFrom(line);
    if (!said) {
        m_noise = readable(line);
        return std::nullopt;
    }
    if (said->deviceS) {
        const auto device = std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(*said->deviceS));
        m_clockAhead.push_back(steady_clock::now().time_since_epoch() - device);
        if (m_clockAhead.size() > stampsKept) m_clockAhead.pop_front();
    }
    if (said->kind == Kind::Hello) m_hello = *said;
    if (said->kind == Kind::Touched) hearTouch(*said);
    return said;
}

/// The message that travelled least tells how far apart the clocks are; the touch was so long ago as its own
/// message took longer than that, or was held back.
void ExternalDisplay::hearTouch(const DriverMessage& touch)
{
    if (!m_showing || touch.id != *m_showing || !m_touched) return;
    Touch told;
    if (touch.deviceS)
        told.ago = std::min(m_clockAhead.back() - *std::min_element(m_clockAhead.begin(), m_clockAhead.end()), oldestTouch);
    m_touched(told);
}

void ExternalDisplay::attend()
{
    std::uint64_t rung = 0;
    [[maybe_unused]] const ssize_t none = ::read(m_bell, &rung, sizeof rung);
    if (!m_link) return;
    const bool wasFelt = m_showing.has_value();
    for (int lines = 0; lines < linesAtOnce; ++lines) {
        const auto line = m_link->receive(steady_clock::now());
        if (!line) break;
        heard(*line);
    }
    if (!m_link->isLost()) return ringIfSomethingWaits();
    lose(m_link->trouble());
    if (wasFelt) throw protocols::workFailed(fault("while an image was felt, the display's driver " + m_trouble));
}

void ExternalDisplay::ringIfSomethingWaits()
{
    const std::uint64_t once = 1;
    if (m_link && m_link->hasLineWaiting()) [[maybe_unused]]
        const ssize_t rung = ::write(m_bell, &once, sizeof once);
}

void ExternalDisplay::lose(const std::string& why)
{
    m_trouble = why;
    m_showing.reset();
    m_clockAhead.clear();
    m_link.reset();
}

protocols::Fault ExternalDisplay::fault(const std::string& what) const
{
    return {what, "display " + m_address.text(), "its reply by the protocol " + std::string(displaySchema),
            "see to the device and its driver (`vis2hap display check` names what is wrong), then show it again"};
}

}  // namespace rendering
