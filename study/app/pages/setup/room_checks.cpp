#include "study/app/pages/setup/room_checks.h"

#include <unistd.h>

#include <QDateTime>
#include <QElapsedTimer>
#include <algorithm>
#include <array>

#include "protocols/files/temporary_folder.h"
#include "study/app/language/app_text.h"

namespace study::app {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t leastRoom = 100'000'000;  // bytes
constexpr int shortWrites = 20;
constexpr qint64 longestWriteMs = 200;

/// The slowest of the writes, ms; -1 where one failed.
qint64 slowestWriteMs(const fs::path& folder)
{
    const protocols::NamelessFile nameless(folder);
    const int file = nameless.descriptor();
    if (file < 0) return -1;
    const std::array<char, 4096> page{};
    qint64 slowest = 0;
    for (int i = 0; i < shortWrites && slowest >= 0; ++i) {
        QElapsedTimer timer;
        timer.start();
        const bool isWritten =
            ::write(file, page.data(), page.size()) == static_cast<ssize_t>(page.size()) && ::fdatasync(file) == 0;
        slowest = isWritten ? std::max(slowest, timer.elapsed()) : -1;
    }
    return slowest;
}

}  // namespace

QString faultOfDatabase(const fs::path& database)
{
    std::error_code error;
    if (fs::is_regular_file(database, error)) return {};
    return AppText::
        tr("%1 is no longer in the study's folder, so no answer can be stored. Close the study, then run vis2hap rescue on its "
           "folder: closing keeps every stored answer in a rescue file.")
            .arg(QString::fromStdString(database.filename().string()));
}

QString faultOfDisk(const fs::path& folder)
{
    std::error_code error;
    const auto room = fs::space(folder, error);
    if (error) return AppText::tr("The disk of %1 cannot be asked for its room.").arg(QString::fromStdString(folder.string()));
    if (room.available < leastRoom)
        return AppText::tr("The disk has %1 MB of room left. Make room for at least 100 MB.").arg(room.available / 1'000'000);
    const qint64 slowest = slowestWriteMs(folder);
    if (slowest < 0)
        return AppText::tr("Nothing can be written into the study's folder. See whether the disk is full or locked.");
    if (slowest > longestWriteMs)
        return AppText::tr("A write took %1 ms, so an answer would wait. End other work on this disk, or use a faster one.")
            .arg(slowest);
    return {};
}

QString faultOfClocks(const std::string& lastWallTime)
{
    const auto last = QDateTime::fromString(QString::fromStdString(lastWallTime), Qt::ISODateWithMs);
    const auto now = QDateTime::currentDateTimeUtc();
    if (last.isValid() && now < last.addSecs(-1))
        return AppText::tr("The computer's clock is behind the last entry of the study. Set the clock.");
    if (QElapsedTimer::clockType() != QElapsedTimer::MonotonicClock)
        return AppText::tr("This computer has no clock that runs evenly, so response times cannot be measured.");
    return {};
}

}  // namespace study::app
