// vis2hap study new|status|plan
#include "database/study_store.h"
#include "protocols/counterbalancing.h"
#include "reports/report.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"
#include "study/commands/new_study.h"
#include "study/commands/progress.h"
#include "study/commands/stored_study.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace study::commands {

namespace {

using nlohmann::ordered_json;

int makeNew(const NewStudy& request)
{
    Progress progress("friction images");
    const auto made = makeStudy(request, [&](int done, int total, const std::string& what) { progress.show(done, total, what); });
    const auto protocol = protocolOf(made.facts);
    for (const auto& warning : made.warnings)
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    std::printf("%s: %s\n", request.study.c_str(), made.facts.name.c_str());
    std::printf("  %d participants, fabrics", protocol.participants);
    for (const auto& fabric : made.facts.fabrics)
        std::printf(" %s (%s)", fabric.value.c_str(), made.facts.fabricNames.at(fabric).c_str());
    std::printf(", %zu conditions%s\n", protocol.conditions.size(), made.imagesReused ? ", friction images reused" : "");
    std::printf("balance reached:\n%s", describe(made.balance).c_str());
    return 0;
}

struct SlotProgress {
    database::Slot slot;
    std::size_t answered = 0, voided = 0, corrected = 0;
};

std::vector<SlotProgress> progressOf(const database::StudyStore& store)
{
    std::vector<SlotProgress> rows;
    const auto answers = store.answers();
    for (const auto& slot : store.slots()) {
        SlotProgress row{slot, 0, 0, 0};
        for (const auto& answer : answers) {
            if (slot.participant.empty() || answer.participant != slot.participant)
                continue;
            ++(answer.voided ? row.voided : row.answered);
            row.corrected += answer.corrections > 0;
        }
        rows.push_back(row);
    }
    return rows;
}

std::size_t answersPerParticipant(const protocols::Protocol& protocol)
{
    std::size_t questions = 0;
    for (const auto& phase : protocol.phases)
        questions += phase.questions.size();
    return questions * static_cast<std::size_t>(protocol.presentationsPerPhase());
}

ordered_json statusJson(const database::StudyStore& store)
{
    const auto facts = store.facts();
    const auto protocol = protocolOf(facts);
    const auto balance = balanceOf(protocols::drawDesign(protocol, facts.designSeed), protocol);
    ordered_json json{{"schema", "vis2hap.status/1"}, {"study", facts.name}, {"protocol_sha256", facts.protocolSha256}};
    json["blinded"] = !store.unblinding().has_value();
    json["answers_per_participant"] = answersPerParticipant(protocol);
    std::map<std::string, int> kinds{{"human", 0}, {"scripted", 0}, {"simulated", 0}}, states;
    for (const auto& row : progressOf(store)) {
        ++states[nameOf(row.slot.state)];
        ordered_json entry{{"slot", row.slot.number}, {"state", nameOf(row.slot.state)}};
        if (row.slot.state != database::SlotState::Free) {
            ++kinds[nameOf(row.slot.kind)];
            entry["participant"] = row.slot.participant.value;
            entry["kind"] = nameOf(row.slot.kind);
            entry["answers"] = row.answered;
            entry["voided"] = row.voided;
            entry["corrected"] = row.corrected;
        }
        json["slots"].push_back(entry);
    }
    json["kinds"] = kinds;
    json["states"] = states;
    for (const auto& range : balance.ranges)
        json["balance"].push_back({{"what", range.what}, {"min", range.min}, {"max", range.max}});
    json["immediate_repeats"] = balance.immediateRepeats;
    json["repeated_foil_pairs"] = balance.repeatedFoilPairs;
    json["stamps"] = facts.stamps;
    json["quality"] = reports::results(studyData(store))["quality"];
    return json;
}

void printStatus(const ordered_json& status)
{
    std::printf("%s (%s)\n", status["study"].get<std::string>().c_str(), status["blinded"].get<bool>() ? "blinded" : "unblinded");
    const auto expected = status["answers_per_participant"].get<std::size_t>();
    for (const auto& slot : status["slots"]) {
        if (slot["state"] == "free") {
            std::printf("  slot %2d  free\n", slot["slot"].get<int>());
            continue;
        }
        std::printf("  slot %2d  %-8s %-9s %-9s %zu of %zu answers, %zu voided, %zu corrected\n", slot["slot"].get<int>(),
                    slot["participant"].get<std::string>().c_str(), slot["kind"].get<std::string>().c_str(),
                    slot["state"].get<std::string>().c_str(), slot["answers"].get<std::size_t>(), expected,
                    slot["voided"].get<std::size_t>(), slot["corrected"].get<std::size_t>());
    }
    std::printf("balance of the running orders:\n");
    for (const auto& range : status["balance"])
        std::printf("  %s: %d to %d\n", range["what"].get<std::string>().c_str(), range["min"].get<int>(), range["max"].get<int>());
    for (const auto& stamp : status["stamps"])
        std::printf("note: %s\n", stamp.get<std::string>().c_str());
    for (const auto& flag : status["quality"])
        std::printf("flag: %s %s: %s\n", flag["participant"].is_string() ? flag["participant"].get<std::string>().c_str() : "",
                    flag["flag"].get<std::string>().c_str(), flag["why"].get<std::string>().c_str());
}

int status(const std::string& study, const JsonTarget& target)
{
    const auto json = statusJson(openStudy(study));
    if (target)
        writeJson(target, json);
    else
        printStatus(json);
    return 0;
}

int plan(const std::string& study, const std::string& csv)
{
    const auto store = openStudy(study);
    const auto facts = store.facts();
    const auto protocol = protocolOf(facts);
    std::string text = "slot,trial,questions,presentation_code,tray,minutes,sitting\n";
    for (const auto& slot : store.slots())
        for (const auto& trial : store.trials(slot.number)) {
            std::string questions, tray;
            for (const auto& question : protocol.phases[trial.phase].questions)
                questions += (questions.empty() ? "" : " ") + question.id.value;
            for (const auto& fabric : trial.alternatives)
                tray += (tray.empty() ? "" : " ") + fabric.value;
            const double minutes = (trial.number.value - 1) * protocol.secondsPerPresentation / 60;
            const int sitting = 1 + static_cast<int>(minutes / protocol.sittingMinutes);
            text += std::to_string(slot.number) + "," + std::to_string(trial.number.value) + "," + csvCell(questions) + "," +
                    trial.presentationCode.value + "," + csvCell(tray) + "," + numberText(minutes) + "," + std::to_string(sitting) + "\n";
        }
    writeFile(csv, text);
    std::printf("%s: running orders of %d slots\n", csv.c_str(), protocol.participants);
    return 0;
}

void addNew(CLI::App& study, Action& action)
{
    auto* command = study.add_subcommand("new", "make a study from a data set and a protocol");
    auto call = std::make_shared<NewStudy>();
    command->add_option("STUDY", call->study, "folder to make")->required();
    command->add_option("--dataset", call->dataset, "the data set")->required();
    command->add_option("--protocol", call->protocol, "protocol JSON (default: the paper's study)");
    command->add_option("--model", call->model, "weights of the generators (default: the shipped ones)");
    command->add_option("--participants", call->participants, "instead of the protocol's number")->check(CLI::Range(1, 10000));
    command->add_option("--seed", call->seed, "draws fabrics, samples and running orders")->capture_default_str();
    command->add_option("--key-seed", call->keySeed, "for tests: draws the allocation, which is else a secret of the system");
    command->add_flag("--allow-training-samples", call->allowTrainingSamples, "show samples the model was trained on; stamped into the report");
    command->add_option("--images", call->images, "keep the friction images here under their names, and reuse them while they fit");
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
