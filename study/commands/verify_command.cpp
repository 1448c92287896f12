// vis2hap verify STUDY, and vis2hap unblind STUDY --who NAME --why TEXT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "database/keys.h"
#include "protocols/files/errors.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"
#include "study/commands/passphrase_option.h"
#include "study/commands/recorded_act.h"
#include "study/records/log_heads.h"
#include "study/records/stored_study.h"
#include "study/records/study_faults.h"
#include "study/session/clock.h"

namespace study::commands {

namespace {

/// Each head that was given out, and why the log does not contain it.
nlohmann::ordered_json comparedWith(const database::StudyStore& store, const std::string& against,
                                    std::vector<std::string>& faults)
{
    auto rows = nlohmann::ordered_json::array();
    if (against.empty()) return rows;
    for (const auto& head : records::headsIn(against)) {
        const std::string fault = records::faultAgainst(store, head);
        const std::string text = head.sequence == 0 ? head.hash : textOf(head);
        rows.push_back({{"head", text}, {"contained", fault.empty()}});
        if (!fault.empty()) faults.push_back("head " + text + ": " + fault);
    }
    return rows;
}

void print(const std::string& study, const database::StudyStore& store, const records::Findings& findings, std::size_t heads)
{
    const auto& faults = findings.faults;
    for (const auto& fault : faults) std::printf("%s\n", fault.c_str());
    for (const auto& note : findings.notes) std::printf("note: %s\n", note.c_str());
    std::printf("%s: %s (%zu answers, %zu stimuli, hash chain, keys, protocol)\n", study.c_str(),
                faults.empty() ? "sound" : (std::to_string(faults.size()) + (faults.size() == 1 ? " fault" : " faults")).c_str(),
                store.answerCount(), store.stimulusHashes().size());
    if (heads > 0 && faults.empty()) std::printf("  the log contains %s\n", heads == 1 ? "the given head" : "all given heads");
    std::printf("  log head %s\n", textOf(store.head()).c_str());
}

int verify(const std::string& study, const std::string& against, const JsonTarget& target)
{
    const auto store = records::openStudy(study);
    auto findings = records::findingsOf(store);
    const auto heads = comparedWith(store, against, findings.faults);
    if (target)
        writeJson(target, {{"schema", "vis2hap.verify/1"},
                           {"study", store.facts().name},
                           {"sound", findings.faults.empty()},
                           {"stimuli", store.stimulusHashes().size()},
                           {"answers", store.answerCount()},
                           {"head", textOf(store.head())},
                           {"against", heads},
                           {"faults", findings.faults},
                           {"notes", findings.notes}});
    else
        print(study, store, findings, heads.size());
    return static_cast<int>(findings.faults.empty() ? protocols::ExitCode::Done : protocols::ExitCode::WorkFailed);
}

int unblind(const std::string& study, const std::string& who, const std::string& why, const PassphraseOption& passphrase)
{
    database::StudyStore store({study}, database::StudyStore::Access::Write);
    if (const auto earlier = store.unblinding()) {
        std::printf("%s: already unblinded by %s on %s (%s)\n", study.c_str(), earlier->who.c_str(), earlier->wallTime.c_str(),
                    earlier->why.c_str());
        return 0;
    }
    const auto done = database::unblind(store, {who, why, session::SystemClock().wallTime()}, passphraseFrom(passphrase));
    recordAct(store, "unblind");
    const auto key = readAllocationKey(store, done);
    std::printf("%s: unblinded by %s; this is recorded\n", study.c_str(), who.c_str());
    std::map<protocols::ConditionLabel, protocols::ConditionId> names;
    for (const auto& [code, entry] : key.entries) names[entry.label] = entry.condition;
    for (const auto& [label, condition] : names) std::printf("  %s is %s\n", label.value.c_str(), condition.value.c_str());
    return 0;
}

std::string nonEmpty(const std::string& text)
{
    return text.find_first_not_of(" \t") == std::string::npos ? "must not be empty" : "";
}

}  // namespace

void addVerify(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("verify", "check the database, hash chain, keys and stimuli of a study");
    auto study = std::make_shared<std::string>();
    auto against = std::make_shared<std::string>();
    auto target = std::make_shared<JsonTarget>();
    command->add_option("STUDY", *study, "the study")->required();
    command->add_option("--against", *against,
                        "a head of the log that was given out earlier (SEQUENCE:HASH), or a file that contains some: finds a log "
                        "that was cut, put back or written anew");
    addJsonOption(*command, *target);
    command->callback([study, against, target, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [study, against, target] { return verify(*study, *against, *target); };
    });
}

void addUnblind(CLI::App& app, Action& action)
{
    struct UnblindCall {
        std::string study, who, why;
        PassphraseOption passphrase;
    };
    auto* command = app.add_subcommand("unblind", "reveal the conditions of a study; who and why are recorded");
    auto call = std::make_shared<UnblindCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--who", call->who, "your name")->required()->check(nonEmpty);
    command->add_option("--why", call->why, "the reason")->required()->check(nonEmpty);
    addPassphraseOption(*command, call->passphrase);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return unblind(call->study, call->who, call->why, call->passphrase); };
    });
}

}  // namespace study::commands
