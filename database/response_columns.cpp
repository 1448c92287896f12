#include "database/response_columns.h"

#include <array>
#include <string_view>
#include <variant>

#include "database/sqlite_connection.h"

namespace database {

namespace {

/// What the view of current answers shows of a column when an answer was corrected.
enum class AfterCorrection {
    OfFirst,   ///< the value of the first answer
    OfLatest,  ///< the value of the latest correction
    NotShown,
};

using Field = std::variant<std::string ResponseRow::*, int ResponseRow::*, std::int64_t ResponseRow::*, bool ResponseRow::*,
                           std::optional<std::string> ResponseRow::*, std::optional<int> ResponseRow::*,
                           std::optional<std::int64_t> ResponseRow::*>;

struct Column {
    const char* name;
    const char* declaration;
    Field field;
    AfterCorrection afterCorrection = AfterCorrection::OfFirst;
    bool isPlace = false;  ///< says which answer it is; stays after an erasure
};

constexpr const char* text = "TEXT NOT NULL";
constexpr const char* whole = "INTEGER NOT NULL";

constexpr std::array<Column, 18> allColumns{{
    {"participant", "TEXT NOT NULL REFERENCES participants(id)", &ResponseRow::participant, AfterCorrection::OfFirst, true},
    {"trial", whole, &ResponseRow::trial, AfterCorrection::OfFirst, true},
    {"attempt", whole, &ResponseRow::attempt, AfterCorrection::OfFirst, true},
    {"question", text, &ResponseRow::question, AfterCorrection::OfFirst, true},
    {"presentation_code", text, &ResponseRow::presentationCode},
    {"alternatives", text, &ResponseRow::alternatives},
    {"choice", "TEXT", &ResponseRow::choice, AfterCorrection::OfLatest},
    {"rating_tenths", "INTEGER", &ResponseRow::ratingTenths, AfterCorrection::OfLatest},
    {"ready_at", whole, &ResponseRow::readyAt},
    {"touched_at", "INTEGER", &ResponseRow::touchedAt},
    {"answered_at", whole, &ResponseRow::answeredAt},
    {"stored_at", whole, &ResponseRow::storedAt, AfterCorrection::OfLatest},
    {"is_correction", whole, &ResponseRow::isCorrection, AfterCorrection::NotShown, true},
    {"touched_by", "TEXT", &ResponseRow::touchedBy},
    {"touch_ended_at", "INTEGER", &ResponseRow::touchEndedAt},
    {"answer_begun_at", "INTEGER", &ResponseRow::answerBegunAt},
    {"answer_begun_by", "TEXT", &ResponseRow::answerBegunBy},
    {"entries", "INTEGER", &ResponseRow::entries},
}};

bool isAmong(const Column& column, ResponseColumns columns)
{
    return columns == ResponseColumns::OfTable || column.afterCorrection != AfterCorrection::NotShown;
}

QVariant valueOf(const std::string& value) { return toQt(value); }
QVariant valueOf(int value) { return value; }
QVariant valueOf(std::int64_t value) { return qlonglong(value); }
QVariant valueOf(bool value) { return int(value); }
template <class T>
QVariant valueOf(const std::optional<T>& value)
{
    return value ? valueOf(*value) : QVariant();
}

/// Of a column that a query casts to BLOB, the bytes as they are.
void read(std::string& value, const QVariant& stored)
{
    value = stored.typeId() == QMetaType::QByteArray ? stored.toByteArray().toStdString() : fromQt(stored);
}
void read(int& value, const QVariant& stored) { value = stored.toInt(); }
void read(std::int64_t& value, const QVariant& stored) { value = stored.toLongLong(); }
void read(bool& value, const QVariant& stored) { value = stored.toInt() != 0; }
template <class T>
void read(std::optional<T>& value, const QVariant& stored)
{
    value.reset();
    if (!stored.isNull()) read(value.emplace(), stored);
}

void add(protocols::CanonicalBytes& bytes, const ResponseRow& row, bool places)
{
    bytes << std::string("response");
    for (const Column& column : allColumns)
        if (column.isPlace == places) std::visit([&](auto field) { bytes << row.*field; }, column.field);
}

/// One text for each column that `wanted` takes, joined by commas.
template <class Wanted, class TextOf>
QString joined(Wanted wanted, TextOf textOf)
{
    QStringList texts;
    for (const Column& column : allColumns)
        if (wanted(column)) texts << textOf(column);
    return texts.join(QStringLiteral(", "));
}

}  // namespace

QString definitions()
{
    return joined([](const Column&) { return true; },
                  [](const Column& column) { return QLatin1String(column.name) + ' ' + QLatin1String(column.declaration); });
}

QString currentAnswerColumns()
{
    return joined([](const Column& column) { return isAmong(column, ResponseColumns::OfCurrentAnswers); },
                  [](const Column& column) {
                      const bool isOfLatest = column.afterCorrection == AfterCorrection::OfLatest;
                      return QStringLiteral("%1.%2 AS %2").arg(QString(isOfLatest ? "latest" : "first"), QString(column.name));
                  });
}

QString namesOf(ResponseColumns columns)
{
    return joined([&](const Column& column) { return isAmong(column, columns); },
                  [](const Column& column) { return QString(column.name); });
}

QString bytesOfTable()
{
    return joined([](const Column&) { return true; },
                  [](const Column& column) {
                      const bool isText = std::string_view(column.declaration).starts_with("TEXT");
                      return QString(isText ? "CAST(%1 AS BLOB)" : "%1").arg(QLatin1String(column.name));
                  });
}

QString placeholders()
{
    return joined([](const Column&) { return true; }, [](const Column&) { return QStringLiteral("?"); });
}

QVariantList valuesOf(const ResponseRow& row)
{
    QVariantList values;
    for (const Column& column : allColumns) values << std::visit([&](auto field) { return valueOf(row.*field); }, column.field);
    return values;
}

ResponseRow rowFrom(const QSqlQuery& query, ResponseColumns columns, int first)
{
    ResponseRow row;
    int place = first;
    for (const Column& column : allColumns)
        if (isAmong(column, columns)) std::visit([&](auto field) { read(row.*field, query.value(place++)); }, column.field);
    return row;
}

void addPlaceTo(protocols::CanonicalBytes& bytes, const ResponseRow& row) { add(bytes, row, true); }

void addContentTo(protocols::CanonicalBytes& bytes, const ResponseRow& row) { add(bytes, row, false); }

}  // namespace database
