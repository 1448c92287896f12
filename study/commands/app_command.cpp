// vis2hap [STUDY]: the app.
#include "protocols/errors.h"
#include "study/app/app.h"
#include "study/commands/command_line.h"
#include "study/commands/new_study.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace study::commands {

namespace {

void makeForApp(const app::NewStudyRequest& form, const app::MakingProgress& progress)
{
    NewStudy request;
    request.study = form.study;
    request.dataset = form.dataset;
    request.protocol = form.protocol.value_or(std::filesystem::path());
    request.participants = form.participants;
    request.seed = form.seed;
    makeStudy(request, [&](int done, int total, const std::string& what) { progress(total > 0 ? 1.0 * done / total : 0.0, what); });
}

int runWindow(const std::string& study, const std::string& display)
{
    if (!study.empty() && !std::filesystem::exists(study))
        throw protocols::badInput({"neither a command nor a study folder", study, "a study, or one of the commands",
                                   "see `vis2hap --help`"});
    app::AppOptions options;
    if (!study.empty())
        options.study = study;
    options.display = display;
    options.makeStudy = makeForApp;
    options.settings = app::userSettings();
    return app::runApp(options);
}

}  // namespace

void addApp(CLI::App& app, Action& action)
{
    auto study = std::make_shared<std::string>();
    auto display = std::make_shared<std::string>("none");
    app.add_option("STUDY", *study, "open this study in the app");
    app.add_option("--display", *display, "haptic display: none, or folder:DIR (keeps DIR/current.pgm)")->capture_default_str();
    app.callback([&app, study, display, &action] {
        if (!app.get_subcommands().empty())
            return;
        action.surroundings = Surroundings::Window;
        action.work = [study, display] { return runWindow(*study, *display); };
    });
}

}  // namespace study::commands
