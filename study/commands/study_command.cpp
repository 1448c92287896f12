// vis2hap study new|status|plan|amend|sheets; preregister, data-sheet, signing-key and sign have files of their own
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "database/server/server_address.h"
#include "database/study_store.h"
#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/id_rule.h"
#include "protocols/files/number_text.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/sha256.h"
#include "protocols/files/utf8.h"
#include "protocols/files/whole_file.h"
#include "protocols/new_texts.h"
#include "protocols/protocol_json.h"
#include "protocols/records/balance.h"
#include "protocols/usual_texts.h"
#include "study/app/app.h"
#include "study/app/language/language.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/cache_option.h"
#include "study/commands/parts/explanation.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/progress.h"
#include "study/commands/parts/text_checks.h"
#include "study/commands/passphrase_option.h"
#include "study/commands/recorded_act.h"
#include "study/commands/server/server_work.h"
#include "study/making/new_study.h"
#include "study/making/study_sheets.h"
#include "study/participant/session/prompts.h"
#include "study/records/display_response_record.h"
#include "study/records/registered_plan.h"
#include "study/records/running_orders_csv.h"
#include "study/records/stored_study.h"
#include "study/records/study_status.h"

namespace study::commands {

namespace {

std::string sittingsText(int sittings) { return sittings == 1 ? "one sitting" : std::to_string(sittings) + " sittings"; }

std::string listOf(const std::vector<database::FamiliarisationItem>& items)
{
    std::string text;
    for (const auto& item : items) text += (text.empty() ? "" : ", ") + item.name;
    return text;
}

/// The last condition that the program renders itself; images for familiarisation are of this one.
protocols::ConditionId conditionOfFamiliarisation(const protocols::Protocol& protocol)
{
    const auto& all = protocol.conditions;
    const auto last = std::find_if(all.rbegin(), all.rend(), [&](const auto& id) { return !isOwnCondition(protocol, id); });
    return last == all.rend() ? protocols::ConditionId() : *last;
}

making::MadeStudy madeWithProgress(const making::NewStudy& request, StageTimes& stages)
{
    Progress images("friction images");
    StagesShown comparison, programs;
    return making::makeStudy(
        request, {[&](int done, int total, const std::string& what) { images.show(done, total, what); },
                  [&](const std::string& stage, int done, int total) { comparison.show(stage, done, total); },
                  [&](const std::string& stage, int done, int total) { programs.show(stage, done, total); },
                  [&](const std::string& text) { stages.print(text); }, [&](const std::string& name) { stages.begin(name); }});
}

int makeNew(const making::NewStudy& request, StageTimes& stages, bool goesToServer)
{
    const auto made = madeWithProgress(request, stages);
    stages.end();
    const auto protocol = records::protocolOf(made.facts);
    for (const auto& warning : made.warnings) std::fprintf(stderr, "warning: %s\n", protocols::printable(warning).c_str());
    std::printf("%s: %s\n", protocols::printable(request.study.string()).c_str(), protocols::printable(made.facts.name).c_str());
    std::printf("  %d participants, fabrics", protocol.participants);
    for (const auto& fabric : made.facts.fabrics)
        std::printf(" %s (%s)", fabric.value.c_str(), protocols::printable(made.facts.fabricNames.at(fabric)).c_str());
    std::printf(", %zu conditions%s\n", protocol.conditions.size(), made.imagesReused ? ", friction images reused" : "");
    std::printf("  %d presentations and %d answers for each participant: about %.0f minutes in %s, at %g s a presentation\n",
                protocol.presentations(), protocol.answersPerParticipant(), protocol.minutesPerParticipant(),
                sittingsText(protocol.sittingsPerParticipant()).c_str(), protocol.secondsPerPresentation);
    std::printf("  %s\n", protocols::printable(records::displayResponseSentence(made.facts)).c_str());
    if (!made.facts.familiarisation.empty())
        std::printf("  fabrics for familiarisation, under %s: %s\n", conditionOfFamiliarisation(protocol).value.c_str(),
                    protocols::printable(listOf(made.facts.familiarisation)).c_str());
    std::printf("balance of other running orders by the same rules (those of this study are sealed):\n%s",
                describe(made.balance).c_str());
    if (made.balanceWithEvenSlots)
        std::printf("what few swaps change:\n%s", describePrice(made.balance, *made.balanceWithEvenSlots).c_str());
    const std::string word = protocols::shellWord(request.study.string());
    std::printf("next: `vis2hap study sheets %s --out DIR` writes the labels of the fabric pieces and the cards of the scales\n",
                word.c_str());
    if (!goesToServer)  // the plan is registered in a folder
        std::printf("next: `vis2hap study preregister %s` registers the plan before the first answer\n", word.c_str());
    noteIfReadByAll(request.study);
    return 0;
}

int status(const std::string& study, const JsonTarget& target, const PassphraseOption& passphrase)
{
    const auto json = records::statusOf(records::openStudy(study), givenPassphrase(passphrase));
    if (target)
        writeJson(target, json);
    else
        std::fputs(protocols::printableLines(records::textOf(json)).c_str(), stdout);
    return 0;
}

int plan(const std::string& study, const std::string& csv)
{
    const auto store = records::openStudy(study);
    protocols::writeWholeFile(csv, records::runningOrdersCsv(store));
    std::printf("%s: running orders of %zu slots\n", protocols::printable(csv).c_str(), store.slots().size());
    return 0;
}

struct Amendment {
    std::string study, who, why;
    bool undo = false;
};

std::string listed(const std::vector<std::string>& items)
{
    std::string text;
    for (const auto& item : items) text += (text.empty() ? "" : ", ") + item;
    return text;
}

/// Uses an edited protocol.json for later participants, or restores the stored one.
int amend(const Amendment& call)
{
    database::StudyStore store({call.study}, database::StudyStore::Access::Write);
    const auto file = store.folder().protocol();
    const auto kept = store.protocolVersions().back();
    if (call.undo) {
        protocols::writeWholeFile(file, kept.json);
        std::printf("%s: restored (version %d)\n", protocols::printable(file.string()).c_str(), kept.version);
        return 0;
    }
    const std::string written = protocols::readWholeFile(file), text(protocols::withoutByteOrderMark(written));
    if (protocols::sha256(written) == kept.sha256 || protocols::sha256(text) == kept.sha256) {
        if (protocols::sha256(written) != kept.sha256) protocols::writeWholeFile(file, text);
        std::printf("%s: unchanged (version %d)\n", protocols::printable(file.string()).c_str(), kept.version);
        return 0;
    }
    const std::string madeBy = store.facts().programVersion;
    const auto before = protocols::keptProtocolFromJson(kept.json, "the kept protocol", madeBy);
    const auto amended = protocols::keptProtocolFromJson(text, file.string(), madeBy);
    if (const std::string why = protocols::faultOfLine(amended.name, protocols::longestReason);
        !why.empty() && amended.name != before.name)
        throw protocols::badInput({"the new name of the study " + why, file.string(),
                                   protocols::lineRule(protocols::longestReason), "correct \"name\" in the file"});
    protocols::requireGoodNewTexts(text, kept.json, file.string());
    const auto changed = fixedPartsChanged(before, amended);
    if (!changed.empty())
        throw protocols::badInput({"the edit changes " + listed(changed) + ", which running orders and stimuli depend on",
                                   file.string(),
                                   "changes of texts, times, bounds, contrasts, checklist or facts only, and of breaks where no "
                                   "presentation is repeated",
                                   "make a new study; `vis2hap study amend " + protocols::shellWord(call.study) +
                                       " --undo` restores the stored protocol"});
    std::vector<std::string> notes = participant::notesOnRecordings(before, amended);
    if (const std::string note = records::noteOnPlan(store, amended); !note.empty()) notes.insert(notes.begin(), note);
    store.takeProtocol(text, call.who, call.why);
    if (text != written) protocols::writeWholeFile(file, text);  // the kept text and the file agree
    std::printf("%s: now version %d; participants who have started keep their version\n",
                protocols::printable(file.string()).c_str(), kept.version + 1);
    for (const std::string& note : notes) std::printf("note: %s\n", protocols::printable(note).c_str());
    return 0;
}

void addNew(CLI::App& study, Action& action)
{
    auto* command = study.add_subcommand("new", "make a study from a data set and a protocol");
    auto call = std::make_shared<making::NewStudy>();
    auto passphrase = std::make_shared<PassphraseOption>();
    auto programs = std::make_shared<std::vector<std::string>>();
    auto programSeconds = std::make_shared<int>(static_cast<int>(call->programLimits.time.count()));
    auto hasNone = std::make_shared<bool>(false), noCache = std::make_shared<bool>(false);
    call->programVersion = versionText();
    call->programCommit = commitText();
    command->add_option("STUDY", call->study, "folder to make, or an address postgresql://USER@HOST/DATABASE?study=NAME")
        ->required();
    command->add_option("--dataset", call->dataset, "the data set")->required();
    command->add_option("--protocol", call->protocol, "protocol file (default: the paper's study)");
    command
        ->add_option("--language", call->language,
                     "language of the participants in the paper's study (default: en); a protocol file states its own")
        ->check(CLI::IsMember(protocols::languagesOfUsualTexts()))
        ->excludes("--protocol");
    command->add_option("--model", call->model, "weights of the generators (default: the shipped ones)");
    command->add_option("--control", call->control, "weights of an L1-only control of the model, compared in the report");
    command
        ->add_option(
            "--program", *programs,
            "ID=COMMAND: the program that makes the images of a condition with \"program\": true; runs once a fabric, as "
            "COMMAND PHOTOGRAPH IMAGE")
        ->allow_extra_args(false);
    command->add_option("--program-seconds", *programSeconds, "time limit of a program for one fabric")
        ->check(CLI::Range(1, 86400))
        ->capture_default_str();
    command->add_option("--program-memory", call->programLimits.memoryMib, "memory limit of a program, MiB")
        ->check(CLI::Range(16, 1048576))
        ->capture_default_str();
    command->add_option("--participants", call->participants, "number of participants (default: the protocol's)")
        ->check(CLI::Range(1, 10000));
    command->add_option("--seed", call->seed, "seed of fabrics, samples and running orders")->capture_default_str();
    command->add_option("--key-seed", call->keySeed, "for tests: seed of the allocation (default: a secret of the system)");
    command->add_flag("--even-strange", call->evenStrange,
                      "generate from photographs that do not look like cloth, too; every report states it");
    command->add_flag("--allow-training-samples", call->allowTrainingSamples,
                      "allow samples that the model was trained on; the report says so");
    command->add_option("--response", call->response,
                        "response.json of the display (vis2hap display calibrate): friction becomes linear in the maps");
    command->add_option("--images", call->images,
                        "folder to keep the friction images in under their names, and to reuse them from");
    command->add_flag("--replace-simulated", call->replaceSimulated, "replace a study in which no human took part");
    addCacheOption(*command, noCache);
    addPassphraseOption(*command, *passphrase);
    command->add_flag("--no-passphrase", *hasNone,
                      "for simulated studies and tests: leave the allocation key open in the folder; the report says so");
    command->callback([call, command, programs, programSeconds, passphrase, hasNone, noCache, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call, command, programs, programSeconds, passphrase, hasNone, noCache] {
            for (const std::string& text : *programs) call->programs.push_back(making::ownProgramFrom(text));
            call->programLimits.time = std::chrono::seconds(*programSeconds);
            call->cache = cacheUnless(*noCache);
            making::requireInputs(*call);  // before anybody types a passphrase
            if (!*hasNone) call->passphrase = newPassphrase(*passphrase);
            StageTimes stages(isExplained(*command));
            const std::string place = call->study.string();
            const bool isOnServer = database::isServerAddress(place);
            if (isOnServer) call->study = folderOfNewStudy(place);
            const int made = makeNew(*call, stages, isOnServer);
            return isOnServer ? moveNewStudy(call->study.string(), place) : made;
        };
    });
}

}  // namespace

void addStudy(CLI::App& app, Action& action)
{
    auto* study = app.add_subcommand("study", "make a study, see its progress, print its running orders");
    study->require_subcommand(1);
    addNew(*study, action);
    addMove(*study, action);
    addJoin(*study, action);
    addPreregister(*study, action);
    addProof(*study, action);

    auto* statusCommand = study->add_subcommand("status", "show progress, balance and data-quality flags; blinded");
    auto folder = std::make_shared<std::string>();
    auto target = std::make_shared<JsonTarget>();
    auto passphrase = std::make_shared<PassphraseOption>();
    statusCommand->add_option("STUDY", *folder, "the study")->required();
    addJsonOption(*statusCommand, *target);
    addPassphraseOption(*statusCommand, *passphrase);
    statusCommand->callback([folder, target, passphrase, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [folder, target, passphrase] { return status(*folder, *target, *passphrase); };
    });

    auto* amendCommand = study->add_subcommand("amend", "use an edited protocol.json for later participants, or undo the edit");
    auto amendment = std::make_shared<Amendment>();
    amendCommand->add_option("STUDY", amendment->study, "the study")->required();
    amendCommand->add_option("--who", amendment->who, "your name")->check(isName());
    amendCommand->add_option("--why", amendment->why, "the reason")->check(isReason());
    amendCommand->add_flag("--undo", amendment->undo, "restore the protocol that the study stores");
    amendCommand->callback([amendment, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [amendment] { return amend(*amendment); };
    });

    auto* sheetsCommand = study->add_subcommand(
        "sheets",
        "write pages to print: labels of the fabric pieces, preparation and session sheets, a card for each rating scale");
    auto out = std::make_shared<std::string>();
    sheetsCommand->add_option("STUDY", *folder, "the study")->required();
    sheetsCommand->add_option("--out", *out, "folder to write the pages to")->required();
    auto language = std::make_shared<std::string>();
    sheetsCommand->add_option("--language", *language,
                              "language of the sheets for operators (default: that of the window); the card of the scale follows "
                              "the protocol");
    sheetsCommand->callback([folder, out, language, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [folder, out, language] {
            app::LanguageInUse inUse(QString::fromStdString(versionText()));
            app::chooseLanguage(inUse, QString::fromStdString(*language), app::userSettings().get());
            making::writeSheets(records::openStudy(*folder), *out);
            std::printf("%s: pages to print\n", protocols::printable(*out).c_str());
            return 0;
        };
    });

    auto* planCommand = study->add_subcommand("plan", "write the blinded running orders, one row a trial");
    auto csv = std::make_shared<std::string>();
    planCommand->add_option("STUDY", *folder, "the study")->required();
    planCommand->add_option("--csv", *csv, "file to write")->required();
    planCommand->callback([folder, csv, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [folder, csv] { return plan(*folder, *csv); };
    });
}

}  // namespace study::commands
