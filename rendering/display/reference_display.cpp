// vis2hap-reference-display: the smallest complete driver of a display by display_protocol.md, as a starting point for
// your own. Its device is a folder: current.pgm is the image that can be felt, all 0 while cleared. It uses nothing of
// the main program, so this file can be copied.
//
//   vis2hap-reference-display DIR [--listen PORT] [--delay MS] [--touch-after MS] [--finger-every MS] [--crash-at N]
//
// Without --listen it uses its standard streams. For tests: --delay delays every reply. --touch-after reports a touch after
// each image, and --finger-every then reports where the finger is: 40 mm to and fro at 80 mm/s, with 0.5 N. --crash-at ends
// the program at the Nth image.
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

namespace {

using nlohmann::ordered_json;
using std::chrono::steady_clock;

constexpr const char* schema = "vis2hap.display/1";
constexpr int widthPx = 1280, heightPx = 800;
constexpr std::size_t mostBytes = 64u << 20;

struct Options {
    std::filesystem::path folder;
    int port = 0, delayMs = 0, touchAfterMs = -1, fingerEveryMs = 0, crashAt = 0;
};

double nowS() { return std::chrono::duration<double>(steady_clock::now().time_since_epoch()).count(); }

/// The connection to one computer, from its first byte to its end of file.
class Connection {
public:
    Connection(const Options& options, int in, int out) : m_options(options), m_in(in), m_out(out) {}

    void run()
    {
        output(0, 0, {});
        while (const auto line = nextLine()) answer(ordered_json::parse(*line, nullptr, false));
        output(0, 0, {});  // At end of file the computer is gone, so nothing may be felt.
    }

private:
    void answer(const ordered_json& request)
    {
        const ordered_json id = request.is_object() ? request.value("id", ordered_json(0)) : ordered_json(0);
        const std::string type = request.is_object() ? request.value("type", ordered_json("")).dump() : "";
        std::this_thread::sleep_for(std::chrono::milliseconds(m_options.delayMs));
        if (type == "\"hello\"")
            send({{"type", "hello"},
                  {"id", id},
                  {"schema", schema},
                  {"name", "reference display"},
                  {"width", widthPx},
                  {"height", heightPx},
                  {"touches", m_options.touchAfterMs >= 0}});
        else if (type == "\"show\"")
            show(request, id);
        else if (type == "\"clear\"")
            clear(id);
        else if (type == "\"status\"")
            send({{"type", "status"}, {"id", id}, {"showing", m_showing}, {"at_s", nowS()}});
        else
            send({{"type", "failed"}, {"id", id}, {"why", "unknown request"}});
    }

    void show(const ordered_json& request, const ordered_json& id)
    {
        const int width = request.value("width", 0), height = request.value("height", 0);
        const auto bytes = request.value("bytes", std::size_t{0});
        if (bytes > mostBytes) std::exit(1);  // The next message could not be found any more.
        const std::string image = exactly(bytes);
        if (image.size() != bytes) return;  // End of file within an image.
        if (++m_images == m_options.crashAt) std::raise(SIGKILL);
        if (width < 1 || height < 1 || bytes != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
            return send({{"type", "failed"}, {"id", id}, {"why", "width x height differs from the number of bytes"}});
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
    /// It uses nothing of the program, because it is meant to be copied.
    void output(int width, int height, const std::string& image) const
    {
        const bool isClear = image.empty();
        std::ofstream file(m_options.folder / "next.pgm.part", std::ios::binary);
        file << "P5\n"
             << (isClear ? widthPx : width) << ' ' << (isClear ? heightPx : height) << "\n255\n"
             << (isClear ? std::string(static_cast<std::size_t>(widthPx) * heightPx, '\0') : image);
        file.close();
        std::filesystem::rename(m_options.folder / "next.pgm.part", m_options.folder / "current.pgm");
    }

    void send(const ordered_json& message) const
    {
        const std::string line = message.dump() + "\n";
        for (std::size_t sent = 0; sent < line.size();) {
            const ssize_t now = ::write(m_out, line.data() + sent, line.size() - sent);
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
        const ssize_t got = ::read(m_in, chunk, sizeof chunk);
        if (got > 0) m_buffer.append(chunk, static_cast<std::size_t>(got));
        return got > 0;
    }

    std::optional<std::string> nextLine()
    {
        std::size_t end = 0;
        while ((end = m_buffer.find('\n')) == std::string::npos)
            if (!readMore()) return std::nullopt;
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
    ::setsockopt(server, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (::bind(server, reinterpret_cast<sockaddr*>(&place), sizeof place) != 0 || ::listen(server, 1) != 0) {
        std::perror("cannot listen");
        return 1;
    }
    ::getsockname(server, reinterpret_cast<sockaddr*>(&place), &size);
    std::printf("listening at port %d\n", ntohs(place.sin_port));
    std::fflush(stdout);
    while (true) {
        const int client = ::accept(server, nullptr, nullptr);
        if (client < 0) continue;
        ::setsockopt(client, SOL_SOCKET, SO_KEEPALIVE, &yes, sizeof yes);  // A computer without power closes nothing.
        Connection(options, client, client).run();
        ::close(client);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    Options options;
    bool isListening = false, isUnderstood = argc >= 2 && argc % 2 == 0 && argv[1][0] != '-';
    for (int i = 2; isUnderstood && i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        const int value = std::atoi(argv[i + 1]);
        isListening = isListening || name == "--listen";
        int* target = name == "--listen"         ? &options.port
                      : name == "--delay"        ? &options.delayMs
                      : name == "--touch-after"  ? &options.touchAfterMs
                      : name == "--finger-every" ? &options.fingerEveryMs
                      : name == "--crash-at"     ? &options.crashAt
                                                 : nullptr;
        isUnderstood = target != nullptr;
        if (target != nullptr) *target = value;
    }
    if (!isUnderstood) {
        std::fputs(
            "usage: vis2hap-reference-display DIR [--listen PORT] [--delay MS] [--touch-after MS] [--finger-every MS] "
            "[--crash-at N]\n",
            stderr);
        return 2;
    }
    options.folder = argv[1];
    std::filesystem::create_directories(options.folder);
    std::signal(SIGPIPE, SIG_IGN);
    if (isListening) return listenAt(options);
    Connection(options, STDIN_FILENO, STDOUT_FILENO).run();
    return 0;
}
