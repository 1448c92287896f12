#include "database/evidence/stored_tables.h"

#include "database/sqlite_connection.h"

namespace database {

std::vector<StoredTable> storedTables(const StudyStore& store)
{
    const SqliteConnection& sqlite = store.connection();
    const ReadSnapshot snapshot(sqlite);
    std::vector<StoredTable> tables;
    QSqlQuery name = sqlite.run(
        QStringLiteral("SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite\\_%' ESCAPE '\\' "
                       "ORDER BY rowid"));
    while (name.next()) {
        const QString quoted =
            QLatin1Char('"') + name.value(0).toString().replace(QLatin1Char('"'), QStringLiteral("\"\"")) + QLatin1Char('"');
        StoredTable table{fromQt(name.value(0)), {}, sqlite.value(QStringLiteral("SELECT COUNT(*) FROM ") + quoted).toLongLong()};
        QSqlQuery column = sqlite.run(QStringLiteral("SELECT name FROM pragma_table_info(?) ORDER BY cid"), {name.value(0)});
        while (column.next()) table.columns.push_back(fromQt(column.value(0)));
        tables.push_back(std::move(table));
    }
    return tables;
}

}  // namespace database
