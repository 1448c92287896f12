#include "study/app/participant/line_process.h"

#include <sys/prctl.h>

#include <QCoreApplication>
#include <QFileInfo>
#include <QProcessEnvironment>
#include <csignal>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/secrets/secret_variables.h"
#include "study/app/language/below.h"

namespace study::app {

namespace {

QString programNamed(const QString& name)
{
    const QString folder = QCoreApplication::applicationDirPath();
    for (const QString& candidate : {folder + QLatin1Char('/') + name, folder + QStringLiteral("/../") + name})
        if (QFileInfo(candidate).isExecutable()) return QFileInfo(candidate).canonicalFilePath();
    throw protocols::environmentFault({.what = "the program " + name.toStdString() + " is missing",
                                       .where = folder.toStdString(),
                                       .expected = name.toStdString() + " beside vis2hap",
                                       .nextStep = "build it again with ./run; the session works without it"});
}

}  // namespace

LineProcess::LineProcess(QObject* parent) : QObject(parent) {}

LineProcess::~LineProcess() { stop(); }

void LineProcess::start(const QString& name, const QStringList& arguments, ProgramSurroundings surroundings)
{
    stop();
    const QString program = programNamed(name);
    m_process.reset(new QProcess);
    m_errors.clear();
    m_process->setWorkingDirectory(QStringLiteral("/"));
    QProcessEnvironment variables;
    if (surroundings == ProgramSurroundings::Own)
        variables = protocols::withoutSecrets(QProcessEnvironment::systemEnvironment());
    else
        variables.insert(QStringLiteral("LC_ALL"), QStringLiteral("C.UTF-8"));
    m_process->setProcessEnvironment(variables);
    m_process->setChildProcessModifier([] { ::prctl(PR_SET_PDEATHSIG, SIGKILL); });
    connect(m_process.get(), &QProcess::readyReadStandardOutput, this, &LineProcess::read);
    connect(m_process.get(), &QProcess::readyReadStandardError, this, &LineProcess::keepErrors);
    connect(m_process.get(), &QProcess::finished, this, [this] {
        keepErrors();
        const QString said = QString::fromUtf8(m_errors).trimmed().section(QLatin1Char('\n'), -1);
        end(said.isEmpty() ? tr("the program ended") : inOwnLanguage(said.mid(said.indexOf(QLatin1String(": ")) + 2)));
    });
    connect(m_process.get(), &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
        if (error == QProcess::FailedToStart) end(m_process->errorString());
    });
    m_process->start(program, arguments);
}

/// The end of what the program says of faults.
void LineProcess::keepErrors()
{
    constexpr qsizetype kept = 4096;  // bytes
    m_errors = (m_errors + m_process->readAllStandardError()).right(kept);
}

void LineProcess::stop()
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

void LineProcess::fail(const QString& why)
{
    stop();
    Q_EMIT ended(why);
}

void LineProcess::send(const std::string& line)
{
    if (m_process) m_process->write(QByteArray::fromStdString(line + "\n"));
}

void LineProcess::read()
{
    try {
        for (const std::string& line : m_lines.take(m_process->readAllStandardOutput().toStdString())) {
            Q_EMIT lineRead(line);
            if (!m_process) return;  // who heard the line has stopped the program
        }
    } catch (const protocols::Error& fault) {
        fail(inOwnLanguage(fault.what()));
    }
}

void LineProcess::end(const QString& why)
{
    if (!m_process) return;
    m_process->disconnect(this);
    m_process.reset();
    m_lines = {};
    Q_EMIT ended(why);
}

}  // namespace study::app
