// The linear mixed model against closed forms of balanced data, against R, and at its edges.
#include "stats/models/mixed_model.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "stats/kernels/distributions.h"
#include "stats/models/crossed_study.h"
#include "stats/power/simulated_study.h"
#include "tests/stats/shared_study.h"

namespace {

bool near(double a, double b, double relative) { return std::fabs(a - b) <= relative * std::max(std::fabs(a), std::fabs(b)); }

void compare(const stats::Value& value, double expected, double relative, const std::string& what)
{
    QVERIFY2(value.exists(), (what + ": " + value.why()).c_str());
    QVERIFY2(near(*value, expected, relative),
             qPrintable(QString("%1: %2, expected %3").arg(what.c_str()).arg(*value, 0, 'g', 12).arg(expected, 0, 'g', 12)));
}

stats::Factor factor(const std::string& name, const std::vector<int>& levels)
{
    std::vector<std::string> values;
    for (const int level : levels) values.push_back(std::to_string(level));
    return stats::factorOf(name, values);
}

/// Eighteen ratings of six people, three conditions and two fabrics, with gaps.
stats::MixedModelData smallStudy()
{
    stats::MixedModelData data;
    data.y = {4.1, 6.1, 6.0, 3.2, 5.5, 5.8, 4.4, 6.9, 6.6, 5.4, 5.2, 7.9, 5.3, 6.6, 5.0, 7.3, 7.0, 4.2};
    data.fixed = stats::treatmentCoded(factor("c", {1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 2, 3, 1, 2, 3, 1}));
    data.random = {{factor("p", {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 5, 6, 6, 6, 2}), {}, ""},
                   {factor("f", {1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 1, 2, 1, 2, 1}), {}, ""}};
    return data;
}

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

const stats::RandomEffect& effectNamed(const stats::MixedModel& model, const std::string& name)
{
    return *std::find_if(model.random.begin(), model.random.end(), [&](const auto& effect) { return effect.name == name; });
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

    void unbalancedDataAsBruteForceHasThem()
    {
        // R 4.2.2, dense matrices and optim(method = "BFGS", reltol = 1e-15) over log variances:
        //   crit <- function(v) { V <- v[1]*tcrossprod(Zp) + v[2]*tcrossprod(Zf) + v[3]*diag(n); W <- solve(V)
        //     C <- t(X)%*%W%*%X; r <- y - X%*%solve(C, t(X)%*%W%*%y)
        //     determinant(V)$modulus + determinant(C)$modulus + t(r)%*%W%*%r + (n-p)*log(2*pi) }
        // and Satterthwaite's df from central differences of crit and of solve(C).
        const auto model = stats::fitMixedModel(smallStudy());
        compare(model.criterion, 39.836918762497, 1e-11, "REML criterion");
        compare(model.random[0].variance, 0.175446519589, 1e-5, "people");
        compare(model.random[1].variance, 0.024546778123, 1e-4, "fabrics");
        compare(model.residualVariance, 0.439785508571, 1e-5, "residual");
        const double estimates[] = {4.431383619, 1.639074622, 2.218616381};
        const double errors[] = {0.3459690052, 0.3898761053, 0.3892013125};
        const double degrees[] = {6.771016972, 10.773378851, 10.725796944};
        for (std::size_t i = 0; i < 3; ++i) {
            compare(model.fixed[i].test.estimate, estimates[i], 1e-6, "estimate");
            compare(model.fixed[i].test.se, errors[i], 1e-6, "se");
            compare(model.fixed[i].test.df, degrees[i], 1e-4, "df");
        }
        const auto f = stats::effectTest(model);
        compare(f.f, 17.3518447164, 1e-6, "F");
        compare(f.df2, 10.60276157, 1e-4, "df2, of the sequential contrasts");
    }

    void maximumLikelihoodAsBruteForceHasIt()
    {
        // As above without determinant(C), n in place of n - p.
        const auto model = stats::fitMixedModel(smallStudy(), {.reml = false});
        compare(model.criterion, 38.219946862559, 1e-11, "-2 log likelihood");
        compare(model.random[0].variance, 0.15179281958753, 1e-5, "people");
        compare(model.random[1].variance, 0.00408021552597, 2e-4, "fabrics");
        compare(model.residualVariance, 0.37319008341682, 1e-5, "residual");
        compare(model.fixed[1].test.se, 0.3587007343, 1e-6, "se");
        compare(model.fixed[1].test.df, 12.40833289, 1e-4, "df");
        compare(stats::effectTest(model).f, 20.4238470282, 1e-5, "F");
    }

    void aVarianceOfZeroIsSaidAndTheModelIsTheOneWithoutIt()
    {
        // The same brute force on these ratings drives the fabrics' variance to 1e-6: REML 20.873958251435,
        // people 0.249451, residual 0.0748709, F 84.9721.
        auto data = smallStudy();
        data.y = {4.1, 5.2, 6.0, 3.9, 5.5, 6.3, 5.0, 5.9, 7.1, 4.4, 4.9, 6.8, 5.6, 6.1, 5.3, 6.6, 7.4, 4.2};
        const auto model = stats::fitMixedModel(data);
        QVERIFY(model.singular && model.random[1].zero && !model.random[0].zero);
        QCOMPARE(*model.random[1].variance, 0.0);
        compare(model.criterion, 20.873958251435, 1e-5, "REML criterion");
        compare(model.random[0].variance, 0.249451, 1e-4, "people");
        compare(stats::effectTest(model).f, 84.9721, 1e-4, "F");
        data.random.pop_back();
        const auto without = stats::fitMixedModel(data);
        QVERIFY(!without.singular);
        compare(model.criterion, *without.criterion, 1e-13, "criterion of the model without fabrics");
        compare(stats::effectTest(model).df2, *stats::effectTest(without).df2, 1e-9, "df2 of the model without fabrics");
    }

    void allVariancesZeroIsLeastSquares()
    {
        // Group means exactly equal: nothing is left for the groups, and the df are those of the residual.
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
                                      << "cannot be told from the residual";
        QTest::addRow("same groups") << "same groups"
                                     << "divide the values alike";
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

    void sharedStudiesAgreeWithR_data()
    {
        QTest::addColumn<QString>("name");
        for (const char* name : {"study_a", "study_missing_a"}) QTest::addRow("%s", name) << name;
    }

    void sharedStudiesAgreeWithR()
    {
        QFETCH(QString, name);
        const auto rows = shared::readCsv(shared::studyFolder() / (name + ".csv").toStdString());
        if (rows.empty()) QSKIP("the shared studies are not here: nothing was compared with lme4 and lmerTest");
        const auto report = shared::expected(name.toStdString());
        for (std::size_t column = 4; column < 7; ++column) {
            const std::string question = rows[0][column];
            const auto& expected = report[question]["lmm"];
            const auto rating = stats::fitRatings(shared::study(rows, column));
            for (const auto& fixed : rating.model.fixed) {
                compare(fixed.test.estimate, expected["fixef"][fixed.name], 1e-5, fixed.name);
                compare(fixed.test.se, expected["se"][fixed.name], 1e-4, "se of " + fixed.name);
            }
            // lme4's optimiser stops up to 5e-8 above the least criterion; there its variances are up to
            // 1.4e-4 away from those of the closed forms that balanced data have (study_a, Q2).
            for (const auto& random : rating.model.random)
                compare(random.variance, expected["var"][random.name], 2e-4, random.name);
            compare(rating.model.residualVariance, expected["var"]["Residual"], 1e-4, "residual");
            compare(rating.model.criterion, expected["REML_criterion"], 1e-10, "REML criterion");
            QVERIFY(*rating.model.criterion <= expected["REML_criterion"].get<double>() + 1e-9);
            compare(rating.condition.f, expected["F"], 1e-4, "F");
            compare(rating.condition.df1, expected["num_df"], 0, "df1");
            compare(rating.condition.df2, expected["den_df"], 1e-4, "df2");
            compare(rating.condition.logP, std::log(expected["p"].get<double>()), 1e-4, "log p");
            QCOMPARE(rating.model.singular, expected["singular"].get<bool>());
        }
    }

    void sleepstudyAsPublished()
    {
        const auto rows = shared::readCsv(oracle::sharedFolder() / "oracle/datasets/sleepstudy.csv");
        if (rows.empty()) QSKIP("sleepstudy is not here: the random slope was not compared");
        auto fixed = stats::interceptOnly(rows.size() - 1);
        fixed.names.push_back("Days");
        fixed.columns.push_back(shared::numbers(rows, 1));
        const stats::RandomTerm subjects{stats::factorOf("Subject", shared::column(rows, 2)), shared::numbers(rows, 1), "Days"};
        const auto model = stats::fitMixedModel({shared::numbers(rows, 0), fixed, {subjects}});
        // Bates et al. 2015, J. Stat. Softw. 67(1): Reaction ~ Days + (Days | Subject).
        compare(model.fixed[0].test.estimate, 251.405, 1e-5, "intercept");
        compare(model.fixed[0].test.se, 6.825, 1e-3, "its se");
        compare(model.fixed[1].test.estimate, 10.467, 1e-4, "slope");
        compare(model.fixed[1].test.se, 1.546, 1e-3, "its se");
        compare(model.random[0].sd, 24.74, 1e-3, "sd of intercepts");
        compare(model.random[0].slopeSd, 5.92, 1e-3, "sd of slopes");
        QVERIFY(std::fabs(*model.random[0].correlation - 0.07) < 0.005);
        compare(model.residualSd, 25.59, 1e-3, "residual");
        compare(model.criterion, 1743.62827196, 1e-10, "REML criterion");
        compare(model.fixed[1].test.df, 17, 1e-6, "df");  // balanced: subjects - 1
    }

    void wineAsPublished()
    {
        const auto rows = shared::readCsv(oracle::sharedFolder() / "oracle/datasets/wine.csv");
        if (rows.empty()) QSKIP("the wine data are not here: two crossed fixed effects were not compared");
        auto fixed = stats::interceptOnly(rows.size() - 1);
        std::vector<double> warm, contact, both;
        for (std::size_t i = 1; i < rows.size(); ++i) {
            warm.push_back(rows[i][2] == "warm" ? 1 : 0);
            contact.push_back(rows[i][3] == "yes" ? 1 : 0);
            both.push_back(warm.back() * contact.back());
        }
        fixed.names.insert(fixed.names.end(), {"tempwarm", "contactyes", "tempwarm:contactyes"});
        fixed.columns.insert(fixed.columns.end(), {warm, contact, both});
        const auto model = stats::fitMixedModel(
            {shared::numbers(rows, 0), fixed, {{stats::factorOf("judge", shared::column(rows, 5)), {}, ""}}});
        compare(model.criterion, 558.842811164, 1e-11, "REML criterion");
        compare(model.random[0].variance, 73.3323507591, 1e-6, "judges");
        compare(model.residualVariance, 152.084258998, 1e-6, "residual");
        const double estimates[] = {31.0555555556, 18.9444444444, 9.5, 7.77777777778};
        for (std::size_t i = 0; i < 4; ++i) compare(model.fixed[i].test.estimate, estimates[i], 1e-10, model.fixed[i].name);
    }
};

QTEST_GUILESS_MAIN(MixedModelTest)
#include "mixed_model_test.moc"
