// The order of the conditions follows from the signals, not from a table. With constant friction images Q1 is at chance and
// ratings do not differ; with the real images h&f beats v_grey.
#include "study/players/simulated_participant.h"

#include <QTemporaryDir>
#include <QTest>

#include "protocols/orders/allocation.h"
#include "protocols/protocol_json.h"
#include "rendering/composition/render_fabrics.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "study/players/expected_touch.h"
#include "study/players/player_answers.h"

using namespace study::players;
using protocols::ConditionId;

namespace {

constexpr int seeds = 20;

struct Scores {
    std::map<ConditionId, double> proportionCorrect, meanRating;
    double proportionCorrectInAll = 0;
};

/// Ten simulated participants answer the whole allocation, without a database.
Scores simulateStudy(const protocols::Protocol& protocol, const protocols::Allocation& allocation, const Percepts& percepts,
                     std::uint64_t seed)
{
    std::map<ConditionId, std::pair<double, int>> correct, ratings;
    for (std::size_t p = 0; p < allocation.participants.size(); ++p) {
        SimulatedParticipant participant(percepts, seed, "SIM" + std::to_string(p));
        for (const auto& trial : allocation.participants[p]) {
            const auto& entry = allocation.key.entryOf(trial);
            const auto& phase = protocol.phases[trial.phase];
            if (std::holds_alternative<protocols::ForcedChoice>(phase.task)) {
                const auto answer = std::get<protocols::FabricId>(participant.match(trial).response);
                correct[entry.condition].first += answer == entry.fabric;
                ++correct[entry.condition].second;
                continue;
            }
            for (const auto& question : phase.questions) {
                const auto rating = std::get<protocols::Tenths>(simulatedAnswer(participant, trial, question).response);
                ratings[entry.condition].first += rating.inScaleUnits();
                ++ratings[entry.condition].second;
            }
        }
    }
    Scores scores;
    for (const auto& [condition, sum] : correct) {
        scores.proportionCorrect[condition] = sum.first / sum.second;
        scores.proportionCorrectInAll += sum.first / sum.second / static_cast<double>(correct.size());
    }
    for (const auto& [condition, sum] : ratings) scores.meanRating[condition] = sum.first / sum.second;
    return scores;
}

}  // namespace

class SimulatedParticipantTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase()
    {
        m_folder = std::make_unique<QTemporaryDir>();
        const auto set = std::filesystem::path(m_folder->path().toStdString()) / "fabrics";
        rendering::fabrics::ProceduralOptions options;
        options.fabrics = 7;
        options.samples = 3;
        options.seed = 11;
        const auto dataset = makeProceduralFabrics(set, options);

        m_protocol = protocols::protocolFromJson(protocols::paperProtocolJson(), "paper");
        m_protocol.conditions = {ConditionId("v_grey"), ConditionId("t_grey"), ConditionId("f"), ConditionId("h"),
                                 ConditionId("h&f")};
        m_protocol.planned.clear();
        for (const auto& fabric : dataset.fabrics) m_facts.fabrics.push_back(fabric.id);
        m_facts.datasetSha256 = hashOf(dataset);
        m_allocation =
            allocate(m_protocol, protocols::drawDesign(m_protocol, 1), m_facts.fabrics, protocols::SecretKey::ofSeed(5));

        rendering::RenderRequest request;
        request.fabrics = m_facts.fabrics;
        request.conditions = m_protocol.conditions;
        const auto rendering = renderFabrics(dataset, request);
        m_percepts.stationKey = stationKeyOf(m_allocation.key.secret);
        m_percepts.fabrics = expectedTouch(m_facts, set);
        for (const auto& [code, entry] : m_allocation.key.entries)
            for (const auto& condition : rendering.conditions)
                if (condition.condition == entry.condition) m_percepts.stimuli[code] = feel(condition.images.at(entry.fabric));
    }

    void constantImagesLeaveMatchesAtChanceAndRatingsEqual()
    {
        auto percepts = m_percepts;
        for (auto& [code, percept] : percepts.stimuli) percept = feel(cv::Mat(800, 1280, CV_8UC1, cv::Scalar(128)));
        double correct = 0;
        std::map<ConditionId, double> rating;
        for (int seed = 0; seed < seeds; ++seed) {
            const auto scores = simulateStudy(m_protocol, m_allocation, percepts, 100 + seed);
            correct += scores.proportionCorrectInAll / seeds;
            for (const auto& [condition, mean] : scores.meanRating) rating[condition] += mean / seeds;
        }
        // 20 x 10 x 35 = 7,000 choices: the standard error of a third is 0.0056.
        QVERIFY2(qAbs(correct - 1.0 / 3) < 0.02, qPrintable(QString::number(correct)));
        double low = 10, high = 0;
        for (const auto& [condition, mean] : rating) {
            low = std::min(low, mean);
            high = std::max(high, mean);
        }
        QVERIFY2(high - low < 0.1, qPrintable(QString("%1 to %2").arg(low).arg(high)));
    }

    void measuredHeightAndFrictionBeatGreyPhotographs()
    {
        int matches = 0, ratings = 0;
        for (int seed = 0; seed < seeds; ++seed) {
            const auto scores = simulateStudy(m_protocol, m_allocation, m_percepts, 200 + seed);
            matches += scores.proportionCorrect.at(ConditionId("h&f")) > scores.proportionCorrect.at(ConditionId("v_grey"));
            ratings += scores.meanRating.at(ConditionId("h&f")) > scores.meanRating.at(ConditionId("v_grey"));
            if (seed == 0)
                for (const auto& [condition, proportion] : scores.proportionCorrect)
                    qInfo("%-8s %.3f correct, mean rating %.2f", condition.value.c_str(), proportion,
                          scores.meanRating.at(condition));
        }
        QVERIFY2(matches >= 19, qPrintable(QString::number(matches)));
        QVERIFY2(ratings >= 19, qPrintable(QString::number(ratings)));
    }

    void theSameSeedIsTheSamePerson()
    {
        SimulatedParticipant first(m_percepts, 3, "SIM01"), second(m_percepts, 3, "SIM01"), other(m_percepts, 4, "SIM01");
        int different = 0;
        for (const auto& trial : m_allocation.participants.front()) {
            if (!std::holds_alternative<protocols::ForcedChoice>(m_protocol.phases[trial.phase].task)) break;
            const auto a = first.match(trial), b = second.match(trial), c = other.match(trial);
            QVERIFY(a.response == b.response && a.seconds == b.seconds);
            different += a.seconds != c.seconds;
        }
        QVERIFY(different > 0);
    }

private:
    std::unique_ptr<QTemporaryDir> m_folder;
    protocols::Protocol m_protocol;
    protocols::Allocation m_allocation;
    database::StudyFacts m_facts;
    Percepts m_percepts;
};

QTEST_GUILESS_MAIN(SimulatedParticipantTest)
#include "simulated_participant_test.moc"
