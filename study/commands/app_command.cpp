// vis2hap [STUDY]: the window for sessions; vis2hap --monitor STUDY: the live monitor.
#include <CLI/CLI.hpp>
#include <memory>

#include "database/server/server_address.h"
#include "protocols/files/errors.h"
#include "reports/analysis/quality_flags.h"
#include "study/app/app.h"
#include "study/app/language/fonts.h"
#include "study/app/language/language.h"
#include "study/app/state/tried_display.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/look_ahead.h"
#include "study/commands/parts/text_checks.h"
#include "study/commands/study_tools.h"
#include "study/looking/look_at_data.h"
#include "study/making/new_study.h"
#include "study/making/rehearsal.h"
#include "study/photographs/photograph_steps.h"
#include "study/records/stored_study.h"

namespace study::commands {

namespace {

struct AppCall {
    std::string study;
    std::string display;  ///< empty: the display that the display page remembers
    std::string operatorName;
    std::string language;  ///< empty: the kept one, or that of the system
    bool monitor = false;
    bool plainImages = false;
};

std::vector<std::string> makeForApp(const app::NewStudyRequest& form, const app::MakingProgress& progress)
{
    making::NewStudy request;
    request.study = form.study;
    request.dataset = form.dataset;
    request.protocol = form.protocol.value_or(std::filesystem::path());
    request.language = form.language;
    request.participants = form.participants;
    request.seed = form.seed;
    request.passphrase = form.passphrase;
    request.programVersion = versionText();
    request.programCommit = commitText();
    const auto show = [&](int done, int total, const std::string& what) { progress(total > 0 ? 1.0 * done / total : 0.0, what); };
    return making::makeStudy(request, {show, [&](const std::string& stage, int done, int total) { show(done, total, stage); }})
        .warnings;
}

/// A harmless explanation of a flag on equal ratings; empty for other flags.
const char* weaknessOf(reports::FlagKind kind)
{
    const bool isOnEqualRatings = kind == reports::FlagKind::StraightLining || kind == reports::FlagKind::SameAcrossQuestions;
    return isOnEqualRatings ? "; a participant who feels no difference also gives such ratings" : "";
}

/// The report's flags without scores, because the study still runs. The monitor has columns of its own for missing answers and
/// voided presentations.
std::vector<app::MonitorFlag> flagsOf(const database::StudyStore& store)
{
    std::vector<app::MonitorFlag> flags;
    for (const reports::QualityFlag& flag : reports::qualityFlags(records::sealedStudyData(store)))
        if (flag.kind != reports::FlagKind::MissingAnswers && flag.kind != reports::FlagKind::VoidedPresentations)
            flags.push_back({flag.participant.value_or(""), nameOf(flag.kind), flag.why + weaknessOf(flag.kind)});
    return flags;
}

app::AppOptions optionsOf(const AppCall& call)
{
    app::AppOptions options;
    if (!call.study.empty()) options.study = call.study;
    if (!call.display.empty()) options.display = call.display;
    options.isDisplayGiven = !call.display.empty();
    options.allowsPlainImages = call.plainImages;
    options.makeStudy = makeForApp;
    options.settings = app::userSettings();
    options.lookAtData = looking::lookAtData();
    options.lookAhead = lookAhead;
    options.photographs = photographs::photographSteps();
    options.readFlags = flagsOf;
    options.makeRehearsal = making::makeRehearsal;
    options.useTool = studyTools(call.operatorName);
    options.operatedBy = session::operatedBy(call.operatorName, versionText());
    options.operatedBy.plainImages = app::leavesPlainImages(call.display);
    return options;
}

void requireAllowedDisplay(const AppCall& call)
{
    if (app::leavesPlainImages(call.display) && !call.plainImages)
        throw protocols::badInput({"this display leaves every image as a plain file, which an operator can open", call.display,
                                   "a driver (exec:COMMAND or tcp:HOST:PORT), or the option --plain-images",
                                   "see \"The display\" in the README; reports will state --plain-images"});
}

/// Before the screen is asked for: a mistyped command needs none.
void requireNamedStudy(const AppCall& call)
{
    if (call.monitor && call.study.empty())
        throw protocols::badInput(
            {"no study is named", "--monitor", "vis2hap --monitor STUDY", "name the folder of the study, or its address"});
    if (!call.study.empty() && !database::isServerAddress(call.study) && !std::filesystem::exists(call.study))
        throw protocols::badInput(
            {"this is neither a command nor the folder of a study", call.study, "a study or a command", "see `vis2hap --help`"});
}

int runWindow(const AppCall& call)
{
    app::requireFontFor(QStringLiteral("en"));
    app::LanguageInUse language(QString::fromStdString(versionText()));
    app::AppOptions options = optionsOf(call);
    options.languageFault = app::chooseLanguage(language, QString::fromStdString(call.language), options.settings.get());
    return call.monitor ? app::runMonitor(options) : app::runApp(std::move(options), language);
}

}  // namespace

void addApp(CLI::App& app, Action& action)
{
    auto call = std::make_shared<AppCall>();
    app.add_option("STUDY", call->study, "open this study in the window");
    app.add_option("--display", call->display,
                   "haptic display: none; folder:DIR (writes DIR/current.pgm); exec:COMMAND (starts a driver); "
                   "tcp:HOST:PORT (a driver on another computer); cover:N (a black window on touch screen N, which "
                   "reports the first touch); or a display under a cover: folder:DIR,cover:N. Default: the display that the page "
                   "\"Display\" remembers; none named here is a rehearsal without a display");
    app.add_option("--operator", call->operatorName, "who runs the sessions (default: the name of this account)")
        ->check(isName());
    app.add_option("--language", call->language,
                   "language of the window: a tag such as de or zh_CN, or the file of a catalogue (*.qm); default: the one "
                   "chosen on the start page, "
                   "or the system's");
    app.add_flag("--plain-images", call->plainImages, "allow --display folder:DIR with people; every report states it");
    app.add_flag("--monitor", call->monitor,
                 "watch this study: progress of each participant, missing answers, flags; read-only and blinded");
    app.callback([&app, call, &action] {
        if (!app.get_subcommands().empty()) return;
        requireNamedStudy(*call);
        requireAllowedDisplay(*call);
        action.surroundings = Surroundings::Window;
        action.handlesStudy = true;
        action.work = [call] { return runWindow(*call); };
    });
}

}  // namespace study::commands
