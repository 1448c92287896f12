// Shares of variance and R squared by hand, and their undefined cases. tests/reports/small_study compares them with R's.
#include "stats/models/explained_variance.h"

#include <QTest>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/stats/stream.h"

namespace {

using stats::Value;

/// Rows of these conditions, each answered by a participant on a fabric of its own order.
stats::CrossedStudy studyOf(const std::vector<std::string>& conditions, const std::vector<double>& values)
{
    stats::CrossedStudy study;
    std::vector<std::string> people, fabrics;
    for (std::size_t i = 0; i < values.size(); ++i) {
        people.push_back("P" + std::to_string(i % 3));
        fabrics.push_back("F" + std::to_string(i / 3 % 2));
    }
    study.participant = stats::factorOf("participant", people);
    study.fabric = stats::factorOf("fabric", fabrics);
    study.condition = stats::factorOf("condition", conditions);
    study.values = values;
    return study;
}

stats::FixedEffect effect(const std::string& name, double estimate)
{
    stats::FixedEffect fixed;
    fixed.name = name;
    fixed.test.estimate = estimate;
    return fixed;
}

stats::RandomEffect randomEffect(const std::string& name, double variance)
{
    stats::RandomEffect random;
    random.name = name;
    random.variance = variance;
    random.sd = std::sqrt(variance);
    random.zero = variance == 0;
    return random;
}

/// A model as if it had been fitted: differences 0, 2 and -1 from the reference, variances 0.5, 0 and 1.5.
stats::RatingModel fittedModel()
{
    stats::RatingModel fitted;
    fitted.conditions = {"a", "b", "c"};
    fitted.model.fixed = {effect("(Intercept)", 5), effect("conditionb", 2), effect("conditionc", -1)};
    fitted.model.random = {randomEffect("participant", 0.5), randomEffect("fabric:condition", 0)};
    fitted.model.residualVariance = 1.5;
    fitted.model.residualSd = std::sqrt(1.5);
    return fitted;
}

}  // namespace

class ExplainedVarianceTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // The missing row counts for nothing. R: var(c(0, 0, 2, 2, 2, -1)) = 1.766666666666667
    void sharesByHand()
    {
        const double missing = std::numeric_limits<double>::quiet_NaN();
        const auto study = studyOf({"a", "a", "b", "b", "b", "c", "c"}, {1, 2, 3, 4, 5, 6, missing});
        const auto variance = stats::explainedVariance(study, fittedModel());
        QCOMPARE(variance.why, std::string());
        QVERIFY(near(*variance.conditionVariance, 1.766666666666667, 1e-14));
        QVERIFY(near(*variance.marginal, 1.766666666666667 / 3.766666666666667, 1e-14));
        QVERIFY(near(*variance.conditional, 1 - 1.5 / 3.766666666666667, 1e-14));
        QCOMPARE(variance.components.size(), std::size_t(3));
        QCOMPARE(variance.components[0].name, std::string("participant"));
        QCOMPARE(*variance.components[0].share, 0.25);
        QVERIFY(variance.components[1].isZero && *variance.components[1].share == 0);
        QCOMPARE(variance.components[2].name, std::string("Residual"));
        QCOMPARE(*variance.components[2].share, 0.75);
    }

    void aModelWithoutAFitHasItsReason()
    {
        stats::RatingModel fitted;
        fitted.model.why = "all values are equal";
        const auto variance = stats::explainedVariance(studyOf({"a", "b"}, {5, 5}), fitted);
        QCOMPARE(variance.why, fitted.model.why);
        QVERIFY(variance.components.empty());
        QCOMPARE(variance.marginal.why(), fitted.model.why);
    }

    void oneConditionExplainsNothing()
    {
        stats::RatingModel fitted = fittedModel();
        fitted.conditions = {"a"};
        fitted.model.fixed.resize(1);
        const auto variance = stats::explainedVariance(studyOf({"a", "a"}, {1, 2}), fitted);
        QCOMPARE(variance.marginal.why(), std::string("there is one condition only"));
        QCOMPARE(*variance.components.back().share, 0.75);
    }

    // Condition b is always right: its log odds are infinite, but the variances of the others are not.
    void separationLeavesNoVarianceOfCondition()
    {
        std::vector<std::string> conditions;
        std::vector<double> values;
        for (int i = 0; i < 48; ++i) {
            conditions.push_back(i < 24 ? "a" : "b");
            values.push_back(i >= 24 || i * 7 % 5 < 2 ? 1 : 0);
        }
        const auto study = studyOf(conditions, values);
        const auto variance = stats::explainedVariance(study, stats::fitChoices(study));
        QCOMPARE(variance.why, std::string());
        QVERIFY(!variance.marginal.exists() && QString::fromStdString(variance.marginal.why()).contains("separation"));
        QVERIFY(near(*variance.components.back().variance, std::numbers::pi * std::numbers::pi / 3, 1e-15));
        QVERIFY(variance.components.back().share.exists());
    }

    void completeSeparationLeavesNoShares()
    {
        std::vector<std::string> conditions;
        std::vector<double> values;
        for (int i = 0; i < 24; ++i) {
            conditions.push_back(i < 12 ? "a" : "b");
            values.push_back(i < 12 ? 0 : 1);
        }
        const auto study = studyOf(conditions, values);
        const auto variance = stats::explainedVariance(study, stats::fitChoices(study));
        for (const stats::VarianceComponent& component : variance.components) QVERIFY(!component.share.exists());
        QVERIFY(!variance.conditional.exists());
    }
};

QTEST_APPLESS_MAIN(ExplainedVarianceTest)
#include "explained_variance_test.moc"
