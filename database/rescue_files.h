// Where rescue files lie, and to which study they belong. A file is written into the study folder, beside it, or into the folder
// for temporary files; the study folder may be named through a link, or renamed later.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "database/disk/study_folder.h"
#include "database/sqlite_connection.h"

namespace database {

/// True for PREFIX, a number and ENDING.
bool isNumbered(std::string_view name, std::string_view prefix, std::string_view ending);

/// A file name that is free: PREFIX1.db, PREFIX2.db ...
std::filesystem::path freeName(const std::filesystem::path& where, const std::string& prefix);

/// The places for a new rescue file, the best first.
std::vector<std::filesystem::path> placesForRescue(const StudyFolder& folder);

/// The rescue files in the study folder and beside it, oldest first, without those of another study. Beside the folder only files
/// of this account count.
std::vector<std::filesystem::path> rescueFiles(const StudyFolder& folder);

/// Whether the file lies in the study folder, or beside it under its present name. A rescue file of another name may be that of
/// the study from which this one was copied.
bool isLeftBy(const std::filesystem::path& rescue, const StudyFolder& folder);

/// Files of this account outside of the study folder, and those in the folder for temporary files, that can be read. Those that
/// bear the name of the study may be of another study of this name; those of other names are of this study.
std::vector<std::filesystem::path> rescueFilesOutside(const StudyFolder& folder);

/// Files of other accounts in these places that bear the name of the study, sorted. They are not opened as databases: anybody may
/// put files there. They may be rescue files all the same, where several accounts use one study; an erasure searches their bytes.
std::vector<std::filesystem::path> rescueFilesOfOthers(const StudyFolder& folder);

/// Whose database it is, by the station key in the folder.
enum class Origin {
    ThisStudy,
    AnotherStudy,
    Unknown,  ///< the folder has no station key, or the database commits to none
};
Origin originOf(const SqliteConnection& database, const StudyFolder& folder);

/// Whether the file holds rows of the participant that an erasure removes. None where it cannot be read as a study's database.
std::optional<bool> rowsAbout(const std::filesystem::path& file, const std::string& participant, bool answersToo,
                              const StudyFolder& folder);

/// Databases in the study folder and outside that still hold facts of the participant or, if `answersToo`, answers or entries
/// with their content; relative to the folder where they lie in it. A file that cannot be read as a database is left out. With
/// the answers count what a session on a server left: held-ID-N.json and not-sent-ID-N.json.
std::vector<std::string> databasesAbout(const std::string& participant, bool answersToo, const StudyFolder& folder);

}  // namespace database
