#include "tests/promises/large_study.h"

#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QProcess>
#include <QTemporaryDir>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/promises/kept_answers.h"
#include "tests/support/played_session.h"

extern char** environ;

namespace tests::promises {

namespace {

namespace fs = std::filesystem;

constexpr int answersOfSession = 252;
constexpr double mostSeconds = 5, mostMegabytes = 500;

struct Cost {
    int exitCode = -1;
    double seconds = 0, processorSeconds = 0, megabytes = 0;
};

/// Runs the program without its output. The memory is the largest resident set of the process.
Cost run(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), VIS2HAP_PROGRAM);
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", 1, 0);
    QElapsedTimer timer;
    timer.start();
    pid_t process = 0;
    const int fault = posix_spawn(&process, VIS2HAP_PROGRAM, &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (fault != 0) throw std::runtime_error("cannot start " VIS2HAP_PROGRAM);
    int status = 0;
    rusage usage{};
    ::wait4(process, &status, 0, &usage);
    const double seconds = static_cast<double>(timer.nsecsElapsed()) / 1e9;
    const auto inSeconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
    };
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, seconds, inSeconds(usage.ru_utime) + inSeconds(usage.ru_stime),
            static_cast<double>(usage.ru_maxrss) / 1000};
}

/// In a process of its own, so that this one stays small: a child's largest resident set includes that of its parent.
void makeInProcess(const fs::path& folder, int answers)
{
    if (fs::exists(folder)) return;
    if (QProcess::execute(QCoreApplication::applicationFilePath(),
                          {"--make-study", QString::fromStdString(folder.string()), "--answers", QString::number(answers)}) != 0)
        throw std::runtime_error("the study of " + std::to_string(answers) + " answers was not made");
}

Promise costOf(const char* name, std::vector<std::string> arguments, const fs::path& small, const fs::path& large,
               const Effort& effort)
{
    arguments.push_back(small.string());
    const Cost ofSmall = run(arguments);
    arguments.back() = large.string();
    const Cost ofLarge = run(arguments);
    char found[200];
    std::snprintf(found, sizeof found, "%.1f s (%.1f s of processors), %.0f MB; %s answers: %.2f s (%.2f s), %.0f MB",
                  ofLarge.seconds, ofLarge.processorSeconds, ofLarge.megabytes, withCommas(effort.answers / 10).c_str(),
                  ofSmall.seconds, ofSmall.processorSeconds, ofSmall.megabytes);
    const bool works = ofLarge.exitCode == 0 && ofSmall.exitCode == 0 && ofLarge.megabytes <= mostMegabytes;
    const bool isFast = ofLarge.seconds <= mostSeconds && ofLarge.processorSeconds <= 12 * ofSmall.processorSeconds;
    return {name, withCommas(effort.answers) + " answers of " + withCommas(effort.answers / answersOfSession) + " participants",
            "≤ 5 s, ≤ 500 MB, growth linear", found,
            works && !effort.decidesTimes ? std::nullopt : std::optional(works && isFast)};
}

}  // namespace

void makeLargeStudy(const fs::path& path, int answers)
{
    support::StudyRecipe recipe = paperStudy();
    const int participants = std::max(1, answers / answersOfSession);
    auto protocol = nlohmann::ordered_json::parse(recipe.protocol);
    protocol["participants"] = participants;
    recipe.protocol = protocol.dump(2);
    const fs::path draft = path.string() + ".partial";
    fs::remove_all(draft);
    const database::StudyFolder folder = support::buildStudy(draft, recipe);
    for (int number = 1; number <= participants; ++number) support::OpenSession(folder, "S" + std::to_string(number)).playToEnd();
    fs::rename(draft, path);
}

std::vector<Promise> ofLargeStudies(const Effort& effort)
{
    const QTemporaryDir place;
    const fs::path folder = effort.studies.empty() ? fs::path(place.path().toStdString()) : fs::path(effort.studies);
    const fs::path small = folder / ("study-" + std::to_string(effort.answers / 10));
    const fs::path large = folder / ("study-" + std::to_string(effort.answers));
    makeInProcess(small, effort.answers / 10);
    makeInProcess(large, effort.answers);
    return {costOf("`study status` of a large study", {"study", "status"}, small, large, effort),
            costOf("`verify` of a large study", {"verify"}, small, large, effort)};
}

}  // namespace tests::promises
