// Records in a study what a command did with it: an export, a backup, a report, an unblinding. Notes who else can read the files.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "database/sqlite_connection.h"
#include "database/study_store.h"

namespace study::commands {

/// Adds the act to the study's chain of acts, with the operator, the program and the machine. Returns why that is not possible,
/// as in a read-only folder; empty if it is done. `operatorName`: empty for the name of the account. `note`: what the act found
/// wrong. `head`: of the log that was read; none for the present one.
std::string addAct(const database::StudyStore& store, const std::string& kind, const std::filesystem::path& path = {},
                   const std::string& operatorName = {}, const std::string& note = {},
                   const std::optional<database::LogHead>& head = {});

/// Adds the act to the study's chain of acts, with the account, the program and the machine. Where that is not possible, as in a
/// read-only folder, it prints "not recorded: " and why on standard error.
void recordAct(const database::StudyStore& store, const std::string& kind, const std::filesystem::path& path = {},
               const std::string& note = {}, const std::optional<database::LogHead>& head = {});

/// One state of the study for a command that writes files, and the act that records them.
class StateForFiles {
public:
    explicit StateForFiles(const database::StudyStore& store);
    /// Ends the state, so that the log can be emptied, and returns its head.
    const database::LogHead& end();
    /// Ends the state and records the act with its head. Call it before the first
    /// word on the screen: a reader such as `head` may close the pipe at any line.
    void record(const std::string& kind, const std::filesystem::path& path, const std::string& note = {});

private:
    const database::StudyStore& m_store;
    std::unique_ptr<database::ReadSnapshot> m_state;
    database::LogHead m_head;
};

/// Prints a note on standard error where the file system of a secret file, or of a folder that holds some, keeps no access
/// rights.
void noteIfReadByAll(const std::filesystem::path& secret);

}  // namespace study::commands
