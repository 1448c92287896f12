// Speed against accuracy, from milliseconds to people: what a report shows of a study with a quality factor.
#include <QTest>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "reports/analysis/quality_chain.h"
#include "reports/figures/chain_figures.h"
#include "reports/figures/report_figures.h"
#include "reports/formats/table_formats.h"
#include "reports/formats/tex_table.h"
#include "reports/json/prices_json.h"
#include "reports/json/results_json.h"
#include "reports/page/page.h"
#include "reports/tables/chain_tables.h"
#include "reports/tables/report_tables.h"
#include "tests/reports/study_builder.h"

using reports::PriceMeasure;
using reports::StudyData;
using Json = nlohmann::ordered_json;

namespace {

reports::RenderingPrice priceOf(const std::string& condition, const std::string& row, const std::string& quality, double ms)
{
    reports::RenderingPrice price{condition, row, quality, R"({"passes":2})", condition == row, 7, {}};
    for (const auto& measure : reports::priceMeasureRows) {
        const auto none = stats::Value::undefined("not in this study");
        price[measure.measure] = {none, {none, none}};
    }
    price[PriceMeasure::Milliseconds] = {ms, {ms / 2, ms * 2}};
    price[PriceMeasure::ReliefError] = {100 / ms, {80 / ms, 120 / ms}};
    return price;
}

/// Six participants, seven fabrics; the accurate rendering is matched more often and rated higher.
StudyData studyOfQualities()
{
    StudyData data = builders::study(6, 7, {"h", "h_g@accurate", "h_g@fast"},
                                     {[](int p, int f, int c) { return (p * 5 + f * 3) % 10 < (c == 2 ? 4 : 8); },
                                      [](int p, int f, int c, int q) { return (c == 2 ? 3.0 : 6.0) + (p + f + q) % 3; }});
    for (auto& response : data.responses)
        if (response.question == "Q1") response.seconds = response.condition == "h_g@fast" ? 4 : 8;
    data.prices = {priceOf("h", "h", "balanced", 40), priceOf("h_g@accurate", "h_g", "accurate", 400),
                   priceOf("h_g@fast", "h_g", "fast", 5)};
    return data;
}

Json resultsOf(const reports::StudyAnalysis& analysis) { return resultsJson(analysis, {}); }

}  // namespace

class ChainTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void rowsFollowTheOrderOfThePaper()
    {
        const auto chain = qualityChain(reports::analyse(studyOfQualities()));
        QStringList rows;
        for (const auto& row : chain.rows) rows << QString::fromStdString(row.price.condition);
        QCOMPARE(rows.join(' '), QString("h_g@fast h_g@accurate h"));
        QCOMPARE(chain.questions.size(), std::size_t{4});
    }

    void eachRowHasTheAnswersToItsOwnRendering()
    {
        const auto analysis = reports::analyse(studyOfQualities());
        const Json results = resultsOf(analysis);
        QCOMPARE(results["chain"].size(), std::size_t{3});
        for (const Json& row : results["chain"]) {
            const auto condition = row["condition"].get<std::string>();
            QCOMPARE(row["questions"]["Q1"]["proportion"], results["questions"]["Q1"][condition]["proportion"]);
            QCOMPARE(row["questions"]["Q3"]["ci95"], results["questions"]["Q3"][condition]["ci95"]);
            QCOMPARE(row["bits_per_second"], results["speed_accuracy"][condition]["bits_per_second"]);
            QCOMPARE(row["bits_per_second_ci95"], results["speed_accuracy"][condition]["bits_per_second_ci95"]);
        }
        const Json& fast = results["chain"][0];
        QCOMPARE(fast["rendering"]["milliseconds"].get<double>(), 5.0);
        QCOMPARE(fast["rendering"]["quality"].get<std::string>(), std::string("fast"));
        QCOMPARE(fast["rendering"]["settings"]["passes"].get<int>(), 2);
        QCOMPARE(fast["rendering"]["why"]["felt_difference_jnd"].get<std::string>(), std::string("not in this study"));
    }

    void tablesHaveOneRowForEachRendering()
    {
        const auto tables = chainTables(reports::analyse(studyOfQualities()));
        QCOMPARE(tables.size(), std::size_t{2});
        const QStringList lines = QString::fromStdString(reports::toCsv(tables[0].table)).split('\n', Qt::SkipEmptyParts);
        QCOMPARE(lines.size(), 1 + 3);
        QVERIFY(lines[0].startsWith("condition,quality,\"time, ms\""));
        QVERIFY2(lines[1].startsWith("h_g@fast,fast,5,20,"), qPrintable(lines[1]));
        QVERIFY(reports::toTex(tables[0].table).find("$h_{\\mathrm{g}}$@fast") != std::string::npos);
    }

    void figureShowsEveryRenderingAndSaysThatParticipantsAreSimulated()
    {
        StudyData data = studyOfQualities();
        data.simulated = true;
        const auto figures = chainFigures(reports::analyse(std::move(data)), reports::FigureWidth::TwoColumns);
        QCOMPARE(figures.size(), std::size_t{1});
        const QString svg = QString::fromStdString(figures[0].svg);
        // Time and error of 3 renderings, 4 questions and bits per second; no point where a value is missing.
        QCOMPARE(svg.count("<circle"), 3 * (2 + 4 + 1));
        QCOMPARE(svg.count(">@fast<"), 3);  // a label in each line of panels
        QVERIFY(figures[0].caption.find("SIMULATED") != std::string::npos);
        QVERIFY(!svg.contains("nan") && !svg.contains("inf\""));
    }

    void everyFigureSaysThatParticipantsAreScripted()
    {
        StudyData data = studyOfQualities();
        data.scripted = true;
        const auto figures = reports::reportFigures(reports::analyse(std::move(data)));
        QVERIFY(figures.size() > 3);
        for (const auto& figure : figures) QVERIFY2(figure.caption.ends_with(" SCRIPTED participants."), figure.caption.c_str());
    }

    /// The interval of a share is Wilson's over the trials, those of ratings and bits are over participants.
    void captionsSayWhatTheIntervalsHoldFor()
    {
        StudyData data = studyOfQualities();
        const auto captionsOf = [](const StudyData& study) {
            const auto analysis = reports::analyse(study, {.depth = reports::Depth::Quick});
            return QStringList{QString::fromStdString(chainTables(analysis)[0].table.caption),
                               QString::fromStdString(chainFigures(analysis, reports::FigureWidth::TwoColumns)[0].caption)};
        };
        const QString shares = "Intervals of shares correct take the trials as independent (Wilson), which they are not";
        for (const QString& caption : captionsOf(data)) {
            QVERIFY2(caption.contains(shares +
                                      ". Intervals of mean ratings and bits per second are over participants, for these fabrics"),
                     qPrintable(caption));
            QVERIFY2(!caption.contains("answers for these fabrics") && !caption.contains("answers, for these fabrics"),
                     qPrintable(caption));
        }
        std::erase_if(data.questions, [](const auto& question) { return question.id == "Q1"; });
        std::erase_if(data.responses, [](const auto& response) { return response.question == "Q1"; });
        for (const QString& caption : captionsOf(data))
            QVERIFY2(caption.contains("Intervals of mean ratings are over participants, for these fabrics") &&
                         !caption.contains("Wilson"),
                     qPrintable(caption));
    }

    void conditionsWithoutATestAgainstChanceAreNamed()
    {
        StudyData data = studyOfQualities();
        data.questions[0].kind = protocols::SameDifferent{};
        std::size_t place = 0;
        for (auto& response : data.responses) {
            auto* choice = std::get_if<reports::ChosenAnswer>(&response.content);
            if (choice == nullptr) continue;
            const bool wasSame = response.condition == "h_g@fast" || place / 3 % 2 == 0;  // three conditions of a cell
            choice->answer = wasSame == choice->correct ? "same" : "different";
            ++place;
        }
        const auto analysis = reports::analyse(std::move(data), {.depth = reports::Depth::Quick});
        QCOMPARE(qualityChain(analysis).questions[0].chance, std::optional(0.5));
        const auto figure = chainFigures(analysis, reports::FigureWidth::TwoColumns)[0];
        QVERIFY2(figure.caption.find(". Dashed line: chance. Q1 is not tested against chance under h_g@fast: the pairs were not "
                                     "half the same there.") != std::string::npos,
                 figure.caption.c_str());
    }

    void hostileNumbersStillDraw()
    {
        StudyData data = studyOfQualities();
        data.prices[0][PriceMeasure::Milliseconds] = {0.0, {0.0, 0.0}};
        data.prices[1][PriceMeasure::ReliefError] = {0.0, {0.0, 0.0}};
        data.prices[2][PriceMeasure::Milliseconds] = {1e-7, {-1.0, 1e12}};
        data.responses.clear();
        const auto figures = chainFigures(reports::analyse(std::move(data)), reports::FigureWidth::TwoColumns);
        const QString svg = QString::fromStdString(figures[0].svg);
        QVERIFY(!svg.contains("nan") && !svg.contains("inf\""));
        QCOMPARE(svg.count("<circle"), 2 + 3);  // the time of 0 ms has no place on a logarithmic axis
    }

    void blindedReportsShowNothingOfIt()
    {
        StudyData data = studyOfQualities();
        data.blinded = true;
        const auto analysis = reports::analyse(std::move(data));
        QVERIFY(resultsOf(analysis)["chain"].is_null());
        for (const reports::ReportTable& one : reports::reportTables(analysis))
            QVERIFY2(!one.table.name.starts_with("chain"), one.table.name.c_str());
        QVERIFY(reports::reportFigures(analysis).empty());
        QVERIFY(reportPage(analysis, {}, {}, "").find("id=\"chain\"") == std::string::npos);
    }

    void studiesWithoutQualitiesHaveNoChain()
    {
        const auto analysis = reports::analyse(builders::paperSized());
        const Json results = resultsOf(analysis);
        QVERIFY(results["chain"].is_null());
        QVERIFY(!results["why"]["chain"].get<std::string>().empty());
        QVERIFY(chainTables(analysis).empty());
    }

    void storedPricesAreReadAsTheyWereWritten()
    {
        const auto prices = studyOfQualities().prices;
        Json stored = Json::array();
        for (const auto& price : prices) stored.push_back(priceJson(price));
        QVERIFY(reports::pricesFromJson(stored) == prices);
        stored[1].erase("quality");
        try {
            reports::pricesFromJson(stored);
            QFAIL("a row without its quality was read");
        } catch (const protocols::Error& error) {
            QCOMPARE(error.exitCode(), protocols::ExitCode::WorkFailed);
        }
    }
};

QTEST_GUILESS_MAIN(ChainTest)
#include "chain_test.moc"
