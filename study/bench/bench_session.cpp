#include "study/bench/bench_session.h"

#include <unistd.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QTemporaryDir>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "database/keys.h"
#include "protocols/counterbalancing.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "rendering/composition/friction_image.h"
#include "rendering/display/stimulus_bank.h"
#include "study/app/gui_operator.h"
#include "study/app/main_window.h"
#include "study/session/driver.h"
#include "study/session/preparation.h"
#include "study/session/stimuli.h"

namespace study::bench {

namespace {

using namespace session;
using nlohmann::ordered_json;

/// A study of constant images. The measured times do not depend on the images.
database::StudyFolder makeStudy(const std::filesystem::path& path, const std::string& protocolJson,
                                protocols::Design (*draw)(const protocols::Protocol&), const cv::Mat& image)
{
    const database::StudyFolder folder{path};
    std::filesystem::create_directories(folder.stimuli());
    protocols::writeWholeFile(folder.protocol(), protocolJson, protocols::Sync::Later);
    const auto protocol = protocols::protocolFromJson(protocolJson, "bench");
    database::StudyFacts facts;
    for (int fabric = 1; fabric <= protocol.fabricCount; ++fabric) facts.fabrics.emplace_back("F" + std::to_string(100 + fabric));
    const auto allocation = allocate(protocol, draw(protocol), facts.fabrics, protocols::SecretKey::ofSeed(2));
    std::map<protocols::FileCode, std::string> hashes;
    for (const auto& [code, entry] : allocation.key.entries)
        hashes[code] = rendering::writeStimulus(folder.stimuli(), code, image, stationKeyOf(allocation.key.secret));
    const auto keys = database::writeKeys(folder, allocation.key);
    facts.name = "bench";
    facts.protocolJson = protocolJson;
    facts.protocolSha256 = protocols::sha256(protocolJson);
    facts.keySha256 = keys.allocation;
    facts.stationKeySha256 = keys.station;
    facts.plannedBalance = facts.madeWith = "{}";
    facts.swatches = allocation.swatches;
    facts.signalsJson = "{}";
    database::StudyStore::create(folder, facts, allocation.participants, hashes);
    return folder;
}

protocols::Design balancedDesign(const protocols::Protocol& protocol) { return drawDesign(protocol, 1); }

/// One participant and every rendering in turn. A session of this length cannot be balanced.
protocols::Design plainDesign(const protocols::Protocol& protocol)
{
    protocols::Design design;
    auto& trials = design.participants.emplace_back();
    for (int phase = 0; phase < static_cast<int>(protocol.phases.size()); ++phase)
        for (int fabric = 0; fabric < protocol.fabricCount; ++fabric)
            for (int label = 0; label < static_cast<int>(protocol.conditions.size()); ++label)
                trials.push_back({phase, label, fabric, {fabric}});
    return design;
}

/// The paper's study with ratings in `phases` phases, one question each.
std::string longProtocol(int phases)
{
    auto json = ordered_json::parse(std::string(protocols::paperProtocolJson()));
    json["dead_time_seconds"] = 0;  // nobody's hand bounces here
    const auto scale = json["phases"][1]["scale"];
    json["participants"] = 1;
    json["phases"] = ordered_json::array();
    json["question_texts"] = ordered_json::object();
    for (int phase = 1; phase <= phases; ++phase) {
        const std::string question = "R" + std::to_string(phase);
        json["phases"].push_back({{"questions", {question}}, {"scale", scale}});
        json["question_texts"][question] = "How realistic is it?";
    }
    return json.dump(2) + "\n";
}

GivenAnswer someResponse(const View& view)
{
    if (std::holds_alternative<protocols::Rating>(view.question->kind)) return protocols::Tenths{(view.presentation * 7) % 101};
    return view.trayIds[static_cast<std::size_t>(view.presentation) % view.trayIds.size()];
}

/// The next event in this state; none at the end.
std::optional<EventBody> nextEvent(const View& view, const Plan& plan)
{
    if (const auto preparation = nextOfPreparation(plan.protocol, view.state.stage)) return preparation;
    if (std::holds_alternative<PlacingTray>(view.state.stage)) return TrayReady{};
    if (std::holds_alternative<Presenting>(view.state.stage)) return Answered{someResponse(view)};
    return std::nullopt;
}

double percentile(std::vector<double> values, double share)
{
    std::sort(values.begin(), values.end());
    return values.empty()
               ? 0
               : values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

double megabytesInUse()
{
    long pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

struct Session {
    Session(const database::StudyFolder& folder, const std::string& participant)
        : store(folder, database::StudyStore::Access::Write),
          bank(session::stimuliOf(store)),
          display(rendering::openDisplay("none")),
          driver(store, protocols::ParticipantId(participant), database::ParticipantKind::Scripted, bank, *display, clock)
    {
    }
    database::StudyStore store;
    rendering::StimulusBank bank;
    std::unique_ptr<rendering::HapticDisplay> display;
    VirtualClock clock;
    Driver driver;
};

/// Milliseconds from every answer to its acknowledgement. Stops after `trials` presentations.
std::vector<double> playThroughEngine(Session& session, int trials)
{
    std::vector<double> ms;
    QElapsedTimer timer;
    while (static_cast<int>(session.driver.state().pace.size()) < trials) {
        const View view = session.driver.view();
        const auto event = nextEvent(view, session.driver.plan());
        if (!event) break;
        session.clock.advanceSeconds(3);
        timer.start();
        session.driver.send(*event);
        if (std::holds_alternative<Answered>(*event)) ms.push_back(static_cast<double>(timer.nsecsElapsed()) / 1e6);
    }
    return ms;
}

struct WindowTimes {
    double untilShownMs = 0, sessionMs = 0;
    std::vector<double> keyToDrawnMs;
};

/// A session by keys. Measures from the key press until the answer is stored and the next question is painted.
WindowTimes playThroughWindow(const database::StudyFolder& folder)
{
    WindowTimes times;
    QElapsedTimer whole, single;
    app::AppOptions options;
    options.kind = database::ParticipantKind::Scripted;
    const auto clock = std::make_shared<VirtualClock>();
    options.clock = clock;
    whole.start();
    app::MainWindow window(options);
    window.openStudy(folder.folder);
    window.show();
    QApplication::processEvents();
    times.untilShownMs = static_cast<double>(whole.nsecsElapsed()) / 1e6;
    window.startSession(protocols::ParticipantId("S01"));
    app::GuiOperator gui(window);
    whole.restart();
    while (const auto event = nextEvent(gui.view(), gui.plan())) {
        clock->advanceSeconds(3);
        single.start();
        gui.perform(*event);
        window.repaint();
        QApplication::processEvents();
        if (std::holds_alternative<Answered>(*event))
            times.keyToDrawnMs.push_back(static_cast<double>(single.nsecsElapsed()) / 1e6);
    }
    times.sessionMs = static_cast<double>(whole.nsecsElapsed()) / 1e6;
    return times;
}

}  // namespace

std::vector<BenchRow> benchSession()
{
    const QTemporaryDir place;
    const std::filesystem::path path = place.path().toStdString();
    std::vector<BenchRow> rows;

    const auto paper = makeStudy(path / "paper", std::string(protocols::paperProtocolJson()), balancedDesign,
                                 cv::Mat(rendering::displayHeightPx, rendering::displayWidthPx, CV_8UC1, cv::Scalar(128)));
    const WindowTimes window = playThroughWindow(paper);
    rows.push_back({"window with a study", "", window.untilShownMs, 0, "-", "from its creation to its first picture"});
    rows.push_back(
        {"answer typed, stored, next drawn", "median", percentile(window.keyToDrawnMs, 0.5), 0, "-", "keys, sync and painting"});
    rows.push_back({"answer typed, stored, next drawn", "99th", percentile(window.keyToDrawnMs, 0.99), 0, "-", ""});
    rows.push_back({"252 answers through the window", "", window.sessionMs, 0, "-", ""});

    const int presentations = 63, phases = 160;
    const auto large = makeStudy(path / "large", longProtocol(phases), plainDesign, cv::Mat(1, 1, CV_8UC1, cv::Scalar(128)));
    Session session(large, "S01");
    playThroughEngine(session, presentations);
    const double before = megabytesInUse();
    const auto ms = playThroughEngine(session, phases * presentations);
    const std::string trials = std::to_string(session.driver.state().pace.size());
    rows.push_back({"answer stored by the engine", "median", percentile(ms, 0.5), 0, "-", trials + " trials in one session"});
    rows.push_back({"answer stored by the engine", "99th", percentile(ms, 0.99), megabytesInUse() - before,
                    "MB more in use after " + trials + " trials than after 63", ""});
    return rows;
}

}  // namespace study::bench
