#include "study/bench/bench_session.h"

#include <unistd.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QSqlDatabase>
#include <QSqlError>
#include <QSqlQuery>
#include <QSqlRecord>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/orders/counterbalancing.h"
#include "protocols/protocol_json.h"
#include "rendering/composition/friction_image.h"
#include "rendering/display/stimulus_bank.h"
#include "study/app/gui_operator.h"
#include "study/app/main_window.h"
#include "study/bench/bench_study.h"
#include "study/session/driver.h"
#include "study/session/preparation.h"
#include "study/session/stimuli.h"

namespace study::bench {

namespace {

using namespace session;
using nlohmann::ordered_json;

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

/// Commits the rows of recorded answers by SQL alone: statements prepared once, the same schema, indices and settings.
class BareCommits {
public:
    /// `played`: a study whose answers are copied into the study `empty`.
    BareCommits(const database::StudyFolder& empty, const database::StudyFolder& played)
        : m_target(opened(empty, "bare-target")), m_source(opened(played, "bare-source")), m_events(m_source), m_answers(m_source)
    {
        QSqlQuery people(m_source);
        run(people, "SELECT * FROM participants");
        QSqlQuery enrol = insertionInto("participants", people);
        while (people.next()) copyRow(people, enrol);
        run(m_events, "SELECT * FROM events WHERE kind = 'answered' ORDER BY sequence");
        run(m_answers, "SELECT * FROM responses ORDER BY event");
        m_addEvent = insertionInto("events", m_events);
        m_addAnswer = insertionInto("responses", m_answers);
    }
    ~BareCommits()
    {
        m_events.clear();
        m_answers.clear();
        m_addEvent.reset();
        m_addAnswer.reset();
        for (QSqlDatabase* database : {&m_target, &m_source}) {
            const QString name = database->connectionName();
            *database = QSqlDatabase();
            QSqlDatabase::removeDatabase(name);
        }
    }
    BareCommits(const BareCommits&) = delete;
    BareCommits& operator=(const BareCommits&) = delete;

    /// Commits the rows of the next answer. Milliseconds.
    double next()
    {
        if (!m_events.next() || !m_answers.next())
            throw protocols::workFailed({"no recorded answer is left", "bench session --peers", "", ""});
        QElapsedTimer timer;
        timer.start();
        QSqlQuery statement(m_target);
        run(statement, "BEGIN IMMEDIATE");
        copyRow(m_events, *m_addEvent);
        copyRow(m_answers, *m_addAnswer);
        run(statement, "COMMIT");
        return static_cast<double>(timer.nsecsElapsed()) / 1e6;
    }

private:
    static void require(bool done, const QSqlQuery& query)
    {
        if (!done)
            throw protocols::workFailed({"a statement of SQLite failed: " + query.lastError().text().toStdString(),
                                         "bench session --peers", "", "report this"});
    }
    static void run(QSqlQuery& query, const QString& sql) { require(query.exec(sql), query); }

    static QSqlDatabase opened(const database::StudyFolder& folder, const QString& name)
    {
        QSqlDatabase database = QSqlDatabase::addDatabase("QSQLITE", name);
        database.setDatabaseName(QString::fromStdString(folder.database().string()));
        database.open();
        QSqlQuery query(database);
        for (const char* pragma : {"PRAGMA journal_mode = WAL", "PRAGMA synchronous = FULL", "PRAGMA foreign_keys = ON"})
            run(query, pragma);
        return database;
    }
    QSqlQuery insertionInto(const QString& table, const QSqlQuery& source)
    {
        QStringList places;
        for (int column = 0; column < source.record().count(); ++column) places << "?";
        QSqlQuery query(m_target);
        require(query.prepare("INSERT INTO " + table + " VALUES (" + places.join(", ") + ")"), query);
        return query;
    }
    static void copyRow(const QSqlQuery& from, QSqlQuery& into)
    {
        for (int column = 0; column < from.record().count(); ++column) into.bindValue(column, from.value(column));
        require(into.exec(), into);
    }

    QSqlDatabase m_target, m_source;
    QSqlQuery m_events, m_answers;
    std::optional<QSqlQuery> m_addEvent, m_addAnswer;
};

/// The engine's durable answer and a bare commit of the same rows, in turns.
BenchRow durableAnswer(const database::StudyFolder& engine, const database::StudyFolder& bare,
                       const database::StudyFolder& played)
{
    BareCommits commits(bare, played);
    Session session(engine, "S01");
    std::vector<double> ours, theirs;
    for (int trial = 1; trial <= 600; ++trial) {
        const auto ms = playThroughEngine(session, trial);
        if (ms.empty()) continue;
        ours.push_back(ms.back());
        theirs.push_back(commits.next());
    }
    const double median = percentile(ours, 0.5), theirMedian = percentile(theirs, 0.5);
    BenchRow row{"durable answer", "engine", median, {}, "", std::to_string(ours.size()) + " answers in turns, 1 sync each"};
    row.quartiles = Quartiles{percentile(ours, 0.25), percentile(ours, 0.75)};
    row.peers["bare SQLite"] = theirMedian;
    row.promise = RatioPromise{"bare SQLite", 1.5, median / theirMedian};
    return row;
}

}  // namespace

std::vector<BenchRow> benchSession(bool peers)
{
    const protocols::TemporaryFolder place;
    const std::filesystem::path& path = place.path();
    std::vector<BenchRow> rows;

    const auto paper =
        makeConstantStudy(path / "paper", std::string(protocols::paperProtocolJson()), balancedDesign,
                          cv::Mat(rendering::displayHeightPx, rendering::displayWidthPx, CV_8UC1, cv::Scalar(128)));
    const WindowTimes window = playThroughWindow(paper);
    rows.push_back({"window with a study", "", window.untilShownMs, {}, "", "from its creation to its first picture"});
    rows.push_back(
        {"answer typed, stored, next drawn", "median", percentile(window.keyToDrawnMs, 0.5), {}, "", "keys, sync and painting"});
    rows.push_back({"answer typed, stored, next drawn", "99th", percentile(window.keyToDrawnMs, 0.99), {}, "", ""});
    rows.push_back({"252 answers through the window", "", window.sessionMs, {}, "", ""});

    const int presentations = 63, phases = 160;
    const auto large =
        makeConstantStudy(path / "large", longProtocol(phases), plainDesign, cv::Mat(1, 1, CV_8UC1, cv::Scalar(128)));
    Session session(large, "S01");
    playThroughEngine(session, presentations);
    const double before = megabytesInUse();
    const auto ms = playThroughEngine(session, phases * presentations);
    const std::string trials = std::to_string(session.driver.state().pace.size());
    rows.push_back({"answer stored by the engine", "median", percentile(ms, 0.5), {}, "", trials + " trials in one session"});
    rows.push_back({"answer stored by the engine", "99th", percentile(ms, 0.99), megabytesInUse() - before,
                    "MB more in use after " + trials + " trials than after 63", ""});
    if (peers) {
        const auto empty = [&](const char* name) {
            return makeConstantStudy(path / name, longProtocol(phases), plainDesign, cv::Mat(1, 1, CV_8UC1, cv::Scalar(128)));
        };
        rows.push_back(durableAnswer(empty("engine"), empty("bare"), large));
    }
    return rows;
}

}  // namespace study::bench
