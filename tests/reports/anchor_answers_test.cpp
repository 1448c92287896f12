// Answers to anchors in the report: pairs of first and second answers, floor and ceiling, tables, figures and sentences, and the
// planted noise of simulated studies found again.
#include "reports/cells/anchor_answers.h"

#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "reports/data/answers_csv.h"
#include "reports/figures/report_figures.h"
#include "reports/json/results_json.h"
#include "reports/page/anchor_text.h"
#include "reports/page/page.h"
#include "reports/tables/report_tables.h"
#include "stats/kernels/draws.h"
#include "tests/reports/study_builder.h"

using namespace reports;

namespace {

StudyResponse placed(StudyResponse response, int trial)
{
    response.trial = trial;
    return response;
}

StudyResponse chosen(const std::string& participant, const std::string& fabric, const std::string& answer)
{
    return {participant, fabric, "h", "Q1", ChosenAnswer{answer == fabric, answer, {}}, {}};
}

/// Ratings of 0 to 10 with planted noise: conditions a to d are felt as 2, 4, 6 and 8, the image of another fabric as `floor`.
StudyData noisyStudy(int participants, double noise, double floor, std::uint64_t stream)
{
    stats::Draws draws(21, stream);
    StudyData data = builders::emptyStudy(participants, 5, {"a", "b", "c", "d"}, {{"Q2", "How close?", builders::onScale}});
    const auto answer = [&](double felt) { return std::round(10 * std::clamp(felt + draws.normal(noise), 0.0, 10.0)) / 10; };
    for (const std::string& participant : data.participants) {
        const double person = draws.normal(0.5);
        int trial = 0;
        for (std::size_t c = 0; c < 4; ++c)
            for (const std::string& fabric : data.fabrics) {
                const double felt = 2 + 2 * static_cast<double>(c) + person + draws.normal(0.5);
                data.responses.push_back(
                    placed(builders::rated(participant, fabric, data.conditions[c], "Q2", answer(felt)), ++trial));
                if (fabric == "F01" || (fabric == "F02" && c < 2))
                    data.repeatedResponses.push_back(
                        placed(builders::rated(participant, fabric, data.conditions[c], "Q2", answer(felt)), 100 + trial));
            }
        for (const char* fabric : {"F01", "F02", "F03", "F04"})
            data.mismatchedResponses.push_back(builders::rated(participant, fabric, "d", "Q2", answer(floor + person)));
    }
    return data;
}

QString lastingText(const std::vector<ReportTable>& tables, const std::string& name)
{
    for (const ReportTable& one : tables)
        if (one.table.name == name) {
            QString text;
            for (const auto& row : one.table.rows) {
                for (const auto& cell : row) text += QString::fromStdString(cell.text) + "|";
                text += "\n";
            }
            return text;
        }
    return {};
}

}  // namespace

class AnchorAnswersTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aPairIsTheFirstAndTheSecondAnswerInTime()
    {
        StudyData data = builders::emptyStudy(2, 2, {"h", "f"}, {{"Q2", "", builders::onScale}});
        data.responses = {placed(builders::rated("P01", "F01", "h", "Q2", 3), 1),
                          placed(builders::rated("P01", "F02", "h", "Q2", 6), 30),
                          placed(builders::rated("P02", "F01", "f", "Q2", 1), 2)};
        data.repeatedResponses = {
            placed(builders::rated("P01", "F01", "h", "Q2", 4), 20),
            placed(builders::rated("P01", "F02", "h", "Q2", 8), 21),   // the first one was voided and came later
            placed(builders::rated("P02", "F02", "f", "Q2", 9), 20)};  // its first answer is missing
        const auto anchors = anchorsOf(data, AnswerCells(data));
        QCOMPARE(anchors.size(), 1u);
        QVERIFY(!anchors[0].floor && anchors[0].ratings);
        QCOMPARE(anchors[0].ratings->pairs, 2u);
        QCOMPARE(anchors[0].ratings->participants, 1u);
        QCOMPARE(*anchors[0].ratings->limitsOfAgreement.low + *anchors[0].ratings->limitsOfAgreement.high, 1.0 - 2.0);
    }

    void theOrderOfRowsChangesNoBit()
    {
        StudyData data = noisyStudy(6, 1, 2, 3);
        const auto numbers = [&] { return resultsJson(analyse(data, {.depth = Depth::Quick}), {})["anchors"].dump(); };
        const std::string before = numbers();
        for (auto* responses : {&data.responses, &data.repeatedResponses, &data.mismatchedResponses})
            std::ranges::reverse(*responses);
        QCOMPARE(QString::fromStdString(numbers()), QString::fromStdString(before));
    }

    void choicesAgreeByTheFabricChosen()
    {
        StudyData data = builders::emptyStudy(1, 3, {"h"}, {{"Q1", "", builders::amongThree}});
        data.responses = {chosen("P01", "F01", "F02"), chosen("P01", "F02", "F02"), chosen("P01", "F03", "F01")};
        data.repeatedResponses = {chosen("P01", "F01", "F02"), chosen("P01", "F02", "F01"), chosen("P01", "F03", "F01")};
        const auto anchors = anchorsOf(data, AnswerCells(data));
        QCOMPARE(anchors.at(0).choices->pairs, 3u);
        QCOMPARE(anchors.at(0).choices->agreeing, 2u);  // wrong twice in the same way agrees, too
        QCOMPARE(*anchors.at(0).choices->kappa.value, 0.5);
        QVERIFY(ceilingOf(anchors[0]) == &anchors[0].choices->shareCeiling);
    }

    /// A choice that comes again has other foils, so that a wrong answer cannot be the same one.
    void besideOtherFoilsRightAndWrongAreCompared()
    {
        StudyData data = builders::emptyStudy(1, 4, {"h"}, {{"Q1", "", builders::amongThree}});
        data.choicesRepeatedAnew = {"Q1"};
        data.responses = {chosen("P01", "F01", "F02"), chosen("P01", "F02", "F02"), chosen("P01", "F03", "F03"),
                          chosen("P01", "F04", "F04")};
        data.repeatedResponses = {chosen("P01", "F01", "F04"), chosen("P01", "F02", "F01"), chosen("P01", "F03", "F03"),
                                  chosen("P01", "F04", "F04")};
        const auto anchors = anchorsOf(data, AnswerCells(data));
        QCOMPARE(anchors.at(0).choices->pairs, 4u);
        QCOMPARE(anchors.at(0).choices->agreeing, 3u);  // wrong both times agrees, whatever was chosen
        QCOMPARE(anchors.at(0).choices->bothWrong, 1u);
        QCOMPARE(*anchors.at(0).choices->kappa.value, 0.4375);  // two wrong of three agree by 1/2: (3 * 2.5/4 - 1) / (3 - 1)
        QCOMPARE(*anchors.at(0).choices->shareCeiling.value, (1 + std::sqrt(0.5)) / 2);
        const StudyAnalysis analysis = analyse(data, {.depth = Depth::Quick});
        const QString words = QString::fromStdString(choiceAnchorsText(analysis));
        QVERIFY2(words.contains("2 were right both times and 1 wrong both times; corrected for guessing (1/3), kappa is 0.44"),
                 qPrintable(words));
        const auto json = resultsJson(analysis, {})["anchors"][0]["repeated"];
        QCOMPARE(json["compared"].get<std::string>(), std::string("right and wrong"));
        QCOMPARE(json["alternatives"].get<int>(), 3);
        QCOMPARE(json["both_wrong"].get<int>(), 1);
    }

    /// Of two phases of choices one has all fabrics on its trays: there a wrong choice can be the same, or another one.
    void aQuestionWithTheSameTraysComparesFabrics()
    {
        StudyData data = builders::emptyStudy(1, 4, {"h"}, {{"Q1", "", builders::amongThree}, {"Q5", "", builders::amongThree}});
        data.choicesRepeatedAnew = {"Q5"};
        data.responses = {chosen("P01", "F01", "F02"), chosen("P01", "F02", "F02")};
        data.repeatedResponses = {chosen("P01", "F01", "F04"), chosen("P01", "F02", "F02")};
        for (auto* responses : {&data.responses, &data.repeatedResponses})
            for (std::size_t i = 0; i < 2; ++i) {
                StudyResponse other = (*responses)[i];
                other.question = "Q5";
                responses->push_back(other);
            }
        const auto anchors = anchorsOf(data, AnswerCells(data));
        QCOMPARE(anchors.at(0).choices->agreeing, 1u);
        QCOMPARE(anchors.at(1).choices->agreeing, 2u);
        QCOMPARE(anchors[0].compared, stats::ChoicesCompared::Answers);
        QCOMPARE(anchors[1].compared, stats::ChoicesCompared::Outcomes);
    }

    /// Who always says "same" repeats themselves without feeling anything: 67 of 75 answers agree, and nothing is reliable.
    void aHabitForSameIsNoReliability()
    {
        StudyData data = builders::emptyStudy(25, 3, {"h"}, {{"Q1", "Same?", protocols::SameDifferent{}}});
        const auto said = [](const std::string& participant, const std::string& fabric, const std::string& word) {
            return StudyResponse{participant, fabric, "h", "Q1", ChosenAnswer{word == "same", word, {}}, {}};
        };
        for (std::size_t p = 0; p < data.participants.size(); ++p)
            for (const std::string& fabric : data.fabrics) {
                const bool isOther = p < 8 && fabric == "F01";
                data.responses.push_back(said(data.participants[p], fabric, isOther && p < 4 ? "different" : "same"));
                data.repeatedResponses.push_back(said(data.participants[p], fabric, isOther && p >= 4 ? "different" : "same"));
            }
        const StudyAnalysis analysis = analyse(data, {.depth = Depth::Quick});
        const auto json = resultsJson(analysis, {})["anchors"][0]["repeated"];
        QCOMPARE(json["compared"].get<std::string>(), std::string("words"));
        QCOMPARE(json["agreeing"].get<int>(), 67);
        QCOMPARE(json["kappa"].get<double>(), 0.0);
        QCOMPARE(json["ceiling_of_proportion"].get<double>(), 0.5);
        QVERIFY(json["kappa_ci95"].is_null());  // 0 for each participant alone, which says nothing of its exactness
        const QString words = QString::fromStdString(choiceAnchorsText(analysis));
        QVERIFY2(
            words.contains("67 of 75 choices that came twice were the same; corrected for each participant&rsquo;s habit for "
                           "one word, kappa is 0.00"),
            qPrintable(words));
        for (const char* part :
             {"words (Cohen 1960). It is how often the first answer", "a kappa of few pairs can lie below &minus;1"})
            QVERIFY2(anchorsMethod(analysis).find(part) != std::string::npos, part);

        for (auto* responses : {&data.responses, &data.repeatedResponses})
            for (StudyResponse& response : *responses) response.content = ChosenAnswer{true, "same", {}};
        const StudyAnalysis constant = analyse(data, {.depth = Depth::Quick});
        const auto none = resultsJson(constant, {})["anchors"][0]["repeated"];
        QVERIFY(none["kappa"].is_null() && none["ceiling_of_proportion"].is_null());
        QVERIFY(none["why"]["kappa"].get<std::string>().starts_with("every participant used one word only"));
        QVERIFY(choiceAnchorsText(constant).find("There is no kappa: every participant used one word only") != std::string::npos);
        QVERIFY(anchorsMethod(analyse(noisyStudy(6, 1, 1, 0), {.depth = Depth::Quick})).find("Cohen 1960") == std::string::npos);
    }

    /// Two wrong choices may be two different ones, so that right and wrong alone say nothing about agreement.
    void choicesWithoutTheFabricChosenAreNotCompared()
    {
        StudyData data = builders::emptyStudy(1, 3, {"h"}, {{"Q1", "", builders::amongThree}});
        for (const char* fabric : {"F01", "F02"}) {
            data.responses.push_back(builders::right("P01", fabric, "h", "Q1", false));
            data.repeatedResponses.push_back(builders::right("P01", fabric, "h", "Q1", false));
        }
        const StudyAnalysis analysis = analyse(data, {.depth = Depth::Quick});
        QCOMPARE(analysis.anchors.size(), std::size_t{1});
        QVERIFY(!analysis.anchors[0].choices && ceilingOf(analysis.anchors[0]) == nullptr);
        const std::string reason = "2 choices came twice, but of none both answers are known";
        const auto json = resultsJson(analysis, {})["anchors"][0];
        QVERIFY(json["repeated"].is_null());
        QVERIFY2(json["why"]["repeated"].get<std::string>().starts_with(reason), json.dump().c_str());
        const QString words = QString::fromStdString(choiceAnchorsText(analysis));
        QVERIFY2(words.contains(QString::fromStdString(reason)), qPrintable(words));
        QVERIFY2(lastingText(reportTables(analysis), "anchors").startsWith("Q1|"),
                 qPrintable(lastingText(reportTables(analysis), "anchors")));
    }

    void theFloorStandsBesideTheLowestCondition()
    {
        StudyData data = builders::emptyStudy(2, 1, {"a", "b"}, {{"Q2", "", builders::onScale}});
        for (const char* person : {"P01", "P02"}) {
            data.responses.push_back(builders::rated(person, "F01", "a", "Q2", 3));
            data.responses.push_back(builders::rated(person, "F01", "b", "Q2", 7));
        }
        for (const double rating : {1.0, 4.0})
            data.mismatchedResponses.push_back(builders::rated("P01", "F01", "b", "Q2", rating));
        for (const double rating : {2.0, 7.0})
            data.mismatchedResponses.push_back(builders::rated("P02", "F01", "b", "Q2", rating));
        const auto anchors = anchorsOf(data, AnswerCells(data));
        const AnchorFloor& floor = *anchors.at(0).floor;
        QCOMPARE(floor.conditions, std::vector<std::string>{"b"});
        QCOMPARE(*floor.mean, 3.5);
        QCOMPARE(floor.lowest, std::string("a"));
        QCOMPARE(*floor.shareAbove, 0.5);
        QCOMPARE(floor.notAbove, std::vector<std::string>{"a"});
    }

    /// Half of the images were rated 7, the others 1: the mean is that of neither condition.
    void aFloorOfSeveralConditionsNamesThemAll()
    {
        StudyData data = builders::emptyStudy(2, 1, {"a", "b"}, {{"Q2", "", builders::onScale}});
        for (const char* person : {"P01", "P02"})
            for (const char* condition : {"a", "b"}) {
                data.responses.push_back(builders::rated(person, "F01", condition, "Q2", 5));
                data.mismatchedResponses.push_back(
                    builders::rated(person, "F01", condition, "Q2", std::string(condition) == "a" ? 7 : 1));
            }
        const StudyAnalysis analysis = analyse(data, {.depth = Depth::Quick});
        QCOMPARE(analysis.anchors.at(0).floor->conditions, (std::vector<std::string>{"a", "b"}));
        QVERIFY(ratingAnchorsText(analysis).find("a and b images were rated 4.0") != std::string::npos);
        const auto row = resultsJson(analysis, {})["anchors"][0]["mismatched"];
        QVERIFY(row["condition"].is_null() && row["why"].contains("condition"));
        QCOMPARE(row["conditions"].size(), std::size_t{2});
    }

    /// The usual design: the second ratings are those of another day. They vanished without a word.
    void aRetestInAnotherSessionFindsItsFirstAnswers()
    {
        StudyData data = noisyStudy(6, 1, 1, 0);
        const auto whole = anchorsOf(data, AnswerCells(data)).at(0).ratings;
        for (StudyResponse& response : data.responses) response.repetition = "session 1";
        for (StudyResponse& response : data.repeatedResponses) response.repetition = "session 2";
        QCOMPARE(anchorsOf(data, AnswerCells(data)).at(0).ratings->pairs, whole->pairs);
        for (StudyResponse& response : data.repeatedResponses) response.fabric = "another " + response.fabric;
        const StudyAnalysis analysis = analyse(data, {.depth = Depth::Quick});
        const std::string reason = "36 repeated answers have no first answer to the same presentation";
        QVERIFY(ratingAnchorsText(analysis).find(reason) != std::string::npos);
        QCOMPARE(resultsJson(analysis, {})["anchors"][0]["why"]["repeated"].get<std::string>(), reason);
    }

    /// Ratings of 1 to 5, or of 0 to 100, once had a ceiling of 9.8.
    void aScaleThatNobodyStatedHasNoCeiling()
    {
        StudyData data = noisyStudy(6, 1, 1, 0);
        data.questions.front().scaleAssumed = true;
        const auto found = anchorsOf(data, AnswerCells(data)).at(0).ratings;
        QVERIFY(found->icc.value.exists() && !found->meanCeiling.value.exists());
        const StudyAnalysis analysis = analyse(data, {.depth = Depth::Quick});
        QVERIFY(ratingAnchorsText(analysis).find("is unknown: nobody stated the scale") != std::string::npos);
        for (const Figure& figure : reportFigures(analysis)) QVERIFY(figure.caption.find("ceiling") == std::string::npos);
    }

    void noAnalysisOfConditionsUsesThem()
    {
        StudyData data = noisyStudy(6, 1, 1, 0);
        const StudyAnalysis with = analyse(data, {.depth = Depth::Quick});
        data.mismatchedResponses.clear();
        data.repeatedResponses.clear();
        auto results = resultsJson(with, {}), plain = resultsJson(analyse(data, {.depth = Depth::Quick}), {});
        QVERIFY(results.contains("anchors") && !plain.contains("anchors"));
        results.erase("anchors");
        QCOMPARE(QString::fromStdString(results.dump()), QString::fromStdString(plain.dump()));
    }

    void theReportShowsFloorAndCeiling()
    {
        const StudyAnalysis analysis = analyse(noisyStudy(8, 1, 2.5, 1), {.depth = Depth::Quick});
        const auto tables = reportTables(analysis);
        const QString means = lastingText(tables, "q2_ratings"), small = lastingText(tables, "anchors");
        QVERIFY2(means.contains("floor: another fabric|32|") && means.contains("ceiling: noise of the answers||"),
                 qPrintable(means));
        QVERIFY2(small.startsWith("Q2|32|"), qPrintable(small));
        QVERIFY(!lastingText(tables, "anchors_retest").isEmpty());
        for (const Figure& figure : reportFigures(analysis))
            if (figure.name == "ratings") {
                QVERIFY(figure.svg.find(">floor<") != std::string::npos && figure.svg.find(">ceiling<") != std::string::npos);
                QVERIFY(figure.caption.find("Dotted lines: floor") != std::string::npos);
            }
        const auto json = resultsJson(analysis, {});
        QCOMPARE(json["anchors"][0]["question"].get<std::string>(), std::string("Q2"));
        QVERIFY(json["anchors"][0]["repeated"]["icc_ci95"].is_array());
        QCOMPARE(json["anchors"][0]["repeated"]["bias"]["bounds"].dump(), std::string("[-0.5,0.5]"));
    }

    /// Ratings of another scale stand in another figure, and only the anchors of a figure have lines in it.
    void aFigureWithoutAnchorsNamesNoLines()
    {
        StudyData data = noisyStudy(8, 1, 2.5, 1);
        protocols::Rating percent;
        percent.scale.max = protocols::Tenths{1000};
        data.questions.push_back({"Q3", "How much?", percent});
        for (const std::string& participant : data.participants)
            for (const std::string& condition : data.conditions)
                for (const std::string& fabric : data.fabrics)
                    data.responses.push_back(builders::rated(participant, fabric, condition, "Q3", 50));
        int seen = 0;
        for (const Figure& figure : reportFigures(analyse(data, {.depth = Depth::Quick})))
            if (figure.name == "ratings" || figure.name == "ratings_2") {
                const bool hasLines = figure.caption.find("Dotted lines") != std::string::npos;
                QCOMPARE(hasLines, figure.name == "ratings");
                QCOMPARE(figure.svg.find(">floor<") != std::string::npos, hasLines);
                QCOMPARE(figure.caption.find("Dashed lines") != std::string::npos, hasLines);
                ++seen;
            }
        QCOMPARE(seen, 2);
    }

    void aBlindedStudyShowsNoAnchors()
    {
        StudyData data = noisyStudy(6, 1, 1, 2);
        data.blinded = true;
        for (StudyResponse& response : data.mismatchedResponses) {
            response.condition.clear();
            response.content = RatedAnswer{10};
        }
        const StudyAnalysis analysis = analyse(data, {.depth = Depth::Quick});
        const auto results = resultsJson(analysis, {});
        // The flag would tell which trials are anchors.
        const auto isOnAnchors = [](const auto& row) { return row["flag"] == "mismatch_rated_high"; };
        QVERIFY(std::ranges::none_of(results["quality"], isOnAnchors));
        data.blinded = false;
        const auto open = resultsJson(analyse(data, {.depth = Depth::Quick}), {});
        QVERIFY(std::ranges::any_of(open["quality"], isOnAnchors));
        QVERIFY(results["anchors"].is_null());
        QCOMPARE(results["why"]["anchors"].get<std::string>(), std::string("left out while the study is blinded"));
    }

    /// 400 studies of 10 participants with 6 pairs and 4 mismatches each; ratings are cut at the ends and rounded to tenths.
    void plantedNoiseAndFloorAreFound()
    {
        constexpr int studies = 400;
        constexpr double noise = 0.8, floor = 2.5;
        int noiseHeld = 0, floorHeld = 0;
        double sumOfCeilings = 0, sumOfIccs = 0;
        for (int study = 0; study < studies; ++study) {
            const StudyData data = noisyStudy(10, noise, floor, static_cast<std::uint64_t>(study));
            const auto anchors = anchorsOf(data, AnswerCells(data));
            const auto& found = *anchors.at(0).ratings;
            noiseHeld += *found.withinSd.ci95.low <= noise && noise <= *found.withinSd.ci95.high;
            const AnchorFloor& low = *anchors[0].floor;
            floorHeld += *low.ci95.low <= floor && floor <= *low.ci95.high;
            sumOfCeilings += *found.meanCeiling.value;
            sumOfIccs += *found.icc.value;
        }
        // Variance between the repeated presentations: a and b twice, c and d once; person and presentation 0.5 each.
        const double between = (2 * 9 + 2 * 1 + 1 + 9) / 6.0 - std::pow((2 * -3 + 2 * -1 + 1 + 3) / 6.0, 2) + 0.25 + 0.25;
        const double icc = between / (between + noise * noise);
        qInfo("noise held in %.1f %%, floor in %.1f %%; mean ICC %.3f (planted %.3f)", 100.0 * noiseHeld / studies,
              100.0 * floorHeld / studies, sumOfIccs / studies, icc);
        QVERIFY(noiseHeld > 0.91 * studies && floorHeld > 0.91 * studies);
        QVERIFY(std::abs(sumOfIccs / studies - icc) < 0.02);
        QVERIFY(std::abs(sumOfCeilings / studies - (10 - noise / std::sqrt(2 * std::numbers::pi))) < 0.02);
    }

    void tablesOfOthersMayNameAnchors()
    {
        const std::string head = "participant,fabric,condition,question,rating,trial,anchor\n";
        const StudyData data = read(head +
                                    "P1,A,x,Q2,5,1,\nP1,B,x,Q2,6,2,\nP1,A,x,Q2,4,9,repeated\nP1,A,x,Q2,1,4,mismatched\n"
                                    "P1,A,x,Q2,2,5,mismatched\n");
        QCOMPARE(data.responses.size(), 2u);
        QCOMPARE(data.mismatchedResponses.size(), 2u);
        QCOMPARE(data.repeatedResponses.size(), 1u);
        QCOMPARE(data.answersPerCell, 1u);
        // Another lab's column of this name means something else, and stays what it was.
        const StudyData other = read(head + "P1,A,x,Q2,5,1,steel\nP1,B,x,Q2,6,2,repeated\n");
        QCOMPARE(other.responses.size(), 2u);
        const StudyData wide = read("participant,fabric,condition,Q2,anchor\nP1,A,x,5,\nP1,A,x,6,repeated\n");
        QCOMPARE(wide.repeatedResponses.size(), 1u);
    }

    /// Published answers have no times of day. Q1 came again beside other foils; the trays of Q5 hold all four fabrics.
    void publicTablesGiveTheSameFigures()
    {
        const std::string columns =
            "participant,trial,question,fabric,condition,alternatives,answer,correct,rating,seconds,"
            "touched_by,answered_at,stored_at,corrections,voided,answer_begun_at,anchor";
        const std::string all = R"("[""A"",""B"",""C"",""D""]")", others = R"("[""A"",""D"",""C""]")";
        int trial = 0;
        std::string rows;
        const auto row = [&](const std::string& question, const std::string& fabric, const std::string& tray,
                             const std::string& answer, const std::string& anchor, const std::string& condition) {
            const bool isRating = question == "Q2";
            rows += "P1," + std::to_string(++trial) + "," + question + "," + fabric + "," + condition + "," + tray + "," +
                    (isRating ? ",," + answer : answer + "," + (answer == fabric ? "1," : "0,")) + ",2,display,5,6,0,0,4," +
                    anchor + "TIME\n";
        };
        const std::string first = R"("[""A"",""B"",""C""]")";
        for (const char* condition : {"v_grey", "h"}) {
            row("Q1", "A", first, "B", "", condition);
            row("Q1", "C", first, "C", "", condition);
            row("Q1", "A", others, "D", "repeated", condition);
            row("Q1", "C", others, "C", "repeated", condition);
            row("Q5", "A", all, "B", "", condition);
            row("Q5", "A", all, "D", "repeated", condition);
            row("Q2", "A", "[]", "4", "", condition);
            row("Q2", "A", "[]", "5", "repeated", condition);
        }
        row("Q2", "A", "[]", "1", "", "catch");
        const auto figures = [&](const std::string& header, const std::string& time) {
            const QString text = QString::fromStdString(header + "\n" + rows).replace("TIME", QString::fromStdString(time));
            return resultsJson(analyse(read(text.toStdString()), {.depth = Depth::Quick}), {});
        };
        const auto own = figures(columns + ",wall_time", ",2026-01-01T00:00:00Z"), published = figures(columns, "");
        QCOMPARE(QString::fromStdString(published.dump()), QString::fromStdString(own.dump()));
        for (const auto& one : published["anchors"])
            if (one["repeated"].contains("compared")) {
                const bool isAnew = one["question"] == "Q1";
                QCOMPARE(one["repeated"]["compared"].get<std::string>(), std::string(isAnew ? "right and wrong" : "answers"));
                QCOMPARE(one["repeated"]["agreement"].get<double>(), isAnew ? 1.0 : 0.0);
            }
        QCOMPARE(published["anchors"].size(), std::size_t{3});
    }

private:
    StudyData read(const std::string& text) const
    {
        const std::string file = m_folder.filePath("answers.csv").toStdString();
        std::ofstream(file) << text;
        return readAnswersCsv(file);
    }

    QTemporaryDir m_folder;
};

QTEST_GUILESS_MAIN(AnchorAnswersTest)
#include "anchor_answers_test.moc"
