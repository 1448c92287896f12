// vis2hap-page: the participant's page for a browser in the same room. The app starts it, sends it codes and instructions on
// standard input, and reads the acts of the participant from standard output. It opens no file and ends with its parent.
#include <sys/prctl.h>
#include <unistd.h>

#include <QCommandLineParser>
#include <QCoreApplication>
#include <QSocketNotifier>
#include <array>
#include <csignal>
#include <cstdio>
#include <optional>

#include "protocols/files/errors.h"
#include "study/participant/page/page_server.h"

namespace {

using namespace study::participant;

void writeLine(const LineFromPage& line)
{
    const std::string text = lineOf(line) + "\n";
    std::fwrite(text.data(), 1, text.size(), stdout);
    if (std::fflush(stdout) != 0) QCoreApplication::exit(1);  // nobody listens any more
}

int report(const std::exception& fault, int code)
{
    std::fprintf(stderr, "vis2hap-page: %s\n", fault.what());
    return code;
}

/// Gives every line of standard input to the page; ends the program with the input.
class InputReader {
public:
    explicit InputReader(PageServer& server) : m_server(server), m_notifier(STDIN_FILENO, QSocketNotifier::Read)
    {
        QObject::connect(&m_notifier, &QSocketNotifier::activated, &m_notifier, [this] { read(); });
    }

private:
    void read()
    {
        std::array<char, 65536> bytes{};
        const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
        if (count <= 0) return QCoreApplication::exit(0);
        try {
            for (const std::string& line : m_lines.take({bytes.data(), static_cast<std::size_t>(count)}))
                m_server.take(lineToPage(line));
        } catch (const protocols::Error& fault) {
            // The app never sends such a line; the page cannot know what it should show.
            QCoreApplication::exit(report(fault, 1));
        }
    }

    PageServer& m_server;
    LineBuffer m_lines;
    QSocketNotifier m_notifier;
};

int wholeNumber(const QCommandLineParser& parser, const QString& option, int least, int most)
{
    bool isNumber = false;
    const int number = parser.value(option).toInt(&isNumber);
    if (!isNumber || number < least || number > most)
        throw protocols::badInput({"--" + option.toStdString() + " " + parser.value(option).toStdString(), "the command line",
                                   "a whole number from " + std::to_string(least) + " to " + std::to_string(most), ""});
    return number;
}

int serve(const QCommandLineParser& parser)
{
    const QHostAddress address(parser.value("address"));
    if (address.isNull())
        throw protocols::badInput({"--address " + parser.value("address").toStdString(), "the command line",
                                   "an address of this computer such as 127.0.0.1", ""});
    AccessLimits limits;
    limits.wait = std::chrono::seconds(wholeNumber(parser, "wait", 1, 3600));
    ConnectionLimits connections;
    connections.lastsMs = 1000 * wholeNumber(parser, "seconds", 1, 3600);
    PageServer server(address, static_cast<quint16>(wholeNumber(parser, "port", 0, 65535)), limits, connections, writeLine);
    const InputReader reader(server);
    writeLine(Listening{server.port()});
    return QCoreApplication::exec();
}

}  // namespace

int main(int argc, char** argv)
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // also where the end of the input is not noticed
    ::close_range(3, ~0U, 0);            // files that a parent of the app left open are none of this program's
    std::signal(SIGPIPE, SIG_IGN);
    QCoreApplication app(argc, argv);
    QCommandLineParser parser;
    parser.setApplicationDescription(
        "The participant's page of Vis2Hap, for a browser in the same room. The app starts this program.");
    parser.addOptions({{"address", "Listen at this address of the computer.", "ADDRESS", "127.0.0.1"},
                       {"port", "Listen at this port, or at any free one if it is taken.", "PORT", "8577"},
                       {"wait", "Wait this long after five wrong codes, s.", "SECONDS", "30"},
                       {"seconds", "End a connection after this time, s.", "SECONDS", "10"}});
    parser.addHelpOption();
    parser.process(app);
    try {
        return serve(parser);
    } catch (const protocols::Error& fault) {
        return report(fault, static_cast<int>(fault.exitCode()));
    }
}
