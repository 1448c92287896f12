// A simulated participant who trades speed for accuracy: the times are those of the stated race, and a planted trade is recovered
// from the answers that the session stored.
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "database/keys.h"
#include "rendering/display/display.h"
#include "reports/analysis/study_analysis.h"
#include "study/players/evidence_accumulation.h"
#include "study/players/hands.h"
#include "study/players/simulated_participant.h"
#include "study/players/simulated_session.h"
#include "study/records/stored_study.h"
#include "study/session/driver.h"
#include "study/session/stimuli.h"
#include "tests/support/study_builder.h"

using namespace study::players;

namespace {

/// Log density, and log survival, of the first passage of drift v at bound a (inverse Gaussian).
double logDensity(double t, double v, double a)
{
    return std::log(a) - 0.5 * std::log(2 * M_PI * t * t * t) - (a - v * t) * (a - v * t) / (2 * t);
}
double normalTail(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }
double logSurvival(double t, double v, double a)
{
    const double root = std::sqrt(t);
    return std::log(std::max(1e-300, normalTail((v * t - a) / root) - std::exp(2 * v * a) * normalTail((v * t + a) / root)));
}

/// One recorded choice: whether it was right, its time, and which bound it belongs to.
struct Choice {
    bool isRight = false;
    double seconds = 0;
    std::size_t instruction = 0;
};

/// The drifts of the right and of each wrong alternative, two bounds, the non-decision time.
using Trade = std::array<double, 5>;

double minusLogLikelihood(const std::vector<Choice>& choices, const Trade& trade, int alternatives)
{
    const auto [right, wrong, boundA, boundB, rest] = trade;
    if (std::min({right, wrong, boundA, boundB, rest}) <= 0) return 1e12;
    double sum = 0;
    for (const Choice& choice : choices) {
        const double t = choice.seconds - rest, a = choice.instruction == 0 ? boundA : boundB;
        if (t <= 0) return 1e12;
        sum += choice.isRight
                   ? logDensity(t, right, a) + (alternatives - 1) * logSurvival(t, wrong, a)
                   : logDensity(t, wrong, a) + logSurvival(t, right, a) + (alternatives - 2) * logSurvival(t, wrong, a);
    }
    return -sum;
}

/// The simplex search of Nelder and Mead (1965).
Trade minimised(const std::function<double(const Trade&)>& f, const Trade& start)
{
    constexpr std::size_t n = std::tuple_size_v<Trade>;
    std::vector<std::pair<double, Trade>> simplex{{f(start), start}};
    for (std::size_t i = 0; i < n; ++i) {
        Trade corner = start;
        corner[i] *= 1.3;
        simplex.emplace_back(f(corner), corner);
    }
    for (int step = 0; step < 2000; ++step) {
        std::sort(simplex.begin(), simplex.end());
        if (simplex.back().first - simplex.front().first < 1e-7) break;
        Trade centre{};
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t i = 0; i < n; ++i) centre[i] += simplex[k].second[i] / n;
        const auto along = [&](double factor) {
            Trade point;
            for (std::size_t i = 0; i < n; ++i) point[i] = centre[i] + factor * (simplex[n].second[i] - centre[i]);
            return std::pair(f(point), point);
        };
        auto candidate = along(-1);
        if (candidate.first < simplex.front().first) {
            const auto further = along(-2);
            if (further.first < candidate.first) candidate = further;
        } else if (candidate.first >= simplex[n - 1].first) {
            candidate = along(candidate.first < simplex[n].first ? -0.5 : 0.5);
        }
        if (candidate.first < simplex[n].first) {
            simplex[n] = candidate;
            continue;
        }
        for (std::size_t k = 1; k <= n; ++k) {
            for (std::size_t i = 0; i < n; ++i)
                simplex[k].second[i] = simplex[0].second[i] + 0.5 * (simplex[k].second[i] - simplex[0].second[i]);
            simplex[k].first = f(simplex[k].second);
        }
    }
    return std::min_element(simplex.begin(), simplex.end())->second;
}

constexpr int fabrics = 6;

/// Percepts in which every stimulus feels exactly like its fabric, and all fabrics are equally far apart.
Percepts equallyFarApart(const database::StudyStore& store, const protocols::AllocationKey& key)
{
    Percepts percepts;
    percepts.stationKey = stationKeyOf(key.secret);
    std::size_t place = 0;
    for (const auto& fabric : store.facts().fabrics) {
        Percept percept;
        percept.texture.at(place++) = 1.0;
        percepts.fabrics[fabric] = percept;
    }
    for (const auto& [code, entry] : key.entries) percepts.stimuli[code] = percepts.fabrics.at(entry.fabric);
    return percepts;
}

std::string protocolWith(const std::string& instructions, int participants)
{
    return R"({"schema": "vis2hap.protocol/1", "name": "Trade", "participants": )" + std::to_string(participants) +
           R"(, "fabrics": ["F01", "F02", "F03", "F04", "F05", "F06"], "conditions": ["v_grey", "v_shape", "f", "h", "h&f"],
               "phases": [{"questions": ["Q1"], "alternatives": 3, "instructions": )" +
           instructions + R"(}], "dead_time_seconds": 0, "consent": "Yes.", "checklist": ["ready"]})";
}

/// Simulated participants play the whole study; returns the data of its report, still blinded.
reports::StudyData playedStudy(const std::filesystem::path& place, const std::string& protocol, int participants,
                               const PerceptualModel& model, const SpeedAccuracySetting& setting)
{
    using namespace study::session;
    tests::support::StudyRecipe recipe;
    recipe.fabrics = fabrics;
    recipe.protocol = protocol;
    const auto folder = tests::support::buildStudy(place, recipe);
    database::StudyStore store(folder, database::StudyStore::Access::Write);
    const auto key = readAllocationKeyForTestDriver(store, database::ParticipantKind::Simulated, {});
    const Percepts percepts = equallyFarApart(store, key);
    auto bank = stimuliOf(store);
    const auto display = rendering::openDisplay("none");
    for (int k = 1; k <= participants; ++k) {
        const protocols::ParticipantId id("SIM" + std::to_string(k));
        VirtualClock clock;
        Driver driver(store, id, database::ParticipantKind::Simulated, bank, *display, clock);
        DriverHands hands(driver);
        SimulatedParticipant participant(percepts, 1, id.value, model, setting);
        Mishaps none({}, 1, id, driver.plan().protocol.answersPerParticipant());
        playSession(judgeOf(participant), none, driver.plan(), hands, clock);
    }
    return *study::records::studyData(store, {});
}

}  // namespace

class SpeedAccuracyTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// Inverse Gaussian: mean a / v, variance a / v^3; and the share of early times by its distribution function.
    void timesOfOneAccumulatorAreInverseGaussian()
    {
        protocols::Random random(4);
        const double v = 0.5, a = 2.0, early = 3.0;
        constexpr int draws = 40'000;
        double sum = 0, squares = 0;
        int before = 0;
        for (int i = 0; i < draws; ++i) {
            const double seconds = race(std::array{v}, a, 1.0, std::nullopt, random).seconds - 1.0;
            sum += seconds;
            squares += seconds * seconds;
            before += seconds <= early;
        }
        const double mean = sum / draws, variance = squares / draws - mean * mean;
        // Standard errors: 0.02, 0.5 and 0.0025.
        QVERIFY2(std::fabs(mean - a / v) < 0.08, qPrintable(QString::number(mean)));
        QVERIFY2(std::fabs(variance - a / (v * v * v)) < 2, qPrintable(QString::number(variance)));
        const double expected = 1 - std::exp(logSurvival(early, v, a));
        QVERIFY2(std::fabs(static_cast<double>(before) / draws - expected) < 0.01, qPrintable(QString::number(expected)));
    }

    void speedLowersTheBoundAndADeadlineCollapsesIt()
    {
        const SpeedAccuracySetting setting;
        const auto bound = [&](protocols::SpeedAim aim) { return boundUnder(setting, aim); };
        QVERIFY(bound(protocols::SpeedAim::Speed) < bound(protocols::SpeedAim::None));
        QVERIFY(bound(protocols::SpeedAim::None) < bound(protocols::SpeedAim::Accuracy));
        protocols::Random random(5);
        const std::array drifts{0.6, 0.2, 0.2};
        int late = 0, lateWithout = 0;
        for (int i = 0; i < 4000; ++i) {
            late += race(drifts, 2.0, 1.0, 3.0, random).seconds > 3.0;
            lateWithout += race(drifts, 2.0, 1.0, std::nullopt, random).seconds > 3.0;
        }
        QVERIFY2(late > 0 && late * 5 < lateWithout, qPrintable(QString("%1 of %2").arg(late).arg(lateWithout)));
    }

    /// 30 persons x 30 renderings x 2 instructions, all alike: drifts, bounds and t0 come back from the stored answers.
    void aPlantedTradeIsRecovered()
    {
        QTemporaryDir place;
        constexpr int participants = 30;
        const SpeedAccuracySetting planted{.nonDecisionSeconds = 1.2,
                                           .bound = 2.0,
                                           .speedFactor = 0.6,
                                           .accuracyFactor = 1.5,
                                           .gain = 1.0,
                                           .fall = 3.0,
                                           .personSpread = 0};
        const PerceptualModel model{.lapseRate = 0, .slipperinessWeight = 0};
        const auto data =
            playedStudy(place.filePath("study").toStdString(),
                        protocolWith(R"([{"id": "speed", "aim": "speed"}, {"id": "accuracy", "aim": "accuracy"}])", participants),
                        participants, model, planted);
        std::vector<Choice> choices;
        for (const auto& response : data.responses)
            choices.push_back({std::get<reports::ChosenAnswer>(response.content).correct, response.seconds.value(),
                               response.instruction == "speed" ? std::size_t(0) : std::size_t(1)});
        QCOMPARE(choices.size(), std::size_t(participants * fabrics * 5 * 2));
        const Trade found =
            minimised([&](const Trade& trade) { return minusLogLikelihood(choices, trade, 3); }, {0.7, 0.4, 1.0, 2.0, 0.8});
        Percept a, b;
        a.texture[0] = b.texture[1] = 1;
        const Trade truth{driftAt(planted, 0), driftAt(planted, textureDistance(a, b)), 2.0 * 0.6, 2.0 * 1.5, 1.2};
        for (std::size_t i = 0; i < truth.size(); ++i) {
            qInfo("planted %.3f, recovered %.3f", truth[i], found[i]);
            QVERIFY2(std::fabs(found[i] / truth[i] - 1) < 0.15, qPrintable(QString("%1: %2").arg(truth[i]).arg(found[i])));
        }
    }

    /// The report has the instruction as a factor, late answers are marked and kept, and every participant gives all answers.
    void theReportShowsTheTrade()
    {
        QTemporaryDir place;
        constexpr int participants = 12;
        auto data = playedStudy(place.filePath("study").toStdString(),
                                protocolWith(R"([{"id": "speed", "aim": "speed"}, {"id": "accuracy", "aim": "accuracy"},
                                                 {"id": "deadline", "deadline_seconds": 2}])",
                                             participants),
                                participants, {}, {});
        data.blinded = false;  // a blinded report compares nothing
        QCOMPARE(data.responses.size(), data.expectedResponses);
        QCOMPARE(data.answersPerCell, std::size_t(3));
        const auto analysis = reports::analyse(data, {.depth = reports::Depth::Quick});
        const auto& choices = reports::questionsWith<reports::ChoiceAnalysis>(analysis).front().findings;
        const auto& rows = choices.instructions.instructions;
        QCOMPARE(rows.size(), std::size_t(3));
        for (const auto& row : rows) {
            qInfo("%s: %.2f s [%.2f, %.2f], %.3f correct, %.3f bits/s, late %zu of %zu", row.instruction.id.c_str(),
                  *row.speed.medianSeconds, *row.speed.medianSecondsCi95.low, *row.speed.medianSecondsCi95.high, *row.speed.share,
                  *row.speed.bitsPerSecond, row.late, row.timed);
            QCOMPARE(row.answers, std::size_t(participants * fabrics * 5));
            QCOMPARE(row.conditions.size(), std::size_t(5));
            QCOMPARE(row.accuracy.bins.size(), reports::speedBins);
            QVERIFY(*row.speed.shareCi95.low <= *row.speed.share && *row.speed.share <= *row.speed.shareCi95.high);
        }
        QVERIFY(*rows[0].speed.medianSecondsCi95.high < *rows[1].speed.medianSecondsCi95.low);
        QVERIFY(*rows[0].speed.share < *rows[1].speed.share);
        QVERIFY(rows[2].late > 0 && rows[2].late < rows[2].timed && rows[2].timed == rows[2].answers);
        QVERIFY(*rows[2].speed.medianSeconds < 2.0);
        const auto& speedAgainstAccuracy = choices.instructions.contrasts.front();
        QVERIFY(*speedAgainstAccuracy.tests.logSeconds.test.estimate < 0 && *speedAgainstAccuracy.tests.logSeconds.pHolm < 0.001);
        QVERIFY(*choices.instructions.logSeconds.effects[1].pGg < 0.001);
    }
};

QTEST_GUILESS_MAIN(SpeedAccuracyTest)
#include "speed_accuracy_test.moc"
