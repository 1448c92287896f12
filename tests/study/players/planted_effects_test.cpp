// Effects that a teacher plants into a simulated study: they are there as stated, and files that do not fit are refused.
#include "study/players/planted_effects.h"

#include <QTest>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "protocols/condition.h"
#include "protocols/protocol_json.h"
#include "tests/support/error_text.h"

using namespace study;
using namespace study::players;
using protocols::ConditionId;
using protocols::FabricId;
using tests::support::errorOf;

namespace {

constexpr const char* protocolText =
    R"({"schema": "vis2hap.protocol/1", "name": "planted", "participants": 8, "fabrics": ["F01", "F02", "F03"],
    "conditions": ["v_grey", "h&f", {"id": "mine", "program": true}], "question_texts": {"S1": "Same?"},
    "phases": [{"questions": ["Q1"], "alternatives": 3}, {"questions": ["S1"], "same_different": true},
               {"questions": ["Q2", "Q3"], "scale": {"min": 0, "max": 10}}]})";

constexpr const char* plantText =
    R"({"schema": "vis2hap.plant/1", "choices": {"Q1": {"right": 0.5, "effects": {"mine": 0.4}}, "S1": {"right": 0.9}},
        "ratings": {"Q2": {"mean": 4, "effects": {"h&f": 3}}}, "careless": ["SIM02"]})";

const protocols::Protocol& protocol()
{
    static const protocols::Protocol read = protocols::protocolFromJson(protocolText, "protocol.json");
    return read;
}

protocols::BlindedTrial trialWith(std::vector<FabricId> tray)
{
    protocols::BlindedTrial trial;
    trial.alternatives = std::move(tray);
    return trial;
}

const std::vector<FabricId> threePieces{FabricId("F01"), FabricId("F02"), FabricId("F03")};

/// The judge of a participant in a study in which every presentation shows `entry`.
struct Sitting {
    PlantedEffects effects = plantedEffectsFromJson(plantText, "plant.json", protocol());
    protocols::AllocationKey::Entry entry{FabricId("F02"), ConditionId("v_grey"), {}};
    Judge judge;

    explicit Sitting(const std::string& participant, std::uint64_t seed = 1)
    {
        const Judge usual = [](const auto&, const auto&) { return SimulatedParticipant::Judgement{protocols::Tenths{99}, 77}; };
        judge = plantedJudge(
            effects, [this](const auto&) -> const auto& { return entry; }, protocols::ParticipantId(participant), seed, usual);
    }

    SimulatedParticipant::Judgement ask(const char* question, const std::vector<FabricId>& tray) const
    {
        return judge(trialWith(tray), *questionWith(protocol(), protocols::QuestionId(question)));
    }
};

double rating(const SimulatedParticipant::Judgement& judgement)
{
    return std::get<protocols::Tenths>(judgement.response).value / 10.0;
}

}  // namespace

class PlantedEffectsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void choicesAreRightAsOftenAsStated()
    {
        Sitting sitting("SIM01");
        for (const auto& [condition, expected] : std::map<std::string, double>{{"v_grey", 0.5}, {"mine", 0.9}}) {
            sitting.entry.condition = ConditionId(condition);
            int right = 0;
            std::map<FabricId, int> wrong;
            for (int k = 0; k < 4000; ++k) {
                const auto chosen = std::get<FabricId>(sitting.ask("Q1", threePieces).response);
                right += chosen == FabricId("F02");
                ++wrong[chosen];
            }
            // Four standard errors of a proportion of 4,000.
            QVERIFY2(std::abs(right / 4000.0 - expected) < 4 * std::sqrt(expected * (1 - expected) / 4000),
                     qPrintable(QString::number(right)));
            QVERIFY2(std::abs(wrong[FabricId("F01")] - wrong[FabricId("F03")]) < 200, "the wrong pieces are as likely");
        }
    }

    void sameAndDifferentAreRightInBothCases()
    {
        Sitting sitting("SIM01");
        for (const char* shown : {"F02", "F03"}) {
            int right = 0;
            for (int k = 0; k < 2000; ++k)
                right += std::get<session::Sameness>(sitting.ask("S1", {FabricId(shown)}).response).same ==
                         (std::string(shown) == "F02");
            QVERIFY2(std::abs(right / 2000.0 - 0.9) < 0.03, qPrintable(QString::number(right)));
        }
    }

    /// Over 400 persons the shift of each averages out; that of the fabric (SD 0.4) is common to both conditions.
    void ratingsDifferByTheStatedEffect()
    {
        double sum[2] = {0, 0};
        for (int person = 0; person < 400; ++person) {
            Sitting sitting("P" + std::to_string(person));
            for (int k = 0; k < 2; ++k) {
                sitting.entry.condition = ConditionId(k == 0 ? "v_grey" : "h&f");
                sum[k] += rating(sitting.ask("Q2", {FabricId("F02")}));
            }
        }
        // SD of a difference 1.2 * sqrt(2), so four standard errors are 0.34; the end of the scale takes a little.
        QVERIFY2(std::abs((sum[1] - sum[0]) / 400 - 3) < 0.4, qPrintable(QString::number((sum[1] - sum[0]) / 400)));
        QVERIFY2(std::abs(sum[0] / 400 - 4) < 4 * 0.4 + 0.3, qPrintable(QString::number(sum[0] / 400)));
    }

    void personsAndFabricsKeepTheirShift()
    {
        std::map<std::string, double> means;
        for (const char* person : {"SIM03", "SIM04", "SIM06", "SIM07"}) {
            Sitting sitting(person);
            for (int k = 0; k < 400; ++k) means[person] += rating(sitting.ask("Q2", {FabricId("F02")})) / 400;
        }
        double least = 10, most = 0;
        for (const auto& [person, mean] : means) {
            least = std::min(least, mean);
            most = std::max(most, mean);
        }
        QVERIFY2(most - least > 0.5, "persons do not differ");
    }

    void blankGlassIsRatedLowAndGuessed()
    {
        Sitting sitting("SIM01");
        sitting.entry = {FabricId("F02"), protocols::catchTrialId(), {}};
        double sum = 0;
        int right = 0;
        for (int k = 0; k < 3000; ++k) {
            sum += rating(sitting.ask("Q2", {FabricId("F02")}));
            right += std::get<FabricId>(sitting.ask("Q1", threePieces).response) == FabricId("F02");
        }
        QVERIFY(sum / 3000 < 1.5);
        QVERIFY2(std::abs(right / 3000.0 - 1.0 / 3) < 0.04, qPrintable(QString::number(right)));
    }

    void otherQuestionsAreAnsweredAsUsual()
    {
        const auto judgement = Sitting("SIM01").ask("Q3", {FabricId("F02")});
        QCOMPARE(rating(judgement), 9.9);
        QCOMPARE(judgement.seconds, 77.0);
    }

    void aCarelessParticipantIsFastAndFeelsNothing()
    {
        Sitting sitting("SIM02");
        int first = 0, middle = 0;
        for (int k = 0; k < 200; ++k) {
            const auto choice = sitting.ask("Q1", threePieces);
            first += std::get<FabricId>(choice.response) == FabricId("F01");
            const auto rated = sitting.ask("Q3", {FabricId("F02")});
            middle += rating(rated) == 5.0;
            QVERIFY(choice.seconds < 0.5 && rated.seconds < 0.5 && choice.seconds > 0);
        }
        QVERIFY2(first > 160 && middle > 160, qPrintable(QString("%1 %2").arg(first).arg(middle)));
    }

    void filesThatDoNotFitAreRefusedWithTheirPlace_data()
    {
        QTest::addColumn<QString>("part");
        QTest::addColumn<QString>("by");
        QTest::addColumn<QString>("words");
        const auto row = [](const char* name, const char* part, const char* by, const char* words) {
            QTest::newRow(name) << QString(part) << QString(by) << QString(words);
        };
        row("another schema", "plant/1", "script/1", "the file plants no effects");
        row("unknown key", "\"careless\"", "\"sloppy\"", "unknown key 'sloppy'");
        row("unknown question", "\"S1\"", "\"S9\"", "the study has no question 'S9'; expected one of Q1, S1, Q2, Q3");
        row("a rating planted as a choice", "\"S1\"", "\"Q3\"", "question Q3 has no right answer");
        row("a choice planted as a rating", "\"Q2\"", "\"Q1\"", "question Q1 is no rating");
        row("unknown condition", "\"h&f\"", "\"h&g\"", "the study has no condition 'h&g'; expected one of v_grey, h&f, mine");
        row("one condition under two spellings", "{\"h&f\": 3}", "{\"h&f\": 3, \"h+f\": -3}",
            "condition 'h&f' has two effects, under two spellings; expected each condition once");
        row("a condition that is not in the study", "\"h&f\"", "\"h\"", "the study has no condition 'h'");
        row("above certainty", "0.4", "0.6", "0.6 is out of range; expected a number from -0.5 to 0.5");
        row("beyond the scale", "{\"h&f\": 3}", "{\"h&f\": 7}", "7 is out of range; expected a number from -4 to 6");
        row("a text for a number", "\"mean\": 4", "\"mean\": \"4\"", "\"4\" is out of range");
        row("no mean", "\"mean\": 4, ", "", "'mean' is missing");
        row("a negative spread", "\"mean\": 4", "\"mean\": 4, \"sd\": -1", "-1 is out of range");
        row("careless by a number", "[\"SIM02\"]", "[2]", "it is no text");
        row("no list", "[\"SIM02\"]", "\"SIM02\"", "it is no list");
        row("cut off", "\"careless\": [\"SIM02\"]}", "", "line 2");
    }

    void filesThatDoNotFitAreRefusedWithTheirPlace()
    {
        QFETCH(QString, part);
        QFETCH(QString, by);
        QFETCH(QString, words);
        QString text = plantText;
        QVERIFY(text.contains(part));
        const std::string changed = text.replace(part, by).toStdString();
        const QString fault = errorOf([&] { (void)plantedEffectsFromJson(changed, "plant.json", protocol()); });
        QVERIFY2(fault.startsWith("2: plant.json, line ") && fault.contains(words) && !fault.contains('\n'), qPrintable(fault));
    }

    void aFileThatPlantsNothingIsRefused()
    {
        const QString fault =
            errorOf([] { (void)plantedEffectsFromJson(R"({"schema": "vis2hap.plant/1"})", "plant.json", protocol()); });
        QVERIFY2(fault.contains("the file plants nothing"), qPrintable(fault));
    }
};

QTEST_GUILESS_MAIN(PlantedEffectsTest)
#include "planted_effects_test.moc"
