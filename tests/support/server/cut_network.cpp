#include "tests/support/server/cut_network.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <span>
#include <stdexcept>

namespace tests::support {

namespace {

sockaddr_in localAddress(int port)
{
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

/// In the message BackendKeyData, where there is one: 'K', the length 12, the number (PostgreSQL manual, 55.7).
void changeProcessNumber(std::span<char> bytes)
{
    constexpr std::array<char, 5> head{'K', 0, 0, 0, 12};
    const auto found = std::ranges::search(bytes, head);
    if (bytes.end() - found.begin() >= 9) found.begin()[8] = static_cast<char>(found.begin()[8] ^ 1);
}

}  // namespace

CutNetwork::CutNetwork(int serverPort) : m_serverPort(serverPort)
{
    m_listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address = localAddress(0);
    socklen_t length = sizeof address;
    if (::bind(m_listener, reinterpret_cast<sockaddr*>(&address), length) != 0 || ::listen(m_listener, 64) != 0 ||
        ::getsockname(m_listener, reinterpret_cast<sockaddr*>(&address), &length) != 0)
        throw std::runtime_error("no port for the relay");
    m_port = ntohs(address.sin_port);
    m_thread = std::thread([this] { run(); });
}

CutNetwork::~CutNetwork()
{
    m_state = State::Ended;
    m_thread.join();
    closeAll();
    ::close(m_listener);
}

void CutNetwork::closeAll()
{
    for (const Pair& pair : m_pairs) {
        ::close(pair.client);
        ::close(pair.server);
    }
    m_pairs.clear();
}

bool CutNetwork::carry(int from, int to) const
{
    std::array<char, 1 << 16> bytes{};
    const ssize_t count = ::recv(from, bytes.data(), bytes.size(), 0);
    if (count <= 0) return false;
    if (m_isPooler) changeProcessNumber({bytes.data(), static_cast<std::size_t>(count)});
    for (ssize_t sent = 0; sent < count;) {
        const ssize_t part = ::send(to, bytes.data() + sent, static_cast<std::size_t>(count - sent), MSG_NOSIGNAL);
        if (part <= 0) return false;
        sent += part;
    }
    return true;
}

void CutNetwork::run()
{
    while (m_state != State::Ended) {
        if (m_state == State::Cut) closeAll();
        if (m_state == State::Silent) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            continue;
        }
        std::vector<pollfd> waiting{{m_listener, POLLIN, 0}};
        for (const Pair& pair : m_pairs) {
            waiting.push_back({pair.client, POLLIN, 0});
            waiting.push_back({pair.server, POLLIN, 0});
        }
        ::poll(waiting.data(), waiting.size(), 2);
        if (m_state != State::Open) {
            if ((waiting[0].revents & POLLIN) != 0 && m_state == State::Cut) ::close(::accept(m_listener, nullptr, nullptr));
            continue;
        }
        std::vector<Pair> open;
        for (std::size_t i = 0; i < m_pairs.size(); ++i) {
            const auto& [client, server] = m_pairs[i];
            bool isOpen = true;
            if (waiting[1 + 2 * i].revents != 0) isOpen = carry(client, server);
            if (isOpen && waiting[2 + 2 * i].revents != 0) isOpen = carry(server, client);
            if (isOpen) {
                open.push_back(m_pairs[i]);
            } else {
                ::close(client);
                ::close(server);
            }
        }
        m_pairs = std::move(open);
        if ((waiting[0].revents & POLLIN) != 0) {
            const int client = ::accept4(m_listener, nullptr, nullptr, SOCK_CLOEXEC);
            const int server = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
            const sockaddr_in address = localAddress(m_serverPort);
            if (::connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
                m_pairs.push_back({client, server});
            } else {
                ::close(client);
                ::close(server);
            }
        }
    }
}

}  // namespace tests::support
