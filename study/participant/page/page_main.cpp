// vis2hap-page: the participant's page for a browser in the same room. The app starts it, sends it codes and instructions on
// standard input, and reads the acts of the participant from standard output. It opens no file and ends with its parent.
#include <QCommandLineParser>
#include <QCoreApplication>
#include <cstdio>

#include "protocols/files/errors.h"
#include "study/participant/page/page_server.h"
#include "study/participant/programs/child_program.h"

namespace {

using namespace study::participant;

constexpr const char* program = "vis2hap-page";

void writeLine(const LineFromPage& line)
{
    const std::string text = lineOf(line) + "\n";
    std::fwrite(text.data(), 1, text.size(), stdout);
    if (std::fflush(stdout) != 0) QCoreApplication::exit(1);  // nobody listens any more
}

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
    const InputLines input(program, [&](const std::string& line) { server.take(lineToPage(line)); });
    writeLine(Listening{server.port()});
    return QCoreApplication::exec();
}

}  // namespace

int main(int argc, char** argv)
{
    becomeChildProgram();
    // Qt warns of odd requests, which anybody in the network can send; the app would keep the texts.
    qInstallMessageHandler([](QtMsgType type, const QMessageLogContext&, const QString& text) {
        if (type == QtCriticalMsg || type == QtFatalMsg) std::fprintf(stderr, "%s: %s\n", program, qPrintable(text));
    });
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
        return reported(program, fault, static_cast<int>(fault.exitCode()));
    }
}
