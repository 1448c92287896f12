#include "rendering/display/external_display.h"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <opencv2/core.hpp>
#include <thread>

#include "protocols/files/id_rule.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/utf8.h"

namespace rendering {

namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr milliseconds restBeforeNextTry(250);
constexpr int linesAtOnce = 1000;  // A driver that floods the connection must not block the window.
constexpr std::size_t noiseKept = 80;
constexpr std::size_t reasonKept = 240;
constexpr std::size_t addressKept = 60;  // A command with many options would hide the reason.

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

/// A part of a line for messages: short and only printable characters.
std::string printable(const std::string& line)
{
    std::string text = line.substr(0, noiseKept);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return text;
}

/// Reason of a reply `failed`, for messages; it may have characters of any language.
std::string reasonIn(const DriverMessage& reply) { return protocols::inShort(reply.why, reasonKept); }

}  // namespace

ExternalDisplay::ExternalDisplay(const DriverAddress& address, const DriverPatience& patience)
    : m_address(address),
      m_patience(patience),
      m_watched(::epoll_create1(EPOLL_CLOEXEC)),
      m_wake(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK))
{
    watch(m_watched, m_wake);
    try {
        m_isGivenUp = true;  // One try only, because a wrong command does not improve.
        clear();             // The image of an earlier session must not be felt.
    } catch (...) {
        ::close(m_wake);
        ::close(m_watched);
        throw;
    }
}

ExternalDisplay::~ExternalDisplay()
{
    m_link.reset();
    ::close(m_wake);
    ::close(m_watched);
}

std::string ExternalDisplay::name() const
{
    if (m_hello.name.empty()) return m_address.text();
    return protocols::printable(protocols::inShort(m_hello.name, protocols::longestName)) + " (" + m_address.text() + ")";
}

void ExternalDisplay::show(const cv::Mat& frictionImage)
{
    assert(frictionImage.type() == CV_8UC1 && "friction images have one byte per pixel");
    const cv::Mat whole = frictionImage.isContinuous() ? frictionImage : frictionImage.clone();
    const std::string_view bytes(reinterpret_cast<const char*>(whole.data), whole.total());
    const auto line = [&](std::int64_t id) { return showLine(id, whole.cols, whole.rows, bytes.size()); };
    m_showing.reset();
    ask({MessageKind::Shown, line, bytes}, m_patience.tries);
    m_showing = m_lastId;
    m_showAskedAt = m_askedAt;
    m_shownAt = steady_clock::now();
}

void ExternalDisplay::clear()
{
    m_showing.reset();
    // A driver that has just been given up gets one more try, not three.
    ask({MessageKind::Cleared, clearLine, {}}, m_isGivenUp ? 1 : m_patience.tries);
}

void ExternalDisplay::ask(const DriverRequest& request, int tries)
{
    int tried = 0;
    StartResult started = StartResult::Started;
    while (tried < tries && started != StartResult::GiveUp) {
        if (tried++ > 0) std::this_thread::sleep_for(restBeforeNextTry);
        started = m_link ? StartResult::Started : start();
        const auto reply = started == StartResult::Started ? exchange(request, m_patience.reply) : std::nullopt;
        if (!reply) continue;
        m_isGivenUp = false;
        wakeIfLinesWait();
        if (reply->kind == MessageKind::Failed) throw protocols::workFailed(fault("the display refuses: " + reasonIn(*reply)));
        return;
    }
    m_isGivenUp = true;
    const std::string often = tried > 1 ? " (tried " + std::to_string(tried) + " times)" : "";
    throw protocols::workFailed(fault("the display's driver " + m_trouble + often));
}

ExternalDisplay::StartResult ExternalDisplay::start()
{
    m_link = std::make_unique<DriverLink>(m_address, steady_clock::now() + m_patience.reply, m_patience.stop);
    if (m_link->isLost()) {
        lose(m_link->trouble());
        return StartResult::TryAgain;
    }
    watch(m_watched, m_link->socket());
    watch(m_watched, m_link->errorStream());
    const auto reply = exchange({MessageKind::Hello, [](std::int64_t id) { return helloLine(id); }, {}}, m_patience.start);
    if (!reply) return m_isTimedOut ? StartResult::GiveUp : StartResult::TryAgain;
    if (reply->kind == MessageKind::Hello && reply->schema == displaySchema) return StartResult::Started;
    if (reply->kind == MessageKind::Failed)
        lose("does not start: " + reasonIn(*reply));
    else
        lose("uses \"" + printable(m_hello.schema) + "\", but this program uses " + displaySchema);
    return StartResult::GiveUp;
}

std::optional<DriverMessage> ExternalDisplay::exchange(const DriverRequest& request, milliseconds patience)
{
    const std::int64_t id = ++m_lastId;
    m_askedAt = steady_clock::now();
    const Instant deadline = m_askedAt + patience;
    m_noise.clear();
    bool isWaiting = m_link->send(request.line(id), deadline) && m_link->send(request.bytes, deadline);
    while (isWaiting) {
        const auto line = m_link->receive(deadline);
        const auto message = line ? received(*line) : std::nullopt;
        if (message && message->id == id && (message->kind == request.reply || message->kind == MessageKind::Failed))
            return message;
        isWaiting = line && steady_clock::now() < deadline;  // A driver that sends other lines does not answer either.
    }
    m_isTimedOut = !m_link->isLost();
    const std::string noise = m_noise.empty() ? "" : "; it sent instead: " + m_noise;
    lose(m_isTimedOut ? std::string("does not answer \"") + nameOf(request.reply) + "\" within " + secondsText(patience) + noise
                      : m_link->trouble());
    return std::nullopt;
}

/// Processes a line, whether it was requested or not. Replies to old requests have no effect.
std::optional<DriverMessage> ExternalDisplay::received(const std::string& line)
{
    const Instant readAt = steady_clock::now();
    const auto message = driverMessageFrom(line);
    if (!message) {
        m_noise = printable(line);
        return std::nullopt;
    }
    if (message->kind == MessageKind::Finger) {
        reportFinger(*message, readAt);
        return message;
    }
    if (message->deviceS) m_clock.take({*message->deviceS, readAt, askedBefore(*message)});
    if (message->kind == MessageKind::Hello) m_hello = *message;
    if (message->kind == MessageKind::Touched) reportTouch(m_touched, *message, readAt);
    if (message->kind == MessageKind::Released) reportTouch(m_released, *message, readAt);
    return message;
}

/// When the request was sent that the event of this message follows from; none where that is not known.
std::optional<Instant> ExternalDisplay::askedBefore(const DriverMessage& message) const
{
    if (isReply(message.kind)) return message.id == m_lastId ? std::optional(m_askedAt) : std::nullopt;
    return message.id == m_showing ? std::optional(m_showAskedAt) : std::nullopt;
}

/// A finger feels an image from the moment when the display has shown it, and not before.
nanoseconds ExternalDisplay::ageOf(const DriverMessage& message, Instant readAt) const
{
    if (!message.deviceS) return {};
    return std::min(m_clock.ageOf({*message.deviceS, readAt, askedBefore(message)}), nanoseconds(readAt - m_shownAt));
}

void ExternalDisplay::reportTouch(const std::function<void(const Touch&)>& report, const DriverMessage& message, Instant readAt)
{
    if (!m_showing || message.id != *m_showing || !report) return;
    report({ageOf(message, readAt)});
}

/// Samples come many at once after a busy moment, so they use the difference between the clocks and do not change it.
void ExternalDisplay::reportFinger(const DriverMessage& sample, Instant readAt) const
{
    if (!m_showing || sample.id != *m_showing || !m_finger) return;
    m_finger({ageOf(sample, readAt), sample.xMm, sample.yMm, sample.forceN});
}

void ExternalDisplay::processMessages()
{
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t none = ::read(m_wake, &count, sizeof count);
    if (!m_link) return;
    const bool wasFelt = m_showing.has_value();
    for (int lines = 0; lines < linesAtOnce; ++lines) {
        const auto line = m_link->receive(steady_clock::now());
        if (!line) break;
        received(*line);
    }
    if (!m_link->isLost()) return wakeIfLinesWait();
    lose(m_link->trouble());
    if (wasFelt) throw protocols::workFailed(fault("while an image was felt, the display's driver " + m_trouble));
}

void ExternalDisplay::wakeIfLinesWait()
{
    const std::uint64_t once = 1;
    if (m_link && m_link->hasLineWaiting()) [[maybe_unused]]
        const ssize_t written = ::write(m_wake, &once, sizeof once);
}

void ExternalDisplay::lose(const std::string& why)
{
    m_trouble = why;
    m_showing.reset();
    m_clock = {};
    m_link.reset();
}

protocols::Fault ExternalDisplay::fault(const std::string& what) const
{
    return {what, "display " + protocols::inShort(m_address.text(), addressKept),
            "a reply by the protocol " + std::string(displaySchema),
            "check the device and its driver (`vis2hap display check` names the fault), then show the image again"};
}

}  // namespace rendering
