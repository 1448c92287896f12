#include "tests/support/program.h"

#include <stdexcept>

namespace support {

namespace {

constexpr int longestMs = 300'000;

QProcessEnvironment environmentWith(const QStringList& more)
{
    auto environment = QProcessEnvironment::systemEnvironment();
    environment.remove("DISPLAY");
    environment.remove("WAYLAND_DISPLAY");
    environment.remove("QT_QPA_PLATFORM");
    environment.insert("VIS2HAP_CACHE_MB", "0");  // a test sees no result of another one
    for (const auto& entry : more) environment.insert(entry.section('=', 0, 0), entry.section('=', 1));
    return environment;
}

}  // namespace

QStringList ProgramResult::messages() const
{
    QStringList lines;
    for (const auto& line : err.split('\n', Qt::SkipEmptyParts))
        if (line.startsWith("vis2hap:")) lines << line;
    return lines;
}

ProgramResult runProgram(const QStringList& arguments, const QStringList& environment)
{
    QProcess process;
    process.setProcessEnvironment(environmentWith(environment));
    process.start(VIS2HAP_PROGRAM, arguments);
    process.waitForFinished(longestMs);
    ProgramResult ended;
    ended.exitCode = process.exitStatus() == QProcess::NormalExit ? process.exitCode() : 128 + process.exitCode();
    ended.out = QString::fromUtf8(process.readAllStandardOutput());
    ended.err = QString::fromUtf8(process.readAllStandardError());
    return ended;
}

ProgramResult mustRun(const QStringList& arguments, const QStringList& environment)
{
    const auto ended = runProgram(arguments, environment);
    if (ended.exitCode != 0)
        throw std::runtime_error(QString("%1 ended with %2: %3")
                                     .arg(arguments.join(' '))
                                     .arg(ended.exitCode)
                                     .arg(ended.err.isEmpty() ? ended.out : ended.err)
                                     .toStdString());
    return ended;
}

void startProgram(QProcess& process, const QStringList& arguments)
{
    process.setProcessEnvironment(environmentWith({}));
    process.setProcessChannelMode(QProcess::MergedChannels);
    process.start(VIS2HAP_PROGRAM, arguments);
    process.waitForStarted();
}

}  // namespace support
