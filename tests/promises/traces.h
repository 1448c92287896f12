// What one person leaves in a study, and where it can still be found.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "database/disk/study_folder.h"

namespace tests::promises {

/// Byte sequences that only this person's data hold, by their kind: "salts", "facts", "notes", "samples of the finger", "times"
/// (as text) and "stored times" (as SQLite keeps numbers).
using Traces = std::map<std::string, std::vector<std::string>>;

Traces tracesOf(const std::string& participant, const database::StudyFolder& folder);

/// The kinds that a file of one of the folders holds.
std::set<std::string> kindsFoundIn(const std::vector<std::filesystem::path>& folders, const Traces& traces);

/// Number of files in the folders that hold any of the traces.
int filesWith(const Traces& traces, const std::vector<std::filesystem::path>& folders);

/// Every text of 64 hexadecimal digits in the files of a folder: what could be a salt.
std::set<std::string> possibleSaltsIn(const std::filesystem::path& folder);

}  // namespace tests::promises
