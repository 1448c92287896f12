// Records in a study what a command did with it: an export, a backup, a report, an unblinding. Notes who else can read the files.
#pragma once

#include <filesystem>
#include <string>

#include "database/study_store.h"

namespace study::commands {

/// Adds the act to the study's chain of acts, with the operator, the program and the machine. Returns why that is not possible,
/// as in a read-only folder; empty if it is done. `operatorName`: empty for the name of the account. `note`: what the act found
/// wrong.
std::string addAct(const database::StudyStore& store, const std::string& kind, const std::filesystem::path& path = {},
                   const std::string& operatorName = {}, const std::string& note = {});

/// Adds the act to the study's chain of acts, with the account, the program and the machine. Where that is not possible, as in a
/// read-only folder, it prints "not recorded: " and why on standard error.
void recordAct(const database::StudyStore& store, const std::string& kind, const std::filesystem::path& path = {},
               const std::string& note = {});

/// Prints a note on standard error where the file system of a secret file, or of a folder that holds some, keeps no access
/// rights.
void noteIfReadByAll(const std::filesystem::path& secret);

}  // namespace study::commands
