#include "study/app/server_bar.h"

#include <cstdlib>

#include "study/app/language/below.h"

namespace study::app {

namespace {

constexpr std::chrono::seconds largestClockError{60};

}  // namespace

QString ServerBar::faultOf(const database::StationStore::Link& link)
{
    const QString station = QString::fromStdString(link.station);
    QString text;
    if (!link.isUp) {
        text = link.isRefused ? tr("Station %1: the server takes nothing from this station now.").arg(station)
                              : tr("Station %1: the server cannot be reached.").arg(station);
        text += ' ' +
                (link.waiting == 0
                     ? tr("No entry waits on this computer.")
                     : tr("Entries that wait on this computer: %1. They are sent when the server takes them.").arg(link.waiting));
        if (!link.fault.empty()) text += ' ' + tr("Reason: %1").arg(inOwnLanguage(link.fault));
    } else if (link.waiting > 0) {
        text = tr("Station %1: entries wait on this computer: %2. They are being sent.").arg(station).arg(link.waiting);
    }
    return text;
}

QString ServerBar::lossOf(const database::StationStore::Link& link)
{
    if (!link.lostAfter) return {};
    return tr("The server lost entries after entry %1 that this station had seen. Ask the study's owner before anybody goes on.")
        .arg(*link.lostAfter);
}

QString ServerBar::clockFaultOf(const database::StationStore::Link& link)
{
    const auto seconds = link.clockAhead.count();
    if (std::abs(seconds) <= largestClockError.count()) return {};
    return (seconds > 0 ? tr("The clock of this computer is %1 s ahead of the server's clock. Set it before the next session.")
                        : tr("The clock of this computer is %1 s behind the server's clock. Set it before the next session."))
        .arg(std::abs(seconds));
}

void ServerBar::present(const std::optional<database::StationStore::Link>& link)
{
    if (!link) return clearMessage();
    QStringList faults;
    for (const QString& line : QString::fromStdString(link->setAside).split('\n', Qt::SkipEmptyParts))
        faults << inOwnLanguage(line);
    for (const QString& fault : {lossOf(*link), faultOf(*link), clockFaultOf(*link)})
        if (!fault.isEmpty()) faults << fault;
    if (faults.isEmpty())
        showDone(tr("Station %1: every answer is on the server.").arg(QString::fromStdString(link->station)));
    else
        showFault(faults.join(' '));
}

}  // namespace study::app
