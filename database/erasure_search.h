// The search of an erasure: every file of the study, and rescue files beside it, for what was removed.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "database/session_store.h"
#include "database/sqlite_connection.h"
#include "protocols/files/byte_search.h"

namespace database {

inline constexpr const char* certifiedKind = "certified";
inline constexpr const char* foundField = "found";  ///< of a certificate's entry: the files that still held something

/// The file of this name, relative to the study. Where the name holds one of the texts, it is left out.
FoundFile foundFile(const std::string& name, const std::set<std::string>& texts, const StudyFolder& study);

/// Files that the certificate of an earlier erasure of this participant names.
std::vector<FoundFile> filesInCertificates(const SqliteConnection& sqlite, const std::string& participant);

/// Those that are still there under their names, or with the same content under any name: what was removed then can no longer be
/// searched for in them. Of a database its rows decide.
std::vector<FoundFile> stillThere(const std::vector<FoundFile>& named, const Erasure& erasure, const StudyFolder& study);

/// Adds the file to what the erasure found, once.
void addFound(const FoundFile& file, ErasureRecord& record);

/// What was removed is known no more, so that a file can be searched for it now or never. Throws environmentFault where a file
/// of the folder cannot be read.
void requireSearchable(const std::filesystem::path& folder);

/// The files of the open database are read through it: to open and close them once more would drop the locks of this process.
protocols::ByteSearch searchFiles(const SqliteConnection& sqlite, const StudyFolder& study,
                                  const std::vector<std::string>& sequences);

}  // namespace database
