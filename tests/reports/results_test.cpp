// results.json: its contents, their order, and the entry for a value that does not exist.
#include <QTest>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "reports/cells/finger_motion.h"
#include "reports/json/results_json.h"
#include "reports/json/signals_json.h"
#include "reports/json/statistics_json.h"
#include "reports/tables/overview_tables.h"
#include "reports/text/number_text.h"
#include "tests/reports/study_builder.h"

using Json = nlohmann::ordered_json;
using builders::nineConditions;
using reports::StudyData;

namespace {

std::vector<std::string> keysOf(const Json& object)
{
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
}

using Keys = std::vector<std::string>;

Json resultsOf(const StudyData& data) { return reports::resultsJson(reports::analyse(data)); }
Json statisticsOf(const StudyData& data) { return reports::statisticsJson(reports::analyse(data)); }

/// Every null must have its reason in the same object; NaN and infinity must not occur.
QString unexplained(const Json& value, const QString& path)
{
    QString faults;
    if (value.is_number_float() && !std::isfinite(value.get<double>())) faults += path + " is not finite; ";
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i) faults += unexplained(value[i], path + "[" + QString::number(i) + "]");
    if (value.is_object())
        for (const auto& [key, item] : value.items()) {
            const QString place = path + "." + QString::fromStdString(key);
            if (item.is_null() && !(value.contains("why") && value["why"].is_object() && value["why"].contains(key)) &&
                !(key == "participant" && value.contains("flag")))
                faults += place + " is null without a reason; ";
            faults += unexplained(item, place);
        }
    return faults;
}

const Json& comparison(const Json& results, const std::string& question, const std::string& a, const std::string& b)
{
    for (const Json& row : results["comparisons"])
        if (row["question"] == question && row["a"] == a && row["b"] == b) return row;
    static const Json none;
    return none;
}

}  // namespace

class ResultsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void meansStandBesideThoseWithoutFlaggedParticipants()
    {
        // P01 rates everything 9; the others rate by fabric and question.
        const auto data = builders::study(
            4, 5, {"v_grey", "h&f", "f"},
            {[](int, int f, int) { return f % 2 == 0; }, [](int p, int f, int, int q) { return p == 0 ? 9.0 : 0.5 * q + f; }});
        const Json screening = statisticsOf(data)["screening"];
        QCOMPARE(screening["excluded"].size(), std::size_t(1));
        QCOMPARE(screening["excluded"][0]["participant"], "P01");
        QCOMPARE(screening["questions"]["Q2"]["v_grey"]["before"], 4.5);
        QCOMPARE(screening["questions"]["Q2"]["v_grey"]["after"], 3.0);
        QCOMPARE(resultsOf(data)["questions"]["Q2"]["v_grey"]["mean"], 4.5);
        auto earnest = data;
        std::erase_if(earnest.responses, [](const auto& response) { return response.participant == "P01"; });
        earnest.participants.erase(earnest.participants.begin());
        const Json none = statisticsOf(earnest)["screening"];
        QVERIFY(none["questions"].is_null());
        QCOMPARE(none["why"]["questions"], "nobody is flagged");
    }

    void speedAndForceStandByCondition()
    {
        StudyData data = builders::study(3, 2, {"v_grey", "h&f", "f"},
                                         {[](int, int f, int) { return f == 0; }, [](int p, int f, int, int) { return p + f; }});
        QVERIFY(resultsOf(data)["touch"].is_null());
        QVERIFY(resultsOf(data)["operator_latency"].is_null());
        const auto touch = [&](const char* who, double speed, std::optional<double> force) {
            data.touches.push_back({who, "v_grey", 2.0, speed, force});
        };
        touch("P01", 40, 0.4);
        touch("P01", 44, {});
        touch("P02", 61, 0.6);
        touch("P03", 80, {});
        data.touches.push_back({"P01", "h&f", 3.0, 50, {}});
        data.operatorTaps = {{"Ada", "2026-11-23T08:00:00Z", "tone", 38, 1, 2, 215.5, 190.0, 250.25},
                             {"Bob", "2026-11-23T09:00:00Z", "flash", 0, 40, 0, {}, {}, {}}};
        const Json results = resultsOf(data);
        QCOMPARE(unexplained(results, "results"), QString());
        const Json speed = results["touch"]["conditions"]["v_grey"]["speed_mm_per_s"];
        // R: median(c(40,44,61,80)); t.test(c(42,61,80))
        QCOMPARE(speed["presentations"], 4);
        QCOMPARE(speed["participants"], 3);
        QCOMPARE(speed["median"], 52.5);
        QCOMPARE(speed["mean"], 61.0);
        QVERIFY(std::abs(speed["ci95"][0].get<double>() - 13.80138348) < 1e-6);
        QVERIFY(std::abs(speed["ci95"][1].get<double>() - 108.19861652) < 1e-6);
        QCOMPARE(results["touch"]["conditions"]["v_grey"]["force_n"]["participants"], 2);
        QVERIFY(results["touch"]["conditions"]["h&f"]["force_n"]["mean"].is_null());
        QVERIFY(results["touch"]["conditions"]["h&f"]["speed_mm_per_s"]["ci95"].is_null());  // one participant
        QVERIFY(results["touch"]["conditions"]["f"]["contact_seconds"]["median"].is_null());
        QCOMPARE(results["operator_latency"][0]["median_ms"], 215.5);
        QVERIFY(results["operator_latency"][1]["median_ms"].is_null());
    }

    void theMotionOfAFingerIsThatOfItsContacts()
    {
        using protocols::FingerSample;
        std::vector<FingerSample> samples;
        const auto at = [](double seconds) { return static_cast<std::int64_t>(std::llround(seconds * 1e9)); };
        for (int i = 0; i <= 100; ++i) samples.push_back({at(0.005 * i), 80 * 0.005 * i, 20.0, 0.5});  // 0.5 s at 80 mm/s
        const reports::FingerMotion straight = reports::motionOf(samples);
        QVERIFY(std::abs(*straight.speedMmPerS - 80) < 1e-9 && std::abs(*straight.forceN - 0.5) < 1e-12);
        QVERIFY(std::abs(straight.contactSeconds - 0.5) < 1e-9);

        auto lifted = samples;  // the finger leaves for 2 s and comes down elsewhere: no path between
        for (int i = 0; i <= 100; ++i) lifted.push_back({at(2.5 + 0.005 * i), 200.0, 20.0, 1.5});
        const reports::FingerMotion both = reports::motionOf(lifted);
        QVERIFY(std::abs(*both.speedMmPerS - 40) < 1e-9 && std::abs(*both.forceN - 1) < 1e-12);

        auto hovering = samples;
        for (int i = 40; i <= 60; ++i) hovering[static_cast<std::size_t>(i)].forceN = -0.01;
        QVERIFY(std::abs(reports::motionOf(hovering).contactSeconds - 0.39) < 1e-9);

        auto noisy = samples;  // 0.1 mm of noise: steps of 5 ms would give a fifth more
        for (std::size_t i = 0; i < noisy.size(); ++i) *noisy[i].yMm += i % 2 == 0 ? 0.1 : -0.1;
        QVERIFY(std::abs(*reports::motionOf(noisy).speedMmPerS - 80) < 1);

        QVERIFY(!reports::motionOf(std::span(samples).first(20)).speedMmPerS);  // 0.1 s
        QVERIFY(!reports::motionOf({}).forceN);
        for (FingerSample& sample : samples) sample.xMm.reset();
        QVERIFY(!reports::motionOf(samples).speedMmPerS && reports::motionOf(samples).forceN);
    }

    void keysStandInTheDocumentedOrder()
    {
        StudyData data = builders::paperSized();
        data.planned = {{"h_g&f_g", "h&f"}};
        const Json results = resultsOf(data);
        QCOMPARE(keysOf(results), (Keys{"schema", "study", "conditions", "questions", "comparisons", "equivalence", "omnibus",
                                        "above_chance", "claims", "speed_accuracy", "chain", "signals", "quality",
                                        "preregistration", "without_flagged", "design", "touch", "operator_latency", "why"}));
        QCOMPARE(results["schema"], "vis2hap.results/2");
        QCOMPARE(keysOf(results["study"]),
                 (Keys{"name", "protocol_sha256", "participants", "fabrics", "blinded", "simulated", "scripted"}));
        QCOMPARE(results["conditions"].get<Keys>(), nineConditions);
        QCOMPARE(keysOf(results["questions"]), (Keys{"Q1", "Q2", "Q3", "Q4"}));
        for (const char* id : {"Q1", "Q2", "Q3", "Q4"}) QCOMPARE(keysOf(results["questions"][id]), nineConditions);
        QCOMPARE(keysOf(results["speed_accuracy"]), nineConditions);
        QCOMPARE(keysOf(results["questions"]["Q1"]["f"]),
                 (Keys{"trials", "correct", "matches_per_rendering", "proportion", "ci95", "p_chance", "p_chance_participants"}));
        QCOMPARE(keysOf(results["questions"]["Q3"]["f"]),
                 (Keys{"n", "mean", "sd", "participants", "ci95", "mean_of_participants"}));
        QCOMPARE(keysOf(comparison(results, "Q2", "h_g&f_g", "h&f")),
                 (Keys{"question", "a", "b", "test", "n", "statistic", "df", "p", "p_holm", "mean_difference", "ci95", "d_z",
                       "generalises_to", "planned"}));
        QCOMPARE(unexplained(results, "results"), QString());
        QCOMPARE(unexplained(statisticsOf(data), "statistics"), QString());
    }

    /// A table of another lab does not say whether people answered, so neither may the report.
    void whoAnsweredIsUnknownWithoutAColumnForIt()
    {
        StudyData data = builders::paperSized();
        QCOMPARE(resultsOf(data)["study"]["simulated"], false);
        QCOMPARE(resultsOf(data)["study"]["scripted"], false);
        data.scripted = true;
        QCOMPARE(resultsOf(data)["study"]["scripted"], true);
        data.knowsKinds = false;
        const Json study = resultsOf(data)["study"], described = statisticsOf(data)["data"];
        QVERIFY(study["simulated"].is_null() && study["why"].contains("simulated"));
        QVERIFY(study["scripted"].is_null() && study["why"].contains("scripted"));
        QVERIFY(described["scripted"].is_null() && described["why"].contains("scripted"));
    }

    void everyPairIsComparedOnceInTheOrderOfConditions()
    {
        const Json results = resultsOf(builders::paperSized());
        QCOMPARE(results["comparisons"].size(), std::size_t{4 * 36});
        QCOMPARE(results["equivalence"].size(), std::size_t{3 * 36});
        const auto place = [](const Json& name) {
            return std::find(nineConditions.begin(), nineConditions.end(), name.get<std::string>()) - nineConditions.begin();
        };
        std::set<std::string> seen;
        for (const Json& row : results["comparisons"]) {
            QVERIFY(place(row["a"]) < place(row["b"]));
            QVERIFY(
                seen.insert(row["question"].get<std::string>() + row["a"].get<std::string>() + "|" + row["b"].get<std::string>())
                    .second);
            QCOMPARE(row["n"], 10);
            QVERIFY(row["p_holm"].get<double>() >= row["p"].get<double>());
        }
    }

    // The paper's own totals: 27, 39 and 50 of 70 are its 3.9, 5.6 and 7.1 matches of ten.
    void publishedTotalsComeOutAsPublished_data()
    {
        QTest::addColumn<int>("correct");
        QTest::addColumn<double>("matches");
        QTest::newRow("v_grey") << 27 << 3.857142857142857;
        QTest::newRow("f_g") << 39 << 5.571428571428571;
        QTest::newRow("h&f") << 50 << 7.142857142857143;
    }

    void publishedTotalsComeOutAsPublished()
    {
        QFETCH(int, correct);
        QFETCH(double, matches);
        // Ratings average 5.1 exactly: 5.0 and 5.2 in turn.
        const StudyData data = builders::study(10, 7, {"v_grey", "f"},
                                               {[correct](int p, int f, int) { return p * 7 + f < correct; },
                                                [](int p, int f, int, int) { return (p * 7 + f) % 2 == 0 ? 5.0 : 5.2; }});
        const Json results = resultsOf(data);
        QCOMPARE(results["questions"]["Q1"]["v_grey"]["trials"], 70);
        QCOMPARE(results["questions"]["Q1"]["v_grey"]["correct"], correct);
        QCOMPARE(results["questions"]["Q1"]["v_grey"]["matches_per_rendering"].get<double>(), matches);
        QCOMPARE(results["questions"]["Q2"]["v_grey"]["mean"].get<double>(), 5.1);
        QCOMPARE(results["questions"]["Q2"]["v_grey"]["n"], 70);
    }

    /// Who is enrolled and gave no answer is no participant of the results; who skipped a question is none of its matches.
    void whoGaveNoAnswerDoesNotCount()
    {
        StudyData data = builders::paperSized();
        const auto complete = resultsOf(data);
        data.participants.insert(data.participants.end(), {"P11", "P12"});
        const Json results = resultsOf(data);
        QCOMPARE(results["study"]["participants"], 10);
        QCOMPARE(results["questions"]["Q1"], complete["questions"]["Q1"]);
        std::erase_if(data.responses, [](const auto& one) { return one.participant == "P10" && one.question == "Q1"; });
        const auto analysis = reports::analyse(data);
        const auto& choices = reports::questionsWith<reports::ChoiceAnalysis>(analysis).front().findings;
        QCOMPARE(reports::answeringParticipants(analysis.data), std::size_t(10));
        QCOMPARE(reports::answeringParticipants(analysis.data, choices), std::size_t(9));
        const reports::CountCorrect& count = choices.conditions.front().count;
        QCOMPARE(*choices.conditions.front().matchesPerRendering, double(9 * count.correct) / double(count.trials));
        QVERIFY(QString::fromStdString(reports::overviewText(analysis)).contains("Q1 matches of 9"));
        QVERIFY(reports::statisticsJson(analysis).dump().find("mean_matches_per_rendering_of_9") != std::string::npos);
    }

    // scipy 1.10.1: from scipy.stats import binomtest; binomtest(27,70,1/3,'greater').pvalue -> 0.20962555830527693
    void matchesAreTestedAgainstChance()
    {
        const Json part = resultsOf(builders::paperSized())["questions"]["Q1"]["v_grey"];
        QCOMPARE(part["correct"], 27);
        QVERIFY(std::abs(part["p_chance"].get<double>() - 0.20962555830527693) < 1e-13);
        QVERIFY(part["p_chance_participants"].is_number());
        QVERIFY(part["ci95"][0].get<double>() < 27.0 / 70 && part["ci95"][1].get<double>() > 27.0 / 70);
    }

    void orderOfRowsAndParticipantsChangesNothing()
    {
        StudyData data = builders::paperSized();
        const Json before = resultsOf(data);
        const Json statisticsBefore = statisticsOf(data);
        std::reverse(data.responses.begin(), data.responses.end());
        QCOMPARE(resultsOf(data), before);
        QCOMPARE(statisticsOf(data), statisticsBefore);
        std::reverse(data.participants.begin(), data.participants.end());
        std::reverse(data.fabrics.begin(), data.fabrics.end());
        QCOMPARE(resultsOf(data)["comparisons"], before["comparisons"]);
        QCOMPARE(resultsOf(data)["questions"]["Q2"], before["questions"]["Q2"]);
    }

    void blindedReportLeavesOutWhatWouldTell()
    {
        StudyData data = builders::paperSized();
        data.planned = {{"h_g&f_g", "h&f"}};
        data.signals = reports::signalsFromJson(R"({"friction_mae":0.1})");
        data.blinded = true;
        const Json results = resultsOf(data);
        QVERIFY(results["signals"].is_null());
        QVERIFY(results["study"]["blinded"].get<bool>());
        for (const char* part : {"comparisons", "equivalence", "claims", "anchors", "speed_accuracy", "without_flagged", "touch"})
            QVERIFY2(results[part].is_null() && results["why"].contains(part), part);
        QCOMPARE(keysOf(results["questions"]["Q2"]["h"]), (Keys{"n", "mean", "sd", "participants", "ci95", "rounded_to", "why"}));
        QCOMPARE(unexplained(results, "results"), QString());
        QCOMPARE(unexplained(statisticsOf(data), "statistics"), QString());
        data.blinded = false;
        const Json open = resultsOf(data);
        QCOMPARE(open["signals"]["friction_mae"].get<double>(), 0.1);
        QVERIFY(comparison(open, "Q4", "h_g&f_g", "h&f")["planned"].get<bool>());
        QVERIFY(!comparison(open, "Q4", "f", "h").contains("planned"));
    }

    void missingAnswersAreCountedAndLeftOut()
    {
        StudyData data = builders::paperSized();
        // P03 gave no rating at all under h, and one match is missing under f.
        std::erase_if(data.responses, [](const reports::StudyResponse& r) {
            return (r.participant == "P03" && r.condition == "h" && r.question == "Q2") ||
                   (r.participant == "P05" && r.condition == "f" && r.question == "Q1" && r.fabric == "F02");
        });
        const Json results = resultsOf(data);
        QCOMPARE(results["questions"]["Q2"]["h"]["n"], 63);
        QCOMPARE(results["questions"]["Q2"]["h"]["participants"], 9);
        QCOMPARE(results["questions"]["Q1"]["f"]["trials"], 69);
        QCOMPARE(comparison(results, "Q2", "v_grey", "h")["n"], 9);
        QCOMPARE(comparison(results, "Q2", "v_grey", "f")["n"], 10);
        const Json statistics = statisticsOf(data);
        QCOMPARE(statistics["data"]["missing_responses"], 8);
        QCOMPARE(statistics["data"]["missing_by_condition"]["Q2"]["h"], 7);
        QCOMPARE(statistics["Q2"]["rm_anova"]["n"], 9);
        QCOMPARE(statistics["q1_cochran"]["blocks"], 69);
        QCOMPARE(results["quality"].size(), std::size_t{2});
        QCOMPARE(results["quality"][0]["flag"], "missing_answers");
        QCOMPARE(results["quality"][0]["participant"], "P03");
        QCOMPARE(results["quality"][0]["why"], "answers missing: Q2: 7 of 63");
    }

    void tooLittleDataGivesNullWithItsReason_data()
    {
        QTest::addColumn<int>("participants");
        QTest::newRow("nobody yet") << 0;
        QTest::newRow("one participant") << 1;
    }

    void tooLittleDataGivesNullWithItsReason()
    {
        QFETCH(int, participants);
        const StudyData data = builders::study(
            participants, 2, {"f", "h"}, {[](int, int f, int) { return f == 0; }, [](int, int, int c, int) { return 4.0 + c; }});
        const Json results = resultsOf(data);
        QCOMPARE(unexplained(results, "results"), QString());
        QCOMPARE(unexplained(statisticsOf(data), "statistics"), QString());
        QVERIFY(results["comparisons"][0]["p"].is_null());
        QVERIFY(results["equivalence"][0]["equivalent"].is_null());
        QVERIFY(results["questions"]["Q2"]["f"]["ci95"].is_null());
        QCOMPARE(results["questions"]["Q1"]["f"]["proportion"].is_null(), participants == 0);
    }

    void constantDataAreUndefinedNotSignificant()
    {
        const StudyData data = builders::study(
            10, 7, {"f", "h"}, {[](int, int, int) { return true; }, [](int, int, int c, int) { return 5.0 + 0.1 * c; }});
        const Json results = resultsOf(data);
        QCOMPARE(unexplained(results, "results"), QString());
        const Json& row = comparison(results, "Q2", "f", "h");
        QVERIFY(row["p"].is_null() && row["p_holm"].is_null() && row["statistic"].is_null());
        QVERIFY(QString::fromStdString(row["why"]["p"]).contains("no variation"));
        QVERIFY(results["questions"]["Q1"]["f"]["p_chance_participants"].is_null());
        QVERIFY(results["questions"]["Q1"]["f"]["p_chance"].is_number());
        QVERIFY(results["questions"]["Q2"]["f"]["ci95"].is_null());
        QVERIFY(QString::fromStdString(results["questions"]["Q2"]["f"]["why"]["ci95"]).contains("no variation"));
    }

    void suspiciousParticipantsAreFlaggedAndKept()
    {
        StudyData data = builders::paperSized();
        for (reports::StudyResponse& r : data.responses) {
            r.seconds = r.participant == "P02" ? 0.2 : 4.0 + (r.fabric == "F01" ? 1 : 0);
            if (auto* choice = std::get_if<reports::ChosenAnswer>(&r.content))
                choice->slot = r.participant == "P04" ? 1 : static_cast<int>(r.fabric.back() % 3);
            if (auto* rated = std::get_if<reports::RatedAnswer>(&r.content); rated != nullptr && r.participant == "P06")
                rated->rating = 5.0;
        }
        data.voided = 2;
        const Json results = resultsOf(data);
        std::set<std::string> flags;
        for (const Json& row : results["quality"])
            flags.insert((row["participant"].is_null() ? "all" : row["participant"].get<std::string>()) + " " +
                         row["flag"].get<std::string>());
        const std::set<std::string> expected{"P02 too_fast", "P04 slot_bias", "P06 straight_lining", "P06 same_across_questions",
                                             "all voided_presentations"};
        QCOMPARE(flags, expected);
        QCOMPARE(results["questions"]["Q2"]["f"]["n"], 70);
    }

    void speedNeedsTimes()
    {
        StudyData data = builders::paperSized();
        QVERIFY(resultsOf(data)["speed_accuracy"]["f"]["bis"].is_null());
        int i = 0;
        for (reports::StudyResponse& r : data.responses) r.seconds = 4 + (i++ % 5);
        const Json part = resultsOf(data)["speed_accuracy"];
        double sum = 0;
        for (const auto& [condition, row] : part.items()) {
            QVERIFY(row["median_seconds"].get<double>() >= 4 && row["median_seconds"].get<double>() <= 8);
            QVERIFY(row["bits_per_second"].get<double>() >= 0);
            sum += row["bis"].get<double>();
        }
        QVERIFY(std::abs(sum) < 1e-10);  // standardised scores of equally many cells average 0
    }

    void piecesOfTheFilesAreTheirObjects()
    {
        StudyData unanswered = builders::paperSized();
        unanswered.responses.clear();
        StudyData blinded = builders::paperSized();
        blinded.blinded = true;
        for (const StudyData& data : {builders::paperSized(), unanswered, blinded}) {
            const reports::StudyAnalysis analysis = reports::analyse(data);
            std::string results, statistics;
            const reports::ReportOrigin origin{"12:ab", R"({"program":"vis2hap"})"};
            reports::writeResults(analysis, origin, [&](std::string_view piece) { results += piece; });
            reports::writeStatistics(analysis, [&](std::string_view piece) { statistics += piece; });
            QCOMPARE(results, reports::resultsJson(analysis, origin).dump(2) + "\n");
            QVERIFY(results.find("\"log_head\": \"12:ab\"") != std::string::npos);
            QCOMPARE(statistics, reports::statisticsJson(analysis).dump(2) + "\n");
        }
    }

    void strayAnswersAreAFault()
    {
        StudyData data = builders::paperSized();
        data.responses.push_back(data.responses.front());
        QVERIFY_EXCEPTION_THROWN(resultsOf(data), protocols::Error);
        data.responses.back().condition = "x";
        QVERIFY_EXCEPTION_THROWN(resultsOf(data), protocols::Error);
    }

    void terminalTableIsAligned()
    {
        const std::string table = reports::overviewText(reports::analyse(builders::paperSized()));
        const QStringList lines = QString::fromStdString(table).split('\n', Qt::SkipEmptyParts);
        QCOMPARE(lines.size(), 11);
        QVERIFY(lines[0].contains("Q1 matches of 10"));
        QVERIFY(lines[2].startsWith("v_grey") && lines[2].contains("3.9") && lines[2].contains("27/70"));
        for (const QString& line : lines) QCOMPARE(line.size(), lines[1].size());
    }
};

QTEST_GUILESS_MAIN(ResultsTest)
#include "results_test.moc"
