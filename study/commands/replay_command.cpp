// vis2hap replay STUDY SCRIPT... [--gui], or --paper STUDY: scripted participants answer through the session engine, or through
// the widgets of the window.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <tuple>

#include "database/disk/server_note.h"
#include "database/keys.h"
#include "database/server/study_move.h"
#include "database/study_store.h"
#include "database/study_writing.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "protocols/shipped_folder.h"
#include "rendering/display/display.h"
#include "study/app/gui_operator.h"
#include "study/app/main_window.h"
#include "study/app/state/open_study.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/progress.h"
#include "study/commands/parts/text_checks.h"
#include "study/commands/passphrase_option.h"
#include "study/players/scripted_participant.h"
#include "study/records/stored_study.h"

namespace study::commands {

namespace {

using database::ParticipantKind;
using database::SessionStore;
using database::SlotState;
using database::StudyStore;

class WindowHands final : public players::Hands {
public:
    explicit WindowHands(app::MainWindow& window) : m_hands(window) {}
    std::optional<session::Refusal> perform(const session::EventBody& event) override { return m_hands.perform(event); }
    const session::State& state() const override { return m_hands.view().state; }

private:
    app::GuiOperator m_hands;
};

/// By running order, and in one running order those who withdrew first: their successor then finds the place free. Scripts
/// without one follow, as they are named.
void sortByPlace(std::vector<players::Script>& scripts)
{
    std::ranges::stable_sort(scripts, {}, [](const players::Script& script) {
        return script.slot ? std::tuple(0, *script.slot, script.withdraws() ? 0 : 1) : std::tuple(1, 0, 0);
    });
}

std::vector<players::Script> readScripts(const std::vector<std::string>& files, const protocols::Protocol& protocol)
{
    std::vector<players::Script> scripts;
    std::set<protocols::ParticipantId> seen;
    for (const auto& file : files) {
        scripts.push_back(players::scriptFromJson(protocols::readWholeFile(file, protocols::largestJson), file, protocol));
        if (!seen.insert(scripts.back().participant).second)
            throw protocols::badInput({"participant " + scripts.back().participant.value + " has two scripts", file,
                                       "one script for each participant", "leave one of them out"});
    }
    sortByPlace(scripts);
    return scripts;
}

/// A blinded script knows its trials by number only: in another running order its answers would belong to other images. A server
/// gives out the next free place.
void takePlace(SessionStore& store, const players::Script& script, const database::Slot& taken)
{
    const auto refuse = [&](int other) {
        throw protocols::badInput({"the answers of " + script.participant.value + " belong to running order " +
                                       std::to_string(*script.slot) + ", not to " + std::to_string(other),
                                   script.where, "a study in which that running order is free",
                                   "take \"slot\" out of a script that names fabrics and conditions"});
    };
    if (script.slot && taken.state != SlotState::Free && taken.number != *script.slot) refuse(taken.number);
    if (auto* own = dynamic_cast<StudyStore*>(&store); own != nullptr && script.slot) {
        database::enrolIn(own->connection(), script.participant, ParticipantKind::Scripted, script.slot);
        return;
    }
    const auto slots = store.slots();
    const auto free = std::ranges::find(slots, SlotState::Free, &database::Slot::state);
    if (script.slot && taken.state == SlotState::Free && free != slots.end() && free->number != *script.slot)
        refuse(free->number);
    store.enrol(script.participant, ParticipantKind::Scripted);
}

constexpr int paperParticipants = 10;

/// The scripts that give the paper's totals (protocols/paper).
std::vector<std::string> paperFiles()
{
    const auto folder = protocols::shippedFolder("paper", VIS2HAP_SOURCE_DIR "/protocols/paper");
    std::vector<std::string> files;
    for (int k = 1; k <= paperParticipants; ++k)
        files.push_back((folder / ((k < 10 ? "S0" : "S") + std::to_string(k) + ".json")).string());
    return files;
}

/// The scripts name fabrics F01 to F07. They become the fabrics of the study, in their order.
void nameFabrics(std::vector<players::Script>& scripts, const std::vector<protocols::FabricId>& fabrics, const std::string& study)
{
    std::set<protocols::FabricId> named;
    for (const auto& script : scripts)
        for (const auto& answer : script.answers) named.insert(answer.place.fabric);
    if (named.size() != fabrics.size())
        throw protocols::badInput({"the study has " + std::to_string(fabrics.size()) + " fabrics", study,
                                   std::to_string(named.size()) + ", as in the paper", "make a study of the paper's protocol"});
    std::map<protocols::FabricId, protocols::FabricId> own;
    for (const auto& fabric : named) own[fabric] = fabrics[own.size()];
    for (auto& script : scripts)
        for (auto& answer : script.answers) answer.place.fabric = own.at(answer.place.fabric);
}

database::Slot slotOf(const SessionStore& store, const protocols::ParticipantId& participant)
{
    for (const auto& enrolment : store.enrolments())
        if (enrolment.participant == participant) return {enrolment.slot, enrolment.state, participant, enrolment.kind};
    return {};
}

/// A script must not continue the session of a person.
void requireScripted(const database::Slot& slot, const players::Script& script)
{
    if (slot.state != SlotState::Free && slot.kind != ParticipantKind::Scripted)
        throw protocols::badInput({"participant " + script.participant.value + " is " + nameOf(slot.kind) + ", not scripted",
                                   script.where, "the id of a scripted participant", "change \"participant\" in the script"});
}

bool finishedAlready(const database::Slot& slot, const players::Script& script)
{
    if (slot.state != SlotState::Finished && slot.state != SlotState::Withdrawn) return false;
    std::printf("%s: already %s, nothing to do\n", protocols::printable(script.participant.value).c_str(),
                nameOf(slot.state).c_str());
    return true;
}

struct Playing {
    const protocols::Protocol& protocol;
    const protocols::AllocationKey& key;
    int answersInAll;
    session::OperatedBy operatedBy;
};

/// A script must know the whole list. A server gives each trial out when it is due, so the list comes from the owner's copy.
players::ScriptedTrials trialsFor(const SessionStore& store, const protocols::ParticipantId& participant, const Playing& playing)
{
    const bool isOnServer = database::readServerNote(store.folder().folder).has_value();
    const session::Plan plan =
        isOnServer ? session::readPlan(readStudy(store.folder()), participant) : session::readPlan(store, participant);
    return {plan.trials, playing.key, plan.protocol, plan.fabricNames};
}

void play(const players::Script& script, const SessionStore& store, players::Hands& hands, session::VirtualClock& clock,
          const std::vector<database::EventRecord>& logged, const Playing& playing)
{
    const auto trials = trialsFor(store, script.participant, playing);
    Progress progress(script.participant.value);
    players::playScript(script, trials, logged, hands, clock, [&](int stored) { progress.show(stored, playing.answersInAll); });
    std::printf("%s: %d answers stored, %s\n", protocols::printable(script.participant.value).c_str(),
                hands.state().answersStored,
                std::holds_alternative<session::Finished>(hands.state().stage) ? "finished" : "withdrawn");
    std::printf("  log head %s\n", protocols::printable(textOf(store.head())).c_str());
}

void playDirectly(const std::vector<players::Script>& scripts, const std::filesystem::path& study, const Playing& playing)
{
    app::OpenStudy open(study);
    SessionStore& store = open.store();
    const auto display = rendering::openDisplay("none");
    for (const auto& script : scripts) {
        const auto slot = slotOf(store, script.participant);
        requireScripted(slot, script);
        if (finishedAlready(slot, script)) continue;
        session::requireKeptProtocol(store);  // this and the station key before the participant takes a place
        rendering::PresentedImages& images = open.images();
        takePlace(store, script, slot);
        const auto logged = store.events(script.participant);
        session::VirtualClock clock;
        session::Driver driver(store, script.participant, ParticipantKind::Scripted, images, *display, clock, playing.operatedBy);
        players::DriverHands hands(driver);
        play(script, store, hands, clock, logged, playing);
    }
}

void playThroughWindow(const std::vector<players::Script>& scripts, const std::filesystem::path& study, const Playing& playing)
{
    for (const auto& script : scripts) {
        const auto clock = std::make_shared<session::VirtualClock>();
        app::AppOptions options;
        options.kind = ParticipantKind::Scripted;
        options.clock = clock;
        options.operatedBy = playing.operatedBy;
        app::MainWindow window(options);
        window.openStudy(study);
        auto& store = window.study()->store();
        const auto slot = slotOf(store, script.participant);
        requireScripted(slot, script);
        if (finishedAlready(slot, script)) continue;
        session::requireKeptProtocol(store);  // this and the station key before the participant takes a place
        window.study()->images();
        takePlace(store, script, slot);
        const auto logged = store.events(script.participant);
        window.show();
        window.startSession(script.participant);
        WindowHands hands(window);
        play(script, store, hands, *clock, logged, playing);
    }
}

struct ReplayCall {
    std::string study;
    std::vector<std::string> scripts;
    bool paper = false;
    bool gui = false;
    std::string operatorName;
    PassphraseOption passphrase;
};

int replay(const ReplayCall& call)
{
    const auto& [study, files, paper, gui, operatorName, passphrase] = call;
    if (paper != files.empty())
        throw protocols::badInput({paper ? "--paper has its own scripts" : "there is no script", study,
                                   "either scripts, one for each participant, or --paper", "see `vis2hap replay --help`"});
    // Opened for writing, so that the key read is that of an upgraded study; a server keeps studies of this version only.
    const bool isOnServer = database::readServerNote(study).has_value();
    std::optional<StudyStore> store(isOnServer ? database::readStudy({study}) : StudyStore({study}, StudyStore::Access::Write));
    const auto protocol = records::protocolOf(store->facts());
    auto scripts = readScripts(paper ? paperFiles() : files, protocol);
    if (paper) nameFabrics(scripts, store->facts().fabrics, study);
    const auto key = readAllocationKeyForTestDriver(*store, ParticipantKind::Scripted, passphraseFrom(passphrase));
    const Playing playing{protocol, key, protocol.answersPerParticipant(), session::operatedBy(operatorName, versionText())};
    store.reset();  // the sessions open the study themselves
    if (gui)
        playThroughWindow(scripts, study, playing);
    else
        playDirectly(scripts, study, playing);
    return 0;
}

}  // namespace

void addReplay(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("replay", "let scripted participants answer; resumes where it stopped");
    auto call = std::make_shared<ReplayCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("SCRIPT", call->scripts, "scripts, one for each participant");
    command->add_flag("--paper", call->paper, "play the ten scripts that give the paper's totals (protocols/paper)");
    command->add_flag("--gui", call->gui, "press the keys of the window, with or without a screen");
    command->add_option("--operator", call->operatorName, "who runs the sessions (default: the name of this account)")
        ->check(isName());
    addPassphraseOption(*command, call->passphrase);
    command->callback([call, &action] {
        action.surroundings = call->gui ? Surroundings::SeenIfPossible : Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return replay(*call); };
    });
}

}  // namespace study::commands
