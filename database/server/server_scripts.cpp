#include "database/server/server_scripts.h"

#include <QFile>
#include <string>

#include "protocols/files/errors.h"

namespace database {

QString serverScript(const char* name)
{
    QFile file(QStringLiteral(":/server/%1.sql").arg(QLatin1String(name)));
    if (!file.open(QIODevice::ReadOnly))
        throw protocols::workFailed({"a part of this program is missing", std::string(name) + ".sql", "", "install it again"});
    return QString::fromUtf8(file.readAll());
}

}  // namespace database
