// The columns of the table `responses` as one list. It drives the table's creation, every INSERT and SELECT, the hash chain and
// the audit.
#pragma once

#include <QSqlQuery>
#include <QString>
#include <QVariantList>
#include <cstdint>
#include <optional>
#include <string>

#include "protocols/files/canonical_bytes.h"

namespace database {

/// A row of `responses` without its id and its event.
struct ResponseRow {
    std::string participant;
    int trial = 0;
    int attempt = 1;
    std::string question, presentationCode, alternatives;
    std::optional<std::string> choice;
    std::optional<int> ratingTenths;
    std::int64_t readyAt = 0;
    std::optional<std::int64_t> touchedAt;
    std::int64_t answeredAt = 0, storedAt = 0;
    bool isCorrection = false;
    std::optional<std::string> touchedBy;
    std::optional<std::int64_t> touchEndedAt, answerBegunAt;
    std::optional<std::string> answerBegunBy;
    std::optional<int> entries;
};

/// Which columns a statement reads.
enum class ResponseColumns {
    OfTable,           ///< all of `responses`
    OfCurrentAnswers,  ///< no column that only marks a row as a correction
};

/// "participant TEXT NOT NULL, trial INTEGER NOT NULL, …": the columns of the table.
QString definitions();

/// "first.participant AS participant, …, latest.choice AS choice, …": a correction replaces the answer and keeps its times.
QString currentAnswerColumns();

/// "participant, trial, …" for SELECT and INSERT.
QString namesOf(ResponseColumns columns);

/// The same of the whole table with texts as their bytes: reading them as text repairs what is no UTF-8.
QString bytesOfTable();

/// "?, ?, …", one for each column of the table.
QString placeholders();

/// The row's values in the order of the table's columns.
QVariantList valuesOf(const ResponseRow& row);

/// The row that a query on namesOf(columns) stands on. `first`: the place of the first of these columns in the query.
ResponseRow rowFrom(const QSqlQuery& query, ResponseColumns columns, int first);

/// Adds to the bytes what stays after an erasure: the place of the answer.
void addPlaceTo(protocols::CanonicalBytes& bytes, const ResponseRow& row);

/// Adds to the bytes what an erasure removes: everything else.
void addContentTo(protocols::CanonicalBytes& bytes, const ResponseRow& row);

}  // namespace database
