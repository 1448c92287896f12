#include "rendering/display/display_check.h"

#include <algorithm>
#include <thread>

#include "protocols/files/id_rule.h"
#include "rendering/composition/friction_image.h"
#include "rendering/display/driver_dialogue.h"

namespace rendering {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr int timedImages = 10;
constexpr milliseconds betweenStamps(37);

/// Image of line ends, braces and all other values: a driver must count these bytes and not read them as lines.
std::string trickyImage(int widthPx, int heightPx)
{
    const std::string request = "\n" + clearLine(1) + "\r\n\x1a";
    std::string image(static_cast<std::size_t>(widthPx) * static_cast<std::size_t>(heightPx), '\0');
    for (std::size_t i = 0; i < image.size(); ++i)
        image[i] = i < image.size() / 2 ? request[i % request.size()] : static_cast<char>(i % 256);
    return image;
}

class DriverCheck {
public:
    DriverCheck(const DriverAddress& address, const DisplayCheckOptions& options)
        : m_address(address), m_options(options), m_driver(address, options.patience)
    {
    }

    DisplayCheck run(const std::function<void(const DisplayDemand&)>& report);

private:
    struct Demand {
        std::string text;
        std::string (DriverCheck::*faultOf)();
    };
    static const std::vector<Demand>& demands();

    // The requirements; each function returns the fault, or an empty text.
    std::string hello();
    std::string nothingFirst();
    std::string shows();
    std::string showsSizeOfSessions();
    std::string statusNamesTheImage();
    std::string imageBytesAreNoLines();
    std::string newImageReplaces();
    std::string clears();
    std::string clearsTwice();
    std::string manyAtOnce();
    std::string inPieces();
    std::string unknownRequest();
    std::string newerSchema();
    std::string wrongSize();
    std::string touches();
    std::string clockAdvances();
    std::string endsAtEndOfFile();
    std::string beginsAgain();
    std::string saysNothingElse() { return m_driver.unexpected(); }

    std::optional<DriverMessage> shown(std::string_view image = {});
    std::string expect(const std::optional<DriverMessage>& reply, MessageKind kind);
    std::string expectShowing(std::optional<std::int64_t> image);

    DriverAddress m_address;
    DisplayCheckOptions m_options;
    DisplayCheck m_result;
    DriverDialogue m_driver;
};

const std::vector<DriverCheck::Demand>& DriverCheck::demands()
{
    static const std::vector<Demand> table{
        {"sends hello with its schema, a name and the size of its surface", &DriverCheck::hello},
        {"shows nothing after hello", &DriverCheck::nothingFirst},
        {"shows an image and replies in time", &DriverCheck::shows},
        {"shows an image of " + std::to_string(displayWidthPx) + " × " + std::to_string(displayHeightPx) +
             " px, the size that sessions send",
         &DriverCheck::showsSizeOfSessions},
        {"names the shown image in its status", &DriverCheck::statusNamesTheImage},
        {"counts the bytes of an image and does not interpret them", &DriverCheck::imageBytesAreNoLines},
        {"replaces the image by a new one", &DriverCheck::newImageReplaces},
        {"clears in time and states it in its status", &DriverCheck::clears},
        {"accepts a second clear", &DriverCheck::clearsTwice},
        {"answers several requests at once in their order", &DriverCheck::manyAtOnce},
        {"reads a request that arrives in pieces", &DriverCheck::inPieces},
        {"answers \"failed\" to an unknown request and continues", &DriverCheck::unknownRequest},
        {"answers a hello of a newer schema with its own schema", &DriverCheck::newerSchema},
        {"shows or refuses an image of another size and continues", &DriverCheck::wrongSize},
        {"reports a touch with the id of the image", &DriverCheck::touches},
        {"stamps its events by a clock that advances as ours does, or leaves at_s out", &DriverCheck::clockAdvances},
        {"sends only messages: one reply to each request, and touches of the shown image", &DriverCheck::saysNothingElse},
        {"stops showing when its input ends", &DriverCheck::endsAtEndOfFile},
        {"works after it is started again", &DriverCheck::beginsAgain},
    };
    return table;
}

DisplayCheck DriverCheck::run(const std::function<void(const DisplayDemand&)>& report)
{
    for (const Demand& demand : demands()) {
        const bool isAsked = demand.faultOf != &DriverCheck::touches || m_options.touchWithin.count() > 0;
        if (!isAsked) continue;
        const bool needsDriver = demand.faultOf != &DriverCheck::saysNothingElse;
        std::string fault;
        // Without a hello only an unexpected message can be reported.
        if (m_driver.hello().schema.empty() && !m_result.demands.empty() && (needsDriver || m_driver.unexpected().empty()))
            fault = "could not be tested, because there was no hello";
        else if (needsDriver && !m_driver.isOpen() && demand.faultOf != &DriverCheck::hello)
            fault = m_driver.opening();
        else
            fault = (this->*demand.faultOf)();
        if (!fault.empty() && needsDriver) m_driver.drop();
        m_result.name = m_driver.hello().name;
        m_result.demands.push_back({demand.text, fault});
        if (report) report(m_result.demands.back());
    }
    return m_result;
}

/// Shows `image`, or a grey image of the size that the driver stated.
std::optional<DriverMessage> DriverCheck::shown(std::string_view image)
{
    const int width = m_driver.hello().widthPx > 0 ? m_driver.hello().widthPx : displayWidthPx;
    const int height = m_driver.hello().heightPx > 0 ? m_driver.hello().heightPx : displayHeightPx;
    const std::string grey(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), '\x80');
    const std::string_view bytes = image.empty() ? std::string_view(grey) : image;
    const std::int64_t id = m_driver.nextId();
    m_driver.showing = id;
    return m_driver.ask(showLine(id, width, height, bytes.size()), bytes);
}

std::string DriverCheck::expect(const std::optional<DriverMessage>& reply, MessageKind kind)
{
    if (reply && reply->kind == kind) return {};
    return reply ? "answers " + inWords(reply) : m_driver.withReason("no reply");
}

std::string DriverCheck::expectShowing(std::optional<std::int64_t> image)
{
    const auto reply = m_driver.ask(statusLine(m_driver.nextId()));
    if (!reply || reply->kind != MessageKind::Status) return "status: " + expect(reply, MessageKind::Status);
    return reply->showing == image ? "" : "its status is " + inWords(reply);
}

std::string DriverCheck::hello()
{
    if (!m_driver.isOpen()) return m_driver.opening();
    if (m_driver.hello().schema != displaySchema)
        return "its schema is \"" + m_driver.hello().schema + "\", not " + displaySchema;
    if (m_driver.hello().name.empty()) return "its hello has no name";
    if (const auto fault = protocols::faultOfLine(m_driver.hello().name, protocols::longestName); !fault.empty())
        return "the name in its hello " + fault;
    return m_driver.hello().widthPx > 0 && m_driver.hello().heightPx > 0 ? "" : "its hello has no width and height";
}

std::string DriverCheck::nothingFirst() { return expectShowing(std::nullopt); }

std::string DriverCheck::shows()
{
    for (int image = 0; image < timedImages; ++image)
        for (const bool isShow : {true, false}) {
            const Instant begin = steady_clock::now();
            const auto reply = isShow ? shown() : m_driver.ask(clearLine(m_driver.nextId()));
            if (const auto fault = expect(reply, isShow ? MessageKind::Shown : MessageKind::Cleared); !fault.empty())
                return fault;
            const std::chrono::duration<double, std::milli> took = steady_clock::now() - begin;
            (isShow ? m_result.showMs : m_result.clearMs).push_back(took.count());
        }
    return {};
}

/// A device with another number of pixels must scale the image.
std::string DriverCheck::showsSizeOfSessions()
{
    const std::string grey(static_cast<std::size_t>(displayWidthPx) * static_cast<std::size_t>(displayHeightPx), '\x80');
    m_driver.showing = m_driver.nextId();
    const std::string line = showLine(*m_driver.showing, displayWidthPx, displayHeightPx, grey.size());
    return expect(m_driver.ask(line, grey), MessageKind::Shown);
}

std::string DriverCheck::statusNamesTheImage()
{
    const auto fault = expect(shown(), MessageKind::Shown);
    return fault.empty() ? expectShowing(m_driver.showing) : fault;
}

std::string DriverCheck::imageBytesAreNoLines()
{
    const int width = std::max(1, m_driver.hello().widthPx), height = std::max(1, m_driver.hello().heightPx);
    const auto fault = expect(shown(trickyImage(width, height)), MessageKind::Shown);
    return fault.empty() ? expectShowing(m_driver.showing) : fault;
}

std::string DriverCheck::newImageReplaces()
{
    for (int image = 0; image < 2; ++image)
        if (const auto fault = expect(shown(), MessageKind::Shown); !fault.empty()) return fault;
    return expectShowing(m_driver.showing);
}

std::string DriverCheck::clears()
{
    if (const auto fault = expect(shown(), MessageKind::Shown); !fault.empty()) return fault;
    if (const auto fault = expect(m_driver.ask(clearLine(m_driver.nextId())), MessageKind::Cleared); !fault.empty()) return fault;
    m_driver.showing.reset();
    return expectShowing(std::nullopt);
}

std::string DriverCheck::clearsTwice()
{
    for (int time = 0; time < 2; ++time)
        if (const auto fault = expect(m_driver.ask(clearLine(m_driver.nextId())), MessageKind::Cleared); !fault.empty())
            return fault;
    m_driver.showing.reset();
    return {};
}

std::string DriverCheck::manyAtOnce()
{
    const std::string image = trickyImage(16, 10);
    const std::int64_t first = m_driver.nextId();
    constexpr int requests = 4;
    m_driver.open(requests);
    m_driver.showing = first;
    if (!m_driver.send(showLine(first, 16, 10, image.size()) + image + statusLine(first + 1) + clearLine(first + 2) +
                       statusLine(first + 3)))
        return m_driver.withReason("it accepts no more bytes");
    for (std::int64_t id = first; id < first + requests; ++id) {
        const auto found = m_driver.reply(id);
        if (!found) return m_driver.withReason("no reply to request " + std::to_string(id - first + 1) + " of 4");
        if (m_driver.hasOtherReplies()) return "the replies come in another order";
    }
    m_driver.showing.reset();
    return {};
}

std::string DriverCheck::inPieces()
{
    const std::int64_t id = m_driver.nextId();
    const std::string line = statusLine(id);
    m_driver.open(1);
    for (const std::size_t begin : {std::size_t{0}, line.size() / 3, 2 * line.size() / 3}) {
        if (!m_driver.send(line.substr(begin, begin == 2 * line.size() / 3 ? line.npos : line.size() / 3)))
            return m_driver.withReason("it accepts no more bytes");
        std::this_thread::sleep_for(milliseconds(20));
    }
    return expect(m_driver.reply(id), MessageKind::Status);
}

std::string DriverCheck::unknownRequest()
{
    const std::string line = "{\"type\":\"wobble\",\"id\":" + std::to_string(m_driver.nextId()) + "}\n";
    if (const auto fault = expect(m_driver.ask(line), MessageKind::Failed); !fault.empty()) return fault;
    return expect(m_driver.ask(statusLine(m_driver.nextId())), MessageKind::Status);
}

std::string DriverCheck::newerSchema()
{
    const auto reply = m_driver.ask(helloLine(m_driver.nextId(), "vis2hap.display/99"));
    if (const auto fault = expect(reply, MessageKind::Hello); !fault.empty()) return fault;
    return reply->schema == displaySchema ? "" : "it answers with \"" + reply->schema + "\"";
}

std::string DriverCheck::wrongSize()
{
    const std::string image(7 * 5, '\x40');
    m_driver.showing = m_driver.nextId();
    const auto reply = m_driver.ask(showLine(*m_driver.showing, 7, 5, image.size()), image);
    if (!reply || (reply->kind != MessageKind::Shown && reply->kind != MessageKind::Failed))
        return expect(reply, MessageKind::Shown);
    return expect(m_driver.ask(clearLine(m_driver.nextId())), MessageKind::Cleared);
}

std::string DriverCheck::touches()
{
    if (!m_driver.hello().touches) return "its hello states that it reports no touches";
    if (const auto fault = expect(shown(), MessageKind::Shown); !fault.empty()) return fault;
    m_driver.awaitTouch(steady_clock::now() + m_options.touchWithin);
    return m_driver.isTouched() ? "" : m_driver.withReason("no touch was reported");
}

/// The events are apart, and at other places within any step of the device's clock.
std::string DriverCheck::clockAdvances()
{
    constexpr int pairs = 3;
    for (int pair = 0; pair < pairs && m_driver.clock().hasStamps(); ++pair) {
        std::this_thread::sleep_for(betweenStamps);
        if (const auto fault = expect(shown(), MessageKind::Shown); !fault.empty()) return fault;
        std::this_thread::sleep_for(betweenStamps);
        if (const auto fault = expect(m_driver.ask(clearLine(m_driver.nextId())), MessageKind::Cleared); !fault.empty())
            return fault;
        m_driver.showing.reset();
    }
    return m_driver.clock().fault();
}

/// A started program must end. A driver that waits for connections must show nothing to the next one.
std::string DriverCheck::endsAtEndOfFile()
{
    if (const auto fault = expect(shown(), MessageKind::Shown); !fault.empty()) return fault;
    const bool hasEnded = m_driver.endInput(steady_clock::now() + m_options.patience.reply);
    if (!hasEnded) return "it continued after the end of its input and was killed";
    if (m_address.isProgram()) return {};
    return m_driver.isOpen() ? expectShowing(std::nullopt) : m_driver.opening();
}

std::string DriverCheck::beginsAgain()
{
    m_driver.drop();
    if (!m_driver.isOpen()) return m_driver.opening();
    if (const auto fault = expect(shown(), MessageKind::Shown); !fault.empty()) return fault;
    return expect(m_driver.ask(clearLine(m_driver.nextId())), MessageKind::Cleared);
}

}  // namespace

int DisplayCheck::faults() const
{
    return static_cast<int>(
        std::count_if(demands.begin(), demands.end(), [](const DisplayDemand& d) { return !d.fault.empty(); }));
}

DisplayCheck checkDisplay(const DriverAddress& address, const DisplayCheckOptions& options,
                          const std::function<void(const DisplayDemand&)>& report)
{
    return DriverCheck(address, options).run(report);
}

}  // namespace rendering
