// The way to a display's driver and back: a program that is started here, or a TCP connection. Bytes
// out, lines in, never without a deadline; a driver that dies or babbles is a state of the link, not a
// signal and not an exception.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace rendering {

using Instant = std::chrono::steady_clock::time_point;

/// Where a driver is to be had: a command for the shell, or host and port.
struct DriverAddress {
    std::string command;
    std::string host, port;

    bool isProgram() const { return !command.empty(); }
    std::string text() const;  ///< "exec:COMMAND", "tcp:HOST:PORT"
};

/// None for other kinds of display. Throws badInput for "exec:" without a command or "tcp:" without host or port.
std::optional<DriverAddress> driverAddressFrom(const std::string& specification);

class DriverLink {
public:
    static constexpr std::size_t longestLine = 65536;

    /// Where the program cannot be started or nobody takes the connection it is lost from the beginning.
    DriverLink(const DriverAddress& address, Instant deadline);
    /// Ends it as `close` does.
    ~DriverLink();
    DriverLink(const DriverLink&) = delete;
    DriverLink& operator=(const DriverLink&) = delete;

    /// False where the deadline passed or the driver was lost before all of it went out.
    bool send(std::string_view bytes, Instant deadline);
    /// The next line without its end; none where the deadline passed or the driver was lost. Lines that are there
    /// already are given out even then, so whoever waits for a certain one minds the time itself.
    std::optional<std::string> receive(Instant deadline);

    bool isLost() const { return !m_trouble.empty(); }
    /// A whole line was read ahead; the socket will not tell of it again.
    bool hasLineWaiting() const { return m_incoming.find('\n') != std::string::npos; }
    /// Why it was lost: "ended with exit code 3", with what it wrote to standard error; empty while all is well.
    std::string trouble();
    /// Can be read when there is something to receive; the second, its standard error, is -1 where there is none.
    int socket() const { return m_socket; }
    int errorStream() const { return m_errors; }

    /// Gives the driver its end of file. A program that has not ended by the deadline is ended. True where
    /// it ended by itself; always for a connection.
    bool close(Instant deadline);

private:
    void startProgram(const std::string& command);
    void connectTo(const DriverAddress& address, Instant deadline);
    void pump(short events, Instant deadline);
    void takeIn();
    void takeErrors();
    std::optional<std::string> nextLine();
    bool waitForEnd(Instant deadline);

    int m_socket = -1;
    int m_errors = -1;
    pid_t m_program = -1;
    std::optional<int> m_ending;  ///< as waitpid tells it
    std::string m_incoming, m_errorText, m_trouble;
    std::size_t m_searched = 0;  ///< so much of what came in holds no line end
};

}  // namespace rendering
