// Connection to a display's driver: a program that is started here, or a TCP connection. It sends bytes and receives
// lines, always with a deadline. A driver that ends or floods the connection is a state of the link, not a signal and
// not an exception.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "rendering/display/driver_lines.h"

namespace rendering {

using Instant = std::chrono::steady_clock::time_point;

/// Address of a driver: a command for the shell, or host and port.
struct DriverAddress {
    std::string command;
    std::string host, port;

    bool isProgram() const { return !command.empty(); }
    std::string text() const;  ///< "exec:COMMAND" or "tcp:HOST:PORT"
};

/// Returns nullopt for other kinds of display. Throws badInput for "exec:" without a command or "tcp:" without host or port.
std::optional<DriverAddress> driverAddressFrom(const std::string& specification);

class DriverLink {
public:
    /// The link is lost from the beginning where the program cannot be started or the connection is refused. `stop` loses the
    /// link at once: every wait ends, and the driver gets no time to end by itself.
    DriverLink(const DriverAddress& address, Instant deadline, const std::stop_token& stop = {});
    /// Ends the driver like `close`.
    ~DriverLink();
    DriverLink(const DriverLink&) = delete;
    DriverLink& operator=(const DriverLink&) = delete;

    /// Returns false where the deadline passed or the driver was lost before all bytes were sent.
    bool send(std::string_view bytes, Instant deadline);
    /// The next line without its line end; nullopt where the deadline passed or the driver was lost. Lines that have already
    /// arrived are returned even after the deadline, so a caller that waits for a certain line must check the time.
    std::optional<std::string> receive(Instant deadline);

    bool isLost() const { return !m_trouble.empty(); }
    /// True where a whole line was read ahead; the socket does not report it again.
    bool hasLineWaiting() const { return m_incoming.hasNext(); }
    /// Reason of the loss, such as "ended with exit code 3", with the driver's error text; empty while the link works.
    std::string trouble();
    /// Descriptors that become readable when something arrives; errorStream() is -1 where there is none.
    int socket() const { return m_socket; }
    int errorStream() const { return m_errors; }

    /// Closes the driver's input. A program that has not ended by the deadline is killed. Returns true where it ended by
    /// itself, and always for a connection.
    bool close(Instant deadline);

private:
    void startProgram(const std::string& command);
    void connectTo(const DriverAddress& address, Instant deadline);
    void pump(short events, Instant deadline);
    void takeIn();
    void takeErrors();
    std::optional<std::string> nextLine();
    bool waitForEnd(Instant deadline);

    std::stop_token m_stop;
    int m_socket = -1;
    int m_errors = -1;
    pid_t m_program = -1;
    bool m_hasEnded = false;      ///< the program
    std::optional<int> m_ending;  ///< status from waitpid; nullopt where another handler took it
    DriverLines m_incoming;
    std::string m_errorText, m_trouble;
};

}  // namespace rendering
