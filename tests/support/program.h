// Runs the built program as a user does, and keeps what it says.
#pragma once

#include <QProcess>
#include <QString>
#include <QStringList>

namespace support {

struct Ended {
    int exitCode = -1;
    QString out;
    QString err;

    /// The lines of standard error that are not progress.
    QStringList complaints() const;
};

/// `environment`: "NAME=value" on top of the test's own.
Ended runProgram(const QStringList& arguments, const QStringList& environment = {});

/// Throws std::runtime_error with what the program said, unless it ended with 0.
Ended mustRun(const QStringList& arguments, const QStringList& environment = {});

/// Started and left running, offscreen.
void startProgram(QProcess& process, const QStringList& arguments);

}  // namespace support
