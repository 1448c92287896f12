// vis2hap study preregister STUDY
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "database/preregistrations.h"
#include "protocols/files/safe_text.h"
#include "reports/data/registration.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/text_checks.h"
#include "study/making/preregistration.h"
#include "study/session/clock.h"

namespace study::commands {

namespace {

struct PreregisterCall {
    std::string study, out, who;
    JsonTarget target;
};

std::vector<std::string> textsOf(const std::vector<std::filesystem::path>& files)
{
    std::vector<std::string> texts;
    for (const auto& file : files) texts.push_back(file.string());
    return texts;
}

void printDone(const PreregisterCall& call, const making::Preregistered& done)
{
    const std::string what =
        done.record.number == 1 ? "preregistered" : "amendment, registration " + std::to_string(done.record.number);
    std::printf("%s: %s%s on %s, %s\n", protocols::printable(call.study).c_str(), done.isNew ? "" : "nothing has changed; ",
                what.c_str(), protocols::printable(done.record.wallTime).c_str(),
                reports::timingText(done.record.answersBefore, done.record.afterUnblinding).c_str());
    for (const auto& change : done.changes) std::printf("  changed: %s\n", protocols::printable(change).c_str());
    std::printf("  SHA-256 %s  %s\n", done.record.jsonSha256().c_str(), done.files[1].filename().c_str());
    std::printf("  SHA-256 %s  %s\n", done.record.textSha256().c_str(), done.files[0].filename().c_str());
    for (const auto& file : done.written) std::printf("  written: %s\n", protocols::printable(file.string()).c_str());
    if (done.isNew) std::printf("next: paste the text into the form of a registry, and keep both files with the study\n");
}

int preregister(const PreregisterCall& call)
{
    database::StudyStore store({call.study}, database::StudyStore::Access::Write);
    const auto done = making::preregister(store, {call.out, call.who, versionText(), session::SystemClock().wallTime()});
    if (!call.target) {
        printDone(call, done);
        return 0;
    }
    writeJson(call.target, {{"schema", "vis2hap.preregister/1"},
                            {"study", store.facts().name},
                            {"new", done.isNew},
                            {"number", done.record.number},
                            {"time", done.record.wallTime},
                            {"answers_before", done.record.answersBefore},
                            {"after_unblinding", done.record.afterUnblinding},
                            {"changes", done.changes},
                            {"sha256", done.record.jsonSha256()},
                            {"text_sha256", done.record.textSha256()},
                            {"files", textsOf(done.files)},
                            {"written", textsOf(done.written)}});
    return 0;
}

}  // namespace

void addPreregister(CLI::App& study, Action& action)
{
    auto* command = study.add_subcommand("preregister", "write the plan as text and JSON, and record its hash in the log");
    auto call = std::make_shared<PreregisterCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--out", call->out, "folder for copies of the two files");
    command->add_option("--who", call->who, "your name")->check(isName());
    addJsonOption(*command, call->target);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return preregister(*call); };
    });
}

}  // namespace study::commands
