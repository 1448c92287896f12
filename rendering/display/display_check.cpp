#include "rendering/display/display_check.h"

#include <algorithm>
#include <thread>

#include "rendering/composition/friction_image.h"
#include "rendering/display/driver_talk.h"

namespace rendering {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using Kind = DriverMessage::Kind;

constexpr int timedImages = 10;

/// Line ends, braces and every other value: bytes that a driver must count and not read as lines.
std::string trickyImage(int widthPx, int heightPx)
{
    const std::string request = "\n" + clearLine(1) + "\r\n\x1a";
    std::string image(static_cast<std::size_t>(widthPx) * static_cast<std::size_t>(heightPx), '\0');
    for (std::size_t i = 0; i < image.size(); ++i)
        image[i] = i < image.size() / 2 ? request[i % request.size()] : static_cast<char>(i % 256);
    return image;
}

class Check {
public:
    Check(const DriverAddress& address, const DisplayCheckOptions& options)
        : m_address(address), m_options(options), m_talk(address, options.patience)
    {
    }

    DisplayCheck run(const std::function<void(const DisplayDemand&)>& tell);

private:
    struct Demand {
        const char* text;
        std::string (Check::*faultOf)();
    };
    static const std::vector<Demand>& demands();

    // ---- the demands; each returns what is wrong, or an empty text
    std::string hello();
    std::string nothingFirst();
    std::string shows();
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
    std::string endsAtEndOfFile();
    std::string beginsAgain();
    std::string saysNothingElse() { return m_talk.stray(); }

    std::optional<DriverMessage> shown(std::string_view image = {});
    std::string expect(const std::optional<DriverMessage>& said, Kind kind);
    std::string expectShowing(std::optional<std::int64_t> image);

    DriverAddress m_address;
    DisplayCheckOptions m_options;
    DisplayCheck m_result;
    DriverTalk m_talk;
};

const std::vector<Check::Demand>& Check::demands()
{
    static const std::vector<Demand> table{
        {"says hello, with its schema, a name and the size of its surface", &Check::hello},
        {"shows nothing after hello", &Check::nothingFirst},
        {"shows an image and says so in time", &Check::shows},
        {"its status names the image that it shows", &Check::statusNamesTheImage},
        {"takes the bytes of an image as bytes, whatever they look like", &Check::imageBytesAreNoLines},
        {"a new image takes the place of the one before", &Check::newImageReplaces},
        {"clears in time, and its status says so", &Check::clears},
        {"clearing what is clear is no fault", &Check::clearsTwice},
        {"answers requests that come at once, in their order", &Check::manyAtOnce},
        {"understands a request that comes in pieces", &Check::inPieces},
        {"answers \"failed\" to a request that it does not know, and goes on", &Check::unknownRequest},
        {"answers a hello of a newer schema with its own", &Check::newerSchema},
        {"shows or refuses an image of another size, and goes on", &Check::wrongSize},
        {"tells a touch, with the id of the image", &Check::touches},
        {"says nothing but messages: one reply a request, touches of the image shown alone", &Check::saysNothingElse},
        {"ends showing when its input ends", &Check::endsAtEndOfFile},
        {"can be begun again and then works", &Check::beginsAgain},
    };
    return table;
}

DisplayCheck Check::run(const std::function<void(const DisplayDemand&)>& tell)
{
    for (const Demand& demand : demands()) {
        const bool isAsked = demand.faultOf != &Check::touches || m_options.touchWithin.count() > 0;
        if (!isAsked) continue;
        const bool needsDriver = demand.faultOf != &Check::saysNothingElse;
        std::string fault;
        // What it said instead of hello is told; of one that said nothing, nothing is known.
        if (m_talk.hello().schema.empty() && !m_result.demands.empty() && (needsDriver || m_talk.stray().empty()))
            fault = "could not be asked: there was no hello";
        else if (needsDriver && !m_talk.isOpen() && demand.faultOf != &Check::hello)
            fault = m_talk.opening();
        else
            fault = (this->*demand.faultOf)();
        if (!fault.empty() && needsDriver) m_talk.drop();
        m_result.name = m_talk.hello().name;
        m_result.demands.push_back({demand.text, fault});
        if (tell) tell(m_result.demands.back());
    }
    return m_result;
}

/// The image, or a grey one of the size that it told.
std::optional<DriverMessage> Check::shown(std::string_view image)
{
    const int width = m_talk.hello().widthPx > 0 ? m_talk.hello().widthPx : displayWidthPx;
    const int height = m_talk.hello().heightPx > 0 ? m_talk.hello().heightPx : displayHeightPx;
    const std::string grey(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), '\x80');
    const std::string_view bytes = image.empty() ? std::string_view(grey) : image;
    const std::int64_t id = m_talk.nextId();
    m_talk.showing = id;
    return m_talk.ask(showLine(id, width, height, bytes.size()), bytes);
}

std::string Check::expect(const std::optional<DriverMessage>& said, Kind kind)
{
    if (said && said->kind == kind) return {};
    return said ? "answers " + seen(said) : m_talk.lost("no reply");
}

std::string Check::expectShowing(std::optional<std::int64_t> image)
{
    const auto said = m_talk.ask(statusLine(m_talk.nextId()));
    if (!said || said->kind != Kind::Status) return "status: " + expect(said, Kind::Status);
    return said->showing == image ? "" : "its status is " + seen(said);
}

std::string Check::hello()
{
    if (!m_talk.isOpen()) return m_talk.opening();
    if (m_talk.hello().schema != displaySchema) return "its schema is \"" + m_talk.hello().schema + "\", not " + displaySchema;
    if (m_talk.hello().name.empty()) return "it tells no name";
    return m_talk.hello().widthPx > 0 && m_talk.hello().heightPx > 0 ? "" : "it tells no width and height";
}

std::string Check::nothingFirst() { return expectShowing(std::nullopt); }

std::string Check::shows()
{
    for (int image = 0; image < timedImages; ++image)
        for (const bool isShow : {true, false}) {
            const Instant begin = steady_clock::now();
            const auto said = isShow ? shown() : m_talk.ask(clearLine(m_talk.nextId()));
            if (const auto fault = expect(said, isShow ? Kind::Shown : Kind::Cleared); !fault.empty()) return fault;
            const std::chrono::duration<double, std::milli> took = steady_clock::now() - begin;
            (isShow ? m_result.showMs : m_result.clearMs).push_back(took.count());
        }
    return {};
}

std::string Check::statusNamesTheImage()
{
    const auto fault = expect(shown(), Kind::Shown);
    return fault.empty() ? expectShowing(m_talk.showing) : fault;
}

std::string Check::imageBytesAreNoLines()
{
    const int width = std::max(1, m_talk.hello().widthPx), height = std::max(1, m_talk.hello().heightPx);
    const auto fault = expect(shown(trickyImage(width, height)), Kind::Shown);
    return fault.empty() ? expectShowing(m_talk.showing) : fault;
}

std::string Check::newImageReplaces()
{
    for (int image = 0; image < 2; ++image)
        if (const auto fault = expect(shown(), Kind::Shown); !fault.empty()) return fault;
    return expectShowing(m_talk.showing);
}

std::string Check::clears()
{
    if (const auto fault = expect(shown(), Kind::Shown); !fault.empty()) return fault;
    if (const auto fault = expect(m_talk.ask(clearLine(m_talk.nextId())), Kind::Cleared); !fault.empty()) return fault;
    m_talk.showing.reset();
    return expectShowing(std::nullopt);
}

std::string Check::clearsTwice()
{
    for (int time = 0; time < 2; ++time)
        if (const auto fault = expect(m_talk.ask(clearLine(m_talk.nextId())), Kind::Cleared); !fault.empty()) return fault;
    m_talk.showing.reset();
    return {};
}

std::string Check::manyAtOnce()
{
    const std::string image = trickyImage(16, 10);
    const std::int64_t first = m_talk.nextId();
    constexpr int requests = 4;
    m_talk.open(requests);
    m_talk.showing = first;
    if (!m_talk.send(showLine(first, 16, 10, image.size()) + image + statusLine(first + 1) + clearLine(first + 2) +
                     statusLine(first + 3)))
        return m_talk.lost("it takes no more");
    for (std::int64_t id = first; id < first + requests; ++id) {
        const auto found = m_talk.reply(id);
        if (!found) return m_talk.lost("no reply to request " + std::to_string(id - first + 1) + " of 4");
        if (m_talk.hasOtherReplies()) return "the replies come in another order";  // one came before its turn
    }
    m_talk.showing.reset();
    return {};
}

std::string Check::inPieces()
{
    const std::int64_t id = m_talk.nextId();
    const std::string line = statusLine(id);
    m_talk.open(1);
    for (const std::size_t begin : {std::size_t{0}, line.size() / 3, 2 * line.size() / 3}) {
        if (!m_talk.send(line.substr(begin, begin == 2 * line.size() / 3 ? line.npos : line.size() / 3)))
            return m_talk.lost("it takes no more");
        std::this_thread::sleep_for(milliseconds(20));
    }
    return expect(m_talk.reply(id), Kind::Status);
}

std::string Check::unknownRequest()
{
    const std::string line = "{\"type\":\"wobble\",\"id\":" + std::to_string(m_talk.nextId()) + "}\n";
    if (const auto fault = expect(m_talk.ask(line), Kind::Failed); !fault.empty()) return fault;
    return expect(m_talk.ask(statusLine(m_talk.nextId())), Kind::Status);
}

std::string Check::newerSchema()
{
    const auto said = m_talk.ask(helloLine(m_talk.nextId(), "vis2hap.display/99"));
    if (const auto fault = expect(said, Kind::Hello); !fault.empty()) return fault;
    return said->schema == displaySchema ? "" : "it answers with \"" + said->schema + "\"";
}

std::string Check::wrongSize()
{
    const std::string image(7 * 5, '\x40');
    m_talk.showing = m_talk.nextId();
    const auto said = m_talk.ask(showLine(*m_talk.showing, 7, 5, image.size()), image);
    if (!said || (said->kind != Kind::Shown && said->kind != Kind::Failed)) return expect(said, Kind::Shown);
    return expect(m_talk.ask(clearLine(m_talk.nextId())), Kind::Cleared);
}

std::string Check::touches()
{
    if (!m_talk.hello().touches) return "its hello says that it tells no touches";
    if (const auto fault = expect(shown(), Kind::Shown); !fault.empty()) return fault;
    m_talk.awaitTouch(steady_clock::now() + m_options.touchWithin);
    return m_talk.isTouched() ? "" : m_talk.lost("no touch was told");
}

/// A program ends; whoever waits for connections shows nothing to the next.
std::string Check::endsAtEndOfFile()
{
    if (const auto fault = expect(shown(), Kind::Shown); !fault.empty()) return fault;
    const bool hasEnded = m_talk.endInput(steady_clock::now() + m_options.patience.reply);
    if (!hasEnded) return "it went on after the end of its input, and was ended";
    if (m_address.isProgram()) return {};
    return m_talk.isOpen() ? expectShowing(std::nullopt) : m_talk.opening();
}

std::string Check::beginsAgain()
{
    m_talk.drop();
    if (!m_talk.isOpen()) return m_talk.opening();
    if (const auto fault = expect(shown(), Kind::Shown); !fault.empty()) return fault;
    return expect(m_talk.ask(clearLine(m_talk.nextId())), Kind::Cleared);
}

}  // namespace

int DisplayCheck::faults() const
{
    return static_cast<int>(
        std::count_if(demands.begin(), demands.end(), [](const DisplayDemand& d) { return !d.fault.empty(); }));
}

DisplayCheck checkDisplay(const DriverAddress& address, const DisplayCheckOptions& options,
                          const std::function<void(const DisplayDemand&)>& tell)
{
    return Check(address, options).run(tell);
}

}  // namespace rendering
