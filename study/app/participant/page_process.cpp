#include "study/app/participant/page_process.h"

#include <sys/prctl.h>

#include <QCoreApplication>
#include <QFileInfo>
#include <csignal>
#include <utility>

#include "protocols/files/errors.h"

namespace study::app {

QString pageProgram()
{
    if (const QString chosen = qEnvironmentVariable("VIS2HAP_PAGE"); !chosen.isEmpty()) return chosen;
    const QString folder = QCoreApplication::applicationDirPath();
    for (const QString& candidate : {folder + QStringLiteral("/vis2hap-page"), folder + QStringLiteral("/../vis2hap-page")})
        if (QFileInfo(candidate).isExecutable()) return QFileInfo(candidate).canonicalFilePath();
    throw protocols::environmentFault({.what = "the program vis2hap-page is missing",
                                       .where = folder.toStdString(),
                                       .expected = "vis2hap-page beside vis2hap",
                                       .nextStep = "install qt6-httpserver-dev and build again, or use the second screen"});
}

PageProcess::PageProcess(QObject* parent) : QObject(parent) {}

PageProcess::~PageProcess() { stop(); }

void PageProcess::start(const QString& address, int port)
{
    stop();
    const QString program = pageProgram();
    m_process.reset(new QProcess);
    m_process->setWorkingDirectory(QStringLiteral("/"));
    // Nothing of this program's surroundings concerns a page that strangers can reach.
    QProcessEnvironment surroundings;
    surroundings.insert(QStringLiteral("LC_ALL"), QStringLiteral("C.UTF-8"));
    m_process->setProcessEnvironment(surroundings);
    m_process->setChildProcessModifier([] { ::prctl(PR_SET_PDEATHSIG, SIGKILL); });
    connect(m_process.get(), &QProcess::readyReadStandardOutput, this, &PageProcess::read);
    connect(m_process.get(), &QProcess::finished, this, [this] {
        const QString said = QString::fromUtf8(m_process->readAllStandardError()).trimmed().section(QLatin1Char('\n'), -1);
        end(said.isEmpty() ? tr("the program ended") : said.mid(said.indexOf(QLatin1String(": ")) + 2));
    });
    connect(m_process.get(), &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
        if (error == QProcess::FailedToStart) end(m_process->errorString());
    });
    m_process->start(program, {QStringLiteral("--address"), address, QStringLiteral("--port"), QString::number(port)});
}

void PageProcess::stop()
{
    if (!m_process) return;
    m_process->disconnect(this);
    m_process->closeWriteChannel();  // the program ends with its input
    constexpr int patienceMs = 500;
    if (!m_process->waitForFinished(patienceMs)) {
        m_process->kill();
        m_process->waitForFinished(patienceMs);
    }
    m_process.reset();
    m_lines = {};
}

void PageProcess::send(const participant::LineToPage& line)
{
    if (m_process) m_process->write(QByteArray::fromStdString(lineOf(line) + "\n"));
}

void PageProcess::read()
{
    try {
        for (const std::string& line : m_lines.take(m_process->readAllStandardOutput().toStdString())) {
            Q_EMIT lineRead(participant::lineFromPage(line));
            if (!m_process) return;  // who heard the line has stopped the program
        }
    } catch (const protocols::Error& fault) {
        const QString why = QString::fromUtf8(fault.what());
        stop();
        Q_EMIT ended(why);
    }
}

void PageProcess::end(const QString& why)
{
    if (!m_process) return;
    m_process->disconnect(this);
    m_process.reset();
    m_lines = {};
    Q_EMIT ended(why);
}

}  // namespace study::app
