// Designs beyond one answer a cell: repetitions, sessions, groups of participants; and analyses of less or more: quick reports,
// many conditions, and results without flagged participants.
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "protocols/files/errors.h"
#include "protocols/orders/same_different.h"
#include "reports/cells/chance_level.h"
#include "reports/data/answers_csv.h"
#include "reports/json/results_json.h"
#include "reports/json/statistics_json.h"
#include "reports/page/page.h"
#include "reports/tables/report_tables.h"
#include "tests/reports/study_builder.h"

using Json = nlohmann::ordered_json;
using reports::Depth;
using reports::StudyData;

namespace {

constexpr const char* answers = "designs_answers.csv";

/// Six participants in two groups, two fabrics, three conditions, two sessions; P6 missed one fabric in the second session. In R:
///   d <- read.csv("designs_answers.csv")
///   cell <- aggregate(cbind(Q2, Q1_correct) ~ participant + group + fabric + condition, d, mean)
///   pm <- aggregate(Q2 ~ participant + group + condition, cell, mean)
void writeAnswers(const QTemporaryDir& folder)
{
    std::ostringstream text;
    text << "participant,group,session,fabric,condition,Q1_correct,Q2\n";
    for (int p = 0; p < 6; ++p)
        for (int s = 1; s <= 2; ++s)
            for (int f = 0; f < 2; ++f)
                for (int c = 0; c < 3; ++c) {
                    if (p == 5 && s == 2 && f == 1) continue;
                    const int value = (p * 7 + s * 3 + f * 5 + c * (p % 2 == 1 ? 2 : 4) + p * s * f * c % 3) % 11;
                    text << 'P' << p + 1 << ',' << (p % 2 == 1 ? "young" : "old") << ',' << s << ",F" << f + 1 << ',' << "abc"[c]
                         << ',' << ((p + s + f + c) % 3 != 0) << ',' << value / 2.0 + c * 0.5 << '\n';
                }
    QFile file(folder.filePath(answers));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(text.str()));
}

StudyData designs()
{
    static const QTemporaryDir folder;
    static const StudyData data = [] {
        writeAnswers(folder);
        return reports::readAnswersCsv(folder.filePath(answers).toStdString());
    }();
    return data;
}

const Json& claim(const Json& results, const std::string& question, const std::string& generalisation)
{
    for (const Json& row : results["claims"])
        if (row["question"] == question && row["generalises_to"] == generalisation && row["a"] == "a" && row["b"] == "b")
            return row;
    static const Json none;
    return none;
}

void compare(const Json& number, double expected)
{
    const double value = number.is_number() ? number.get<double>() : NAN;
    QVERIFY2(std::fabs(value - expected) <= 1e-9 * std::fabs(expected), qPrintable(QString::number(value, 'g', 16)));
}

std::vector<std::string> manyConditions(int count)
{
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i) names.push_back(builders::numbered("c", i));
    return names;
}

/// Everybody answers alike except the last participant, who gives one rating only and so is flagged.
StudyData withOneStraightLiner()
{
    return builders::study(6, 7, {"f", "h"},
                           {[](int p, int f, int c) { return (p + f + c) % 2 == 0; },
                            [](int p, int f, int c, int q) {
                                if (p == 5) return c == 0 ? 9.0 : 0.5;
                                return 5.0 + ((p * 5 + f * 3 + c * 4 + q) % 7) / 10.0;
                            }});
}

}  // namespace

class DesignsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void repeatedAnswersOfACellCountOnceInEveryTest()
    {
        const Json results = reports::resultsJson(reports::analyse(designs()));
        QCOMPARE(results["design"]["answers_per_cell"], Json(2));
        // t.test(Q2.a - Q2.b) over the six participants' means of the cells
        compare(claim(results, "Q2", "these_fabrics")["p"], 0.618025329462198);
        QCOMPARE(claim(results, "Q2", "these_fabrics")["n"], Json(12));
        QCOMPARE(results["questions"]["Q2"]["a"]["n"], Json(23));  // answers, of which each is described
    }

    void modelOfRatingsTakesTheCells()
    {
        const auto statistics = reports::statisticsJson(reports::analyse(designs()));
        // REMLcrit(lmer(Q2 ~ condition + (1|participant) + (1|fabric) + (1|participant:condition) + (1|fabric:condition), cell))
        const double criterion = statistics["lmm_variances"]["Q2"]["REML_criterion"].get<double>();
        QVERIFY2(std::fabs(criterion - 106.222870788) < 1e-6, qPrintable(QString::number(criterion, 'g', 12)));
    }

    void groupsAreComparedOnParticipantsMeans()
    {
        const Json groups = reports::statisticsJson(reports::analyse(designs()))["groups"];
        QCOMPARE(groups["participants"], (Json{{"old", 3}, {"young", 3}}));
        const Json& rated = groups["questions"]["Q2"];
        // t.test(Q2 ~ group, aggregate(Q2 ~ participant + group, pm, mean)): t^2, df, p, difference, interval
        compare(rated["overall"]["statistic"], 0.835260115606937);
        compare(rated["overall"]["df2"], 2.998221843772694);
        compare(rated["overall"]["p"], 0.428182168067488);
        compare(rated["overall"]["difference"], -0.236111111111111);
        compare(rated["overall"]["ci95"][0], -1.058566519751414);
        compare(rated["overall"]["ci95"][1], 0.586344297529192);
        // the same for a - b, a - c and b - c, then p.adjust(p, "holm")
        QCOMPARE(rated["contrasts"].size(), std::size_t{3});
        compare(rated["contrasts"][0]["statistic"], 7.50649350649351);
        compare(rated["contrasts"][0]["p"], 0.055775554166545);
        compare(rated["contrasts"][0]["p_adjusted"], 0.167326662499635);
        compare(rated["contrasts"][1]["p_adjusted"], 0.242406462774661);
        compare(rated["contrasts"][2]["difference"], 0.291666666666667);
    }

    void pageSaysWhatTheDesignLeavesOut()
    {
        const auto analysis = reports::analyse(designs());
        const std::string page = reports::reportPage(analysis, reports::reportTables(analysis), {});
        for (const char* part :
             {"answered up to 2 times", "belong to 2 groups", "Groups of participants", "group young (3 participants)"})
            QVERIFY2(page.find(part) != std::string::npos, part);
    }

    /// P1 answered twice about each fabric under each condition: more answers match than there are participants.
    void tablesSayWhetherParticipantsOrAnswersAreCounted()
    {
        const auto captionOf = [](const StudyData& data) {
            for (const auto& one : reports::reportTables(reports::analyse(data, {.depth = Depth::Quick})))
                if (one.table.name == "q1_matches_by_fabric") return one.table.caption;
            return std::string();
        };
        QCOMPARE(captionOf(designs()), std::string("Q1: number of answers that matched each rendering with its fabric"));
        QCOMPARE(captionOf(builders::paperSized()),
                 std::string("Q1: number of participants who matched each rendering with its fabric"));
    }

    /// F for these fabrics has degrees of freedom after Greenhouse and Geisser; one participant has no such test.
    void sentencesSayWhoseDegreesOfFreedomTheyHave()
    {
        const std::string corrected = "<i>F</i> tests for these fabrics have degrees of freedom after Greenhouse and Geisser";
        const auto pageOf = [](const StudyData& data) {
            return reports::reportPage(reports::analyse(data, {.depth = Depth::Quick}), {}, {});
        };
        const std::string whole = pageOf(builders::paperSized());
        QVERIFY(whole.find("are Satterthwaite\u2019s in <i>t</i> tests, and in <i>F</i> tests for fabrics like these.") !=
                std::string::npos);
        QVERIFY(whole.find(corrected) != std::string::npos);
        StudyData data = builders::paperSized();
        data.participants.resize(1);
        std::erase_if(data.responses, [](const auto& response) { return response.participant != "P01"; });
        const std::string one = pageOf(data);
        QVERIFY(one.find("Degrees of freedom with a decimal are Satterthwaite\u2019s.") != std::string::npos);
        QVERIFY(one.find(corrected) == std::string::npos);
    }

    void groupsOfABlindedStudyAreLeftOut()
    {
        StudyData data = designs();
        data.blinded = true;
        const auto analysis = reports::analyse(data);
        QVERIFY(!reports::statisticsJson(analysis).contains("groups"));
        QVERIFY(reports::resultsJson(analysis)["design"]["groups"].empty());
    }

    void oneParticipantAGroupGivesReasons()
    {
        StudyData data = builders::study(2, 3, {"f", "h"},
                                         {[](int p, int f, int c) { return (p + f + c) % 2 == 0; },
                                          [](int p, int f, int c, int q) { return 4.0 + p + (f * c + q) % 3; }});
        data.groupOf = {{data.participants[0], "x"}, {data.participants[1], "y"}};
        const Json groups = reports::statisticsJson(reports::analyse(data))["groups"];
        const Json& test = groups["questions"]["Q2"]["overall"];
        QVERIFY(test["p"].is_null());
        QVERIFY(!test["why"]["p"].get<std::string>().empty());
    }

    void aParticipantIsInOneGroup()
    {
        QTemporaryDir folder;
        QFile file(folder.filePath(answers));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write("participant,fabric,condition,group,Q2\nP1,F1,a,x,5\nP1,F1,b,y,5\n");
        file.close();
        try {
            reports::readAnswersCsv(folder.filePath(answers).toStdString());
            QFAIL("two groups were accepted");
        } catch (const protocols::Error& error) {
            QVERIFY2(QString(error.what()).contains("participant P1 is in the groups x and y"), error.what());
        }
    }

    void claimsAreRepeatedWithoutFlaggedParticipants()
    {
        const StudyData data = withOneStraightLiner();
        const auto analysis = reports::analyse(data);
        QCOMPARE(analysis.screening.excluded.size(), std::size_t{1});
        const Json results = reports::resultsJson(analysis);
        const Json& without = results["without_flagged"];
        QCOMPARE(without["participants"], Json(5));
        QCOMPARE(without["claims"].size(), results["claims"].size());
        StudyData rest = data;
        std::erase(rest.participants, "P06");
        std::erase_if(rest.responses, [](const auto& response) { return response.participant == "P06"; });
        const Json expected = reports::resultsJson(reports::analyse(rest, {.depth = Depth::Quick}));
        QCOMPARE(without["claims"], expected["claims"]);
        QVERIFY(without["claims"] != results["claims"]);
        const auto tables = reports::reportTables(analysis);
        QVERIFY(std::ranges::any_of(tables, [](const auto& one) { return one.table.name == "claims_without_flagged"; }));
    }

    void quickReportMakesTheSameClaimsAndSaysWhatItLacks()
    {
        const StudyData data = withOneStraightLiner();
        const auto quick = reports::analyse(data, {.depth = Depth::Quick}), whole = reports::analyse(data);
        Json some = reports::resultsJson(quick)["claims"], all = reports::resultsJson(whole)["claims"];
        for (Json* claims : {&some, &all})
            for (Json& row : *claims) {
                row.erase("leave_one_fabric_out");
                row.erase("leave_one_participant_out");
            }
        QCOMPARE(some, all);
        QVERIFY(reports::resultsJson(quick)["without_flagged"].is_null());
        QVERIFY(reports::reportPage(quick, {}, {}).find("This is a quick report") != std::string::npos);
        QVERIFY(reports::reportPage(whole, {}, {}).find("This is a quick report") == std::string::npos);
    }

    void methodsSayWhatWasLeftOutInTurn_data()
    {
        QTest::addColumn<int>("participants");
        QTest::addColumn<int>("conditions");
        QTest::addColumn<bool>("isQuick");
        QTest::addColumn<QString>("said");
        const QString each = "Each family is analysed again without each fabric", many = " A family of more than 100 contrasts";
        QTest::newRow("usual") << 4 << 2 << false << each + " and without each participant.</p>";
        QTest::newRow("quick") << 4 << 2 << true << "if neither is.</p>";
        QTest::newRow("61 participants") << 61 << 2 << false
                                         << each + ". With more than 60 participants, none of them is left out in turn.</p>";
        QTest::newRow("120 contrasts") << 4 << 16 << false
                                       << many + " is not analysed again without single fabrics or participants.</p>";
    }
    void methodsSayWhatWasLeftOutInTurn()
    {
        QFETCH(int, participants);
        QFETCH(int, conditions);
        QFETCH(bool, isQuick);
        QFETCH(QString, said);
        StudyData data =
            builders::emptyStudy(participants, 3, manyConditions(conditions), {{"Q1", "Which?", builders::amongThree}});
        data.everyPair = true;
        int i = 0;
        for (const std::string& participant : data.participants)
            for (const std::string& fabric : data.fabrics)
                for (const std::string& condition : data.conditions)
                    data.responses.push_back(builders::right(participant, fabric, condition, "Q1", i++ * 37 % 101 < 60));
        const auto analysis = reports::analyse(data, {.depth = isQuick ? Depth::Quick : Depth::Whole});
        const QString page = QString::fromStdString(reports::reportPage(analysis, {}, {}));
        QVERIFY2(page.contains(said), qPrintable(page.mid(page.indexOf("if neither is."), 200)));
    }

    void manyConditionsAreComparedByWish()
    {
        StudyData data = builders::study(3, 2, manyConditions(46),
                                         {[](int p, int f, int c) { return (p + f * c) % 3 == 0; },
                                          [](int p, int f, int c, int q) { return (p * f + c * q + p * c) % 11; }});
        const Json usual = reports::resultsJson(reports::analyse(data, {.depth = Depth::Quick}));
        QVERIFY(usual["comparisons"].empty() && usual["claims"].empty());
        QVERIFY(usual["design"]["left_out"].back() != Json());
        QVERIFY(usual["design"]["left_out"].dump().find("1035 pairs of conditions") != std::string::npos);
        data.everyPair = true;
        const Json every = reports::resultsJson(reports::analyse(data, {.depth = Depth::Quick}));
        QCOMPARE(every["comparisons"].size(), std::size_t{4 * 46 * 45 / 2});
        QVERIFY(every["design"]["left_out"].dump().find("stand in the folder tables only") != std::string::npos);
        data.everyPair = false;
        data.planned = {{"c03", "c07"}};
        const Json planned = reports::resultsJson(reports::analyse(data, {.depth = Depth::Quick}));
        QCOMPARE(planned["claims"].size(), std::size_t{4 * 2});
    }

    /// A study like the simulated ones must reject about as often as the kept table says.
    void falseClaimsAreSimulatedForTheStudyItself()
    {
        const auto analysis = reports::analyse(builders::paperSized(), {.depth = Depth::Quick, .resimulated = 200});
        QCOMPARE(analysis.falseClaims.size(), std::size_t{4});
        for (const reports::FalseClaimFinding& finding : analysis.falseClaims) {
            QVERIFY(finding.simulated.has_value());
            QCOMPARE(finding.simulated->any.studies, std::size_t{200});
            QVERIFY2(finding.simulated->any.rate() < 0.12, finding.question.c_str());
            QVERIFY2(finding.simulated->first.rate() < 0.12, finding.question.c_str());
            QCOMPARE(finding.simulated->any.undefined, std::size_t{0});
        }
        const Json written = reports::statisticsJson(analysis)["false_claims"];
        QCOMPARE(written["Q3"]["simulated"]["any_contrast"]["studies"], Json(200));
        const auto tables = reports::reportTables(analysis);
        QVERIFY(std::ranges::any_of(tables, [](const auto& one) { return one.table.name == "false_claims_simulated"; }));
        QVERIFY(!reports::statisticsJson(reports::analyse(builders::paperSized(), {.depth = Depth::Quick}))["false_claims"]["Q2"]
                     .contains("simulated"));
    }

    /// Two conditions that share their repetitions on one fabric only cannot be compared for fabrics like these. Studies that
    /// were simulated with whole cells had such a test all the same.
    void falseClaimsAreSimulatedOnTheAnswersThatAreCompared()
    {
        StudyData data = builders::emptyStudy(6, 3, {"a", "b", "c"}, {{"Q2", "", builders::onScale}});
        data.answersPerCell = 2;
        data.planned = {{"a", "b"}};
        for (int p = 0; p < 6; ++p)
            for (int f = 0; f < 3; ++f)
                for (int c = 0; c < 3; ++c)
                    for (int r = 0; r < 2; ++r) {
                        const bool isMissing = f > 0 && c < 2 && r != c;  // a has the first one there, b the second one
                        if (isMissing) continue;
                        data.responses.push_back(builders::rated(data.participants[static_cast<std::size_t>(p)],
                                                                 data.fabrics[static_cast<std::size_t>(f)],
                                                                 data.conditions[static_cast<std::size_t>(c)], "Q2",
                                                                 (40 + (p * 13 + f * 29 + c * 17 + r * 7) % 31) / 10.0));
                        data.responses.back().repetition = (c < 2 ? "morning " : "evening ") + std::to_string(r);
                    }
        const auto analysis = reports::analyse(data, {.depth = Depth::Quick, .resimulated = 50});
        QCOMPARE(analysis.falseClaims.size(), std::size_t{1});
        const auto& simulated = analysis.falseClaims.front().simulated;
        QVERIFY(simulated.has_value());
        QCOMPARE(simulated->first.studies, std::size_t{50});
        QCOMPARE(simulated->first.undefined, std::size_t{50});
        for (const reports::ContrastFinding& finding : reports::claimsOf(analysis.questions.front())->contrasts)
            if (finding.generalisation == stats::Generalisation::FabricsLikeThese) QVERIFY(!finding.claim.difference.p.exists());
    }

    /// A rating that stands there several times tells no more than once, and the cells of simulated studies vary as before.
    void repeatedRatingsAreSimulatedLikeOneInEachCell()
    {
        StudyData once =
            builders::study(8, 5, {"a", "b", "c"},
                            {[](int, int, int) { return true; },
                             [](int p, int f, int c, int) { return (40 + 2 * c + (p * 13 + f * 29 + c * 17) % 31) / 10.0; }});
        std::erase_if(once.questions, [](const auto& question) { return question.id != "Q2"; });
        std::erase_if(once.responses, [](const auto& response) { return response.question != "Q2"; });
        const auto simulated = [](const StudyData& data) {
            return reports::analyse(data, {.depth = Depth::Quick, .resimulated = 400}).falseClaims.front().simulated.value();
        };
        const auto repeated = [&](std::size_t times, double difference) {
            StudyData data = once;
            data.answersPerCell = times;
            data.responses.clear();
            for (std::size_t r = 0; r < times; ++r)
                for (reports::StudyResponse response : once.responses) {
                    std::get<reports::RatedAnswer>(response.content).rating += r % 2 == 0 ? difference : -difference;
                    response.repetition = std::to_string(r);
                    data.responses.push_back(response);
                }
            return data;
        };
        const stats::FalseClaims expected = simulated(once);
        QVERIFY(expected.first.rejected > 0 && expected.any.rejected > 0);
        for (const std::size_t times : {2U, 4U}) {
            const stats::FalseClaims same = simulated(repeated(times, 0));
            QCOMPARE(same.first.rejected, expected.first.rejected);
            QCOMPARE(same.any.rejected, expected.any.rejected);
            // Answers that differ have draws of their own; four standard errors.
            const stats::FalseClaims differing = simulated(repeated(times, 0.5));
            QVERIFY(std::fabs(differing.first.rate() - expected.first.rate()) < 4 * std::sqrt(2 * 0.05 * 0.95 / 400));
        }
    }

    /// Of seven pairs under a condition, three or four are the same, by turns over the participants. Whoever is left out takes
    /// one of them away.
    void chanceIsTestedWhereParticipantsOfADrawnDesignWithdrew()
    {
        const protocols::StudySize size{10, 2, 7};
        protocols::Random random(11);
        const auto drawn = drawSameDifferent(drawRunningOrders(size, protocols::FabricOrder::Even, random), size, random);
        StudyData all = builders::emptyStudy(10, 7, {"a", "b"}, {{"S1", "", protocols::SameDifferent{}}});
        for (std::size_t p = 0; p < drawn.orders.size(); ++p)
            for (std::size_t at = 0; at < drawn.orders[p].size(); ++at) {
                const protocols::Rendering& shown = drawn.orders[p][at];
                all.responses.push_back(builders::right(all.participants[p], all.fabrics[static_cast<std::size_t>(shown.fabric)],
                                                        all.conditions[static_cast<std::size_t>(shown.label)], "S1",
                                                        drawn.trays[p][at].front() == shown.fabric));
                std::get<reports::ChosenAnswer>(all.responses.back().content).answer = "same";  // whatever lies there
            }
        long long most = 0;
        for (std::size_t first = 0; first < 10; ++first)
            for (std::size_t second = 0; second < first; ++second) {
                StudyData data = all;
                const std::string one = all.participants[first], other = all.participants[second];
                std::erase_if(data.participants, [&](const auto& id) { return id == one || id == other; });
                std::erase_if(data.responses,
                              [&](const auto& response) { return response.participant == one || response.participant == other; });
                std::vector<const reports::StudyResponse*> underA;
                reports::PairList pairs;
                for (const reports::StudyResponse& response : data.responses) {
                    if (response.condition != "a") continue;
                    underA.push_back(&response);
                    ++(std::get<reports::ChosenAnswer>(response.content).correct ? pairs.same : pairs.different);
                }
                QCOMPARE(reports::whyNoChance({2, true}, underA), std::string());
                if (std::abs(pairs.excess()) <= most) continue;
                most = std::abs(pairs.excess());
                for (const Json& row : reports::resultsJson(reports::analyse(data, {.depth = Depth::Quick}))["above_chance"])
                    QVERIFY(row["p"].is_number() && row["p"] > 0.05 && row["above_chance"] == false);
            }
        QCOMPARE(most, 2LL);  // of 56
    }

    void progressRunsFromTheFirstToTheLastStep()
    {
        std::vector<int> done;
        int total = 0;
        reports::analyse(withOneStraightLiner(), {.progress = [&](int step, int of, const std::string& what) {
                             done.push_back(step);
                             total = of;
                             QVERIFY(!what.empty());
                         }});
        QVERIFY(std::ranges::is_sorted(done));
        QCOMPARE(done.front(), 0);
        QCOMPARE(done.back(), total);
    }
};

QTEST_GUILESS_MAIN(DesignsTest)
#include "designs_test.moc"
