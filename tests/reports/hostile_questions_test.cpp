// Studies with unusual questions: ids that are also keys of the files, many questions, only words, only same/different, several
// scales. The files must contain all of them.
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/whole_file.h"
#include "reports/cells/chance_level.h"
#include "reports/data/answers_csv.h"
#include "reports/figures/report_figures.h"
#include "reports/json/results_json.h"
#include "reports/json/statistics_json.h"
#include "reports/tables/overview_tables.h"
#include "reports/tables/report_tables.h"
#include "reports/text/plain_words.h"
#include "reports/write_report.h"
#include "tests/reports/study_builder.h"

using Json = nlohmann::ordered_json;
using namespace reports;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> conditions{"v_grey", "f", "h&f"};

/// Five participants answer every question about four fabrics under three conditions.
StudyData studyOf(const std::vector<QuestionInfo>& questions)
{
    StudyData data = builders::emptyStudy(5, 4, conditions, questions);
    int i = 0;
    for (const std::string& participant : data.participants)
        for (const std::string& fabric : data.fabrics)
            for (const std::string& condition : conditions)
                for (const QuestionInfo& question : questions) {
                    const Scoring scoring = scoringOf(question.kind);
                    const int draw = i++ * 37 % 101;
                    if (std::holds_alternative<RightOrWrong>(scoring))
                        data.responses.push_back(builders::right(participant, fabric, condition, question.id, draw < 60));
                    else if (const auto* scale = std::get_if<NumberOnScale>(&scoring))
                        data.responses.push_back(builders::rated(participant, fabric, condition, question.id,
                                                                 scale->min + (scale->max - scale->min) * draw / 101));
                    else
                        data.responses.push_back(builders::worded(participant, fabric, condition, question.id,
                                                                  "<b>warm</b>, \"soft\" " + std::to_string(draw)));
                }
    return data;
}

protocols::AnswerKind scale(int min, int max)
{
    protocols::Rating rating;
    rating.scale.min = protocols::Tenths{min};
    rating.scale.max = protocols::Tenths{max};
    return rating;
}

/// People say "same" at random, but mostly. `sameOfTen`: of ten pairs under each condition so many are the same.
StudyData studyOfPairs(const std::vector<int>& sameOfTen)
{
    StudyData data = builders::emptyStudy(6, 10, conditions, {{"Same", "Is it the same?", protocols::SameDifferent{}}});
    for (std::size_t c = 0; c < conditions.size(); ++c)
        for (int p = 0; p < 6; ++p)
            for (int f = 0; f < 10; ++f) {
                const bool wasSame = (f + p) % 10 < sameOfTen[c];
                const bool saidSame = (p * 37 + f * 11 + static_cast<int>(c) * 5 + p * f) % 14 != 0;
                StudyResponse response =
                    builders::right(data.participants[static_cast<std::size_t>(p)], data.fabrics[static_cast<std::size_t>(f)],
                                    conditions[c], "Same", wasSame == saidSame);
                response.seconds = 2 + (p + f) % 5;
                std::get<ChosenAnswer>(response.content).answer = saidSame ? "same" : "different";
                data.responses.push_back(response);
            }
    return data;
}

std::size_t countOf(const std::string& text, const std::string& part)
{
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

}  // namespace

class HostileQuestionsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void idsOfOtherKeysLoseNothing_data()
    {
        QTest::addColumn<QString>("id");
        for (const char* id : {"data", "schema", "questions", "screening", "response_times", "why", "quality", "conditions",
                               "condition", "comparisons", "equivalence", "study", "signals", "planned", "ratings", "q1_cochran",
                               "q1_glmm", "Overview", "missing"})
            QTest::newRow(id) << id;
    }

    void idsOfOtherKeysLoseNothing()
    {
        QFETCH(QString, id);
        const std::string hostile = id.toStdString();
        const StudyData odd = studyOf({{"Q1", "Which?", builders::amongThree}, {hostile, "How?", builders::onScale}});
        StudyData plain = studyOf({{"Q1", "Which?", builders::amongThree}, {"Q2", "How?", builders::onScale}});
        plain.planned = {{"f", "h&f"}};
        StudyData planned = odd;
        planned.planned = plain.planned;
        const StudyAnalysis analysis = analyse(planned), usual = analyse(plain);

        const Json results = resultsJson(analysis), usualResults = resultsJson(usual);
        QCOMPARE(results["questions"][hostile], usualResults["questions"]["Q2"]);
        QCOMPARE(results["questions"]["Q1"], usualResults["questions"]["Q1"]);
        for (const char* part : {"conditions", "speed_accuracy", "study"}) QCOMPARE(results[part], usualResults[part]);
        QCOMPARE(results["comparisons"].size(), usualResults["comparisons"].size());

        const Json statistics = statisticsJson(analysis), usualStatistics = statisticsJson(usual);
        const Json& ratings = statistics.contains("questions") && statistics["questions"].contains(hostile)
                                  ? statistics["questions"][hostile]
                                  : statistics[hostile];
        QCOMPARE(ratings, usualStatistics["Q2"]);
        for (const char* part : {"q1_cochran", "q1_glmm", "q1_per_condition"}) QCOMPARE(statistics[part], usualStatistics[part]);
        QCOMPARE(statistics["schema"], "vis2hap.statistics/1");
        QCOMPARE(statistics["data"]["responses"], 120);
        QCOMPARE(statistics["response_times"].size(), std::size_t(2));

        std::set<std::string> names;
        for (const ReportTable& one : reportTables(analysis)) {
            QVERIFY2(names.insert(lowerCase(one.table.name)).second, one.table.name.c_str());
            std::set<std::string> columns;
            for (std::size_t i = 0; i < one.table.columns.size(); ++i)
                if (one.table.isInCsv(i))
                    QVERIFY2(columns.insert(lowerCase(one.table.columns[i].name)).second, one.table.name.c_str());
        }
        QCOMPARE(names.size(), reportTables(usual).size());
    }

    void usualIdsKeepTheirPlace()
    {
        const Json statistics =
            statisticsJson(analyse(studyOf({{"Q1", "", builders::amongThree}, {"Q2", "", builders::onScale}})));
        QVERIFY(statistics.contains("Q2") && !statistics.contains("questions"));
    }

    // A study of an earlier version may hold ids that are refused today.
    void idsOfEarlierStudiesMakeWholeFiles()
    {
        const StudyData data = studyOf({{"Real", "", builders::amongThree},
                                        {"real", "", builders::amongThree},
                                        {"soft/hard", "", builders::onScale},
                                        {"<i>", "", builders::onScale}});
        const fs::path report = path("report");
        writeReport(analyse(data), report);
        for (const char* name : {"tables/real_matches.csv", "tables/real_matches-2.csv", "tables/soft_hard_ratings.csv",
                                 "tables/_i__ratings.csv", "figures/matches_Real.svg", "figures/matches_real-2.svg"})
            QVERIFY2(fs::exists(report / name), name);
        const Json statistics = Json::parse(protocols::readWholeFile(report / "statistics.json"));
        QVERIFY(statistics.contains("real_glmm") && statistics["questions"]["real"].contains("real_glmm"));
        QVERIFY(statistics["questions"]["real"]["real_matches_by_rendering"] != statistics["real_matches_by_rendering"]);
        QVERIFY(protocols::readWholeFile(report / "index.html").find("<i>:") == std::string::npos);
    }

    void manyQuestionsAreAllReported()
    {
        std::vector<QuestionInfo> questions;
        for (char letter = 'A'; letter <= 'Z'; ++letter)
            questions.push_back(
                {std::string("Question_") + letter, "How?", letter < 'E' ? builders::amongThree : builders::onScale});
        const StudyAnalysis analysis = analyse(studyOf(questions));
        QCOMPARE(resultsJson(analysis)["questions"].size(), std::size_t(26));
        std::string drawn;
        std::size_t ratingFigures = 0;
        for (const Figure& figure : reportFigures(analysis)) {
            drawn += figure.svg;
            ratingFigures += QString::fromStdString(figure.name).startsWith("ratings") ? 1 : 0;
        }
        for (const QuestionInfo& question : questions)
            QVERIFY2(drawn.find(question.id) != std::string::npos, question.id.c_str());
        QCOMPARE(ratingFigures, std::size_t(8));  // three names of ten letters fit into a legend
        writeReport(analysis, path("report"));
        for (char letter = 'e'; letter <= 'z'; ++letter)
            QVERIFY(fs::exists(path("report") / "tables" / (std::string("question_") + letter + "_ratings.csv")));
        QVERIFY(fs::exists(path("report") / "figures" / "ratings_8.svg"));
    }

    void studyOfWordsAlone()
    {
        StudyData data = studyOf({{"Feel", "What does it feel like?", protocols::FreeText{}}});
        data.responses.pop_back();
        const StudyAnalysis analysis = analyse(data);
        const Json results = resultsJson(analysis);
        QCOMPARE(results["questions"]["Feel"]["v_grey"], (Json{{"answers", 20}, {"participants", 5}}));
        QCOMPARE(results["questions"]["Feel"]["h&f"], (Json{{"answers", 19}, {"participants", 5}}));
        QVERIFY(results["comparisons"].empty() && results["equivalence"].empty());
        QCOMPARE(results["quality"][0]["why"], "answers missing: Feel: 1 of 12");
        const Json described = statisticsJson(analysis)["data"];
        QCOMPARE(described["responses"], 59);
        QCOMPARE(described["missing_responses"], 1);
        QCOMPARE(described["missing_by_condition"]["Feel"]["h&f"], 1);
        QCOMPARE(described["questions"][0]["kind"], "words");

        writeReport(analysis, path("report"));
        const auto table = protocols::readForeignTable(path("report") / "tables" / "worded_answers.csv").table;
        QCOMPARE(table.columns, (std::vector<std::string>{"participant", "fabric", "condition", "question", "words"}));
        QCOMPARE(table.rows.size(), std::size_t(59));
        QCOMPARE(table.rows[1], (std::vector<std::string>{"P01", "F02", "v_grey", "Feel", "<b>warm</b>, \"soft\" 10"}));
        const std::string page = protocols::readWholeFile(path("report") / "index.html");
        QCOMPARE(countOf(page, "&lt;b&gt;warm&lt;/b&gt;, &quot;soft&quot;"), std::size_t(59));
        QVERIFY(page.find("Feel: 5 participants gave 59 answers in words.") != std::string::npos);
        QVERIFY(page.find("<b>Feel</b> \u201CWhat does it feel like?\u201D") != std::string::npos);
        QVERIFY(page.find("59 of 60 expected answers are analysed, 1 is missing.") != std::string::npos);
        for (const char* absent : {"Paired t tests", "Balanced integration", "Unit of analysis", "<figure>"})
            QVERIFY2(page.find(absent) == std::string::npos, absent);
        QVERIFY(overviewText(analysis).find("Feel answers") != std::string::npos);
        QVERIFY(fs::is_directory(path("report") / "figures"));
    }

    void wordsOfABlindedStudyAreCountedOnly()
    {
        StudyData data = studyOf({{"Q1", "", builders::amongThree}, {"Feel", "", protocols::FreeText{}}});
        data.blinded = true;
        const std::map<std::string, std::string> masks{{"v_grey", "K3"}, {"f", "K1"}, {"h&f", "K2"}};
        data.conditions = {"K1", "K2", "K3"};
        for (StudyResponse& response : data.responses) response.condition = masks.at(response.condition);
        writeReport(analyse(data), path("report"));
        QVERIFY(!fs::exists(path("report") / "tables" / "worded_answers.csv"));
        QVERIFY(protocols::readWholeFile(path("report") / "index.html").find("v_grey") == std::string::npos);
    }

    void studyOfSameAndDifferentAlone()
    {
        const StudyAnalysis analysis = analyse(studyOf({{"Same", "Is it the same?", protocols::SameDifferent{}}}));
        const Json statistics = statisticsJson(analysis);
        QCOMPARE(statistics["data"]["alternatives"], 2);
        QVERIFY(statistics["same_per_condition"][0].contains("p_exact_greater_one_half"));
        QCOMPARE(statistics["data"]["questions"][0]["kind"], "choice");
        writeReport(analysis, path("report"));
        const std::string page = protocols::readWholeFile(path("report") / "index.html");
        QVERIFY(page.find("Chance is 1/2.") != std::string::npos);
        QVERIFY(page.find("two one-sided tests") == std::string::npos);
        QVERIFY(page.find("mean share. The ends") == std::string::npos);  // d' is that of hits and false alarms
        QVERIFY(page.find("Same: number of participants who gave the right answer to each rendering") != std::string::npos);
    }

    // Everybody says "same" readily: 54 of 60 times about each condition. python3, with z = NormalDist().inv_cdf:
    // h, f = 29.5 / 31, 25.5 / 31; print(z(h) - z(f), -(z(h) + z(f)) / 2)
    void sensitivityToSameAndDifferentIsThatOfHitsAndFalseAlarms()
    {
        StudyData data = builders::emptyStudy(6, 10, conditions, {{"Same", "Is it the same?", protocols::SameDifferent{}}});
        for (const std::string& condition : conditions)
            for (std::size_t p = 0; p < 6; ++p)
                for (std::size_t f = 0; f < 10; ++f) {
                    const bool wasSame = (p + f) % 2 == 0, saidSame = wasSame ? p + f != 0 : (f + 5 * p) % 7 != 1;
                    StudyResponse response =
                        builders::right(data.participants[p], data.fabrics[f], condition, "Same", wasSame == saidSame);
                    std::get<ChosenAnswer>(response.content).answer = saidSame ? "same" : "different";
                    std::get<ChosenAnswer>(response.content).slot = saidSame ? 0 : 1;
                    data.responses.push_back(response);
                }
        const StudyAnalysis analysis = analyse(data);
        const Json row = statisticsJson(analysis)["same_sensitivity"]["f"];
        QCOMPARE(row["hits"], 29);
        QCOMPARE(row["same_pairs"], 30);
        QCOMPARE(row["false_alarms"], 25);
        QCOMPARE(row["different_pairs"], 30);
        QVERIFY(std::fabs(row["d_prime"].get<double>() - 0.735453051) < 1e-8);
        QVERIFY(std::fabs(row["criterion"].get<double>() + 1.292971085) < 1e-8);
        QCOMPARE(row["clustered"][0]["d_prime"], row["d_prime"]);
        for (const QualityFlag& flag : qualityFlags(data))  // two participants know one word only
            QVERIFY(flag.why.find("the answer \"same\" was given in all 30 trials") != std::string::npos);
        writeReport(analysis, path("report"));
        const auto table = protocols::readForeignTable(path("report") / "tables" / "same_hits.csv").table;
        QCOMPARE(table.rows[0][*table.column("hits")], std::string("29"));
        QVERIFY(table.rows[0][*table.column("d\u2032")].starts_with("0.7354"));
        const auto page = [&] { return protocols::readWholeFile(path("report") / "index.html"); };
        QVERIFY(page().find("tested against 1/2, because half of the pairs were the same") != std::string::npos);
        // 75 of 165 pairs were the same.
        std::erase_if(data.responses, [&](const StudyResponse& one) {
            const auto& choice = std::get<ChosenAnswer>(one.content);
            return one.participant == data.participants[0] && choice.correct == (*choice.answer == "same");
        });
        writeReport(analyse(data), path("report"));
        QVERIFY(page().find("because half of the pairs") == std::string::npos);
        QVERIFY(page().find("is not tested against 1/2, because 45 % of the pairs were the same") != std::string::npos);
    }

    // 80 % of the pairs are the same: three quarters of the guesses are right.
    void guessersAmongUnevenPairsAreNotAboveChance()
    {
        const std::string why = "guessing is not right in half of the answers: 48 of 60 pairs were the same";
        const StudyAnalysis analysis = analyse(studyOfPairs({8, 8, 8}));
        const Json results = resultsJson(analysis), &one = results["questions"]["Same"]["f"];
        QVERIFY(one["proportion"].get<double>() > 0.7 && one["ci95"][0].is_number());
        for (const char* test : {"p_chance", "p_chance_participants"})
            QVERIFY(one[test].is_null() && one["why"][test].get<std::string>() == why);
        QCOMPARE(results["above_chance"].size(), 2 * conditions.size());
        for (const Json& row : results["above_chance"]) {
            QVERIFY(row["estimate"].is_number() && row["p"].is_null() && row["p_adjusted"].is_null());
            for (const char* field : {"p", "above_chance"})
                QVERIFY(row[field].is_null() && row["why"][field].get<std::string>() == why);
        }
        QVERIFY(results["speed_accuracy"]["f"]["bits_per_second"].is_null());
        const Json statistics = statisticsJson(analysis);
        QVERIFY(statistics["same_sensitivity"]["f"]["d_prime"].is_number());
        QVERIFY(statistics["same_sensitivity"]["f"]["clustered"][0]["d_prime_low"].is_number());
        writeReport(analysis, path("report"));
        const std::string page = protocols::readWholeFile(path("report") / "index.html");
        QVERIFY(page.find("shown to be above chance") == std::string::npos);
        QVERIFY(page.find("Same: There is no test against chance (1/2) under") != std::string::npos);
        QVERIFY(page.find("there is no test (" + why + "); <i>d</i>\u2032") != std::string::npos);
        QVERIFY(page.find("No line of chance: the pairs were not half the same.") != std::string::npos);
        QVERIFY(page.find("chance, 1/2") == std::string::npos);
        const auto table = protocols::readForeignTable(path("report") / "tables" / "above_chance_same.csv").table;
        QCOMPARE(table.rows[0][*table.column("above chance")], std::string("not tested"));
        // Halves are tested as before.
        for (const Json& row : resultsJson(analyse(studyOfPairs({5, 5, 5})))["above_chance"]) QVERIFY(row["p"].is_number());
    }

    void figuresNameTheConditionsWithoutATestAgainstChance()
    {
        const StudyAnalysis analysis = analyse(studyOfPairs({8, 5, 5}));
        std::size_t withChance = 0;
        for (const Figure& figure : reportFigures(analysis)) {
            if (figure.section != PageSection::Matches && figure.section != PageSection::Speed) continue;
            const bool names = figure.caption.find(" Not tested against chance under v_grey: ") != std::string::npos;
            QVERIFY2(names == (figure.svg.find(">chance") != std::string::npos), figure.name.c_str());
            withChance += names ? 1 : 0;
        }
        QCOMPARE(withChance, std::size_t(3));  // matches, speed against accuracy, accuracy by time
        for (const ReportTable& one : reportTables(analysis))
            if (one.table.name == "above_chance_same") QVERIFY(one.table.caption.ends_with("the pairs were not half the same"));
    }

    // Seven pairs halve into three and four; a list that ended early may lack more of one half.
    void halvesMayDifferAsDrawsMakeThem()
    {
        const auto isTested = [](std::size_t some, PairList list, std::size_t others, PairList other) {
            std::vector<PairList> lists(some, list);
            lists.insert(lists.end(), others, other);
            return whyNotHalved(lists).empty();
        };
        QVERIFY(isTested(5, {4, 3}, 3, {3, 4}) && isTested(6, {4, 3}, 4, {3, 4}));
        QVERIFY(!isTested(10, {4, 3}, 0, {}) && !isTested(3, {4, 3}, 0, {}) && !isTested(9, {4, 3}, 1, {3, 4}));
        QVERIFY(isTested(6, {4, 4}, 1, {3, 1}) && !isTested(6, {4, 4}, 1, {5, 1}));
        QVERIFY(!isTested(6, {4, 4}, 2, {5, 3}) && !isTested(1, {4, 4}, 10, {3, 1}));
        QVERIFY(!isTested(9, {1, 0}, 0, {}));
        // Whoever says "same" to every pair is right in half of them, or a standard error more.
        for (const long long pairs : {1, 3, 5, 7})
            for (std::size_t people = 1; people < 60; ++people)
                for (std::size_t more = people / 2; more <= people; ++more) {
                    const auto excess = static_cast<double>(2 * more) - static_cast<double>(people);
                    if (isTested(more, {(pairs + 1) / 2, pairs / 2}, people - more, {pairs / 2, (pairs + 1) / 2}))
                        QVERIFY(excess <= 1 || excess * excess <= std::min(2.25, static_cast<double>(pairs)) * double(people));
                }
    }

    void halvesMayDifferByOddNumbers_data()
    {
        QTest::addColumn<int>("same");
        QTest::addColumn<int>("different");
        QTest::addColumn<int>("lists");
        QTest::addColumn<bool>("isTested");
        QTest::newRow("halves") << 30 << 30 << 1 << true;
        QTest::newRow("one more") << 5 << 4 << 1 << true;
        QTest::newRow("two more of few") << 5 << 3 << 1 << false;
        QTest::newRow("one more in each of two instructions") << 3 << 2 << 2 << true;
        QTest::newRow("two more of many, as after a session that ended") << 33 << 31 << 1 << true;
        QTest::newRow("four more of many") << 34 << 30 << 1 << false;
        QTest::newRow("4 of 7 for everybody") << 40 << 30 << 1 << false;
        QTest::newRow("only the same") << 9 << 0 << 1 << false;
        QTest::newRow("no answers") << 0 << 0 << 1 << true;
    }
    void halvesMayDifferByOddNumbers()
    {
        QFETCH(const int, same);
        QFETCH(const int, different);
        QFETCH(const int, lists);
        std::vector<StudyResponse> answers;
        for (int list = 0; list < lists; ++list)
            for (int pair = 0; pair < same + different; ++pair) {
                answers.push_back(builders::right("P01", "F01", "f", "Same", pair < same));
                answers.back().instruction = std::to_string(list);
                std::get<ChosenAnswer>(answers.back().content).answer = "same";
            }
        std::vector<const StudyResponse*> responses;
        for (const StudyResponse& one : answers) responses.push_back(&one);
        QTEST(whyNoChance(RightOrWrong{2, true}, responses).empty(), "isTested");
        QVERIFY(whyNoChance(RightOrWrong{2, false}, responses).empty());
    }

    void everyQuestionKeepsItsOwnScale()
    {
        const StudyAnalysis analysis = analyse(studyOf({{"Q2", "", builders::onScale},
                                                        {"Warm", "", scale(-30, 30)},
                                                        {"Cold", "", scale(-30, 30)},
                                                        {"Q3", "", scale(10, 70)}}));
        const auto ratings = questionsWith<RatingAnalysis>(analysis);
        QCOMPARE(ratings[0].findings.scale.max, 10.0);
        QCOMPARE(ratings[1].findings.scale.min, -3.0);
        QCOMPARE(ratings[3].findings.scale.max, 7.0);
        const Json described = statisticsJson(analysis)["data"];
        QCOMPARE(described["scale"], (Json{-3.0, 10.0}));
        QCOMPARE(described["questions"][1]["scale"], (Json{-3.0, 3.0}));
        auto figures = reportFigures(analysis);
        std::erase_if(figures, [](const Figure& figure) { return !QString::fromStdString(figure.name).startsWith("ratings"); });
        QCOMPARE(figures.size(), std::size_t(3));
        QCOMPARE(figures[0].name, std::string("ratings"));
        QCOMPARE(figures[1].name, std::string("ratings_2"));
        QVERIFY(figures[1].caption.find("(Warm and Cold)") != std::string::npos);
    }

    void choicesAmongDifferentNumbersHaveTheirOwnChance()
    {
        const StudyAnalysis analysis =
            analyse(studyOf({{"Q1", "", protocols::ForcedChoice{4}}, {"Same", "", protocols::SameDifferent{}}}));
        const Json statistics = statisticsJson(analysis);
        QVERIFY(statistics["q1_per_condition"][0].contains("p_exact_greater_one_quarter"));
        QVERIFY(statistics["same_per_condition"][0].contains("p_exact_greater_one_half"));
        writeReport(analysis, path("report"));
        const std::string page = protocols::readWholeFile(path("report") / "index.html");
        QVERIFY(page.find("Chance is 1/m, where m is the number of answers to choose from: 4 for Q1 and 2 for Same.") !=
                std::string::npos);
        QVERIFY(page.find("d\u2032 of Q1 belongs to the mean share. The ends") != std::string::npos);
        StudyData assumed = studyOf({{"Q1", "", protocols::ForcedChoice{3}}});
        assumed.questions[0].alternativesAssumed = true;
        writeReport(analyse(assumed), path("report"));
        QVERIFY(protocols::readWholeFile(path("report") / "index.html")
                    .find("Chance is 1/3. For Q1 this is the default of this program") != std::string::npos);
    }

    void answersOfAnotherKindAreAFault()
    {
        StudyData data = studyOf({{"Q2", "", builders::onScale}});
        data.responses.front().content = WordedAnswer{"soft"};
        QVERIFY_EXCEPTION_THROWN(analyse(data), protocols::Error);
    }

private:
    fs::path path(const char* name) const { return fs::path(m_folder->path().toStdString()) / name; }

    std::unique_ptr<QTemporaryDir> m_folder;
};

QTEST_GUILESS_MAIN(HostileQuestionsTest)
#include "hostile_questions_test.moc"
