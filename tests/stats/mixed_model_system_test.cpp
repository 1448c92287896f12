// The closed forms of balanced data and the elimination by blocks, against the dense equations of the same model.
#include "stats/models/mixed_model_system.h"

#include <QTest>
#include <cmath>
#include <limits>

#include "stats/kernels/draws.h"
#include "stats/models/mixed_model_balanced.h"
#include "stats/models/mixed_model_blocks.h"
#include "stats/models/mixed_model_criterion.h"
#include "stats/models/mixed_model_equations.h"
#include "stats/models/mixed_model_fit.h"
#include "stats/power/simulated_study.h"

using stats::CrossedStudy;
using stats::Matrix;
using stats::MixedModelData;

namespace {

CrossedStudy drawnStudy(const stats::StudyDesign& design, std::uint64_t seed)
{
    stats::Draws draws(seed, 0);
    CrossedStudy study = stats::emptyStudy(design);
    stats::RatingTruth truth;
    truth.fabricCondition = 0.3;
    stats::drawRatings(study, truth, std::vector<double>(design.conditions), draws);
    return study;
}

MixedModelData dataOf(const CrossedStudy& study)
{
    return {study.values,
            stats::treatmentCoded(study.condition),
            {{study.participant, {}, ""},
             {study.fabric, {}, ""},
             {stats::interactionOf(study.participant, study.condition), {}, ""},
             {stats::interactionOf(study.fabric, study.condition), {}, ""}}};
}

/// About 10 % of the values are missing.
void punch(MixedModelData& data)
{
    for (std::size_t i = 0; i < data.y.size(); i += 7 + i % 5) data.y[i] = std::numeric_limits<double>::quiet_NaN();
}

double farthest(const Matrix& a, const Matrix& b)
{
    double most = a.rows() == b.rows() && a.columns() == b.columns() ? 0 : HUGE_VAL, size = 0;
    for (std::size_t i = 0; i < a.rows(); ++i)
        for (std::size_t j = 0; j < a.columns(); ++j) {
            most = std::max(most, std::fabs(a(i, j) - b(i, j)));
            size = std::max(size, std::fabs(b(i, j)));
        }
    return most / size;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b, double unit = 0)
{
    double most = a.size() == b.size() ? 0 : HUGE_VAL, size = unit;
    for (std::size_t i = 0; i < a.size(); ++i) {
        most = std::max(most, std::fabs(a[i] - b[i]));
        size = std::max(size, std::fabs(b[i]));
    }
    return most / size;
}

#define CLOSE(distance, limit) QVERIFY2((distance) < (limit), qPrintable(QString("%1: %2").arg(#distance).arg(distance)))

/// Every number that a fit needs, at one theta.
void compareSystems(const stats::MixedModelSystem& system, const stats::MixedModelSystem& dense, const std::vector<double>& theta,
                    bool reml)
{
    const auto parts = system.criterionAt(theta), expected = dense.criterionAt(theta);
    QVERIFY(parts.exists && expected.exists);
    CLOSE(farthest({parts.logDetRandom, parts.logDetFixed, parts.residual},
                   {expected.logDetRandom, expected.logDetFixed, expected.residual}),
          1e-12);
    const auto at = system.solutionAt(theta, reml), there = dense.solutionAt(theta, reml);
    CLOSE(farthest(at.fixed, there.fixed, 1), 1e-11);
    CLOSE(farthest(at.fixedCovariance, there.fixedCovariance), 1e-10);
    CLOSE(farthest(at.derivatives.traces, there.derivatives.traces), 1e-10);
    CLOSE(farthest(at.derivatives.forms, there.derivatives.forms), 1e-10);
    CLOSE(farthest(at.derivatives.traceProducts, there.derivatives.traceProducts), 1e-9);
    CLOSE(farthest(at.derivatives.formProducts, there.derivatives.formProducts), 1e-9);
    for (std::size_t k = 0; k < theta.size(); ++k)
        CLOSE(farthest(at.derivatives.fixedCovariance[k], there.derivatives.fixedCovariance[k]), 1e-9);
}

const std::vector<std::vector<double>> thetas{{1, 1, 1, 1}, {0.3, 2, 0.05, 0.7}, {4, 0.2, 1.1, 0.02}};

void addDesigns()
{
    QTest::addColumn<int>("participants");
    QTest::addColumn<int>("fabrics");
    QTest::addColumn<int>("conditions");
    QTest::addRow("10 x 7 x 9") << 10 << 7 << 9;
    QTest::addRow("many participants") << 30 << 3 << 4;
    QTest::addRow("many conditions") << 4 << 5 << 25;
    QTest::addRow("two conditions") << 5 << 6 << 2;
}

stats::StudyDesign fetchedDesign()
{
    QFETCH(int, participants);
    QFETCH(int, fabrics);
    QFETCH(int, conditions);
    return {static_cast<std::size_t>(participants), static_cast<std::size_t>(fabrics), static_cast<std::size_t>(conditions), 3};
}

}  // namespace

class MixedModelSystemTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void balancedDataInClosedForm_data() { addDesigns(); }

    void balancedDataInClosedForm()
    {
        const auto rows = stats::mixedModelRows(dataOf(drawnStudy(fetchedDesign(), 3)));
        const auto design = stats::balancedDesign(rows);
        QVERIFY(design);
        const std::vector<std::size_t> all{0, 1, 2, 3};
        for (const auto& theta : thetas)
            for (const bool reml : {true, false})
                compareSystems(stats::BalancedEquations(*design, all),
                               stats::MixedModelEquations(rows.y, rows.fixed, rows.random), theta, reml);
        // A model without two of the terms.
        const std::vector<std::size_t> two{3, 0};
        const std::vector<stats::RandomTerm> terms{rows.random[3], rows.random[0]};
        compareSystems(stats::BalancedEquations(*design, two), stats::MixedModelEquations(rows.y, rows.fixed, terms), {0.4, 1.3},
                       true);
    }

    void repetitionsAreBalanced()
    {
        MixedModelData data = dataOf(drawnStudy({6, 5, 3, 3}, 8));
        const MixedModelData more = dataOf(drawnStudy({6, 5, 3, 3}, 9));
        data.y.insert(data.y.end(), more.y.begin(), more.y.end());
        for (auto& column : data.fixed.columns) column.insert(column.end(), column.begin(), column.begin() + 90);
        for (auto& term : data.random)
            term.group.of.insert(term.group.of.end(), term.group.of.begin(), term.group.of.begin() + 90);
        const auto rows = stats::mixedModelRows(data);
        const auto design = stats::balancedDesign(rows);
        QVERIFY(design);
        const std::vector<std::size_t> all{0, 1, 2, 3};
        compareSystems(stats::BalancedEquations(*design, all), stats::MixedModelEquations(rows.y, rows.fixed, rows.random),
                       thetas[1], true);
    }

    void onlyBalancedDataHaveAClosedForm()
    {
        const auto isBalanced = [](const MixedModelData& data) {
            return stats::balancedDesign(stats::mixedModelRows(data)).has_value();
        };
        const MixedModelData whole = dataOf(drawnStudy({4, 3, 3, 3}, 1));
        QVERIFY(isBalanced(whole));
        MixedModelData data = whole;
        data.y[5] = std::numeric_limits<double>::quiet_NaN();
        QVERIFY(!isBalanced(data));
        data = whole;
        data.fixed.columns[1][0] = 0.5;  // a covariate
        QVERIFY(!isBalanced(data));
        data = whole;
        data.random[0].slope.assign(data.y.size(), 1);
        data.random[0].slope[0] = 2;
        QVERIFY(!isBalanced(data));
        data = whole;  // two participants exchange a row, and each still has as many
        std::swap(data.random[0].group.of.front(), data.random[0].group.of.back());
        QVERIFY(!isBalanced(data));
        data = whole;  // fabrics within pairs of conditions: their common classes are no partition of the model
        data.random = {whole.random[2], whole.random[1]};
        QVERIFY(isBalanced(data));
        data.random[1].group.of.clear();
        data.random[1].group.levels = {"x", "y"};
        for (std::size_t row = 0; row < data.y.size(); ++row) data.random[1].group.of.push_back(row % 9 < 5 ? 0 : 1);
        QVERIFY(!isBalanced(data));
    }

    void incompleteDataByBlocks_data() { addDesigns(); }

    void incompleteDataByBlocks()
    {
        MixedModelData data = dataOf(drawnStudy(fetchedDesign(), 4));
        punch(data);
        const auto rows = stats::mixedModelRows(data);
        QVERIFY(!stats::balancedDesign(rows));
        const stats::MixedModelEquations dense(rows.y, rows.fixed, rows.random);
        const auto blocks = stats::cheapestBlocks(rows.fixed, rows.random);
        for (const auto& theta : thetas)
            for (const bool reml : {true, false})
                compareSystems(stats::BlockEquations(rows.y, rows.fixed, rows.random, blocks), dense, theta, reml);
    }

    void blocksAreParticipantsOrConditions()
    {
        const auto blocksOf = [](const stats::StudyDesign& design) {
            MixedModelData data = dataOf(drawnStudy(design, 4));
            punch(data);
            const auto rows = stats::mixedModelRows(data);
            return stats::cheapestBlocks(rows.fixed, rows.random);
        };
        const auto participants = blocksOf({60, 3, 4, 3}), conditions = blocksOf({4, 5, 60, 3});
        QCOMPARE(participants.count, std::size_t(60));
        QCOMPARE(participants.nested, (std::vector<bool>{true, false, true, false}));
        QCOMPARE(conditions.count, std::size_t(60));
        QCOMPARE(conditions.nested, (std::vector<bool>{false, false, true, true}));
    }

    void largeIncompleteStudiesAreFittedByBlocks()
    {
        CrossedStudy study = drawnStudy({30, 3, 10, 3}, 6);  // 30 + 3 + 300 + 30 random effects
        for (std::size_t i = 0; i < study.values.size(); i += 11 + i % 3)
            study.values[i] = std::numeric_limits<double>::quiet_NaN();
        const auto rows = stats::mixedModelRows(dataOf(study));
        const auto dense = stats::fitTheta(stats::MixedModelEquations(rows.y, rows.fixed, rows.random), true);
        const stats::RatingModel rating = stats::fitRatings(study);
        QVERIFY2(rating.model.why.empty(), rating.model.why.c_str());
        std::vector<double> theta;
        for (const auto& effect : rating.model.random) theta.push_back(*effect.sd / *rating.model.residualSd);
        CLOSE(farthest(theta, dense.parts.theta), 1e-7);
        QVERIFY(rating.condition.p.exists() && *rating.condition.df2 > 2);
    }

    void modelsThatTakeTooLongAreRefused()
    {
        // Thirty thousand of the cells of 300 participants, 60 fabrics and 60 conditions.
        stats::Draws draws(3, 0);
        CrossedStudy study{{"p", {}, {}}, {"f", {}, {}}, {"c", {}, {}}, {}};
        for (int i = 0; i < 300; ++i) study.participant.levels.push_back(std::to_string(i));
        for (int i = 0; i < 60; ++i) study.fabric.levels.push_back(std::to_string(i));
        study.condition.levels = study.fabric.levels;
        for (int row = 0; row < 30000; ++row) {
            study.participant.of.push_back(static_cast<std::size_t>(draws.uniform() * 300));
            study.fabric.of.push_back(static_cast<std::size_t>(draws.uniform() * 60));
            study.condition.of.push_back(static_cast<std::size_t>(draws.uniform() * 60));
            study.values.push_back(draws.normal());
        }
        const stats::RatingModel rating = stats::fitRatings(study);
        QVERIFY2(rating.model.why.find("random effects then takes too long") != std::string::npos, rating.model.why.c_str());
        QVERIFY(!rating.condition.p.exists() && !stats::levelDifference(rating.model, 1, 0).p.exists());
        QCOMPARE(rating.model.random.size(), std::size_t(4));
    }

    void fitsAgree()
    {
        for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
            // Without variance between fabrics some of these are singular.
            MixedModelData data = dataOf(drawnStudy({8, 4, 5, 3}, seed));
            const auto complete = stats::mixedModelRows(data);
            const std::vector<std::size_t> all{0, 1, 2, 3};
            punch(data);
            const auto gaps = stats::mixedModelRows(data);
            for (const bool reml : {true, false}) {
                const stats::MixedModelEquations dense(complete.y, complete.fixed, complete.random);
                const stats::BalancedEquations balanced(*stats::balancedDesign(complete), all);
                const auto one = stats::fitTheta(balanced, reml), other = stats::fitTheta(dense, reml);
                CLOSE(std::fabs(stats::profiledCriterion(balanced, one.parts, reml) -
                                stats::profiledCriterion(dense, other.parts, reml)),
                      1e-9);
                QCOMPARE(one.free, other.free);
                CLOSE(farthest(one.parts.theta, other.parts.theta), 1e-6);
                const stats::MixedModelEquations denseGaps(gaps.y, gaps.fixed, gaps.random);
                const stats::BlockEquations blocks(gaps.y, gaps.fixed, gaps.random,
                                                   stats::cheapestBlocks(gaps.fixed, gaps.random));
                const auto third = stats::fitTheta(blocks, reml), fourth = stats::fitTheta(denseGaps, reml);
                CLOSE(std::fabs(stats::profiledCriterion(blocks, third.parts, reml) -
                                stats::profiledCriterion(denseGaps, fourth.parts, reml)),
                      1e-9);
                QCOMPARE(third.free, fourth.free);
            }
        }
    }
};

QTEST_GUILESS_MAIN(MixedModelSystemTest)
#include "mixed_model_system_test.moc"
