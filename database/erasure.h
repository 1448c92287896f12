// Removes what is stored about a participant: facts and debriefing, or every answer and note too, from the tables, the log, the
// write-ahead log and the free pages of the file. The hashes stay, so that the rest can be verified.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "database/sqlite_connection.h"
#include "database/study_store.h"

namespace database {

/// As StudyStore::erase.
ErasureRecord eraseFrom(const SqliteConnection& sqlite, const Erasure& erasure);

/// Records that a certificate of this erasure was written, and the files that it names. `sha256`: of the certificate.
void recordCertificate(const StudyStore& store, const ErasureRecord& record, const std::string& sha256);

/// The first recorded hash of each certificate, by the entry of its erasure. Certificates of earlier versions have none.
std::map<std::int64_t, std::string> certificatesOf(const StudyStore& store);

/// STUDY/erasures, and the certificate of the erasure with this entry in it.
std::filesystem::path certificatesFolder(const StudyFolder& folder);
std::filesystem::path certificateFile(const StudyFolder& folder, std::int64_t erasure);

}  // namespace database
