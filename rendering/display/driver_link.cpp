#include "rendering/display/driver_link.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <future>
#include <memory>
#include <string_view>
#include <thread>
#include <vector>

#include "protocols/files/errors.h"
#include "protocols/secrets/secret_variables.h"

namespace rendering {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::size_t mostWaiting = std::size_t{1} << 22;  // Bytes of lines that have not been requested yet.
constexpr std::size_t errorTextKept = 2000;
constexpr milliseconds untilStopIsSeen(50);

std::string systemText() { return std::strerror(errno); }

void closeBoth(const std::array<int, 2>& ends)
{
    for (const int end : ends) ::close(end);
}

int millisecondsTo(Instant deadline)
{
    const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now()).count();
    return static_cast<int>(std::max<long long>(0, left));
}

void setOption(int socket, int level, int option, int value) { ::setsockopt(socket, level, option, &value, sizeof value); }

/// Sends small requests at once, and detects a lost computer within seconds.
void tuneConnection(int socket)
{
    setOption(socket, IPPROTO_TCP, TCP_NODELAY, 1);
    setOption(socket, SOL_SOCKET, SO_KEEPALIVE, 1);
    setOption(socket, IPPROTO_TCP, TCP_KEEPIDLE, 1);
    setOption(socket, IPPROTO_TCP, TCP_KEEPINTVL, 1);
    setOption(socket, IPPROTO_TCP, TCP_KEEPCNT, 3);
}

/// Number of descriptors that are ready; 0 where the deadline passed or a stop was requested before.
template <std::size_t Count>
int waitFor(std::array<pollfd, Count>& descriptors, Instant deadline, const std::stop_token& stop)
{
    const int slice = static_cast<int>(untilStopIsSeen.count());
    while (true) {
        const int left = millisecondsTo(deadline);
        const bool isLast = !stop.stop_possible() || left <= slice;
        const int ready = ::poll(descriptors.data(), descriptors.size(), isLast ? left : slice);
        if (ready != 0) return std::max(0, ready);
        if (isLast || stop.stop_requested()) return 0;
    }
}

/// Addresses of a host, or the error number of getaddrinfo().
struct Addresses {
    std::shared_ptr<addrinfo> first;
    int fault = 0;
};

/// The resolver knows no deadline, so it runs on a thread of its own. The thread is left alone where it takes too long.
Addresses addressesOf(const DriverAddress& address, Instant deadline, const std::stop_token& stop)
{
    std::promise<Addresses> promise;
    auto answer = promise.get_future();
    std::thread([host = address.host, port = address.port, promise = std::move(promise)]() mutable {
        addrinfo wanted{}, *found = nullptr;
        wanted.ai_socktype = SOCK_STREAM;
        const int fault = ::getaddrinfo(host.c_str(), port.c_str(), &wanted, &found);
        promise.set_value({fault == 0 ? std::shared_ptr<addrinfo>(found, &::freeaddrinfo) : nullptr, fault});
    }).detach();
    while (!stop.stop_requested() && steady_clock::now() < deadline)
        if (answer.wait_until(std::min(deadline, steady_clock::now() + untilStopIsSeen)) == std::future_status::ready)
            return answer.get();
    return {nullptr, EAI_AGAIN};
}

/// Error number of the attempt; 0 where it is connected.
int connectBefore(int socket, const addrinfo& place, Instant deadline, const std::stop_token& stop)
{
    if (::connect(socket, place.ai_addr, place.ai_addrlen) == 0) return 0;
    if (errno != EINPROGRESS) return errno;
    std::array<pollfd, 1> waiting{pollfd{socket, POLLOUT, 0}};
    if (waitFor(waiting, deadline, stop) == 0) return ETIMEDOUT;
    int fault = 0;
    socklen_t size = sizeof fault;
    ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &fault, &size);
    return fault;
}

std::string lastLineOf(const std::string& text)
{
    const auto end = text.find_last_not_of(" \t\r\n");
    if (end == std::string::npos) return {};
    const auto begin = text.rfind('\n', end);
    return text.substr(begin == std::string::npos ? 0 : begin + 1, end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

std::string endingText(int status)
{
    if (WIFSIGNALED(status)) return "was ended by signal " + std::to_string(WTERMSIG(status));
    constexpr int shellsSignal = 128;  // The shell in between ends with 128 + signal.
    if (WEXITSTATUS(status) > shellsSignal) return "was ended by signal " + std::to_string(WEXITSTATUS(status) - shellsSignal);
    return "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

std::string DriverAddress::text() const
{
    return isProgram() ? "exec:" + command
                       : "tcp:" + (host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" + port;
}

std::optional<DriverAddress> driverAddressFrom(const std::string& specification)
{
    const std::string exec = "exec:", tcp = "tcp:";
    const auto refusal = [&](const std::string& expected) {
        return protocols::badInput({.what = "display '" + specification + "' names no driver",
                                    .where = "",
                                    .expected = expected,
                                    .nextStep = "correct the name of the display"});
    };
    if (specification.starts_with(exec)) {
        if (specification.find_first_not_of(' ', exec.size()) == std::string::npos) throw refusal("exec:COMMAND");
        return DriverAddress{specification.substr(exec.size()), {}, {}};
    }
    if (!specification.starts_with(tcp)) return std::nullopt;
    const std::string place = specification.substr(tcp.size());
    const auto colon = place.rfind(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == place.size()) throw refusal("tcp:HOST:PORT");
    std::string host = place.substr(0, colon);
    if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
    return DriverAddress{{}, host, place.substr(colon + 1)};
}

DriverLink::DriverLink(const DriverAddress& address, Instant deadline, const std::stop_token& stop) : m_stop(stop)
{
    if (address.isProgram())
        startProgram(address.command);
    else
        connectTo(address, deadline);
}

DriverLink::~DriverLink() { close(steady_clock::now() + milliseconds(m_stop.stop_requested() ? 0 : 500)); }

/// Standard input and output are one socket, so that writing to an ended driver fails without SIGPIPE.
void DriverLink::startProgram(const std::string& command)
{
    std::array<int, 2> streams{}, errors{};
    const bool hasStreams = ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, streams.data()) == 0;
    if (!hasStreams || ::pipe2(errors.data(), O_CLOEXEC) != 0) {
        m_trouble = "cannot be started (" + systemText() + ")";
        if (hasStreams) closeBoth(streams);
        return;
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, streams[1], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, streams[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, errors[1], STDERR_FILENO);
    // A process group of its own: Ctrl-C in the terminal reaches only this program, and all child processes can be ended.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::string words = command, shell = "sh", option = "-c";
    std::array<char*, 4> arguments{shell.data(), option.data(), words.data(), nullptr};
    std::vector<std::string> surroundings = protocols::environmentWithoutSecrets();
    std::vector<char*> variables;
    for (std::string& variable : surroundings) variables.push_back(variable.data());
    variables.push_back(nullptr);
    const int fault = ::posix_spawn(&m_program, "/bin/sh", &actions, &attributes, arguments.data(), variables.data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    ::close(streams[1]);
    ::close(errors[1]);
    m_socket = streams[0];
    m_errors = errors[0];
    ::fcntl(m_socket, F_SETFL, O_NONBLOCK);
    ::fcntl(m_errors, F_SETFL, O_NONBLOCK);
    if (fault == 0) return;
    m_program = -1;
    m_trouble = std::string("cannot be started (") + std::strerror(fault) + ")";
}

void DriverLink::connectTo(const DriverAddress& address, Instant deadline)
{
    const Addresses places = addressesOf(address, deadline, m_stop);
    if (places.fault != 0) {
        m_trouble = std::string("cannot be reached (") + ::gai_strerror(places.fault) + ")";
        return;
    }
    int fault = EADDRNOTAVAIL;
    for (const addrinfo* place = places.first.get(); place != nullptr; place = place->ai_next) {
        m_socket = ::socket(place->ai_family, place->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, place->ai_protocol);
        fault = m_socket < 0 ? errno : connectBefore(m_socket, *place, deadline, m_stop);
        if (fault == 0) return tuneConnection(m_socket);
        if (m_socket >= 0) ::close(m_socket);
        m_socket = -1;
    }
    m_trouble = std::string("cannot be reached (") + std::strerror(fault) + ")";
}

bool DriverLink::send(std::string_view bytes, Instant deadline)
{
    while (!bytes.empty() && !isLost()) {
        const ssize_t sent = ::send(m_socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent > 0)
            bytes.remove_prefix(static_cast<std::size_t>(sent));
        else if (errno == EAGAIN || errno == EWOULDBLOCK)
            // The driver may wait until we read.
            pump(POLLIN | POLLOUT, deadline);
        else if (errno != EINTR)
            takeIn();  // Sets the reason.
        if (sent <= 0 && !isLost() && steady_clock::now() >= deadline) return false;
    }
    return bytes.empty();
}

std::optional<std::string> DriverLink::receive(Instant deadline)
{
    while (true) {
        if (auto line = nextLine()) return line;
        if (isLost()) return std::nullopt;
        pump(POLLIN, deadline);
        if (steady_clock::now() >= deadline) return nextLine();
    }
}

/// Waits until something can be read (or sent, if requested) and reads what has arrived.
void DriverLink::pump(short events, Instant deadline)
{
    std::array<pollfd, 2> waiting{pollfd{m_socket, events, 0}, pollfd{m_errors, POLLIN, 0}};
    if (waitFor(waiting, deadline, m_stop) == 0) {
        if (m_stop.stop_requested()) m_trouble = "was stopped before it answered";
        return;
    }
    if (waiting[1].revents != 0) takeErrors();
    if (waiting[0].revents & (POLLIN | POLLHUP | POLLERR)) takeIn();
}

void DriverLink::takeIn()
{
    std::array<char, 65536> chunk{};
    ssize_t got = 0;
    while (m_incoming.waiting() < mostWaiting && (got = ::recv(m_socket, chunk.data(), chunk.size(), 0)) > 0)
        m_incoming.add({chunk.data(), static_cast<std::size_t>(got)});
    const bool isOpen = got > 0 || (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR));
    if (m_incoming.waiting() >= mostWaiting)
        m_trouble = "sends more than was requested";
    else if (!isOpen)
        m_trouble = m_program > 0 ? "closed its standard output" : "closed the connection";
}

void DriverLink::takeErrors()
{
    std::array<char, 4096> chunk{};
    ssize_t got = 0;
    while ((got = ::read(m_errors, chunk.data(), chunk.size())) > 0) {
        m_errorText.append(chunk.data(), static_cast<std::size_t>(got));
        if (m_errorText.size() > errorTextKept) m_errorText.erase(0, m_errorText.size() - errorTextKept);
    }
    if (got == 0) {  // At end of file the descriptor would stay readable.
        ::close(m_errors);
        m_errors = -1;
    }
}

std::optional<std::string> DriverLink::nextLine()
{
    auto line = m_incoming.next();
    if (m_incoming.isTooLong()) m_trouble = "sent a line longer than " + std::to_string(DriverLines::longest) + " bytes";
    return line;
}

std::string DriverLink::trouble()
{
    if (!isLost()) return {};
    std::string text = m_trouble;
    if (m_program > 0 && !m_hasEnded && !m_stop.stop_requested()) waitForEnd(steady_clock::now() + milliseconds(200));
    if (m_ending) text = endingText(*m_ending);
    if (m_errors >= 0) takeErrors();
    const std::string words = lastLineOf(m_errorText);
    return words.empty() ? text : text + "; its error text: " + words;
}

bool DriverLink::waitForEnd(Instant deadline)
{
    while (!m_hasEnded) {
        int status = 0;
        const pid_t ended = ::waitpid(m_program, &status, WNOHANG);
        m_hasEnded = ended == m_program || (ended < 0 && errno != EINTR);
        if (ended == m_program)
            m_ending = status;
        else if (!m_hasEnded && steady_clock::now() >= deadline)
            return false;
        else if (!m_hasEnded)
            std::this_thread::sleep_for(milliseconds(2));
        if (!m_hasEnded && m_errors >= 0) takeErrors();
    }
    return true;
}

bool DriverLink::close(Instant deadline)
{
    if (m_socket >= 0) ::close(m_socket);
    m_socket = -1;
    if (m_trouble.empty()) m_trouble = "was closed";
    if (m_program <= 0) return true;
    const bool hasEnded = waitForEnd(deadline);
    if (!hasEnded) {
        // It may have left its group.
        for (const pid_t target : {-m_program, m_program}) ::kill(target, SIGTERM);
        if (!waitForEnd(steady_clock::now() + milliseconds(300)))
            for (const pid_t target : {-m_program, m_program}) ::kill(target, SIGKILL);
        waitForEnd(steady_clock::now() + std::chrono::seconds(5));
    }
    if (m_errors >= 0) ::close(m_errors);
    m_errors = -1;
    m_program = -1;
    return hasEnded;
}

}  // namespace rendering
