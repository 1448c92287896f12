// The commands of the program, one file each. A command adds itself to the command line. If the line names the
// command, it puts its work into `Action`, and main() runs this work after the whole line is parsed.
#pragma once

#include <functional>
#include <string>

#include "study/commands/parts/version_text.h"

namespace CLI {
class App;
}

namespace study::commands {

/// The Qt application that the work needs.
enum class Surroundings {
    None,            ///< no Qt at all
    Core,            ///< a QCoreApplication, for Qt SQL and image formats
    Window,          ///< widgets on a screen; without a screen the command ends with exit code 3
    SeenIfPossible,  ///< widgets, on a screen where one is named
    Offscreen,       ///< pictures and fonts; a screen is not used, so a desktop that has gone does no harm
};

struct Action {
    Surroundings surroundings = Surroundings::None;
    bool handlesStudy = false;  ///< its files are for this user only, and no debugger may read its memory
    std::function<int()> work;  ///< returns the exit code
};

void addFabrics(CLI::App& app, Action& action);
void addImport(CLI::App& app, Action& action);
void addCalibrate(CLI::App& app, Action& action);
void addHeight(CLI::App& app, Action& action);
void addTrain(CLI::App& app, Action& action);
void addEvaluate(CLI::App& app, Action& action);
void addRender(CLI::App& app, Action& action);
void addStudy(CLI::App& app, Action& action);
void addReplay(CLI::App& app, Action& action);
void addSimulate(CLI::App& app, Action& action);
void addReport(CLI::App& app, Action& action);
void addExport(CLI::App& app, Action& action);
void addUnblind(CLI::App& app, Action& action);
void addVerify(CLI::App& app, Action& action);
void addLeakCheck(CLI::App& app, Action& action);
void addErase(CLI::App& app, Action& action);
void addBackup(CLI::App& app, Action& action);
void addRescue(CLI::App& app, Action& action);
void addNumbers(CLI::App& app, Action& action);  ///< describe, compare, metrics
void addAnalyse(CLI::App& app, Action& action);
void addPower(CLI::App& app, Action& action);
void addProtocol(CLI::App& app, Action& action);  ///< protocol check, protocol show
void addMerge(CLI::App& app, Action& action);
void addBench(CLI::App& app, Action& action);
void addDisplay(CLI::App& app, Action& action);
void addStroke(CLI::App& app, Action& action);
void addView(CLI::App& app, Action& action);
/// `study preregister`; `study` is the command that it belongs to.
void addPreregister(CLI::App& study, Action& action);
void addProof(CLI::App& study, Action& action);  ///< study data-sheet, signing-key, sign
void addMove(CLI::App& study, Action& action);
void addJoin(CLI::App& study, Action& action);
void addServer(CLI::App& app, Action& action);  ///< server roles, server status
/// The window: `vis2hap [STUDY]`, when no command is named.
void addApp(CLI::App& app, Action& action);

/// The commit of the sources when the build was configured; empty outside a repository.
std::string commitText();

}  // namespace study::commands
