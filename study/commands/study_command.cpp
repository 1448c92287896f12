// vis2hap study new|status|plan|amend|sheets
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "database/study_store.h"
#include "protocols/balance.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/protocol_json.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"
#include "study/commands/progress.h"
#include "study/making/new_study.h"
#include "study/making/study_sheets.h"
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

int makeNew(const making::NewStudy& request)
{
    Progress progress("friction images");
    const auto made =
        making::makeStudy(request, [&](int done, int total, const std::string& what) { progress.show(done, total, what); });
    const auto protocol = records::protocolOf(made.facts);
    for (const auto& warning : made.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    std::printf("%s: %s\n", request.study.c_str(), made.facts.name.c_str());
    std::printf("  %d participants, fabrics", protocol.participants);
    for (const auto& fabric : made.facts.fabrics)
        std::printf(" %s (%s)", fabric.value.c_str(), made.facts.fabricNames.at(fabric).c_str());
    std::printf(", %zu conditions%s\n", protocol.conditions.size(), made.imagesReused ? ", friction images reused" : "");
    std::printf("  %d presentations and %d answers a participant: about %.0f minutes in %s, by %g s a presentation\n",
                protocol.presentations(), protocol.answersPerParticipant(), protocol.minutesPerParticipant(),
                sittingsText(protocol.sittingsPerParticipant()).c_str(), protocol.secondsPerPresentation);
    if (!made.facts.familiarisation.empty())
        std::printf("  for getting to know the display: %s\n", listOf(made.facts.familiarisation).c_str());
    std::printf("balance reached:\n%s", describe(made.balance).c_str());
    std::printf("next: vis2hap study sheets %s --out DIR prints the swatch codes and the scale's card\n", request.study.c_str());
    return 0;
}

int status(const std::string& study, const JsonTarget& target)
{
    const auto json = records::statusOf(records::openStudy(study));
    if (target)
        writeJson(target, json);
    else
        std::fputs(records::textOf(json).c_str(), stdout);
    return 0;
}

/// The codes on the fabric pieces, where there are any.
std::string pieceName(const database::StudyFacts& facts, int slot, const protocols::FabricId& fabric)
{
    const auto index = static_cast<std::size_t>(slot) - 1;
    return index < facts.swatches.size() ? facts.swatches[index].at(fabric) : fabric.value;
}

int plan(const std::string& study, const std::string& csv)
{
    const auto store = records::openStudy(study);
    const auto facts = store.facts();
    const auto protocol = records::protocolOf(facts);
    std::string text = "slot,trial,questions,presentation_code,tray,minutes,sitting\n";
    for (const auto& slot : store.slots())
        for (const auto& trial : store.trials(slot.number)) {
            std::string questions, tray;
            for (const auto& question : protocol.phases[trial.phase].questions)
                questions += (questions.empty() ? "" : " ") + question.id.value;
            for (const auto& fabric : trial.alternatives)
                tray += (tray.empty() ? "" : " ") + pieceName(facts, slot.number, fabric);
            const double minutes = (trial.number.value - 1) * protocol.secondsPerPresentation / 60;
            const int sitting = 1 + static_cast<int>(minutes / protocol.sittingMinutes);
            text += std::to_string(slot.number) + "," + std::to_string(trial.number.value) + "," + csvCell(questions) + "," +
                    trial.presentationCode.value + "," + csvCell(tray) + "," + numberText(minutes) + "," +
                    std::to_string(sitting) + "\n";
        }
    writeFile(csv, text);
    std::printf("%s: running orders of %d slots\n", csv.c_str(), protocol.participants);
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

/// protocol.json was edited: taken over for participants to come, or put back.
int amend(const Amendment& call)
{
    database::StudyStore store({call.study}, database::StudyStore::Access::Write);
    const auto file = store.folder().protocol();
    const auto kept = store.protocolVersions().back();
    if (call.undo) {
        writeFile(file, kept.json);
        std::printf("%s: put back as it was (version %d)\n", file.c_str(), kept.version);
        return 0;
    }
    const std::string text = readFile(file);
    if (protocols::sha256(text) == kept.sha256) {
        std::printf("%s: unchanged (version %d), nothing to take over\n", file.c_str(), kept.version);
        return 0;
    }
    const auto changed = fixedPartsChanged(protocols::keptProtocolFromJson(kept.json, "the kept protocol"),
                                           protocols::keptProtocolFromJson(text, file.string()));
    if (!changed.empty())
        throw protocols::badInput(
            {"it changes " + listed(changed) + ", on which running orders and stimuli hang", file.string(),
             "changes of words, times, breaks, bounds, contrasts, checklist or facts",
             "make a new study for it; `vis2hap study amend " + call.study + " --undo` puts the kept text back"});
    store.takeProtocol(text, call.who, call.why);
    std::printf("%s: taken over as version %d; participants enrolled before keep theirs\n", file.c_str(), kept.version + 1);
    return 0;
}

void addNew(CLI::App& study, Action& action)
{
    auto* command = study.add_subcommand("new", "make a study from a data set and a protocol");
    auto call = std::make_shared<making::NewStudy>();
    call->programVersion = versionText();
    command->add_option("STUDY", call->study, "folder to make")->required();
    command->add_option("--dataset", call->dataset, "the data set")->required();
    command->add_option("--protocol", call->protocol, "protocol JSON (default: the paper's study)");
    command->add_option("--model", call->model, "weights of the generators (default: the shipped ones)");
    command->add_option("--participants", call->participants, "instead of the protocol's number")->check(CLI::Range(1, 10000));
    command->add_option("--seed", call->seed, "draws fabrics, samples and running orders")->capture_default_str();
    command->add_option("--key-seed", call->keySeed, "for tests: draws the allocation, which is else a secret of the system");
    command->add_flag("--allow-training-samples", call->allowTrainingSamples,
                      "show samples the model was trained on; stamped into the report");
    command->add_option("--images", call->images,
                        "keep the friction images here under their names, and reuse them while they fit");
    command->add_flag("--replace-simulated", call->replaceSimulated, "remake a study in which no human took part");
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [call] { return makeNew(*call); };
    });
}

}  // namespace

void addStudy(CLI::App& app, Action& action)
{
    auto* study = app.add_subcommand("study", "make a study, see how it stands, print its running orders");
    study->require_subcommand(1);
    addNew(*study, action);

    auto* statusCommand = study->add_subcommand("status", "progress, balance, data-quality flags; blinded");
    auto folder = std::make_shared<std::string>();
    auto target = std::make_shared<JsonTarget>();
    statusCommand->add_option("STUDY", *folder, "the study")->required();
    addJsonOption(*statusCommand, *target);
    statusCommand->callback([folder, target, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [folder, target] { return status(*folder, *target); };
    });

    auto* amendCommand =
        study->add_subcommand("amend", "take an edited protocol.json over for participants to come, or undo the edit");
    auto amendment = std::make_shared<Amendment>();
    amendCommand->add_option("STUDY", amendment->study, "the study")->required();
    amendCommand->add_option("--who", amendment->who, "who changes it");
    amendCommand->add_option("--why", amendment->why, "why");
    amendCommand->add_flag("--undo", amendment->undo, "put the text back that the study keeps");
    amendCommand->callback([amendment, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [amendment] { return amend(*amendment); };
    });

    auto* sheetsCommand = study->add_subcommand("sheets", "to print: swatch labels, preparation sheets, the scale's card");
    auto out = std::make_shared<std::string>();
    sheetsCommand->add_option("STUDY", *folder, "the study")->required();
    sheetsCommand->add_option("--out", *out, "folder to write")->required();
    sheetsCommand->callback([folder, out, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [folder, out] { return making::writeSheets(records::openStudy(*folder), *out); };
    });

    auto* planCommand = study->add_subcommand("plan", "the blinded running order, one row a trial");
    auto csv = std::make_shared<std::string>();
    planCommand->add_option("STUDY", *folder, "the study")->required();
    planCommand->add_option("--csv", *csv, "file to write")->required();
    planCommand->callback([folder, csv, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [folder, csv] { return plan(*folder, *csv); };
    });
}

}  // namespace study::commands
