// Work on an open study that its page offers besides sessions: sheets to print, backup, check, export, status, report, data
// sheet.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace study::app {

enum class StudyTool { Status, Verify, Sheets, Backup, Export, Report, DataSheet };

struct ToolOutcome {
    std::string text;              ///< for the operator; names no condition of a blinded study
    std::filesystem::path made{};  ///< the file or folder that was written; empty if none
    bool isSound = true;           ///< false: `text` lists faults of the study
};

/// Reports the share done (0..1) and the current step. Throws if the operator stops the work.
using ToolProgress = std::function<void(double fraction, const std::string& what)>;

/// Does the work with the study. `into`: the folder that receives a new file or folder; nothing that exists is overwritten.
/// Throws protocols::Error and then leaves nothing half-made. Called on a worker thread.
using UseTool = std::function<ToolOutcome(StudyTool tool, const std::filesystem::path& study, const std::filesystem::path& into,
                                          const ToolProgress& progress)>;

}  // namespace study::app
