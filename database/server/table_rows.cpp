#include "database/server/table_rows.h"

#include <QSqlRecord>
#include <nlohmann/json.hpp>

#include "protocols/files/canonical_bytes.h"

namespace database {

namespace {

struct Table {
    const char* name;
    const char* order;        ///< in the file
    const char* serverOrder;  ///< on the server, where SQLite's row numbers are the column position
};

/// A table stands after those that it refers to.
constexpr Table tables[] = {
    {"study", "id", "id"},
    {"fabrics", "position", "position"},
    {"stimuli", "file_code", "file_code"},
    {"slots", "number", "number"},
    {"trials", "slot, number", "slot, number"},
    {"participants", "rowid", "position"},
    {"events", "sequence", "sequence"},
    {"responses", "id", "id"},
    {"voids", "rowid", "position"},
    {"notes", "id", "id"},
    {"finger_samples", "id", "id"},
    {"unblindings", "event", "event"},
    {"participant_facts", "participant, fact", "participant, fact"},
    {"swatches", "slot, fabric", "slot, fabric"},
    {"familiarisation", "position", "position"},
    {"protocol_versions", "version", "version"},
    {"erasures", "event", "event"},
    {"acts", "number", "number"},
};

constexpr int rowsOfStatement = 500;

QStringList columnsOf(const SqliteConnection& file, const Table& table)
{
    QStringList columns;
    QSqlQuery row =
        file.run(QStringLiteral("SELECT name FROM pragma_table_info(?) ORDER BY cid"), {QString(QLatin1String(table.name))});
    while (row.next()) columns << row.value(0).toString();
    return columns;
}

QString selection(const QStringList& columns, const QString& table, const char* order)
{
    return QStringLiteral("SELECT %1 FROM %2 ORDER BY %3").arg(columns.join(QStringLiteral(", ")), table, QLatin1String(order));
}

nlohmann::json valueOf(const QVariant& value)
{
    if (value.isNull()) return nullptr;
    if (value.typeId() == QMetaType::QString) return fromQt(value);
    return std::int64_t{value.toLongLong()};
}

void sendTable(const SqliteConnection& file, const ServerConnection& server, const Table& table)
{
    const QStringList columns = columnsOf(file, table);
    const QString list = columns.join(QStringLiteral(", "));
    const QString insertion = QStringLiteral(
                                  "INSERT INTO @schema@.%1(%2) SELECT %2 FROM json_populate_recordset(CAST(NULL AS @schema@.%1), "
                                  "CAST(? AS json))")
                                  .arg(QLatin1String(table.name), list);
    nlohmann::json rows = nlohmann::json::array();
    const auto send = [&] {
        if (!rows.empty()) server.run(insertion, {toQt(rows.dump())});
        rows = nlohmann::json::array();
    };
    QSqlQuery row = file.run(selection(columns, QLatin1String(table.name), table.order));
    while (row.next()) {
        nlohmann::json& one = rows.emplace_back(nlohmann::json::object());
        for (int column = 0; column < columns.size(); ++column) one[columns[column].toStdString()] = valueOf(row.value(column));
        if (rows.size() == rowsOfStatement) send();
    }
    send();
}

void fetchTable(const ServerConnection& server, const SqliteConnection& file, const Table& table)
{
    const QStringList columns = columnsOf(file, table);
    QStringList places;
    for (qsizetype i = 0; i < columns.size(); ++i) places << QStringLiteral("?");
    const QString insertion =
        QStringLiteral("INSERT INTO %1(%2) VALUES (%3)")
            .arg(QLatin1String(table.name), columns.join(QStringLiteral(", ")), places.join(QStringLiteral(", ")));
    QSqlQuery row =
        server.run(selection(columns, QStringLiteral("@schema@.%1").arg(QLatin1String(table.name)), table.serverOrder));
    while (row.next()) {
        QVariantList values;
        for (int column = 0; column < columns.size(); ++column) values << row.value(column);
        file.runKept(insertion, values);
    }
    server.requireRead(row);
}

}  // namespace

void sendRows(const SqliteConnection& file, const ServerConnection& server)
{
    for (const Table& table : tables) sendTable(file, server, table);
}

void fetchRows(const ServerConnection& server, const SqliteConnection& file)
{
    Transaction transaction(file);
    for (const Table& table : tables) fetchTable(server, file, table);
    transaction.commit();
}

std::string hashOfAllRows(const SqliteConnection& file)
{
    protocols::CanonicalBytes bytes;
    for (const Table& table : tables) {
        // Columns by name, because an upgraded table has them in another order.
        QStringList columns = columnsOf(file, table);
        columns.sort();
        bytes << std::string(table.name);
        QSqlQuery row = file.run(selection(columns, QLatin1String(table.name), table.order));
        while (row.next())
            for (int column = 0; column < columns.size(); ++column)
                bytes << (row.value(column).isNull() ? std::optional<std::string>() : std::optional(fromQt(row.value(column))));
    }
    return bytes.hash();
}

}  // namespace database
