// The claims of a report: what each row says, what it generalises to, and what the summary makes of it.
#include "reports/analysis/question_claims.h"

#include <QRegularExpression>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "protocols/files/number_text.h"
#include "reports/figures/report_figures.h"
#include "reports/json/results_json.h"
#include "reports/json/statistics_json.h"
#include "reports/page/page.h"
#include "reports/scripts/reproduction.h"
#include "reports/tables/report_tables.h"
#include "tests/reports/study_builder.h"

using Json = nlohmann::ordered_json;
using reports::StudyAnalysis;
using reports::StudyData;

namespace {

/// 0 to 4, without a pattern.
int noiseOf(int p, int f, int c)
{
    const auto mixed = static_cast<unsigned>(p * 7919 + f * 104729 + c * 1299709 + 12345) * 2654435761U;
    return static_cast<int>((mixed >> 16) % 5);
}

/// Condition "a" is rated one point above "b" on every fabric but one, where it is far below; "c" equals "b" up to noise.
StudyData studyOfOneOddFabric()
{
    return builders::study(8, 6, {"a", "b", "c"},
                           {[](int p, int f, int c) { return (p + 2 * f + c) % 3 != 0; },
                            [](int p, int f, int c, int) {
                                const double noise = 0.1 * (noiseOf(p, f, c) - 2);
                                const double effect = c != 0 ? 0 : f == 5 ? -4 : 1;
                                return 5 + effect + noise;
                            }});
}

Json claimsOf(const StudyData& data) { return reports::resultsJson(reports::analyse(data))["claims"]; }

Json rowOf(const Json& claims, const std::string& question, const std::string& a, const std::string& b, const std::string& to)
{
    for (const Json& row : claims)
        if (row["question"] == question && row["a"] == a && row["b"] == b && row["generalises_to"] == to) return row;
    return {};
}

/// The row of this pair of conditions, and of Q2 where the rows are of several questions.
const Json& rowWith(const Json& rows, const std::string& a, const std::string& b)
{
    for (const Json& row : rows)
        if (row["a"] == a && row["b"] == b && row.value("question", "Q2") == "Q2") return row;
    static const Json none;
    return none;
}

QString pageOf(const StudyData& data)
{
    const StudyAnalysis analysis = reports::analyse(data);
    return QString::fromStdString(
        reports::reportPage(analysis, reports::reportTables(analysis), reports::reportFigures(analysis)));
}

}  // namespace

class QuestionClaimsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void plannedContrastsKeepOrderAndSign()
    {
        StudyData data = studyOfOneOddFabric();
        data.planned = {{"c", "b"}, {"a", "b"}};
        const Json claims = claimsOf(data);
        // Four questions, two contrasts, two generalisations.
        QCOMPARE(claims.size(), std::size_t(16));
        QCOMPARE(claims[0]["a"], "c");
        QCOMPARE(claims[0]["primary"], true);
        QCOMPARE(claims[0]["generalises_to"], "these_fabrics");
        QCOMPARE(claims[1]["generalises_to"], "fabrics_like_these");
        QCOMPARE(claims[2]["primary"], false);
        const Json forward = rowOf(claims, "Q2", "a", "b", "these_fabrics");
        data.planned = {{"b", "a"}};
        const Json backward = rowOf(claimsOf(data), "Q2", "b", "a", "these_fabrics");
        QVERIFY(std::abs(forward["estimate"].get<double>() + backward["estimate"].get<double>()) < 1e-12);
        QCOMPARE(backward["p_adjusted"], backward["p"]);  // a family of one
    }

    /// b - a against -0.1 and 0.6 is a - b against -0.6 and 0.1. The same holds in every place that tests a pair.
    void boundsStayThoseOfThePlannedDifferenceWhereItsPairStandsReversed()
    {
        StudyData data = studyOfOneOddFabric();
        data.planned = {{"b", "a"}, {"b", "c"}};
        data.equivalenceBounds = {-0.1, 0.6};
        StudyData ordered = data;  // the same, with the pair of the plan in the order of the conditions
        ordered.planned = {{"a", "b"}, {"b", "c"}};
        ordered.equivalenceBounds = {-0.6, 0.1};
        const StudyAnalysis reversed = reports::analyse(data), same = reports::analyse(ordered);
        const Json results = reports::resultsJson(reversed), expected = reports::resultsJson(same);
        const Json &row = rowWith(results["equivalence"], "a", "b"), &own = rowWith(expected["equivalence"], "a", "b");
        QCOMPARE(row["bounds"], (Json{-0.6, 0.1}));
        QCOMPARE(row, own);
        QCOMPARE(rowWith(results["equivalence"], "b", "c")["bounds"], (Json{-0.1, 0.6}));
        QCOMPARE(rowWith(results["equivalence"], "a", "c")["bounds"], (Json{-0.1, 0.6}));  // planned in neither order
        const Json statistics = reports::statisticsJson(reversed), statisticsOfSame = reports::statisticsJson(same);
        QCOMPARE(rowWith(statistics["lmm_contrasts"]["Q2"], "a", "b")["tost"],
                 rowWith(statisticsOfSame["lmm_contrasts"]["Q2"], "a", "b")["tost"]);
        QCOMPARE(statistics["Q2"]["tost_a_vs_b_participant"], statisticsOfSame["Q2"]["tost_a_vs_b_participant"]);
        QVERIFY(reports::expectedNumbersCsv(reversed).find("\nequivalence,Q2,a,b,-0.6,0.1,") != std::string::npos);
        const QString words = "with the bounds \u22120.6 and 0.1: a \u2212 b.";
        QVERIFY(pageOf(data).contains(words) && !pageOf(ordered).contains("stand the other way round"));
        data.equivalenceBounds = {0, 0.6};
        QCOMPARE(reports::boundsOf(data, "a", "b"), std::pair(-0.6, 0.0));
        QVERIFY(!std::signbit(reports::boundsOf(data, "a", "b").second));
        data.equivalenceBounds = {-0.5, 0.5};
        QVERIFY(reports::mirroredPairs(data).empty());
    }

    /// A CSV of another laboratory may name its conditions otherwise than the protocol.
    void answersWithoutThePlannedConditionsHaveNoPlannedContrast()
    {
        StudyData data = studyOfOneOddFabric();
        data.planned = {{"h_g&f_g", "h&f"}, {"a", "b"}};
        for (const Json& row : claimsOf(data)) QVERIFY(row["planned"] == true && row["primary"] == false && row["a"] == "a");
        data.planned = {{"h_g&f_g", "h&f"}};
        const Json claims = claimsOf(data);
        QCOMPARE(claims.size(), std::size_t(4 * 3 * 2));
        for (const Json& row : claims) QVERIFY(row["planned"] == false && row["primary"] == false);
        QVERIFY(pageOf(data).contains("of 3 pairs") && !pageOf(data).contains("planned contrasts"));
    }

    void unplannedStudiesClaimAllPairs()
    {
        const Json claims = claimsOf(studyOfOneOddFabric());
        QCOMPARE(claims.size(), std::size_t(4 * 3 * 2));
        for (const Json& row : claims) QVERIFY(row["planned"] == false && row["primary"] == false);
    }

    /// Nobody rated the second fabric under B. On the first, which has ratings under both, A and B do not differ.
    void missingFabricsMakeNoDifferenceOfConditions()
    {
        const double first[2][6] = {{2, 3, 2, 3, 2, 3}, {3, 2, 2, 3, 3, 2}}, second[] = {8, 8, 9, 8, 9, 9};
        StudyData data = builders::emptyStudy(6, 2, {"A", "B"}, {{"Q2", "", builders::onScale}});
        for (std::size_t p = 0; p < 6; ++p) {
            data.groupOf[data.participants[p]] = p % 2 == 0 ? "even" : "odd";
            for (const std::size_t c : {0U, 1U})
                data.responses.push_back(builders::rated(data.participants[p], "F01", data.conditions[c], "Q2", first[c][p]));
            data.responses.push_back(builders::rated(data.participants[p], "F02", "A", "Q2", second[p]));
        }
        const StudyAnalysis analysis = reports::analyse(data);
        const Json results = reports::resultsJson(analysis), statistics = reports::statisticsJson(analysis);
        // R: t.test(c(2,3,2,3,2,3), c(3,2,2,3,3,2), paired = TRUE)
        const Json& row = results["comparisons"][0];
        QCOMPARE(row["n"], 6);
        QCOMPARE(row["mean_difference"], 0.0);
        QCOMPARE(row["statistic"], 0.0);
        QVERIFY(std::abs(row["p"].get<double>() - 1) < 1e-12);
        QCOMPARE(row["d_z"], 0.0);
        QCOMPARE(results["equivalence"][0]["mean_difference"], 0.0);
        const Json& both = statistics["Q2"]["on_common_fabrics"];
        QCOMPARE(both["friedman"]["Q"], 0.0);
        QCOMPARE(both["rm_anova"]["F"], 0.0);
        QCOMPARE(statistics["effect_sizes"]["Q2"]["partial_eta_squared"], 0.0);
        // The names of the reference keep its definition: means over all fabrics that are answered.
        QVERIFY(std::abs(statistics["Q2"]["pairwise_t_participant_means"][0]["diff"].get<double>() - 3) < 1e-12);
        // Differences of the even: -1, 0, -1; of the odd: 1, 0, 1.
        const reports::GroupTest& groups = analysis.groups.questions[0].contrasts[0].test;
        QVERIFY(std::abs(*groups.difference + 4.0 / 3) < 1e-12);

        std::erase_if(data.responses, [](const auto& one) { return one.fabric == "F01" && one.participant == "P01"; });
        const Json rest = reports::resultsJson(reports::analyse(data));
        QCOMPARE(rest["comparisons"][0]["n"], 5);  // P01 has no fabric under both
    }

    /// One fabric: the repeated-measures analysis stood there a second time, "for fabrics like these".
    void oneFabricClaimsNothingAboutOthers()
    {
        StudyData data = builders::emptyStudy(8, 1, {"A", "B"}, {{"Q2", "", builders::onScale}});
        for (std::size_t p = 0; p < data.participants.size(); ++p)
            for (const int c : {0, 1})
                data.responses.push_back(
                    builders::rated(data.participants[p], "F01", data.conditions[static_cast<std::size_t>(c)], "Q2",
                                    c == 0 ? 2 + 0.5 * static_cast<double>(p % 3) : 7 + 0.5 * static_cast<double>(p % 2)));
        const StudyAnalysis analysis = reports::analyse(data, {.depth = reports::Depth::Quick});
        const Json omnibus = reports::resultsJson(analysis)["omnibus"];
        QVERIFY(omnibus[0]["p"].is_number() && omnibus[1]["p"].is_null());
        QVERIFY(QString::fromStdString(omnibus[1]["why"]["p"]).startsWith("there is one fabric only"));
    }

    /// t(399) = -1,200 and more: p has more than 300 zeros. A corrected p stood there as 0.
    void aPBelowTheSmallestDoubleIsNoZero()
    {
        StudyData data = builders::emptyStudy(400, 1, {"A", "B"}, {{"Q2", "", builders::onScale}});
        for (std::size_t p = 0; p < data.participants.size(); ++p)
            for (const int c : {0, 1})
                data.responses.push_back(
                    builders::rated(data.participants[p], "F01", data.conditions[static_cast<std::size_t>(c)], "Q2",
                                    c == 0 ? 2 + 0.1 * static_cast<double>(p % 3) : 8 + 0.1 * static_cast<double>(p % 2)));
        const StudyAnalysis analysis = reports::analyse(data, {.depth = reports::Depth::Quick});
        const Json results = reports::resultsJson(analysis);
        const Json &comparison = results["comparisons"][0], &equivalence = results["equivalence"][0];
        for (const char* key : {"p", "p_holm"}) {
            QVERIFY2(comparison[key].is_null(), key);
            QVERIFY(QString::fromStdString(comparison["why"][key]).startsWith("below the smallest double"));
        }
        QVERIFY(equivalence["p_upper"].is_null() && equivalence["p_lower"] == 1.0);
        const Json these = rowOf(results["claims"], "Q2", "A", "B", "these_fabrics");
        QVERIFY(these["p_adjusted"].is_null() && these["p_equivalence_adjusted"] == 1.0);
        for (const reports::ReportTable& one : reports::reportTables(analysis))
            for (const auto& row : one.table.rows)
                for (std::size_t i = 0; i < row.size(); ++i)
                    if (one.table.columns[i].name.starts_with("p")) QVERIFY2(row[i].csv != "0", one.table.name.c_str());
    }

    /// P01 rated eight fabrics under A, the others one each: the mean of all ratings is not that of the interval beside it.
    void aMeanBesideAnIntervalIsItsMiddle()
    {
        StudyData data = builders::emptyStudy(3, 8, {"A", "B"}, {{"Q2", "", builders::onScale}});
        for (std::size_t p = 0; p < 3; ++p)
            for (std::size_t f = 0; f < 8; ++f) {
                const auto add = [&](const char* condition, double rating) {
                    data.responses.push_back(builders::rated(data.participants[p], data.fabrics[f], condition, "Q2", rating));
                };
                if (p == 0 || f == p) add("A", p == 0 ? 9 : static_cast<double>(p));
                add("B", 0.1 * static_cast<double>(7 * p + f));
            }
        const StudyAnalysis analysis = reports::analyse(data, {.depth = reports::Depth::Quick});
        const Json results = reports::resultsJson(analysis);
        const Json &a = results["questions"]["Q2"]["A"], &b = results["questions"]["Q2"]["B"];
        QCOMPARE(a["mean"], 7.5);
        QCOMPARE(a["mean_of_participants"], 4.0);  // of 9, 1 and 2
        QVERIFY(std::abs((a["ci95"][0].get<double>() + a["ci95"][1].get<double>()) / 2 - 4) < 1e-12);
        QCOMPARE(b["mean_of_participants"], b["mean"]);
        const auto columnOf = [](const StudyAnalysis& study) {
            for (const reports::ReportTable& one : reports::reportTables(study))
                for (const reports::TableColumn& column : one.table.columns)
                    if (one.table.name == "q2_ratings" && column.name == "mean of participants") return column.use;
            return reports::ColumnUse::InDocuments;
        };
        QVERIFY(columnOf(analysis) == reports::ColumnUse::Everywhere);
        std::erase_if(data.responses, [](const auto& one) { return one.condition == "A"; });
        QVERIFY(columnOf(reports::analyse(data, {.depth = reports::Depth::Quick})) == reports::ColumnUse::InCsv);
    }

    /// Satterthwaite's degrees of freedom have one decimal on the page and all digits in files; whole ones stay whole.
    void degreesOfFreedomAreNotRoundedToWholeNumbers()
    {
        StudyData data = studyOfOneOddFabric();
        int count = 0;
        std::erase_if(data.responses, [&](const auto&) { return count++ % 9 == 0; });  // complete data have whole ones
        const StudyAnalysis analysis = reports::analyse(data, {.depth = reports::Depth::Quick});
        const auto& ratings = std::get<reports::RatingAnalysis>(analysis.questions[1].findings);
        const double df2 = *ratings.model.condition.df2;
        QVERIFY(df2 != std::floor(df2));
        std::string model, anova;
        for (const reports::ReportTable& one : reports::reportTables(analysis))
            if (one.table.name == "all_conditions")
                for (const auto& row : one.table.rows)
                    if (row[0].csv == "Q2")
                        (row[1].csv.starts_with("mixed model") ? model : anova) = row[5].csv + " | " + row[6].text;
        QCOMPARE(model.substr(0, model.find(" | ")), "2, " + protocols::shortest(df2));
        QVERIFY2(model.ends_with("(2, " + protocols::fixed(df2, 1) + ")"), model.c_str());
        QVERIFY2(anova.starts_with("2 | "), anova.c_str());  // Friedman's, the last of them
    }

    void oneOddFabricIsNoResultForFabricsLikeThese()
    {
        // Means over the six fabrics: (5 * 1 - 4) / 6 = 0.17, surely known for these fabrics, unknown for others.
        const Json claims = claimsOf(studyOfOneOddFabric());
        const Json these = rowOf(claims, "Q2", "a", "b", "these_fabrics"),
                   alike = rowOf(claims, "Q2", "a", "b", "fabrics_like_these");
        QCOMPARE(these["verdict"], "different_within_bounds");
        QCOMPARE(alike["verdict"], "not_decided");
        QVERIFY(alike["ci95"][0].get<double>() < -1 && alike["ci95"][1].get<double>() > 1);
        QVERIFY(std::abs(alike["by_fabric"]["F06"].get<double>() + 4) < 0.2);
        QVERIFY(std::abs(alike["by_fabric"]["F01"].get<double>() - 1) < 0.2);
        // Without the odd fabric all others agree.
        const Json& without = alike["leave_one_fabric_out"];
        QCOMPARE(without.size(), std::size_t(6));
        QCOMPARE(without[5]["without"], "F06");
        QCOMPARE(without[5]["verdict"], "different");
        QCOMPARE(alike["leave_one_participant_out"].size(), std::size_t(8));
        QVERIFY(pageOf(studyOfOneOddFabric()).contains("not decided"));
    }

    void equalConditionsAreEquivalentForBoth()
    {
        const Json claims = claimsOf(studyOfOneOddFabric());
        for (const char* to : {"these_fabrics", "fabrics_like_these"}) {
            const Json row = rowOf(claims, "Q2", "b", "c", to);
            QCOMPARE(row["verdict"], "equivalent");
            QVERIFY(row["p_equivalence_adjusted"].get<double>() < 0.05);
            QCOMPARE(row["bounds"], Json::array({-0.5, 0.5}));
        }
    }

    void choicesHaveNoBounds()
    {
        const Json row = rowOf(claimsOf(studyOfOneOddFabric()), "Q1", "a", "b", "fabrics_like_these");
        QVERIFY(row["bounds"].is_null() && row["p_equivalence"].is_null());
        QVERIFY(row["why"].contains("bounds") && row["why"].contains("p_equivalence"));
        StudyData choices = studyOfOneOddFabric();
        QVERIFY(pageOf(choices).contains("bounds of equivalence"));
        std::erase_if(choices.questions, [](const auto& one) { return std::holds_alternative<protocols::Rating>(one.kind); });
        std::erase_if(choices.responses,
                      [](const auto& one) { return std::holds_alternative<reports::RatedAnswer>(one.content); });
        QVERIFY(!pageOf(choices).contains("bounds of equivalence"));
    }

    void everyConditionIsComparedWithChanceTwice()
    {
        const Json results = reports::resultsJson(reports::analyse(studyOfOneOddFabric()));
        QCOMPARE(results["above_chance"].size(), std::size_t(6));
        QCOMPARE(results["omnibus"].size(), std::size_t(8));
        QCOMPARE(results["omnibus"][0]["generalises_to"], "these_fabrics");
    }

    void oneFabricCannotSpeakForOthers()
    {
        const StudyData data = builders::study(6, 1, {"a", "b"},
                                               {[](int p, int, int c) { return (p + c) % 2 == 0; },
                                                [](int p, int, int c, int) { return 5 + c + 0.1 * noiseOf(p, 0, c); }});
        const Json row = rowOf(claimsOf(data), "Q2", "a", "b", "fabrics_like_these");
        QCOMPARE(row["verdict"], "not_decided");
        QVERIFY(row["p"].is_null() && row["why"]["p"].get<std::string>().find("one fabric") != std::string::npos);
        QVERIFY(pageOf(data).contains("With 1 fabric this study can hardly show what holds for fabrics like these"));
    }

    void whiskersOfMatchesSayWhatTheyHoldFor()
    {
        const auto figureOf = [](const StudyData& data) {
            const auto figures = reports::reportFigures(reports::analyse(data));
            return *std::ranges::find(figures, std::string("matches_Q1"), &reports::Figure::name);
        };
        const QString both = "with participants and fabrics as samples", people = "over participants, for these fabrics";
        const auto has = [](const std::string& text, const QString& words) {
            return QString::fromStdString(text).contains(words);
        };
        const auto one = figureOf(builders::study(6, 1, {"a", "b"},
                                                  {[](int p, int, int c) { return (p + c) % 3 != 0; },
                                                   [](int p, int, int c, int) { return 5 + 0.1 * noiseOf(p, 0, c); }}));
        for (const std::string& text : {one.caption, one.svg}) QVERIFY(has(text, people) && !has(text, both));
        QVERIFY(has(one.svg, "95 % interval, participants<") && !has(one.svg, "participants and fabrics"));
        StudyData data = studyOfOneOddFabric();
        const auto many = figureOf(data);
        QVERIFY(has(many.caption, both) && !has(many.caption, people) && has(many.svg, "interval, participants and fabrics<"));
        // About "c" one fabric is answered.
        std::erase_if(data.responses, [](const auto& response) { return response.condition == "c" && response.fabric != "F01"; });
        const auto mixed = figureOf(data);
        QVERIFY2(has(mixed.caption, both + "; under c " + people), mixed.caption.c_str());
        QVERIFY(has(mixed.svg, "interval, see the caption<"));
    }

    void fewParticipantsCannotSpeakForOtherFabrics_data()
    {
        QTest::addColumn<int>("participants");
        QTest::addColumn<bool>("isWarned");
        QTest::newRow("2") << 2 << true;
        QTest::newRow("4") << 4 << true;
        QTest::newRow("5") << 5 << false;
    }
    void fewParticipantsCannotSpeakForOtherFabrics()
    {
        QFETCH(const int, participants);
        QFETCH(const bool, isWarned);
        const QString page = pageOf(builders::study(participants, 7, {"a", "b"},
                                                    {[](int p, int f, int c) { return (p + f + c) % 2 == 0; },
                                                     [](int p, int f, int c, int) { return 5 + 0.1 * noiseOf(p, f, c); }}));
        const QString warning =
            QString("With %1 participants the claims for fabrics like these are not reliable").arg(participants);
        QCOMPARE(page.contains(warning), isWarned);
        // The rates are those of studies of the paper's size.
        QCOMPARE(page.contains("A study that varies like this one, without any true difference"), !isWarned);
    }

    void conditionsWithoutAWrongAnswerAreNamed()
    {
        const StudyData data = builders::study(6, 4, {"a", "b"},
                                               {[](int p, int f, int c) { return c == 0 || (p + f) % 2 == 0; },
                                                [](int p, int f, int c, int) { return 5 + 0.1 * noiseOf(p, f, c); }});
        const QString page = pageOf(data);
        QVERIFY(page.contains("All answers were right under") && !page.contains("All answers were wrong under"));
        const Json row = reports::resultsJson(reports::analyse(data))["above_chance"][1];
        QVERIFY(row["p"].is_null() && row["estimate"] == 1.0 && row["above_chance"].is_null());
        QCOMPARE(row["why"]["above_chance"], row["why"]["p"]);
    }

    void twoConditionsHaveTheirVerdictInTheSummary()
    {
        const QString page = pageOf(builders::study(6, 5, {"a", "b"},
                                                    {[](int p, int f, int c) { return (p + f + c) % 3 != 0; },
                                                     [](int p, int f, int c, int) { return 5 + c + 0.1 * noiseOf(p, f, c); }}));
        QVERIFY(page.contains("Q2, a \u2212 b: \u2212"));
        QVERIFY(page.contains("For fabrics like these: <b>different</b>"));
    }

    void onePersonSpeaksForNobodyElse()
    {
        const QString page = pageOf(builders::study(1, 5, {"a", "b"},
                                                    {[](int, int f, int c) { return (f + c) % 3 != 0; },
                                                     [](int, int f, int c, int) { return 5 + c + 0.1 * noiseOf(0, f, c); }}));
        QVERIFY(page.contains("With 1 participant this study cannot show what holds for others."));
    }

    void boundsWithoutAProtocolAreCalledADefault()
    {
        StudyData data = studyOfOneOddFabric();
        data.boundsFrom = reports::PlanOrigin::Program;
        QVERIFY(pageOf(data).contains("default of this program") && !pageOf(data).contains("The protocol states"));
        data.boundsFrom = reports::PlanOrigin::Protocol;
        QVERIFY(!pageOf(data).contains("default of this program") && pageOf(data).contains("The protocol states"));
    }

    void figuresShowBothGeneralisations()
    {
        StudyData data = studyOfOneOddFabric();
        data.planned = {{"a", "b"}, {"c", "b"}};
        QStringList names;
        for (const reports::Figure& figure : reports::reportFigures(reports::analyse(data))) {
            names << QString::fromStdString(figure.name);
            if (figure.name != "contrasts_Q2") continue;
            QVERIFY(figure.svg.find("fabrics like these") != std::string::npos);
            QVERIFY(figure.svg.find(">these fabrics<") != std::string::npos);
            QVERIFY(figure.svg.find("not decided") != std::string::npos);
        }
        QVERIFY(names.contains("contrasts_Q1") && names.contains("contrasts_Q4") && names.contains("participants_Q3"));
    }

    /// With two participants the degrees of freedom may be far below 1.
    void anIntervalWithoutASensibleEndLeavesTheFigureReadable()
    {
        reports::StudyAnalysis analysis = reports::analyse(studyOfOneOddFabric());
        for (const bool isEndless : {false, true}) {
            for (const reports::Figure& figure : reports::reportFigures(analysis)) {
                if (figure.name != "contrasts_Q2") continue;
                QCOMPARE(figure.caption.find("goes on beyond it") != std::string::npos, isEndless);
                QVERIFY(!QString::fromStdString(figure.svg).contains(QRegularExpression("[0-9]{12}|e[+][0-9]{2}")));
            }
            for (auto& question : analysis.questions) {
                const auto* claims = reports::claimsOf(question);
                if (claims == nullptr) continue;
                for (auto& contrast : const_cast<reports::QuestionClaims*>(claims)->contrasts)
                    if (auto& ci95 = contrast.claim.mean.ci95; ci95.low.exists())
                        ci95 = {stats::Value(-1e276), stats::Value(1e276)};
            }
        }
    }
};

QTEST_GUILESS_MAIN(QuestionClaimsTest)
#include "question_claims_test.moc"
