// The linear mixed model against closed forms of balanced data, and at its limits.
#include "stats/models/mixed_model.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "stats/kernels/distributions.h"
#include "stats/models/crossed_study.h"
#include "stats/power/simulated_study.h"
#include "tests/stats/small_models.h"

namespace {

stats::CrossedStudy drawnStudy(const stats::StudyDesign& design, std::uint64_t seed)
{
    stats::Draws draws(seed, 0);
    stats::CrossedStudy study = stats::emptyStudy(design);
    std::vector<double> means(design.conditions);
    means.back() = 0.8;
    stats::RatingTruth truth;
    truth.fabricCondition = 0.3;
    stats::drawRatings(study, truth, means, draws);
    return study;
}

/// Mean squares of a complete participant x fabric x condition table without participant x fabric.
struct MeanSquares {
    double participant, fabric, condition, participantCondition, fabricCondition, residual;
};

double meanWhere(const stats::CrossedStudy& study, const stats::Factor* one, std::size_t first, const stats::Factor* other,
                 std::size_t second)
{
    double sum = 0;
    double n = 0;
    for (std::size_t row = 0; row < study.values.size(); ++row) {
        if ((one != nullptr && one->of[row] != first) || (other != nullptr && other->of[row] != second)) continue;
        sum += study.values[row];
        n += 1;
    }
    return sum / n;
}

MeanSquares meanSquares(const stats::CrossedStudy& study)
{
    const auto p = static_cast<double>(study.participant.levels.size());
    const auto f = static_cast<double>(study.fabric.levels.size());
    const auto k = static_cast<double>(study.condition.levels.size());
    const double grand = meanWhere(study, nullptr, 0, nullptr, 0);
    const auto main = [&](const stats::Factor& one) {
        double sum = 0;
        for (std::size_t i = 0; i < one.levels.size(); ++i) sum += std::pow(meanWhere(study, &one, i, nullptr, 0) - grand, 2);
        return sum * p * f * k / static_cast<double>(one.levels.size());
    };
    const auto both = [&](const stats::Factor& one, const stats::Factor& other) {
        double sum = 0;
        for (std::size_t i = 0; i < one.levels.size(); ++i)
            for (std::size_t j = 0; j < other.levels.size(); ++j)
                sum += std::pow(meanWhere(study, &one, i, &other, j) - meanWhere(study, &one, i, nullptr, 0) -
                                    meanWhere(study, &other, j, nullptr, 0) + grand,
                                2);
        return sum * p * f * k / static_cast<double>(one.levels.size() * other.levels.size());
    };
    double total = 0;
    for (const double value : study.values) total += std::pow(value - grand, 2);
    const double sp = main(study.participant), sf = main(study.fabric), sc = main(study.condition);
    const double spc = both(study.participant, study.condition), sfc = both(study.fabric, study.condition);
    const double rest = total - sp - sf - sc - spc - sfc;
    return {sp / (p - 1),
            sf / (f - 1),
            sc / (k - 1),
            spc / ((p - 1) * (k - 1)),
            sfc / ((f - 1) * (k - 1)),
            rest / (k * (p - 1) * (f - 1))};
}

}  // namespace

class MixedModelTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void balancedOneWayIsTheAnalysisOfVariance()
    {
        // Three groups of four: mean squares 43 between and 3.3333 within, by hand.
        const std::vector<double> y{1, 3, 5, 3, 8, 6, 7, 11, 2, 6, 4, 4};
        stats::MixedModelData data{y, stats::interceptOnly(12), {{factor("g", {1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3}), {}, ""}}};
        const auto model = stats::fitMixedModel(data);
        const double between = 4 * ((3 - 5) * (3 - 5) + (8 - 5) * (8 - 5) + (4 - 5) * (4 - 5)) / 2.0;
        const double within = (8 + 14 + 8) / 9.0;
        compare(model.residualVariance, within, 1e-9, "within");
        compare(model.random[0].variance, (between - within) / 4, 1e-9, "between");
        compare(model.fixed[0].test.estimate, 5, 1e-12, "mean");
        compare(model.fixed[0].test.se, std::sqrt(between / 12), 1e-9, "se");
        compare(model.fixed[0].test.df, 2, 1e-8, "df");
        QVERIFY(!model.singular);
    }

    void balancedCrossedStudyIsTheAnalysisOfVariance_data()
    {
        QTest::addColumn<int>("participants");
        QTest::addColumn<int>("fabrics");
        QTest::addColumn<int>("conditions");
        QTest::addColumn<int>("seed");
        QTest::addRow("the paper's study") << 10 << 7 << 9 << 4;
        QTest::addRow("small") << 6 << 5 << 3 << 1;
    }

    void balancedCrossedStudyIsTheAnalysisOfVariance()
    {
        QFETCH(int, participants);
        QFETCH(int, fabrics);
        QFETCH(int, conditions);
        QFETCH(int, seed);
        const stats::StudyDesign design{static_cast<std::size_t>(participants), static_cast<std::size_t>(fabrics),
                                        static_cast<std::size_t>(conditions), 3};
        const auto study = drawnStudy(design, static_cast<std::uint64_t>(seed));
        const auto rating = stats::fitRatings(study);
        const MeanSquares ms = meanSquares(study);
        const double p = participants, f = fabrics, k = conditions;
        QVERIFY2(!rating.model.singular, "the study was chosen to have all variances above 0");
        compare(effectNamed(rating.model, "participant:condition").variance, (ms.participantCondition - ms.residual) / f, 1e-7,
                "p:c");
        compare(effectNamed(rating.model, "fabric:condition").variance, (ms.fabricCondition - ms.residual) / p, 1e-7, "f:c");
        compare(effectNamed(rating.model, "participant").variance, (ms.participant - ms.participantCondition) / (f * k), 1e-7,
                "p");
        compare(effectNamed(rating.model, "fabric").variance, (ms.fabric - ms.fabricCondition) / (p * k), 1e-7, "f");
        compare(rating.model.residualVariance, ms.residual, 1e-8, "residual");
        // Satterthwaite 1946: the error of a condition is a sum of three mean squares.
        const double error = ms.participantCondition + ms.fabricCondition - ms.residual;
        const double df =
            error * error /
            (std::pow(ms.participantCondition, 2) / ((p - 1) * (k - 1)) + std::pow(ms.fabricCondition, 2) / ((f - 1) * (k - 1)) +
             std::pow(ms.residual, 2) / (k * (p - 1) * (f - 1)));
        compare(rating.condition.f, ms.condition / error, 1e-7, "F");
        compare(rating.condition.df2, df, 1e-6, "df2");
        const auto difference = stats::levelDifference(rating.model, design.conditions - 1, 0);
        compare(difference.se, std::sqrt(2 * error / (p * f)), 1e-8, "se of a difference");
        compare(difference.df, df, 1e-6, "its df");
    }

    void aVarianceOfZeroIsSaidAndTheModelIsTheOneWithoutIt()
    {
        // /usr/bin/python3 tests/stats/reference/mixed_models.py, without the fabrics
        auto data = smallStudy();
        data.y = {4.1, 5.2, 6.0, 3.9, 5.5, 6.3, 5.0, 5.9, 7.1, 4.4, 4.9, 6.8, 5.6, 6.1, 5.3, 6.6, 7.4, 4.2};
        const auto model = stats::fitMixedModel(data);
        QVERIFY(model.singular && model.random[1].zero && !model.random[0].zero);
        QCOMPARE(*model.random[1].variance, 0.0);
        compare(model.criterion, 20.8738572851158, 1e-13, "REML criterion");
        compare(model.random[0].variance, 0.249441079636302, 1e-9, "people");
        compare(model.residualVariance, 0.0748718715404557, 1e-9, "residual");
        compare(stats::effectTest(model).f, 84.9711112739534, 1e-9, "F");
        compare(stats::effectTest(model).df2, 10.143773943106, 1e-7, "df2");
        compare(stats::effectTest(model).p, 4.61095741672414e-07, 1e-7, "p");
        data.random.pop_back();
        const auto without = stats::fitMixedModel(data);
        QVERIFY(!without.singular);
        compare(model.criterion, *without.criterion, 1e-13, "criterion of the model without fabrics");
        compare(stats::effectTest(model).df2, *stats::effectTest(without).df2, 1e-9, "df2 of the model without fabrics");
    }

    void allVariancesZeroIsLeastSquares()
    {
        // The group means are equal: the variance of the groups is 0, and the df are those of the residual.
        stats::MixedModelData data{
            {1, 2, 3, 3, 2, 1, 2, 1, 3}, stats::interceptOnly(9), {{factor("g", {1, 1, 1, 2, 2, 2, 3, 3, 3}), {}, ""}}};
        const auto model = stats::fitMixedModel(data);
        QVERIFY(model.why.empty() && model.singular);
        compare(model.residualVariance, 6.0 / 8, 1e-12, "variance");
        compare(model.fixed[0].test.df, 8, 1e-9, "df");
    }

    void fIsTheSquareOfTAtTwoConditions()
    {
        const auto rating = stats::fitRatings(drawnStudy({8, 5, 2, 3}, 9));
        const auto& t = rating.model.fixed[1].test;
        compare(rating.condition.f, *t.t * *t.t, 1e-10, "F");
        compare(rating.condition.df2, *t.df, 1e-10, "df");
        compare(rating.condition.p, *t.p, 1e-9, "p");
    }

    void differencesAreTheFixedEffectsAndTurnTheirSign()
    {
        const auto model = stats::fitRatings(drawnStudy({6, 5, 4, 3}, 2)).model;
        compare(stats::levelDifference(model, 2, 0).p, *model.fixed[2].test.p, 1e-12, "against the reference");
        const auto there = stats::levelDifference(model, 1, 3), back = stats::levelDifference(model, 3, 1);
        QCOMPARE(*there.estimate, -*back.estimate);
        QCOMPARE(*there.p, *back.p);
        QCOMPARE(*there.ci.low, -*back.ci.high);
        QVERIFY(!stats::levelDifference(model, 2, 2).p.exists());
    }

    void powersOfTwoChangeNoBitAndOffsetsNoDigitThatMatters()
    {
        auto data = smallStudy();
        const auto plain = stats::fitMixedModel(data);
        for (const int exponent : {-600, -3, 600}) {
            auto scaled = data;
            for (double& y : scaled.y) y = std::ldexp(y, exponent);
            const auto model = stats::fitMixedModel(scaled);
            QVERIFY(*model.fixed[1].test.t == *plain.fixed[1].test.t);
            QVERIFY(*model.fixed[1].test.df == *plain.fixed[1].test.df);
            QVERIFY(*stats::effectTest(model).f == *stats::effectTest(plain).f);
        }
        for (double& y : data.y) y += 1e9;
        compare(stats::effectTest(stats::fitMixedModel(data)).f, *stats::effectTest(plain).f, 1e-5, "F beside 1e9");
    }

    void ratingsFarFromZeroHaveTheSameDegreesOfFreedom_data()
    {
        QTest::addColumn<double>("offset");
        for (const double offset : {1000.0, -1000.0, 1e5, 1e7}) QTest::addRow("%g", offset) << offset;
    }

    /// A scale from -1000 to -990 is one from 0 to 10.
    void ratingsFarFromZeroHaveTheSameDegreesOfFreedom()
    {
        QFETCH(double, offset);
        auto near = smallStudy();
        for (double& y : near.y) y /= 8;
        auto far = near;
        for (double& y : far.y) y += offset;
        const auto plain = stats::fitMixedModel(near), moved = stats::fitMixedModel(far);
        const double precision = 1e-15 * std::fabs(offset) + 1e-9;
        for (const std::size_t effect : {std::size_t(1), std::size_t(2)}) {
            const stats::ContrastTest &expected = plain.fixed[effect].test, &test = moved.fixed[effect].test;
            compare(test.df, *expected.df, 100 * precision, "df");
            compare(test.p, *expected.p, 100 * precision, "p");
            compare(test.ci.low, *expected.ci.low, 100 * precision, "low");
            compare(test.ci.high, *expected.ci.high, 100 * precision, "high");
        }
        compare(stats::effectTest(moved).df2, *stats::effectTest(plain).df2, 100 * precision, "df2");
        compare(stats::effectTest(moved).p, *stats::effectTest(plain).p, 100 * precision, "p of all");

        const stats::CrossedStudy drawn = drawnStudy({6, 5, 4, 3}, 2);
        stats::CrossedStudy shifted = drawn;
        for (double& value : shifted.values) value += offset;
        const auto balanced = stats::fitRatings(drawn).condition, elsewhere = stats::fitRatings(shifted).condition;
        compare(elsewhere.df2, *balanced.df2, 100 * precision, "df2 of complete data");
        compare(elsewhere.p, *balanced.p, 100 * precision, "p of complete data");
    }

    void orderOfRowsAndTermsChangesNothing()
    {
        auto study = drawnStudy({6, 5, 4, 3}, 3);
        study.values[7] = study.values[50] = std::nan("");
        const auto one = stats::fitRatings(study);
        stats::CrossedStudy turned{{study.participant.name, study.participant.levels, {}},
                                   {study.fabric.name, study.fabric.levels, {}},
                                   {study.condition.name, study.condition.levels, {}},
                                   {}};
        for (std::size_t i = study.values.size(); i-- > 0;) {
            turned.participant.of.push_back(study.participant.of[i]);
            turned.fabric.of.push_back(study.fabric.of[i]);
            turned.condition.of.push_back(study.condition.of[i]);
            turned.values.push_back(study.values[i]);
        }
        const auto other = stats::fitRatings(turned);
        QCOMPARE(other.model.missing, std::size_t(2));
        compare(other.condition.f, *one.condition.f, 1e-9, "F");
        compare(other.condition.df2, *one.condition.df2, 1e-6, "df2");
        compare(other.model.criterion, *one.model.criterion, 1e-12, "criterion");
    }

    void missingRatingsAreCountedAndLeftOut()
    {
        auto data = smallStudy();
        const auto plain = stats::fitMixedModel(data);
        data.y.push_back(std::nan(""));
        for (auto& column : data.fixed.columns) column.push_back(1);
        for (auto& term : data.random) term.group.of.push_back(0);
        const auto model = stats::fitMixedModel(data);
        QCOMPARE(model.missing, std::size_t(1));
        QCOMPARE(model.rows, std::size_t(18));
        QVERIFY(*model.criterion == *plain.criterion);
    }

    void whatCannotBeEstimatedIsLeftOutByName()
    {
        const auto oneFabric = stats::fitRatings(drawnStudy({8, 1, 4, 3}, 5));
        QCOMPARE(oneFabric.formula, std::string("y~condition+(1|participant)"));
        QCOMPARE(oneFabric.leftOut.size(), std::size_t(3));  // fabric, fabric:condition, participant:condition
        QVERIFY(oneFabric.condition.p.exists());

        auto study = drawnStudy({8, 3, 4, 3}, 5);
        for (std::size_t row = 0; row < study.values.size(); ++row)
            if (study.condition.of[row] == 0) study.values[row] = std::nan("");
        const auto gap = stats::fitRatings(study);
        QCOMPARE(gap.conditions, (std::vector<std::string>{"C2", "C3", "C4"}));
        QCOMPARE(gap.leftOut.front().name, std::string("C1"));
        QCOMPARE(gap.model.fixed[1].name, std::string("conditionC3"));
        QVERIFY(gap.condition.p.exists());
    }

    void refusalsSayWhy_data()
    {
        QTest::addColumn<QString>("kind");
        QTest::addColumn<QString>("why");
        QTest::addRow("nothing") << "nothing"
                                 << "needs more values";
        QTest::addRow("all missing") << "missing"
                                     << "needs more values";
        QTest::addRow("infinite") << "infinite"
                                  << "not finite";
        QTest::addRow("constant") << "constant"
                                  << "no variation";
        QTest::addRow("one group") << "one group"
                                   << "belong to one p";
        QTest::addRow("a group each") << "group each"
                                      << "cannot be separated from the residual";
        QTest::addRow("same groups") << "same groups"
                                     << "divide the values in the same way";
        QTest::addRow("determined") << "determined"
                                    << "determined by those before it";
        QTest::addRow("no residual") << "no residual"
                                     << "no residual variation";
    }

    void refusalsSayWhy()
    {
        QFETCH(QString, kind);
        QFETCH(QString, why);
        auto data = smallStudy();
        if (kind == "nothing") data = {{}, stats::interceptOnly(0), {}};
        if (kind == "missing") std::fill(data.y.begin(), data.y.end(), std::nan(""));
        if (kind == "infinite") data.y[3] = HUGE_VAL;
        if (kind == "constant") std::fill(data.y.begin(), data.y.end(), 5.4);
        if (kind == "one group") data.random[0].group = factor("p", std::vector<int>(18, 1));
        if (kind == "group each") {
            std::vector<int> all;
            for (int i = 0; i < 18; ++i) all.push_back(i);
            data.random[0].group = factor("p", all);
        }
        if (kind == "same groups")
            data.random[1].group.of = data.random[0].group.of, data.random[1].group.levels = data.random[0].group.levels;
        if (kind == "determined") data.fixed.columns[2] = data.fixed.columns[1];
        if (kind == "no residual") {
            data.random.pop_back();
            for (std::size_t i = 0; i < 18; ++i)
                data.y[i] = 2.0 * static_cast<double>(data.random[0].group.of[i] % 4) + data.fixed.columns[1][i];
        }
        const auto model = stats::fitMixedModel(data);
        QVERIFY2(QString::fromStdString(model.why).contains(why), model.why.c_str());
        QVERIFY(!model.criterion.exists() && !model.residualVariance.exists());
        for (const auto& fixed : model.fixed) QVERIFY(!fixed.test.p.exists() && !fixed.test.p.why().empty());
        const auto f = stats::effectTest(model);
        QVERIFY(!f.p.exists() && !f.why.empty());
    }

    void everyReasonForLeavingOutIsNamed()
    {
        const auto reasons = [](const stats::CrossedStudy& study) {
            std::string text;
            for (const auto& one : stats::fitRatings(study).leftOut) text += one.name + " " + one.why + "; ";
            return text;
        };
        QCOMPARE(reasons(drawnStudy({8, 1, 4, 3}, 5)),
                 std::string("fabric has one level only; fabric:condition fabric was left out; "
                             "participant:condition has a level for every value, as the residual; "));
        QCOMPARE(reasons(drawnStudy({8, 3, 1, 3}, 5)), std::string("participant:condition there is one condition only; "
                                                                   "fabric:condition there is one condition only; "));
        QCOMPARE(reasons(drawnStudy({5, 4, 3, 3}, 5)), std::string());
        auto choices = drawnStudy({6, 1, 2, 3}, 5);
        for (std::size_t i = 0; i < choices.values.size(); ++i) choices.values[i] = i % 3 == 0 ? 1 : 0;
        const auto model = stats::fitChoices(choices);
        QCOMPARE(model.formula, std::string("correct~condition+(1|participant)"));
        QCOMPARE(model.leftOut.size(), std::size_t{1});
        QCOMPARE(model.conditions.size(), std::size_t{2});
    }
};

QTEST_GUILESS_MAIN(MixedModelTest)
#include "mixed_model_test.moc"
