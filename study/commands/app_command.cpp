// vis2hap [STUDY]: the app; vis2hap --monitor STUDY: the live monitor.
#include <CLI/CLI.hpp>
#include <memory>

#include "protocols/files/errors.h"
#include "reports/analysis/answer_cells.h"
#include "reports/analysis/quality_flags.h"
#include "study/app/app.h"
#include "study/commands/command_line.h"
#include "study/looking/look_at_data.h"
#include "study/making/new_study.h"
#include "study/records/stored_study.h"

namespace study::commands {

namespace {

struct Call {
    std::string study;
    std::string display = "none";
    bool monitor = false;
};

void makeForApp(const app::NewStudyRequest& form, const app::MakingProgress& progress)
{
    making::NewStudy request;
    request.study = form.study;
    request.dataset = form.dataset;
    request.protocol = form.protocol.value_or(std::filesystem::path());
    request.participants = form.participants;
    request.seed = form.seed;
    request.programVersion = versionText();
    making::makeStudy(
        request, [&](int done, int total, const std::string& what) { progress(total > 0 ? 1.0 * done / total : 0.0, what); });
}

/// What a reader of the flag must know before believing it.
const char* weaknessOf(const std::string& flag)
{
    const bool isStraightLining = flag == "straight_lining" || flag == "same_across_questions";
    return isStraightLining ? "; somebody to whom all renderings feel alike answers so in earnest" : "";
}

/// The report's own flags, and nothing else of it: no scores while the study runs. What is missing and void has
/// columns of its own in the monitor.
std::vector<app::MonitorFlag> flagsOf(const database::StudyStore& store)
{
    std::vector<app::MonitorFlag> flags;
    const auto data = records::studyData(store);
    for (const auto& entry : reports::qualityFlags(data, reports::Cells(data))) {
        const auto flag = entry["flag"].get<std::string>();
        if (flag != "missing_answers" && flag != "voided_presentations")
            flags.push_back({entry["participant"].is_string() ? entry["participant"].get<std::string>() : std::string(), flag,
                             entry["why"].get<std::string>() + weaknessOf(flag)});
    }
    return flags;
}

app::AppOptions optionsOf(const Call& call)
{
    app::AppOptions options;
    if (!call.study.empty()) options.study = call.study;
    options.display = call.display;
    options.makeStudy = makeForApp;
    options.settings = app::userSettings();
    options.lookAtData = looking::lookAtData();
    options.readFlags = flagsOf;
    return options;
}

int runWindow(const Call& call)
{
    if (call.monitor && call.study.empty())
        throw protocols::badInput({"no study to monitor", "", "vis2hap --monitor STUDY", "name the study's folder"});
    if (!call.study.empty() && !std::filesystem::exists(call.study))
        throw protocols::badInput(
            {"neither a command nor a study folder", call.study, "a study, or one of the commands", "see `vis2hap --help`"});
    return call.monitor ? app::runMonitor(optionsOf(call)) : app::runApp(optionsOf(call));
}

}  // namespace

void addApp(CLI::App& app, Action& action)
{
    auto call = std::make_shared<Call>();
    app.add_option("STUDY", call->study, "open this study in the app");
    app.add_option("--display", call->display,
                   "haptic display: none, folder:DIR (keeps DIR/current.pgm), exec:COMMAND (a driver that is started), "
                   "tcp:HOST:PORT (a driver on another computer), cover:N (blackens touch screen N, which tells the first "
                   "touch), or one under a cover: folder:DIR,cover:N")
        ->capture_default_str();
    app.add_flag("--monitor", call->monitor,
                 "watch this study instead: who is where, what is missing, flags; reads only, blinded");
    app.callback([&app, call, &action] {
        if (!app.get_subcommands().empty()) return;
        action.surroundings = Surroundings::Window;
        action.work = [call] { return runWindow(*call); };
    });
}

}  // namespace study::commands
