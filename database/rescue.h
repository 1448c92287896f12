// Answers whose database was deleted, replaced, overwritten or moved in mid-session: a whole copy of the open database is kept
// aside, and can be brought back.
#pragma once

#include <cstddef>
#include <filesystem>

#include "database/disk/page_copy.h"
#include "database/disk/study_folder.h"
#include "database/sqlite_connection.h"

namespace database {

/// Writes the open database into a new file "rescue-N.db" in the study folder; where the folder is gone, "NAME-rescue-N.db"
/// beside its place, or else in the folder for temporary files. `copy`: what it held when every file was in place. What the
/// connection reads is taken where that has every row of the copy: another process may have recorded acts since. Without a copy
/// (null) it is taken as it is, which fails where the files were overwritten. Throws environmentFault where no place takes it.
std::filesystem::path keepAside(const SqliteConnection& sqlite, const PageCopy* copy, const StudyFolder& folder);

/// Whether facts and states of participants count as rows, too: a session changes them.
enum class Facts { MayDiffer, MustAgree };

/// Whether the database is sound to SQLite and has every row of the copy. So it is where another process recorded
/// acts and moved the write-ahead log into the database, which then holds other bytes than the copy. Takes seconds for large
/// studies.
bool holdsAllOf(const PageCopy& copy, const std::filesystem::path& database, Facts facts = Facts::MayDiffer);

struct Rescue {
    std::size_t events = 0;         ///< entries of the log that the study gained
    std::filesystem::path earlier;  ///< the database that stood there, kept under another name; empty where there was none
    std::size_t acts = 0;           ///< exports and the like that only that database had: the study keeps them
    bool lacksActs = false;         ///< some of them are altered or cannot be read, and stay in that database
};

/// Puts what the rescue file and its write-ahead log hold in the place of study.db. The log of the present study.db must be the
/// beginning of the rescued one; its exports and other acts are kept. A study.db that is damaged, or no study, is only put aside;
/// then the keys in the folder must be those of the rescued study, and no certificate of an erasure may be newer. Throws badInput
/// where that is not so, where the file is no database of a study, and for a study on a server; nothing is changed then. A file
/// that isLeftBy() the folder is gone afterwards, any other one stays. The caller holds the write lock.
Rescue bringBack(const StudyFolder& folder, const std::filesystem::path& rescue);

}  // namespace database
