// vis2hap-reference-display: the smallest complete driver of a display by display_protocol.md, as a starting point for
// your own. Its device is a folder: current.pgm is the image that can be felt, all 0 while cleared. It uses nothing of
// the main program, so this file can be copied.
//
//   vis2hap-reference-display DIR [--listen [ADDRESS:]PORT] [--delay MS] [--touch-after MS] [--finger-every MS] [--crash-at N]
//
// Without --listen it uses its standard streams. With a port alone it listens to this computer, 127.0.0.1. Name the address of
// your own cable for another computer, or 0.0.0.0 for every network: nothing checks who connects. For tests: --delay delays every
// reply. --touch-after reports a touch after each image, and --finger-every then reports where the finger is: 40 mm to and fro at
// 80 mm/s, with 0.5 N. --crash-at ends the program at the Nth image.
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

namespace {

using nlohmann::ordered_json;
using std::chrono::steady_clock;

constexpr const char* schema = "vis2hap.display/1";
constexpr int widthPx = 1280, heightPx = 800;
constexpr std::size_t mostBytes = 64u << 20;
constexpr std::size_t longestLine = 65536;
constexpr int deepestMessage = 8;

struct Options {
    std::filesystem::path folder;
    std::string address = "127.0.0.1";
    int port = 0, delayMs = 0, touchAfterMs = -1, fingerEveryMs = 0, crashAt = 0;
};

double nowS() { return std::chrono::duration<double>(steady_clock::now().time_since_epoch()).count(); }

/// The connection to one computer, from its first byte to its end of file.
class Connection {
public:
    Connection(const Options& options, int in, int out) : m_options(options), m_in(in), m_out(out) {}

    void run()
    {
        clearForNobody();
        while (const auto line = nextLine()) answer(*line);
        clearForNobody();  // At end of file the computer is gone, so nothing may be felt.
    }

private:
    /// Every fault becomes a reply: a driver that ends costs the operator more than one that says what is wrong.
    void answer(const std::string& line)
    {
        ordered_json id = 0;
        std::string why;
        try {
            const ordered_json request = messageOf(line);
            id = request.value("id", ordered_json(0));
            std::this_thread::sleep_for(std::chrono::milliseconds(m_options.delayMs));
            fulfil(request, id);
        } catch (const std::exception& fault) {
            why = fault.what();
        }
        if (!why.empty()) send({{"type", "failed"}, {"id", id}, {"why", why}});
    }

    /// Copies and texts of JSON values are recursive, so a message may not be nested deeply.
    static ordered_json messageOf(const std::string& line)
    {
        const auto limit = [](int depth, ordered_json::parse_event_t, const ordered_json&) {
            if (depth > deepestMessage) throw std::runtime_error("the message is nested too deeply");
            return true;
        };
        ordered_json request = ordered_json::parse(line, limit);
        if (!request.is_object()) throw std::runtime_error("the message is no JSON object");
        return request;
    }

    void fulfil(const ordered_json& request, const ordered_json& id)
    {
        const ordered_json type = request.value("type", ordered_json());
        if (type == "hello")
            send({{"type", "hello"},
                  {"id", id},
                  {"schema", schema},
                  {"name", "reference display"},
                  {"width", widthPx},
                  {"height", heightPx},
                  {"touches", m_options.touchAfterMs >= 0}});
        else if (type == "show")
            show(request, id);
        else if (type == "clear")
            clear(id);
        else if (type == "status")
            send({{"type", "status"}, {"id", id}, {"showing", m_showing}, {"at_s", nowS()}});
        else
            throw std::runtime_error("unknown request");
    }

    void show(const ordered_json& request, const ordered_json& id)
    {
        const ordered_json size = request.value("bytes", ordered_json());
        if (!size.is_number_unsigned() || size.get<std::uint64_t>() > mostBytes) {
            m_isLost = true;  // The next message could not be found any more.
            throw std::runtime_error("the number of bytes is missing or too large");
        }
        const auto bytes = size.get<std::size_t>();
        const std::string image = exactly(bytes);
        if (image.size() != bytes) return;  // End of file within an image.
        if (++m_images == m_options.crashAt) std::raise(SIGKILL);
        const int width = request.value("width", 0), height = request.value("height", 0);
        if (width < 1 || height < 1 || bytes != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
            throw std::runtime_error("width x height differs from the number of bytes");
        output(width, height, image);
        m_showing = id;
        m_fingerDue.reset();
        if (m_options.touchAfterMs >= 0) m_touchDue = steady_clock::now() + std::chrono::milliseconds(m_options.touchAfterMs);
        send({{"type", "shown"}, {"id", id}, {"at_s", nowS()}});
    }

    void clear(const ordered_json& id)
    {
        output(0, 0, {});
        m_showing = nullptr;
        m_touchDue.reset();
        m_fingerDue.reset();
        send({{"type", "cleared"}, {"id", id}, {"at_s", nowS()}});
    }

    /// Call the interface of your device here. This example writes a file and renames it, so that nobody reads half an image.
    /// It uses nothing of the program, because it is meant to be copied. Throws where the device did not take the image.
    void output(int width, int height, const std::string& image) const
    {
        const bool isClear = image.empty();
        std::ofstream file(m_options.folder / "next.pgm.part", std::ios::binary);
        file << "P5\n"
             << (isClear ? widthPx : width) << ' ' << (isClear ? heightPx : height) << "\n255\n"
             << (isClear ? std::string(static_cast<std::size_t>(widthPx) * heightPx, '\0') : image);
        file.close();
        if (!file) throw std::runtime_error("the device cannot write its image (is the disk full?)");
        std::filesystem::rename(m_options.folder / "next.pgm.part", m_options.folder / "current.pgm");
    }

    /// Clears the device while no computer listens to a reason.
    void clearForNobody() const
    {
        try {
            output(0, 0, {});
        } catch (const std::exception& fault) {
            std::fprintf(stderr, "the device is not cleared: %s\n", fault.what());
        }
    }

    void send(const ordered_json& message) const
    {
        const std::string line = message.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
        for (std::size_t sent = 0; sent < line.size();) {
            const ssize_t now = ::write(m_out, line.data() + sent, line.size() - sent);
            if (now < 0 && errno == EINTR) continue;
            if (now <= 0) return;  // The reader is gone; the end of file follows.
            sent += static_cast<std::size_t>(now);
        }
    }

    /// Milliseconds until the next report; -1 without one.
    int untilNextReport() const
    {
        const auto due = m_touchDue ? m_touchDue : m_fingerDue;
        if (!due) return -1;
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(*due - steady_clock::now()).count();
        return static_cast<int>(std::max(0L, static_cast<long>(left)));
    }

    /// Sends the report that is due: the touch, then samples of the finger.
    void report()
    {
        const auto now = steady_clock::now();
        if (m_touchDue && *m_touchDue <= now) {
            send({{"type", "touched"}, {"id", m_showing}, {"at_s", nowS()}});
            m_touchedAt = now;
            m_touchDue.reset();
            if (m_options.fingerEveryMs > 0) m_fingerDue = now;
        } else if (m_fingerDue && *m_fingerDue <= now) {
            send({{"type", "finger"},
                  {"id", m_showing},
                  {"at_s", nowS()},
                  {"x_mm", strokePlaceMm(std::chrono::duration<double>(now - m_touchedAt).count())},
                  {"y_mm", 20.0},
                  {"force_n", 0.5}});
            m_fingerDue = now + std::chrono::milliseconds(m_options.fingerEveryMs);
        }
    }

    static double strokePlaceMm(double seconds)
    {
        constexpr double leftMm = 20, strokeMm = 40, mmPerS = 80;
        const double along = std::fmod(seconds * mmPerS, 2 * strokeMm);
        return leftMm + (along < strokeMm ? along : 2 * strokeMm - along);
    }

    /// Waits for more bytes, and sends reports that are due. Returns false at the end of file.
    bool readMore()
    {
        pollfd waiting{m_in, POLLIN, 0};
        while (::poll(&waiting, 1, untilNextReport()) <= 0) report();
        char chunk[65536];
        ssize_t got = 0;
        while ((got = ::read(m_in, chunk, sizeof chunk)) < 0 && errno == EINTR) {
        }
        if (got > 0) m_buffer.append(chunk, static_cast<std::size_t>(got));
        return got > 0;
    }

    /// None at the end of file, and where the next message cannot be found.
    std::optional<std::string> nextLine()
    {
        std::size_t end = std::string::npos;
        while (!m_isLost && (end = m_buffer.find('\n')) == std::string::npos && m_buffer.size() <= longestLine)
            if (!readMore()) return std::nullopt;
        if (!m_isLost && std::min(end, m_buffer.size()) > longestLine) {
            m_isLost = true;
            send({{"type", "failed"}, {"id", 0}, {"why", "the line is longer than 65536 bytes"}});
        }
        if (m_isLost) return std::nullopt;
        std::string line = m_buffer.substr(0, end);
        m_buffer.erase(0, end + 1);
        return line;
    }

    std::string exactly(std::size_t bytes)
    {
        while (m_buffer.size() < bytes && readMore()) {
        }
        std::string image = m_buffer.substr(0, bytes);
        m_buffer.erase(0, image.size());
        return image;
    }

    const Options& m_options;
    int m_in, m_out;
    std::string m_buffer;
    bool m_isLost = false;  ///< the next message cannot be found in what follows
    ordered_json m_showing = nullptr;
    int m_images = 0;
    std::optional<steady_clock::time_point> m_touchDue, m_fingerDue;
    steady_clock::time_point m_touchedAt;
};

/// Serves one computer after the other; prints the port, which the system chooses for port 0.
int listenAt(const Options& options)
{
    const int server = ::socket(AF_INET, SOCK_STREAM, 0);
    const int yes = 1;
    sockaddr_in place{};
    socklen_t size = sizeof place;
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<std::uint16_t>(options.port));
    if (::inet_pton(AF_INET, options.address.c_str(), &place.sin_addr) != 1) {
        std::fprintf(stderr, "cannot listen: %s is no address such as 127.0.0.1\n", options.address.c_str());
        return 2;
    }
    ::setsockopt(server, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (::bind(server, reinterpret_cast<sockaddr*>(&place), sizeof place) != 0 || ::listen(server, 1) != 0) {
        std::perror("cannot listen");
        return 1;
    }
    ::getsockname(server, reinterpret_cast<sockaddr*>(&place), &size);
    std::printf("listening at port %d of %s\n", ntohs(place.sin_port), options.address.c_str());
    std::fflush(stdout);
    while (true) {
        const int client = ::accept(server, nullptr, nullptr);
        if (client < 0) continue;
        ::setsockopt(client, SOL_SOCKET, SO_KEEPALIVE, &yes, sizeof yes);  // A computer without power closes nothing.
        Connection(options, client, client).run();
        ::close(client);
    }
}

/// A whole number; none for any other text.
std::optional<int> numberIn(const std::string& text)
{
    int number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    return fault == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// PORT, or ADDRESS:PORT.
bool takePlace(const std::string& text, Options& options)
{
    const auto colon = text.rfind(':');
    if (colon != std::string::npos) options.address = text.substr(0, colon);
    const auto port = numberIn(colon == std::string::npos ? text : text.substr(colon + 1));
    options.port = port.value_or(0);
    return port && *port >= 0 && *port <= 65535;
}

bool takeNumber(const std::string& name, const std::string& text, Options& options)
{
    int* target = name == "--delay"          ? &options.delayMs
                  : name == "--touch-after"  ? &options.touchAfterMs
                  : name == "--finger-every" ? &options.fingerEveryMs
                  : name == "--crash-at"     ? &options.crashAt
                                             : nullptr;
    const auto number = numberIn(text);
    if (target != nullptr && number) *target = *number;
    return target != nullptr && number.has_value();
}

}  // namespace

int main(int argc, char** argv)
{
    Options options;
    bool isListening = false, isUnderstood = argc >= 2 && argc % 2 == 0 && argv[1][0] != '-';
    for (int i = 2; isUnderstood && i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        isListening = isListening || name == "--listen";
        isUnderstood = name == "--listen" ? takePlace(argv[i + 1], options) : takeNumber(name, argv[i + 1], options);
    }
    if (!isUnderstood) {
        std::fputs(
            "usage: vis2hap-reference-display DIR [--listen [ADDRESS:]PORT] [--delay MS] [--touch-after MS] "
            "[--finger-every MS] [--crash-at N]\n",
            stderr);
        return 2;
    }
    options.folder = argv[1];
    std::error_code fault;
    std::filesystem::create_directories(options.folder, fault);
    if (fault) {
        std::fprintf(stderr, "the folder %s cannot be made: %s\n", argv[1], fault.message().c_str());
        return 3;
    }
    std::signal(SIGPIPE, SIG_IGN);
    if (isListening) return listenAt(options);
    Connection(options, STDIN_FILENO, STDOUT_FILENO).run();
    return 0;
}
