// What a person with a shell and the tools of SQLite does to a study, for the tests of `verify`.
#pragma once

#include <QString>
#include <QStringList>
#include <stdexcept>
#include <string>

#include "database/study_store.h"
#include "study/records/study_faults.h"
#include "tests/support/raw_sqlite.h"

namespace tests::meddling {

using support::RawSqlite;

inline database::StudyStore reading(const database::StudyFolder& folder) { return {folder, database::StudyStore::Access::Read}; }

inline QString faultsOf(const database::StudyFolder& folder)
{
    QStringList lines;
    for (const auto& fault : study::records::findingsOf(reading(folder)).faults) lines << QString::fromStdString(fault);
    return lines.join('\n');
}

/// Runs the statements without the triggers, and puts these back as they were.
inline void meddle(const database::StudyFolder& folder, const std::string& sql)
{
    RawSqlite raw(folder.database());
    const auto triggers = raw.rows("SELECT sql FROM sqlite_master WHERE type = 'trigger'");
    raw.dropTriggers();
    const std::string fault = raw.run("PRAGMA foreign_keys = 0; " + sql);
    if (!fault.empty()) throw std::runtime_error(fault + ": " + sql);
    for (const auto& trigger : triggers) raw.run(trigger);
}

}  // namespace tests::meddling
