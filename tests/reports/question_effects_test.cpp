// Effect sizes, agreement, Bayes factors and variances in the report: what does not exist, and what each test generalises to.
// tests/reports/small_study compares the numbers with R's.
#include "reports/analysis/question_effects.h"

#include <QTest>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "reports/figures/report_figures.h"
#include "reports/json/results_json.h"
#include "reports/json/statistics_json.h"
#include "reports/page/page.h"
#include "reports/tables/report_tables.h"
#include "tests/reports/study_builder.h"

using Json = nlohmann::ordered_json;
using reports::StudyAnalysis;
using reports::StudyData;

namespace {

/// 0 to 6, without a pattern.
int mixed(int p, int f, int c)
{
    const auto bits = static_cast<unsigned>(p * 7919 + f * 104729 + c * 1299709 + 4711) * 2654435761U;
    return static_cast<int>((bits >> 16) % 7);
}

const builders::Answers varied{[](int p, int f, int c) { return mixed(p, f, c) > 2; },
                               [](int p, int f, int c, int q) { return 3 + 0.5 * mixed(p + q, f, c) + 0.4 * p + 0.3 * c; }};

StudyData variedStudy(int participants = 6, int fabrics = 4, const std::vector<std::string>& conditions = {"a", "b", "c"})
{
    return builders::study(participants, fabrics, conditions, varied);
}

Json statisticsOf(const StudyData& data) { return reports::statisticsJson(reports::analyse(data)); }

std::string reasonOf(const Json& object, const char* key)
{
    return object.at(key).is_null() ? object.at("why").at(key).get<std::string>() : "exists";
}

StudyData without(StudyData data, const std::function<bool(const reports::StudyResponse&)>& isMissing)
{
    std::erase_if(data.responses, isMissing);
    return data;
}

QString pageOf(const StudyAnalysis& analysis)
{
    return QString::fromStdString(
        reports::reportPage(analysis, reports::reportTables(analysis), reports::reportFigures(analysis)));
}

}  // namespace

class QuestionEffectsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void everyQuestionHasItsEffects()
    {
        const Json statistics = statisticsOf(variedStudy());
        QVERIFY(!statistics["reliability"].contains("Q1"));  // right and wrong are no ratings of the stimuli
        for (const char* question : {"Q2", "Q3", "Q4"}) {
            const Json& agreement = statistics["reliability"][question];
            QCOMPARE(agreement["stimuli"], 12);
            QCOMPARE(agreement["raters"], 6);
            QVERIFY(agreement["ICC2_ci95"][0] < agreement["ICC2"] && agreement["ICC2"] < agreement["ICC2_ci95"][1]);
            QVERIFY(agreement["ICC2"] < agreement["ICC3"]);  // participants use the scale at different places
        }
        for (const char* question : {"Q1", "Q2", "Q3", "Q4"}) {
            QCOMPARE(statistics["bayes_factors"][question]["contrasts"].size(), std::size_t(3));
            double shares = 0;
            for (const Json& component : statistics["variance_components"][question]["components"])
                shares += component["share"].get<double>();
            QVERIFY(std::fabs(shares - 1) < 1e-12);
            const Json& r = statistics["r_squared"][question];
            QVERIFY(0 < r["marginal"] && r["marginal"] < r["conditional"] && r["conditional"] < 1);
        }
    }

    /// A family of planned contrasts has Bayes factors for them only, in the protocol's order and sign.
    void plannedContrastsHaveTheEvidence()
    {
        StudyData data = variedStudy();
        data.planned = {{"c", "a"}};
        const Json row = statisticsOf(data)["bayes_factors"]["Q2"]["contrasts"];
        QCOMPARE(row.size(), std::size_t(1));
        QCOMPARE(row[0]["a"], "c");
        QCOMPARE(row[0]["planned"], true);
        QVERIFY(row[0]["t"].get<double>() > 0);
        QVERIFY(std::fabs(std::log10(row[0]["bf10"].get<double>()) - row[0]["log10_bf10"].get<double>()) < 1e-12);
    }

    void manyContrastsHaveNoBayesFactors()
    {
        std::vector<std::string> conditions;
        for (int c = 0; c < 15; ++c) conditions.push_back("c" + std::to_string(c));  // 105 pairs
        const StudyAnalysis analysis = reports::analyse(variedStudy(3, 2, conditions), {reports::Depth::Quick, {}});
        const Json part = reports::statisticsJson(analysis)["bayes_factors"]["Q2"];
        QCOMPARE(reasonOf(part, "contrasts"), std::string("left out for more than 100 contrasts"));
        for (const reports::ReportTable& one : reports::reportTables(analysis)) QVERIFY(one.table.name != "bayes_factors");
    }

    void oneParticipantHasReasonsOnly()
    {
        const Json statistics = statisticsOf(variedStudy(1));
        const Json& agreement = statistics["reliability"]["Q2"];
        QCOMPARE(reasonOf(agreement, "ICC2"), std::string("needs at least 2 raters"));
        QCOMPARE(reasonOf(agreement, "ICC3k_ci95"), std::string("needs at least 2 raters"));
        QCOMPARE(reasonOf(statistics["effect_sizes"]["Q2"], "generalised_eta_squared"),
                 std::string("needs at least 2 complete blocks"));
        const Json row = statistics["bayes_factors"]["Q2"]["contrasts"][0];
        QVERIFY(QString::fromStdString(reasonOf(row, "bf10")).contains("one participant only"));
        const Json sensitivity = statistics["q1_sensitivity"]["a"]["clustered"][0];
        QVERIFY(sensitivity["d_prime"].is_number());
        QVERIFY(QString::fromStdString(reasonOf(sensitivity, "d_prime_low")).contains("one participant only"));
        QCOMPARE(statistics["variance_components"]["Q2"]["left_out"]["participant"], "has one level only");
    }

    void constantRatingsHaveReasonsOnly()
    {
        const StudyAnalysis analysis =
            reports::analyse(builders::study(4, 3, {"a", "b"}, {varied.isCorrect, [](int, int, int, int) { return 10.0; }}));
        const Json statistics = reports::statisticsJson(analysis);
        QVERIFY(!reasonOf(statistics["reliability"]["Q2"], "ICC2").empty());
        QVERIFY(statistics["reliability"]["Q2"]["ICC2"].is_null());
        QVERIFY(statistics["effect_sizes"]["Q2"]["generalised_eta_squared"].is_null());
        QVERIFY(statistics["r_squared"]["Q2"]["marginal"].is_null());
        QVERIFY(statistics["variance_components"]["Q2"]["components"].is_null());
        QVERIFY(statistics["bayes_factors"]["Q2"]["contrasts"][0]["bf10"].is_null());
        QVERIFY(pageOf(analysis).contains("varies from fabric to fabric is not known"));
    }

    void whereAllIsRightSensitivityHasNoBound()
    {
        const StudyAnalysis analysis =
            reports::analyse(builders::study(4, 3, {"a", "b"}, {[](int, int, int) { return true; }, varied.rating}));
        const Json statistics = reports::statisticsJson(analysis);
        for (const Json& row : statistics["q1_sensitivity"]["a"]["clustered"]) {
            QCOMPARE(row["share"], 1.0);
            QCOMPARE(reasonOf(row, "d_prime"), std::string("at a share of 1 d' has no upper bound"));
            QVERIFY(QString::fromStdString(reasonOf(row, "d_prime_high")).contains("all values are equal"));
        }
        QVERIFY(statistics["r_squared"]["Q1"]["marginal"].is_null());
        for (const reports::ReportTable& one : reports::reportTables(analysis))
            if (one.table.name == "above_chance_q1") QCOMPARE(one.table.rows[0].back().text, std::string("\u221E"));
    }

    void whereAllIsWrongSensitivityIsZeroWithItsReason()
    {
        const Json statistics =
            statisticsOf(builders::study(4, 3, {"a", "b"}, {[](int, int, int) { return false; }, varied.rating}));
        const Json row = statistics["q1_sensitivity"]["b"]["clustered"][1];
        QCOMPARE(row["d_prime"], 0.0);
        QCOMPARE(row["note"], "at or below chance d' is set to 0");
        QVERIFY(row["d_prime_low"].is_null());
    }

    /// Which participants rate together is decided by what they answered; the others are named.
    void participantsWithFewRatingsAreNoRaters()
    {
        const StudyData data = without(variedStudy(), [](const reports::StudyResponse& response) {
            if (response.question != "Q2") return false;
            return (response.participant == "P02" && (response.fabric != "F01" || response.condition != "a")) ||
                   (response.participant == "P03" && response.fabric == "F04");
        });
        const Json agreement = statisticsOf(data)["reliability"]["Q2"];
        QCOMPARE(agreement["left_out"], Json::array({"P02"}));
        QCOMPARE(agreement["raters"], 5);
        QCOMPARE(agreement["stimuli"], 9);  // without those on F04
        QVERIFY(agreement["ICC2"].is_number());
    }

    void oneFabricSaysThatOthersAreUnknown()
    {
        const StudyAnalysis analysis = reports::analyse(variedStudy(5, 1));
        const Json part = reports::statisticsJson(analysis)["variance_components"]["Q2"];
        QCOMPARE(part["left_out"]["fabric"], "has one level only");
        QVERIFY(QString::fromStdString(part["meaning"]).contains("is not known"));
    }

    /// Ids are anything: these are names of the file itself.
    void questionsNamedAsTheKeysKeepTheirNumbers()
    {
        StudyData data = builders::emptyStudy(
            3, 2, {"a", "b"}, {{"reliability", "", builders::onScale}, {"variance_components", "", builders::onScale}});
        for (const reports::QuestionInfo& question : data.questions)
            for (int p = 0; p < 3; ++p)
                for (int f = 0; f < 2; ++f)
                    for (int c = 0; c < 2; ++c)
                        data.responses.push_back(builders::rated(data.participants[static_cast<std::size_t>(p)],
                                                                 data.fabrics[static_cast<std::size_t>(f)], c == 0 ? "a" : "b",
                                                                 question.id, varied.rating(p, f, c, 2)));
        const Json statistics = statisticsOf(data);
        QVERIFY(statistics["questions"]["reliability"].contains("cell_mean"));
        QVERIFY(statistics["reliability"]["reliability"].contains("ICC2"));
        QVERIFY(statistics["variance_components"]["variance_components"].contains("components"));
    }

    void everyTestSaysWhatItGeneralisesTo()
    {
        const StudyAnalysis analysis = reports::analyse(variedStudy());
        const Json statistics = reports::statisticsJson(analysis), results = reports::resultsJson(analysis);
        for (const char* key : {"q1_cochran", "q1_glmm"}) QCOMPARE(statistics[key]["generalises_to"], "these_trials");
        QCOMPARE(statistics["q1_per_condition"][0]["generalises_to"], "these_trials");
        QCOMPARE(statistics["q1_sensitivity"]["a"]["generalises_to"], "these_trials");
        QCOMPARE(statistics["q1_glmm_crossed"]["generalises_to"], "fabrics_like_these");
        QCOMPARE(statistics["q1_participant_level"]["generalises_to"], "these_fabrics");
        QCOMPARE(statistics["q1_cochran"]["rejects_falsely"]["participant_and_fabric_sd_0.5"], 0.3272);
        for (const char* key : {"rm_anova", "friedman"}) QCOMPARE(statistics["Q2"][key]["generalises_to"], "these_fabrics");
        QCOMPARE(statistics["Q2"]["lmm"]["generalises_to"], "fabrics_like_these");
        for (const Json& row : statistics["Q2"]["pairwise_t_participant_means"]) QCOMPARE(row["generalises_to"], "these_fabrics");
        for (const char* key : {"comparisons", "equivalence"})
            for (const Json& row : results[key]) QCOMPARE(row["generalises_to"], "these_fabrics");
        for (const char* words : {"these trials", "trials as independent", "for these fabrics only", "Effect sizes"})
            QVERIFY2(pageOf(analysis).contains(words), words);
    }

    void tablesStayReadable()
    {
        const std::set<std::string> kept{"q1_matches",   "above_chance_q1",     "all_conditions",
                                         "effect_sizes", "variance_components", "bayes_factors"};
        std::size_t found = 0;
        for (const reports::ReportTable& one : reports::reportTables(reports::analyse(variedStudy()))) {
            if (!kept.contains(one.table.name)) continue;
            ++found;
            std::size_t columns = 0;
            for (std::size_t i = 0; i < one.table.columns.size(); ++i) columns += one.table.isInDocuments(i) ? 1 : 0;
            QVERIFY2(columns <= 8, one.table.name.c_str());
            for (const auto& row : one.table.rows) QCOMPARE(row.size(), one.table.columns.size());
        }
        QCOMPARE(found, kept.size());
    }
};

QTEST_GUILESS_MAIN(QuestionEffectsTest)
#include "question_effects_test.moc"
