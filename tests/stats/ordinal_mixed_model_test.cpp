// The ordinal mixed model against R, against the logistic model and a table of proportions, and where the likelihood has no
// maximum.
#include "stats/models/ordinal_mixed_model.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "stats/kernels/decimal_grid.h"
#include "stats/models/crossed_study.h"
#include "stats/models/logistic_mixed_model.h"
#include "stats/power/simulated_study.h"
#include "tests/stats/cycled_factor.h"
#include "tests/stats/exact_numbers.h"
#include "tests/stats/shared_study.h"

namespace {

using Numbers = std::vector<double>;

/// Five people, four fabrics, three conditions: every cell once, on a scale from 1 to 7.
stats::OrdinalData smallStudy()
{
    return {{4, 3, 5, 6, 4, 6, 5, 5, 7, 3, 2, 6, 5, 6, 7, 6, 3, 3, 5, 6, 6, 7, 5, 7, 2, 3, 2, 4, 2, 3,
             5, 3, 6, 4, 3, 2, 6, 5, 6, 5, 7, 4, 6, 5, 3, 2, 5, 6, 2, 4, 4, 3, 1, 2, 4, 5, 5, 3, 2, 5},
            cycled("c", 3, 1, 60),
            {cycled("p", 5, 12, 60), cycled("f", 4, 3, 60)}};
}

void rateAll(stats::OrdinalData& data, std::size_t condition, double value)
{
    for (std::size_t row = 0; row < data.values.size(); ++row)
        if (data.condition.of[row] == condition) data.values[row] = value;
}

void mirror(stats::OrdinalData& data)
{
    for (double& value : data.values) value = 8 - value;
}

/// Compares with a tolerance for estimates and one for standard errors.
void compareEffect(const stats::LogOdds& effect, double estimate, double se)
{
    compareNumbers({{effect.name.c_str(), effect.estimate, estimate, 1e-5}, {"its se", effect.se, se, 2e-5}});
}

}  // namespace

class OrdinalMixedModelTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // Rscript tests/stats/reference/ordinal_mixed_model.R: ordinal::clmm, also where ratings of the scale are never used. clmm
    // takes second differences, so that its standard errors have three digits here.
    void numbersOfClmm_data()
    {
        QTest::addColumn<QString>("kind");
        QTest::addColumn<double>("logLikelihood");
        QTest::addColumn<Numbers>("levels");
        QTest::addColumn<Numbers>("thresholds");
        QTest::addColumn<Numbers>("effects");
        QTest::addColumn<Numbers>("sds");
        QTest::addColumn<Numbers>("errors");  // of thresholds, then of effects
        QTest::newRow("seven levels") << "all" << -101.445119219 << Numbers{1, 2, 3, 4, 5, 6, 7}
                                      << Numbers{-4.742767, -2.072510, -0.880961, -0.153863, 1.201085, 2.980529}
                                      << Numbers{-0.594695, 0.657016} << Numbers{1.100716, 0.411810}
                                      << Numbers{1.229371, 0.746804, 0.694129, 0.682721, 0.702936, 0.824821, 0.563473, 0.588273};
        QTest::newRow("4 is never used") << "gap" << -88.116680139 << Numbers{1, 2, 3, 5, 6, 7}
                                         << Numbers{-4.656201, -2.024752, -0.865973, 1.089977, 2.838026}
                                         << Numbers{-0.668691, 0.597291} << Numbers{0.992202, 0.221432}
                                         << Numbers{1.197116, 0.696003, 0.640987, 0.645021, 0.772442, 0.580044, 0.595017};
        QTest::newRow("1 and 7 are never used")
            << "ends" << -88.421952034 << Numbers{2, 3, 4, 5, 6} << Numbers{-2.080539, -0.876364, -0.145301, 1.199507}
            << Numbers{-0.540091, 0.605733} << Numbers{1.076486, 0.446106}
            << Numbers{0.751015, 0.695641, 0.684149, 0.706250, 0.566522, 0.610343};
    }

    void numbersOfClmm()
    {
        QFETCH(const QString, kind);
        QFETCH(const double, logLikelihood);
        QFETCH(const Numbers, levels);
        QFETCH(const Numbers, thresholds);
        QFETCH(const Numbers, effects);
        QFETCH(const Numbers, sds);
        QFETCH(const Numbers, errors);
        auto data = smallStudy();
        for (double& value : data.values) {
            if (kind == "gap" && value == 4) value = 5;
            if (kind == "ends") value = std::clamp(value, 2.0, 6.0);
        }
        const auto model = stats::fitOrdinalMixedModel(data);
        QVERIFY2(model.why.empty() && model.separation == stats::Separation::None, model.why.c_str());
        compareNumbers({{"log likelihood", model.logLikelihood, logLikelihood, 1e-10}});
        QCOMPARE(model.levels, levels);
        QCOMPARE(model.thresholds.size(), thresholds.size());
        for (std::size_t j = 0; j < thresholds.size(); ++j)
            compareNumbers({{"threshold", model.thresholds[j].estimate, thresholds[j], 1e-4},
                            {"its se", model.thresholds[j].se, errors[j], 1e-3}});
        for (std::size_t i = 0; i < effects.size(); ++i)
            compareNumbers({{"effect", model.fixed[i].estimate, effects[i], 1e-4},
                            {"its se", model.fixed[i].se, errors[thresholds.size() + i], 1e-3}});
        for (std::size_t g = 0; g < sds.size(); ++g) compareNumbers({{"sd", model.random[g].sd, sds[g], 1e-4}});
    }

    // The same script. Where conditions separate, clmm stops on the way to infinity (effects of -26 and 44, no standard errors).
    // The rest of its numbers is right.
    void separationIsWhatClmmRunsInto()
    {
        auto data = smallStudy();
        rateAll(data, 2, 1);
        const auto model = stats::fitOrdinalMixedModel(data);
        const Numbers thresholds{-4.762229, -2.461018, -1.177344, -0.282489, 1.609247, 3.407266};
        compareNumbers({{"log likelihood", model.logLikelihood, -66.531603798, 1e-9},
                        {"effect of 2", model.fixed[0].estimate, -0.662632, 1e-4},
                        {"people", model.random[0].sd, 1.311712, 1e-4},
                        {"fabrics", model.random[1].sd, 0.413286, 1e-4}});
        for (std::size_t j = 0; j < thresholds.size(); ++j)
            compareNumbers({{"threshold", model.thresholds[j].estimate, thresholds[j], 1e-4}});
        compareReasons({{"effect of 3", model.fixed[1].estimate, "3 (always 1)"}});
        data = smallStudy();
        for (const std::size_t condition : {0U, 1U, 2U}) rateAll(data, condition, condition == 1 ? 6 : 3);
        const auto complete = stats::fitOrdinalMixedModel(data);
        QVERIFY(complete.separation == stats::Separation::Complete);
        compareNumbers({{"log likelihood", stats::Value(1 + *complete.logLikelihood), 1 - 0.000000027, 1e-7}});
        compareReasons({{"effect", complete.fixed[0].estimate, "separation"}});
        // clmm: "optimizer nlminb failed to converge"
        for (std::size_t row = 0; row < 60; ++row) data.values[row] = static_cast<double>(row / 12 + 1);
        const auto byPerson = stats::fitOrdinalMixedModel(data);
        QVERIFY2(byPerson.why.find("no finite estimate") != std::string::npos, byPerson.why.c_str());
    }

    // /usr/bin/python3 tests/stats/reference/ordinal_mixed_model.py, whose estimates are exact to about 1e-6.
    void everyNumberOfTheSmallStudy_data()
    {
        QTest::addColumn<int>("groups");
        QTest::addColumn<bool>("hasMissing");
        QTest::addColumn<double>("logLikelihood");
        QTest::addColumn<Numbers>("sds");
        QTest::addColumn<Numbers>("thresholds");
        QTest::addColumn<Numbers>("thresholdErrors");
        QTest::addColumn<Numbers>("effects");  // estimate and standard error of each
        QTest::newRow("people and fabrics") << 2 << false << -101.445119218601 << Numbers{1.100718360, 0.411811647}
                                            << Numbers{-4.742773979, -2.072518640, -0.880967591,
                                                       -0.153868534, 1.201084425,  2.980526584}
                                            << Numbers{1.22937086, 0.74680444, 0.69412913, 0.68272098, 0.70293604, 0.82481998}
                                            << Numbers{-0.594696653, 0.56347270, 0.657016979, 0.58827324};
        QTest::newRow("people") << 1 << false << -101.776743110720 << Numbers{1.056955607}
                                << Numbers{-4.623066977, -2.005605009, -0.852976917, -0.161499281, 1.146115557, 2.905499462}
                                << Numbers{1.18668855, 0.69389725, 0.64250875, 0.63168349, 0.64995482, 0.77534631}
                                << Numbers{-0.549963056, 0.55725506, 0.623825565, 0.58431927};
        QTest::newRow("no groups") << 0 << false << -106.716653176336 << Numbers{}
                                   << Numbers{-4.100954318, -1.623445181, -0.621271299, -0.059004140, 0.972464499, 2.493818927}
                                   << Numbers{1.05828509, 0.46808469, 0.40881200, 0.39893259, 0.42367027, 0.57260891}
                                   << Numbers{-0.410633471, 0.54676401, 0.531863777, 0.56988038};
        QTest::newRow("missing cells") << 2 << true << -87.835790436452 << Numbers{1.122244997, 0.143104983}
                                       << Numbers{-4.656141842, -1.915817572, -0.727683125,
                                                  -0.224431820, 1.092585022,  2.713145201}
                                       << Numbers{1.25489785, 0.75964380, 0.70357863, 0.69477497, 0.70568639, 0.81378062}
                                       << Numbers{-0.817013264, 0.64170033, 0.425230118, 0.61004166};
    }

    void everyNumberOfTheSmallStudy()
    {
        QFETCH(int, groups);
        QFETCH(bool, hasMissing);
        QFETCH(double, logLikelihood);
        QFETCH(Numbers, sds);
        QFETCH(Numbers, thresholds);
        QFETCH(Numbers, thresholdErrors);
        QFETCH(Numbers, effects);
        auto data = smallStudy();
        data.groups.resize(static_cast<std::size_t>(groups));
        if (hasMissing)
            for (const std::size_t row : {0, 6, 7, 19, 32, 33, 34, 49}) data.values[row] = std::nan("");
        const auto model = stats::fitOrdinalMixedModel(data);
        QVERIFY2(model.why.empty(), model.why.c_str());
        QCOMPARE(model.rows, std::size_t(hasMissing ? 52 : 60));
        QCOMPARE(model.missing, std::size_t(hasMissing ? 8 : 0));
        compareNumbers({{"log likelihood", model.logLikelihood, logLikelihood, 1e-12}});
        for (std::size_t g = 0; g < sds.size(); ++g) compareNumbers({{"sd", model.random[g].sd, sds[g], 3e-5}});
        QCOMPARE(model.levels, (Numbers{1, 2, 3, 4, 5, 6, 7}));
        QCOMPARE(model.thresholds.size(), thresholds.size());
        for (std::size_t j = 0; j < thresholds.size(); ++j)
            compareNumbers({{"threshold", model.thresholds[j].estimate, thresholds[j], 1e-5},
                            {"its se", model.thresholds[j].se, thresholdErrors[j], 2e-5}});
        for (std::size_t i = 0; i < 2; ++i) compareEffect(model.fixed[i], effects[2 * i], effects[2 * i + 1]);
    }

    // /usr/bin/python3 tests/stats/reference/ordinal_mixed_model.py ("without condition")
    void conditionIsTestedOnRequest()
    {
        const auto model = stats::fitOrdinalMixedModel(smallStudy(), {.likelihoodRatio = true});
        compareNumbers({{"without condition", model.logLikelihoodNull, -103.600627412854, 1e-12},
                        {"chi-squared", model.test.chiSquared, 2 * (103.600627412854 - 101.445119218601), 1e-9},
                        {"df", model.test.df, 2}});
        const auto untested = stats::fitOrdinalMixedModel(smallStudy());
        QVERIFY(!untested.test.p.exists() && !untested.logLikelihoodNull.exists());
    }

    void twoCategoriesAreTheLogisticModel()
    {
        auto data = smallStudy();
        for (double& value : data.values) value = value > 4 ? 9 : 2;
        const auto model = stats::fitOrdinalMixedModel(data);
        stats::LogisticData choices{{}, data.condition, data.groups};
        for (const double value : data.values) choices.right.push_back(value > 4 ? 1 : 0);
        const auto logistic =
            stats::fitLogisticMixedModel(choices, {.confidence = 0.95, .curvature = stats::Curvature::AtTheMode});
        QCOMPARE(model.thresholds.size(), std::size_t(1));
        compareNumbers({{"log likelihood", model.logLikelihood, *logistic.logLikelihood},
                        {"threshold", model.thresholds[0].estimate, -*logistic.fixed[0].estimate},
                        {"its se", model.thresholds[0].se, *logistic.fixed[0].se},
                        {"effect", model.fixed[1].estimate, *logistic.fixed[2].estimate},
                        {"its se", model.fixed[1].se, *logistic.fixed[2].se},
                        {"sd", model.random[0].sd, *logistic.random[0].sd}});
    }

    void theScaleTurnedAroundGivesTheSameModel()
    {
        auto data = smallStudy();
        const auto model = stats::fitOrdinalMixedModel(data);
        mirror(data);
        const auto turned = stats::fitOrdinalMixedModel(data);
        compareNumbers({{"log likelihood", turned.logLikelihood, *model.logLikelihood, 1e-11},
                        {"effect", turned.fixed[0].estimate, -*model.fixed[0].estimate, 1e-6},
                        {"its se", turned.fixed[0].se, *model.fixed[0].se, 1e-6},
                        {"threshold", turned.thresholds[0].estimate, -*model.thresholds[5].estimate, 1e-6}});
    }

    // Three ratings of 30 each under two conditions, all people alike: odds of the table, log(20/10) and so on.
    void peopleAlikeLeaveAPlainTable()
    {
        stats::OrdinalData data{{}, cycled("c", 2, 1, 120), {cycled("p", 4, 30, 120)}};
        for (int i = 0; i < 60; ++i) {
            data.values.push_back(i % 3 == 0 ? 1 : 2);
            data.values.push_back(i % 3 == 0 ? 2 : 1);
        }
        const auto model = stats::fitOrdinalMixedModel(data);
        QVERIFY(model.singular && model.random[0].zero && *model.random[0].sd == 0);
        compareNumbers({{"threshold", model.thresholds[0].estimate, std::log(0.5), 1e-9},
                        {"effect", model.fixed[0].estimate, std::log(0.5) - std::log(2.0), 1e-9},
                        {"its se", model.fixed[0].se, std::sqrt(2 / 20.0 + 2 / 40.0), 1e-6}});
    }

    void aConditionAtTheEndOfTheScaleIsSaidAndTheRestIsFitted_data()
    {
        QTest::addColumn<bool>("isTurned");
        QTest::newRow("lowest") << false;
        QTest::newRow("highest") << true;
    }

    void aConditionAtTheEndOfTheScaleIsSaidAndTheRestIsFitted()
    {
        QFETCH(bool, isTurned);
        auto data = smallStudy();
        rateAll(data, 2, 1);
        if (isTurned) mirror(data);
        const auto model = stats::fitOrdinalMixedModel(data);
        QVERIFY2(model.why.empty(), model.why.c_str());
        QVERIFY(model.separation == stats::Separation::Quasi);
        QCOMPARE(model.separationWhy, std::string("quasi-complete separation: 3 (always ") + (isTurned ? "7)" : "1)"));
        compareReasons({{"effect", model.fixed[1].estimate, "no finite estimate"}, {"p", model.fixed[1].p, "3 (always"}});
        auto rest = data;
        for (std::size_t row = 0; row < 60; ++row)
            if (rest.condition.of[row] == 2) rest.values[row] = std::nan("");
        const auto other = stats::fitOrdinalMixedModel(rest);
        compareNumbers({{"log likelihood", model.logLikelihood, *other.logLikelihood},
                        {"other effect", model.fixed[0].estimate, *other.fixed[0].estimate},
                        {"sd", model.random[0].sd, *other.random[0].sd}});
    }

    // Only condition 3 has the rating 0, so that the threshold 0|1 lies infinitely low; then condition 2 is always the lowest.
    void aCategoryOfTheSeparatedConditionHasNoThreshold()
    {
        auto data = smallStudy();
        rateAll(data, 2, 0);
        rateAll(data, 1, 1);
        for (std::size_t row = 0; row < 60; ++row)
            if (data.condition.of[row] == 0) data.values[row] = std::max(2.0, data.values[row]);
        const auto model = stats::fitOrdinalMixedModel(data);
        QVERIFY2(model.why.empty(), model.why.c_str());
        QCOMPARE(model.separationWhy, std::string("quasi-complete separation: 2 (always 1), 3 (always 0)"));
        QCOMPARE(model.thresholds.size(), model.levels.size() - 1);
        compareReasons({{"0|1", model.thresholds[0].estimate, "no finite"}, {"1|2", model.thresholds[1].se, "no finite"}});
        QVERIFY(model.thresholds[2].estimate.exists() && model.thresholds[2].se.exists());
    }

    void aSeparatedReferenceLeavesNoDifference()
    {
        auto data = smallStudy();
        rateAll(data, 0, 7);
        const auto model = stats::fitOrdinalMixedModel(data);
        QVERIFY(model.why.empty() && model.logLikelihood.exists() && model.random[0].sd.exists());
        for (const auto& effect : model.fixed) compareReasons({{"effect", effect.estimate, "1 (always 7)"}});
        for (const auto& threshold : model.thresholds) compareReasons({{"threshold", threshold.estimate, "1 (always 7)"}});
    }

    void completeSeparationIsSaid()
    {
        auto data = smallStudy();
        for (const std::size_t condition : {0U, 1U, 2U}) rateAll(data, condition, condition == 1 ? 6 : 3);
        const auto model = stats::fitOrdinalMixedModel(data);
        QVERIFY(model.separation == stats::Separation::Complete && model.why.empty());
        QCOMPARE(*model.logLikelihood, 0.0);
        QVERIFY(!model.random[0].sd.exists() && !model.thresholds[0].estimate.exists());
    }

    void refusalsSayWhy_data()
    {
        QTest::addColumn<QString>("kind");
        QTest::addColumn<QString>("why");
        QTest::newRow("nothing") << "nothing"
                                 << "no ratings";
        QTest::newRow("all missing") << "missing"
                                     << "no ratings";
        QTest::newRow("constant") << "constant"
                                  << "every rating is 4.5";
        QTest::newRow("one condition") << "one"
                                       << "one condition";
        QTest::newRow("one person") << "person"
                                    << "belong to one p";
        QTest::newRow("many values") << "many"
                                     << "at most 101";
        QTest::newRow("ranges apart") << "apart"
                                      << "both below and above 3";
        QTest::newRow("by person") << "by person"
                                   << "no finite estimate";
    }

    void refusalsSayWhy()
    {
        QFETCH(QString, kind);
        QFETCH(QString, why);
        auto data = smallStudy();
        if (kind == "nothing") data = {{}, {"c", {}, {}}, {}};
        if (kind == "missing") std::fill(data.values.begin(), data.values.end(), std::nan(""));
        if (kind == "constant") std::fill(data.values.begin(), data.values.end(), 4.5);
        if (kind == "one") data.condition = cycled("c", 1, 1, 60);
        if (kind == "person") data.groups[0] = cycled("p", 1, 1, 60);
        if (kind == "many") {
            data = {{}, cycled("c", 2, 1, 204), {}};
            for (int i = 0; i < 204; ++i) data.values.push_back(i / 2);
        }
        if (kind == "apart")
            for (std::size_t row = 0; row < 60; ++row) {
                const bool isLow = data.condition.of[row] == 0;
                data.values[row] = isLow ? std::min(3.0, data.values[row]) : std::max(4.0, data.values[row]);
            }
        if (kind == "by person")
            for (std::size_t row = 0; row < 60; ++row) data.values[row] = static_cast<double>(data.groups[0].of[row]);
        const auto model = stats::fitOrdinalMixedModel(data, {.likelihoodRatio = true});
        QVERIFY2(QString::fromStdString(model.why).contains(why), model.why.c_str());
        QVERIFY(!model.logLikelihood.exists() && !model.test.p.exists());
        for (const auto& effect : model.fixed) QVERIFY(!effect.p.exists());
        for (const auto& threshold : model.thresholds) QVERIFY(!threshold.estimate.exists());
    }

    void manyDrawnStudiesAllHaveAFit()
    {
        const stats::StudyDesign design{6, 5, 4, 3};
        int singular = 0;
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            stats::Draws draws(seed, 2);
            auto study = stats::emptyStudy(design);
            for (std::size_t row = 0; row < study.values.size(); ++row) {
                const double effect = static_cast<double>(study.condition.of[row] + study.participant.of[row] % 2);
                study.values[row] = std::clamp(std::floor(4 + effect + 1.5 * draws.normal()), 0.0, 10.0);
            }
            const auto fit = stats::fitOrdinal(study).model;
            QVERIFY2(fit.why.empty(), fit.why.c_str());
            for (const auto& effect : fit.fixed) QVERIFY(*effect.se > 0 && *effect.se < 5);
            singular += fit.singular ? 1 : 0;
        }
        QVERIFY(singular > 5 && singular < 95);  // both kinds occurred
    }

    void sharedStudiesAgreeWithR_data()
    {
        QTest::addColumn<QString>("name");
        for (const char* name : {"study_a", "study_crossed_a", "study_missing_a"}) QTest::addRow("%s", name) << name;
    }

    void sharedStudiesAgreeWithR()
    {
        QFETCH(QString, name);
        const auto rows = shared::readCsv(shared::studyFolder() / (name + ".csv").toStdString());
        if (rows.empty()) QSKIP("the shared studies are missing: nothing was compared with clmm (set VIS2HAP_SHARED)");
        const auto expected = shared::expected(name.toStdString())["rating_ordinal"];
        auto study = shared::study(rows, 6);
        study.values = stats::roundedHalvesUp(study.values, 1);
        const auto fitted = stats::fitOrdinal(study);
        const auto& model = fitted.model;
        QVERIFY2(model.why.empty(), model.why.c_str());
        QCOMPARE(fitted.formula, expected["formula"].get<std::string>());
        QCOMPARE(model.levels, expected["levels"].get<Numbers>());
        QCOMPARE(model.counts, expected["counts"].get<std::vector<std::size_t>>());
        compareNumbers({{"log likelihood", model.logLikelihood, expected["logLik"], 1e-9},
                        {"participants", model.random[0].sd, expected["sd_participant"], 1e-4},
                        {"fabrics", model.random[1].sd, expected["sd_fabric"], 1e-4}});
        for (const auto& effect : model.fixed)
            // clmm takes second differences with a step so small that its standard errors are wrong by up to 0.2 % here.
            compareNumbers({{effect.name.c_str(), effect.estimate, expected["fixef"][effect.name], 2e-4},
                            {"its se", effect.se, expected["se"][effect.name], 3e-3}});
        for (const auto& threshold : model.thresholds) {
            const std::string key =
                std::to_string(std::lround(threshold.below)) + "|" + std::to_string(std::lround(threshold.above));
            compareNumbers({{key.c_str(), threshold.estimate, expected["thresholds"][key], 2e-4},
                            {"its se", threshold.se, expected["thresholds_se"][key], 3e-3}});
        }
    }
};

QTEST_GUILESS_MAIN(OrdinalMixedModelTest)
#include "ordinal_mixed_model_test.moc"
