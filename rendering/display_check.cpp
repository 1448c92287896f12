#include "rendering/display_check.h"

#include <algorithm>
#include <set>
#include <thread>

#include "rendering/friction_image.h"

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

std::string seen(const std::optional<DriverMessage>& said)
{
    if (!said) return "no reply";
    std::string text = std::string("\"") + nameOf(said->kind) + "\"";
    if (said->kind == Kind::Failed) text += " (" + said->why + ")";
    if (said->kind == Kind::Status) text += said->showing ? " showing " + std::to_string(*said->showing) : " showing nothing";
    return text;
}

class Check {
public:
    Check(const DriverAddress& address, const DisplayCheckOptions& options) : m_address(address), m_options(options) {}

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
    std::string saysNothingElse() { return m_stray.empty() ? "" : m_stray; }

    // ---- talking
    bool isOpen();
    bool send(std::string_view bytes) { return m_link->send(bytes, steady_clock::now() + m_options.patience.reply); }
    std::optional<DriverMessage> reply(std::int64_t id, milliseconds patience);
    std::optional<DriverMessage> asked(const std::string& line, std::string_view bytes = {});
    std::optional<DriverMessage> shown(std::string_view image = {});
    std::string expect(const std::optional<DriverMessage>& said, Kind kind);
    std::string expectShowing(std::optional<std::int64_t> image);
    std::string lost(const std::string& what);
    void take(const std::string& line);

    DriverAddress m_address;
    DisplayCheckOptions m_options;
    DisplayCheck m_result;
    std::unique_ptr<DriverLink> m_link;
    DriverMessage m_hello;
    std::int64_t m_id = 100;
    std::set<std::int64_t> m_open;         ///< requests without a reply yet
    std::optional<std::int64_t> m_showing; ///< the image shown last, so long as it is not cleared
    std::vector<DriverMessage> m_said;     ///< replies not asked for yet
    bool m_isTouched = false;
    std::string m_opening, m_stray;
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
        if (m_hello.schema.empty() && !m_result.demands.empty() && needsDriver)
            fault = "could not be asked: there was no hello";
        else if (needsDriver && !isOpen() && demand.faultOf != &Check::hello)
            fault = m_opening;
        else
            fault = (this->*demand.faultOf)();
        if (!fault.empty() && needsDriver && m_link) {
            m_link->close(steady_clock::now());  // late replies must not confuse what follows
            m_link.reset();
        }
        m_result.demands.push_back({demand.text, fault});
        if (tell) tell(m_result.demands.back());
    }
    return m_result;
}

/// A driver that was lost is begun again, so that one fault does not hide the next.
bool Check::isOpen()
{
    if (m_link && !m_link->isLost()) return true;
    m_link.reset();
    m_open.clear();
    m_said.clear();
    m_showing.reset();
    try {
        m_link = std::make_unique<DriverLink>(m_address, steady_clock::now() + m_options.patience.reply);
    } catch (const protocols::Error& error) {
        m_opening = error.what();
        return false;
    }
    const std::int64_t id = ++m_id;
    m_open.insert(id);
    const auto said = send(helloLine(id)) ? reply(id, m_options.patience.start) : std::nullopt;
    if (said && said->kind == Kind::Hello) {
        m_hello = *said;
        m_result.name = said->name;
        return true;
    }
    m_opening = said ? "answers hello with " + seen(said) : lost("no hello");
    m_link.reset();
    return false;
}

std::string Check::lost(const std::string& what)
{
    return m_link && m_link->isLost() ? what + "; it " + m_link->trouble() : what + " in time";
}

/// Sorts a line: a reply to what was asked, a touch, or a stray that is a fault of its own.
void Check::take(const std::string& line)
{
    const auto said = driverMessageFrom(line);
    std::string stray;
    if (!said)
        stray = "said what is no message: " + line.substr(0, 60);
    else if (said->kind == Kind::Touched && m_showing != said->id)
        stray = "told a touch of image " + std::to_string(said->id) + ", which is not shown";
    else if (said->kind == Kind::Touched)
        m_isTouched = true;
    else if (m_open.erase(said->id) == 0)
        stray = "answered " + seen(said) + " to request " + std::to_string(said->id) + ", which was not asked or answered before";
    else
        m_said.push_back(*said);
    if (m_stray.empty()) m_stray = stray;
}

std::optional<DriverMessage> Check::reply(std::int64_t id, milliseconds patience)
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
std::optional<DriverMessage> Check::asked(const std::string& line, std::string_view bytes)
{
    m_open.insert(++m_id);
    if (!send(line) || !send(bytes)) return std::nullopt;
    return reply(m_id, m_options.patience.reply);
}

/// The image, or a grey one of the size that it told.
std::optional<DriverMessage> Check::shown(std::string_view image)
{
    const int width = m_hello.widthPx > 0 ? m_hello.widthPx : displayWidthPx;
    const int height = m_hello.heightPx > 0 ? m_hello.heightPx : displayHeightPx;
    const std::string grey(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), '\x80');
    const std::string_view bytes = image.empty() ? std::string_view(grey) : image;
    const std::int64_t id = m_id + 1;
    m_showing = id;
    return asked(showLine(id, width, height, bytes.size()), bytes);
}

std::string Check::expect(const std::optional<DriverMessage>& said, Kind kind)
{
    if (said && said->kind == kind) return {};
    return said ? "answers " + seen(said) : lost("no reply");
}

std::string Check::expectShowing(std::optional<std::int64_t> image)
{
    const auto said = asked(statusLine(m_id + 1));
    if (!said || said->kind != Kind::Status) return "status: " + expect(said, Kind::Status);
    return said->showing == image ? "" : "its status is " + seen(said);
}

std::string Check::hello()
{
    if (!isOpen()) return m_opening;
    if (m_hello.schema != displaySchema) return "its schema is \"" + m_hello.schema + "\", not " + displaySchema;
    if (m_hello.name.empty()) return "it tells no name";
    return m_hello.widthPx > 0 && m_hello.heightPx > 0 ? "" : "it tells no width and height";
}

std::string Check::nothingFirst() { return expectShowing(std::nullopt); }

std::string Check::shows()
{
    for (int image = 0; image < timedImages; ++image)
        for (const bool isShow : {true, false}) {
            const Instant begin = steady_clock::now();
            const auto said = isShow ? shown() : asked(clearLine(m_id + 1));
            if (const auto fault = expect(said, isShow ? Kind::Shown : Kind::Cleared); !fault.empty()) return fault;
            const std::chrono::duration<double, std::milli> took = steady_clock::now() - begin;
            (isShow ? m_result.showMs : m_result.clearMs).push_back(took.count());
        }
    return {};
}

std::string Check::statusNamesTheImage()
{
    const auto fault = expect(shown(), Kind::Shown);
    return fault.empty() ? expectShowing(m_showing) : fault;
}

std::string Check::imageBytesAreNoLines()
{
    const int width = std::max(1, m_hello.widthPx), height = std::max(1, m_hello.heightPx);
    const auto fault = expect(shown(trickyImage(width, height)), Kind::Shown);
    return fault.empty() ? expectShowing(m_showing) : fault;
}

std::string Check::newImageReplaces()
{
    for (int image = 0; image < 2; ++image)
        if (const auto fault = expect(shown(), Kind::Shown); !fault.empty()) return fault;
    return expectShowing(m_showing);
}

std::string Check::clears()
{
    if (const auto fault = expect(shown(), Kind::Shown); !fault.empty()) return fault;
    if (const auto fault = expect(asked(clearLine(m_id + 1)), Kind::Cleared); !fault.empty()) return fault;
    m_showing.reset();
    return expectShowing(std::nullopt);
}

std::string Check::clearsTwice()
{
    for (int time = 0; time < 2; ++time)
        if (const auto fault = expect(asked(clearLine(m_id + 1)), Kind::Cleared); !fault.empty()) return fault;
    m_showing.reset();
    return {};
}

std::string Check::manyAtOnce()
{
    const std::string image = trickyImage(16, 10);
    const std::int64_t first = m_id + 1;
    m_id += 4;
    for (std::int64_t id = first; id <= m_id; ++id) m_open.insert(id);
    m_showing = first;
    if (!send(showLine(first, 16, 10, image.size()) + image + statusLine(first + 1) + clearLine(first + 2) + statusLine(first + 3)))
        return lost("it takes no more");
    std::int64_t last = first - 1;
    for (std::int64_t id = first; id <= m_id; ++id) {
        const auto found = reply(id, m_options.patience.reply);
        if (!found) return lost("no reply to request " + std::to_string(id - first + 1) + " of 4");
        const bool isInOrder = m_said.empty() && found->id == last + 1;
        if (!isInOrder) return "the replies come in another order";
        last = found->id;
    }
    m_showing.reset();
    return {};
}

std::string Check::inPieces()
{
    const std::string line = statusLine(++m_id);
    m_open.insert(m_id);
    for (const std::size_t begin : {std::size_t{0}, line.size() / 3, 2 * line.size() / 3}) {
        if (!send(line.substr(begin, begin == 2 * line.size() / 3 ? line.npos : line.size() / 3))) return lost("it takes no more");
        std::this_thread::sleep_for(milliseconds(20));
    }
    return expect(reply(m_id, m_options.patience.reply), Kind::Status);
}

std::string Check::unknownRequest()
{
    const std::string line = "{\"type\":\"wobble\",\"id\":" + std::to_string(m_id + 1) + "}\n";
    if (const auto fault = expect(asked(line), Kind::Failed); !fault.empty()) return fault;
    return expect(asked(statusLine(m_id + 1)), Kind::Status);
}

std::string Check::newerSchema()
{
    const auto said = asked(helloLine(m_id + 1, "vis2hap.display/99"));
    if (const auto fault = expect(said, Kind::Hello); !fault.empty()) return fault;
    return said->schema == displaySchema ? "" : "it answers with \"" + said->schema + "\"";
}

std::string Check::wrongSize()
{
    const std::string image(7 * 5, '\x40');
    m_showing = m_id + 1;
    const auto said = asked(showLine(*m_showing, 7, 5, image.size()), image);
    if (!said || (said->kind != Kind::Shown && said->kind != Kind::Failed)) return expect(said, Kind::Shown);
    return expect(asked(clearLine(m_id + 1)), Kind::Cleared);
}

std::string Check::touches()
{
    if (!m_hello.touches) return "its hello says that it tells no touches";
    if (const auto fault = expect(shown(), Kind::Shown); !fault.empty()) return fault;
    m_isTouched = false;
    const Instant deadline = steady_clock::now() + m_options.touchWithin;
    while (!m_isTouched && steady_clock::now() < deadline)
        if (const auto line = m_link->receive(deadline)) take(*line);
    return m_isTouched ? "" : lost("no touch was told");
}

/// A program ends; whoever waits for connections shows nothing to the next.
std::string Check::endsAtEndOfFile()
{
    if (const auto fault = expect(shown(), Kind::Shown); !fault.empty()) return fault;
    const bool hasEnded = m_link->close(steady_clock::now() + m_options.patience.reply);
    if (!hasEnded) return "it went on after the end of its input, and was ended";
    if (m_address.isProgram()) return {};
    return isOpen() ? expectShowing(std::nullopt) : m_opening;
}

std::string Check::beginsAgain()
{
    m_link.reset();
    if (!isOpen()) return m_opening;
    if (const auto fault = expect(shown(), Kind::Shown); !fault.empty()) return fault;
    return expect(asked(clearLine(m_id + 1)), Kind::Cleared);
}

}  // namespace

int DisplayCheck::faults() const
{
    return static_cast<int>(std::count_if(demands.begin(), demands.end(), [](const DisplayDemand& d) { return !d.fault.empty(); }));
}

DisplayCheck checkDisplay(const DriverAddress& address, const DisplayCheckOptions& options,
                          const std::function<void(const DisplayDemand&)>& tell)
{
    return Check(address, options).run(tell);
}

}  // namespace rendering
