#include "study/commands/server/display_relay.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <thread>

#include "database/server/server_connection.h"
#include "database/server/server_link.h"
#include "database/server/server_rights.h"
#include "database/session_store.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/utf8.h"
#include "rendering/display/driver_link.h"
#include "rendering/display/driver_messages.h"
#include "rendering/display/stimulus_bank.h"
#include "study/commands/server/station_requests.h"

namespace study::commands {

namespace {

using nlohmann::ordered_json;
using std::chrono::steady_clock;

constexpr auto devicePatience = std::chrono::seconds(2);
constexpr auto serverPatience = std::chrono::milliseconds(1500);  // the station waits 2 s for a reply
constexpr const char* ticketsOnly = "this display takes tickets only";
constexpr std::size_t longestReason = 200;

constexpr auto stationPatience = std::chrono::seconds(2);         // until a station takes the next bytes of a line
constexpr auto untilFirstRequest = std::chrono::seconds(3);       // a station sends hello at once, and waits 5 s for the reply
constexpr auto untilIdle = std::chrono::seconds(10);              // without a request, while nothing can be felt
constexpr auto untilNextAccept = std::chrono::milliseconds(100);  // after one that failed
constexpr int mostWaiting = 16;

/// The message of a line; null for what is none, is nested too deeply or names a key twice.
ordered_json messageIn(const std::string& line)
{
    try {
        auto message = protocols::parseStrictOrderedJson(line, "a message");
        return message.is_object() && message.contains("type") ? message : ordered_json();
    } catch (const protocols::Error&) {
        return {};
    }
}

/// Milliseconds for poll() until the time; 0 for one that is over.
int millisecondsUntil(steady_clock::time_point time)
{
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(time - steady_clock::now()).count();
    return static_cast<int>(std::max<long long>(0, left));
}

/// A listening socket of this computer alone.
class Listener {
public:
    explicit Listener(int port)
    {
        const int yes = 1;
        sockaddr_in place{};
        place.sin_family = AF_INET;
        place.sin_port = htons(static_cast<std::uint16_t>(port));
        place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        ::setsockopt(m_socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        if (::bind(m_socket, reinterpret_cast<sockaddr*>(&place), sizeof place) != 0 || ::listen(m_socket, mostWaiting) != 0)
            throw protocols::badInput({std::string("nobody can connect there: ") + std::strerror(errno),
                                       "127.0.0.1:" + std::to_string(port), "a free port", "choose another --port"});
    }
    ~Listener() { ::close(m_socket); }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    int port() const
    {
        sockaddr_in place{};
        socklen_t size = sizeof place;
        ::getsockname(m_socket, reinterpret_cast<sockaddr*>(&place), &size);
        return ntohs(place.sin_port);
    }
    int socket() const { return m_socket; }
    int accept() const { return ::accept4(m_socket, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK); }

private:
    int m_socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
};

/// The images of tickets. The server may have ended the connection since the last one: it was started again, or ends idle
/// sessions.
class TicketImages {
public:
    explicit TicketImages(database::ServerAddress address) : m_address(std::move(address)) {}

    /// An ended connection is opened anew at once, because the same ticket may be sent twice. A lost server is tried again at the
    /// next ticket.
    cv::Mat imageOf(const std::string& ticket)
    {
        const auto deadline = steady_clock::now() + serverPatience;
        const bool wasConnected = m_link.has_value();
        try {
            return fetched(ticket, deadline);
        } catch (const database::ServerAway&) {
            m_link.reset();
            if (!wasConnected || steady_clock::now() >= deadline) throw;
        }
        try {
            return fetched(ticket, deadline);
        } catch (const database::ServerAway&) {
            m_link.reset();
            throw;
        }
    }

private:
    cv::Mat fetched(const std::string& ticket, steady_clock::time_point deadline)
    {
        if (!m_link) m_link.emplace(m_address);
        const auto reply = m_link->callForImage("released_image", {QString::fromUtf8(ticket.c_str())},
                                                std::chrono::milliseconds(millisecondsUntil(deadline)));
        return rendering::openedStimulus(protocols::SecretKey::ofHex(reply.key, m_address.text), reply.image,
                                         database::releasedImageBound, m_address.text);
    }

    database::ServerAddress m_address;
    std::optional<database::ServerLink> m_link;
};

/// One station, from its first byte to its end of file. It ends earlier where no request comes soon after it connected, and where
/// it is idle while another one waits: any program of this computer can connect, and must not keep the station out.
class Relay {
public:
    Relay(int station, TicketImages& images, const rendering::DriverAddress& device)
        : m_station(station), m_images(images), m_device(device, steady_clock::now() + devicePatience)
    {
    }

    void run(const Listener& others)
    {
        passMessages(others);
        if (m_device.isLost()) reportLoss();
    }

private:
    /// Until the station or the device is gone.
    void passMessages(const Listener& others)
    {
        while (!m_device.isLost()) {
            while (const auto line = m_device.receive(steady_clock::now()))
                if (!send(*line)) return noteEnd("does not take the replies");
            if (m_device.isLost()) break;
            const bool isReplaceable = m_isGreeted && !m_isShowing && steady_clock::now() >= m_lastRequest + untilIdle;
            std::array<pollfd, 4> waiting{{{m_station, POLLIN, 0},
                                           {m_device.socket(), POLLIN, 0},
                                           {m_device.errorStream(), POLLIN, 0},
                                           {isReplaceable ? others.socket() : -1, POLLIN, 0}}};
            const int ready = ::poll(waiting.data(), waiting.size(), untilNextLimit(isReplaceable));
            if (ready < 0 && errno != EINTR) return noteEnd(std::strerror(errno));
            if (ready > 0 && waiting[0].revents != 0) {
                if (!takeFromStation()) return;  // or the device is lost, see run()
            } else if (ready > 0 && waiting[3].revents != 0) {
                return noteEnd("was idle, and another one waits");
            }
            if (!m_isGreeted && steady_clock::now() >= m_lastRequest + untilFirstRequest) return noteEnd("sends no request");
        }
    }

    /// A device without a hello did not start, so the station's operator gets the reason. Another request gets no reply: the
    /// station then connects and asks again.
    void reportLoss()
    {
        const std::string why = protocols::printable(m_device.trouble());
        std::fprintf(stderr, "vis2hap: the display %s\n", why.c_str());
        while (!m_isGreeted && steady_clock::now() < m_lastRequest + untilFirstRequest) {  // its hello may be on the way
            pollfd station{m_station, POLLIN, 0};
            if (::poll(&station, 1, untilNextLimit(false)) > 0 && !takeFromStation()) break;
        }
        if (m_openHello) fail(*m_openHello, protocols::inShort("the device's driver " + why, longestReason));
    }

    static void noteEnd(const std::string& why) { std::fprintf(stderr, "vis2hap: the station %s\n", why.c_str()); }

    /// For poll(); -1 where only messages change anything.
    int untilNextLimit(bool isReplaceable) const
    {
        if (!m_isGreeted) return millisecondsUntil(m_lastRequest + untilFirstRequest);
        return m_isShowing || isReplaceable ? -1 : millisecondsUntil(m_lastRequest + untilIdle);
    }

    /// A line of the device. Its hello also states that this display turns tickets into images.
    bool send(const std::string& line)
    {
        auto message = messageIn(line);
        const auto isOf = [&](const char* type) { return !message.is_null() && message.at("type") == type; };
        if (isOf("hello") || isOf("failed")) m_openHello.reset();
        if (!isOf("hello")) return sendBytes(line + "\n");
        message["fetches"] = true;
        return sendBytes(message.dump() + "\n");
    }

    /// The reply to a request that cannot be fulfilled. Bytes that are not UTF-8, as a driver may print them, are replaced.
    bool fail(std::int64_t id, const std::string& why)
    {
        const ordered_json reply{{"type", "failed"}, {"id", id}, {"why", why}};
        return sendBytes(reply.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n");
    }

    /// The whole text. False where the station is gone, or takes nothing for a while: half a line would spoil the next one.
    bool sendBytes(const std::string& bytes)
    {
        const auto deadline = steady_clock::now() + stationPatience;
        for (std::size_t sent = 0; sent < bytes.size();) {
            const ssize_t now = ::send(m_station, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
            if (now > 0) {
                sent += static_cast<std::size_t>(now);
                continue;
            }
            if (now < 0 && errno == EINTR) continue;
            if (now == 0 || (errno != EAGAIN && errno != EWOULDBLOCK) || steady_clock::now() >= deadline) return false;
            pollfd room{m_station, POLLOUT, 0};
            (void)::poll(&room, 1, millisecondsUntil(deadline));
        }
        return true;
    }

    /// False where the device did not take the whole message.
    bool sendToDevice(const std::string& bytes)
    {
        if (m_device.send(bytes, steady_clock::now() + devicePatience)) return true;
        if (!m_device.isLost()) std::fprintf(stderr, "vis2hap: the display takes no messages\n");
        return false;
    }

    /// False at the end of file, for what is no request, and where nobody takes a message.
    bool takeFromStation()
    {
        std::array<char, 65536> chunk{};
        const ssize_t got = ::read(m_station, chunk.data(), chunk.size());
        if (got <= 0) return got < 0 && (errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK);
        m_requests.add({chunk.data(), static_cast<std::size_t>(got)});
        while (const auto request = m_requests.next())
            if (!answer(*request)) return false;
        return true;
    }

    bool answer(const StationRequest& request)
    {
        using Kind = StationRequest::Kind;
        if (request.kind == Kind::NoMessage || request.kind == Kind::TooLong) {
            noteEnd(request.kind == Kind::TooLong ? "sends a line that is too long" : "sends what is no message");
            return false;
        }
        m_isGreeted = true;
        m_lastRequest = steady_clock::now();
        if (request.kind == Kind::NoTicket) {
            noteEnd("sends what is no ticket");
            if (request.id) fail(*request.id, ticketsOnly);
            return false;
        }
        if (request.kind == Kind::Image) {
            std::fprintf(stderr, "vis2hap: the station sent an image; %s\n", ticketsOnly);
            return fail(request.id.value(), ticketsOnly);
        }
        if (request.kind == Kind::Ticket) return show(request.id.value(), request.ticket);
        if (request.isHello && request.id) m_openHello = request.id;
        if (!sendToDevice(request.line)) return false;
        if (request.isClear) m_isShowing = false;
        return true;
    }

    /// False where the device or the station does not take its message.
    bool show(std::int64_t id, const std::string& ticket)
    {
        try {
            const cv::Mat image = m_images.imageOf(ticket);
            if (image.empty()) throw protocols::workFailed({"the image was altered", "the server", "", ""});
            const std::string bytes(reinterpret_cast<const char*>(image.data), image.total());
            m_isShowing = true;
            return sendToDevice(rendering::showLine(id, image.cols, image.rows, bytes.size()) + bytes);
        } catch (const protocols::Error& fault) {
            std::fprintf(stderr, "vis2hap: %s\n", fault.what());
            return fail(id, fault.what());
        }
    }

    int m_station;
    TicketImages& m_images;
    rendering::DriverLink m_device;
    StationRequests m_requests;
    std::optional<std::int64_t> m_openHello;                       ///< the station's hello, until the device answers it
    bool m_isGreeted = false;                                      ///< a request came
    bool m_isShowing = false;                                      ///< an image was sent to the device and not cleared since
    steady_clock::time_point m_lastRequest = steady_clock::now();  ///< or the beginning of the connection
};

void requireRole(const database::ServerAddress& address)
{
    const auto rights = rightsOf(address);
    if (std::ranges::find(rights.may, "released_image") == rights.may.end())
        throw protocols::badInput({"login " + rights.login + " may not fetch images", address.text,
                                   "a login with the role display",
                                   "the owner grants it: vis2hap server roles ADDRESS --grant LOGIN=display"});
}

}  // namespace

int serveDisplay(const std::string& text, const std::string& specification, int port)
{
    const auto device = rendering::driverAddressFrom(specification);
    if (!device)
        throw protocols::badInput({"display '" + specification + "' has no driver", "--display", "exec:COMMAND or tcp:HOST:PORT",
                                   "name the driver of the display"});
    const auto address = database::serverAddressFrom(text);
    requireRole(address);
    TicketImages images(address);
    const Listener listener(port);
    std::signal(SIGPIPE, SIG_IGN);
    std::printf("the station takes --display tcp:127.0.0.1:%d\n", listener.port());
    std::fflush(stdout);
    while (true) {
        const int station = listener.accept();
        if (station < 0) {  // without a free descriptor the connection would stay waiting, and this loop would spin
            if (errno != EINTR && errno != ECONNABORTED) std::this_thread::sleep_for(untilNextAccept);
            continue;
        }
        Relay(station, images, *device).run(listener);
        ::close(station);
    }
}

}  // namespace study::commands
