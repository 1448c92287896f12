// Runs the built program as a user does, and captures its output.
#pragma once

#include <QProcess>
#include <QString>
#include <QStringList>

namespace support {

struct ProgramResult {
    int exitCode = -1;
    QString out;
    QString err;

    /// Lines of standard error that are messages, not progress.
    QStringList messages() const;
};

/// Runs the program to its end. `environment`: entries "NAME=value" added to the environment of the test.
ProgramResult runProgram(const QStringList& arguments, const QStringList& environment = {});

/// Runs the program. Throws std::runtime_error with its error output if its exit code is not 0.
ProgramResult mustRun(const QStringList& arguments, const QStringList& environment = {});

/// Starts the program and leaves it running.
void startProgram(QProcess& process, const QStringList& arguments);

}  // namespace support
