#include "database/evidence/finger_records.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "database/disk/finger_text.h"
#include "database/sqlite_connection.h"

namespace database {

namespace {

bool isSamePresentation(const FingerRecord& a, const FingerRecord& b)
{
    return a.participant == b.participant && a.trial == b.trial && a.attempt == b.attempt;
}

/// Whether the row was measured by another clock than the samples before it: each sitting begins its own, at any time.
bool isOfAnotherClock(const FingerRecord& record, const QSqlQuery& row)
{
    return !record.samples.empty() && row.value(4).toLongLong() < record.samples.back().atNs;
}

/// Adds the row to the record. Samples that do not come later are left out.
void addRow(FingerRecord& record, const QSqlQuery& row)
{
    const auto samples = fingerSamplesFrom(fromQt(row.value(6)), row.value(4).toLongLong());
    if (!samples) {
        ++record.unreadable;
        return;
    }
    constexpr std::int64_t most = std::numeric_limits<int>::max();
    record.leftOut = static_cast<int>(std::clamp<std::int64_t>(std::int64_t{record.leftOut} + row.value(5).toInt(), 0, most));
    for (const protocols::FingerSample& sample : *samples)
        if (record.samples.empty() || sample.atNs > record.samples.back().atNs) record.samples.push_back(sample);
}

}  // namespace

void eachFingerRecord(const StudyStore& store, const protocols::ParticipantId& participant,
                      const std::function<void(const FingerRecord&)>& take)
{
    const SqliteConnection& sqlite = store.connection();
    const ReadSnapshot snapshot(sqlite);
    QSqlQuery row = sqlite.run(
        QStringLiteral(
            "SELECT participant, trial, attempt, EXISTS (SELECT 1 FROM voids v WHERE v.participant = f.participant AND "
            "v.trial = f.trial AND v.attempt = f.attempt), began_at, left_out, samples FROM finger_samples f "
            "WHERE participant = ? OR ? = '' ORDER BY participant, trial, attempt, id"),
        {toQt(participant.value), toQt(participant.value)});
    std::optional<FingerRecord> current;
    while (row.next()) {
        FingerRecord next{protocols::ParticipantId(fromQt(row.value(0))),
                          {row.value(1).toInt()},
                          row.value(2).toInt(),
                          row.value(3).toInt() != 0,
                          {},
                          0};
        if (current && (!isSamePresentation(*current, next) || isOfAnotherClock(*current, row))) {
            take(*current);
            current.reset();
        }
        if (!current) current = std::move(next);
        addRow(*current, row);
    }
    if (current) take(*current);
}

std::int64_t fingerSampleCount(const StudyStore& store, const protocols::ParticipantId& participant)
{
    const SqliteConnection& sqlite = store.connection();
    return sqlite
        .value(QStringLiteral("SELECT TOTAL(count) FROM finger_samples WHERE participant = ? OR ? = ''"),
               {toQt(participant.value), toQt(participant.value)})
        .toLongLong();
}

}  // namespace database
