#include "study/app/server_bar.h"

#include "study/app/language/below.h"

namespace study::app {

void ServerBar::present(const std::optional<database::StationStore::Link>& link)
{
    if (!link) return clearMessage();
    const QString station = QString::fromStdString(link->station);
    if (!link->isUp && link->waiting == 0)
        showFault(tr("Station %1: the server cannot be reached. No entry waits on this computer.").arg(station));
    else if (!link->isUp)
        showFault(tr("Station %1: the server cannot be reached. Entries that wait on this computer: %2. They are sent "
                     "when the server is back.")
                      .arg(station)
                      .arg(link->waiting));
    else if (!link->fault.empty())
        showFault(inOwnLanguage(link->fault.c_str()));
    else
        showDone(tr("Station %1: every answer is on the server.").arg(station));
}

}  // namespace study::app
