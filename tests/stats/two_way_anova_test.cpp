// Two-way analyses of variance. Expected numbers: tests/stats/reference/two_way_anova.R.
#include <QTest>
#include <cmath>
#include <limits>

#include "stats/anova/between_anova.h"
#include "stats/anova/within_anova.h"

using stats::AnovaEffect;
using stats::Factor;
using stats::SumsOfSquares;
using stats::TwoWayAnova;

namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

/// `levels` labels, each `runs` rows long, again and again over all rows.
Factor cycling(const char* name, std::size_t rows, std::size_t levels, std::size_t runs)
{
    std::vector<std::string> labels;
    for (std::size_t row = 0; row < rows; ++row) labels.push_back(name + std::to_string(row / runs % levels));
    return stats::factorOf(name, labels);
}

Factor labelled(const char* name, const char* letters)
{
    std::vector<std::string> labels;
    for (const char* letter = letters; *letter != 0; ++letter) labels.emplace_back(1, *letter);
    return stats::factorOf(name, labels);
}

bool near(const stats::Value& value, double expected, double relative = 1e-9)
{
    const bool agrees = value.exists() && std::abs(*value - expected) <= relative * std::abs(expected);
    if (!agrees) qWarning("got %.15g, expected %.15g (%s)", value.orElse(gap), expected, value.why().c_str());
    return agrees;
}

bool hasF(const AnovaEffect& effect, double ss, double df1, double df2, double f, double p)
{
    return near(effect.ss, ss) && near(effect.df1, df1) && near(effect.df2, df2) && near(effect.f, f, 2e-5) &&
           near(effect.p, p, 5e-5);
}

bool isRefused(const TwoWayAnova& anova, const char* words)
{
    if (anova.why.find(words) == std::string::npos) qWarning("refused with: %s", anova.why.c_str());
    return anova.why.find(words) != std::string::npos && !anova.effects[0].f.exists() && !anova.effects[2].p.exists();
}

const std::vector<double> unbalanced{4.1, 5.3, 3.8, 6.2, 7.1, 5.9, 8.4, 2.9, 3.5, 6.6, 7.7, 7.2, 9.1, 8.8};
const Factor unbalancedA = labelled("a", "xxxxxxxzzzzzzz");
const Factor unbalancedB = labelled("b", "pppqqrrppqqqrr");

const std::vector<double> within{5.1, 6.2, 7.4, 4.9, 6.6, 8.9, 3.2, 4.9, 5.1, 4.1, 4.4, 7.0, 6.0, 6.1, 8.2, 6.3, 7.9, 8.1,
                                 2.9, 3.6, 6.1, 3.3, 5.2, 7.7, 5.5, 5.2, 6.9, 4.4, 6.1, 7.2, 4.4, 6.8, 7.0, 5.9, 6.5, 9.6};
const std::vector<double> mixed{5.1, 6.2, 7.4, 6.0, 3.2, 4.9, 5.1, 4.1, 6.0, 6.1, 8.2, 6.3, 2.9, 3.6,
                                6.1, 3.3, 5.5, 5.2, 6.9, 4.4, 4.4, 6.8, 7.0, 5.9, 3.9, 4.2, 6.6, 6.1};

TwoWayAnova anovaOfWithin(const std::vector<double>& values)
{
    return stats::twoWayWithin(values, cycling("who", values.size(), 1000, 6), cycling("a", values.size(), 2, 3),
                               cycling("b", values.size(), 3, 1));
}

TwoWayAnova anovaOfMixed(const std::vector<double>& values, SumsOfSquares type)
{
    return stats::twoWayMixed(values, cycling("who", 28, 7, 4), labelled("g", "1111111111112222222222222222"),
                              cycling("c", 28, 4, 1), type);
}

}  // namespace

class TwoWayAnovaTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void unbalancedCellsOfTypeTwo()
    {
        const TwoWayAnova anova = stats::twoWayBetween(unbalanced, unbalancedA, unbalancedB, SumsOfSquares::TypeII);
        QVERIFY(hasF(anova.effects[0], 0.2824705882, 1, 8, 0.40197, 0.54376990));
        QVERIFY(hasF(anova.effects[1], 41.0638991597, 2, 8, 29.21831, 0.00021025));
        QVERIFY(hasF(anova.effects[2], 5.0058627451, 2, 8, 3.56184, 0.07829447));
        QVERIFY(near(anova.effects[0].ssError, 5.6216666667));
        QVERIFY(near(anova.effects[1].partialEtaSquared, 41.0638991597 / (41.0638991597 + 5.6216666667)));
        QVERIFY(!anova.balanced);
    }

    void unbalancedCellsOfTypeThree()
    {
        const TwoWayAnova anova = stats::twoWayBetween(unbalanced, unbalancedA, unbalancedB, SumsOfSquares::TypeIII);
        QVERIFY(hasF(anova.effects[0], 0.467604167, 1, 8, 0.66543, 0.43826004));
        QVERIFY(hasF(anova.effects[1], 43.708215686, 2, 8, 31.09983, 0.00016866));
        QVERIFY(hasF(anova.effects[2], 5.0058627451, 2, 8, 3.56184, 0.07829447));
    }

    void factorsMayChangePlaces()
    {
        const TwoWayAnova ab = stats::twoWayBetween(unbalanced, unbalancedA, unbalancedB, SumsOfSquares::TypeII);
        const TwoWayAnova ba = stats::twoWayBetween(unbalanced, unbalancedB, unbalancedA, SumsOfSquares::TypeII);
        QVERIFY(near(ba.effects[1].ss, *ab.effects[0].ss, 1e-12) && near(ba.effects[0].ss, *ab.effects[1].ss, 1e-12));
        QCOMPARE(ba.effects[2].name, std::string("b:a"));
    }

    void emptyCellIsForTypeTwoOnly()
    {
        auto values = unbalanced;
        values[12] = values[13] = gap;
        const TwoWayAnova anova = stats::twoWayBetween(values, unbalancedA, unbalancedB, SumsOfSquares::TypeII);
        QCOMPARE(anova.missing, std::size_t(2));
        QVERIFY(near(anova.effects[0].ss, 0.280166666667) && near(anova.effects[1].ss, 28.0774523809));
        QVERIFY(near(anova.effects[2].ss, 1.76816666667) && near(anova.effects[2].df1, 1) && near(anova.effects[2].df2, 7));
        QVERIFY(near(anova.effects[2].f, 2.21946, 2e-6) && near(anova.effects[0].ssError, 5.57666666667));
        QVERIFY(isRefused(stats::twoWayBetween(values, unbalancedA, unbalancedB, SumsOfSquares::TypeIII), "a cell is empty"));
    }

    void balancedCellsHaveOneAnswer()
    {
        std::vector<double> values;
        for (int i = 0; i < 60; ++i) values.push_back(i * i * 7 % 11 + (i % 3) * 0.5);
        const Factor a = cycling("a", 60, 4, 3), b = cycling("b", 60, 3, 1);
        const TwoWayAnova two = stats::twoWayBetween(values, a, b, SumsOfSquares::TypeII);
        const TwoWayAnova three = stats::twoWayBetween(values, a, b, SumsOfSquares::TypeIII);
        QVERIFY(two.balanced && near(two.effects[0].ss, *three.effects[0].ss, 1e-12));
        QVERIFY(near(two.effects[1].ss, *three.effects[1].ss, 1e-12));
    }

    void offsetsAndUnitsChangeNothing()
    {
        const TwoWayAnova plain = stats::twoWayBetween(unbalanced, unbalancedA, unbalancedB, SumsOfSquares::TypeII);
        std::vector<double> shifted, grown;
        for (const double y : unbalanced) {
            shifted.push_back(std::ldexp(std::round(y * 10), -3) + 1e9);  // exact
            grown.push_back(std::ldexp(y, 600));
        }
        const TwoWayAnova far = stats::twoWayBetween(shifted, unbalancedA, unbalancedB, SumsOfSquares::TypeII);
        const TwoWayAnova large = stats::twoWayBetween(grown, unbalancedA, unbalancedB, SumsOfSquares::TypeII);
        for (std::size_t i = 0; i < 3; ++i) {
            QVERIFY(near(far.effects[i].f, *plain.effects[i].f, 1e-12));
            QVERIFY(near(large.effects[i].f, *plain.effects[i].f, 1e-13));
        }
        QVERIFY(!large.effects[1].ss.exists() && !large.effects[1].ss.decimal().empty());
    }

    void bothFactorsWithinParticipants()
    {
        const TwoWayAnova anova = anovaOfWithin(within);
        QVERIFY(anova.why.empty() && anova.participants == 6 && anova.dropped == 0);
        const auto& [a, b, ab] = anova.effects;
        QVERIFY(near(a.ss, 5.0625) && near(a.ssError, 1.53583333333) && near(a.f, 16.48128052089));
        QVERIFY(near(a.p, 9.73185706506e-03) && near(a.generalizedEtaSquared, 0.114906656074));
        QVERIFY(near(a.epsilonGg, 1) && near(a.pGg, *a.p) && !a.mauchly.pChiSquared.exists());
        QVERIFY(near(b.f, 83.88064192578) && near(b.p, 5.63396453528e-07) && near(b.partialEtaSquared, 0.943744780734));
        QVERIFY(near(b.epsilonGg, 0.573971534318) && near(b.pGg, 0.000103947481655) && near(b.epsilonHf, 0.634421881466));
        QVERIFY(near(b.pHf, 4.92750805583e-05) && near(b.mauchly.w, 0.257753320141));
        QVERIFY(near(ab.f, 1.44889027821) && near(ab.df2, 10) && near(ab.generalizedEtaSquared, 0.038110508140));
        QVERIFY(near(ab.epsilonGg, 0.618228595462) && near(ab.pGg, 0.284131516747376) && near(ab.mauchly.w, 0.382475337860));
        QVERIFY(near(ab.pHf, 2.84036998504e-01));
    }

    void incompleteParticipantsAreDropped()
    {
        auto values = within;
        values.insert(values.end(), {1, 2, 3, 4, 5, gap});
        const TwoWayAnova anova = anovaOfWithin(values);
        QCOMPARE(anova.dropped, std::size_t(1));
        QVERIFY(near(anova.effects[2].f, 1.44889027821));
    }

    void groupsOfParticipantsOfUnequalSize()
    {
        const TwoWayAnova two = anovaOfMixed(mixed, SumsOfSquares::TypeII);
        QVERIFY(!two.balanced && two.participants == 7);
        QVERIFY(near(two.effects[0].ss, 2.011904761905) && near(two.effects[0].ssError, 21.14666666667));
        QVERIFY(near(two.effects[0].f, 0.475702576112) && near(two.effects[0].generalizedEtaSquared, 0.066428206438));
        QVERIFY(near(two.effects[1].ss, 20.001428571429) && near(two.effects[1].f, 14.029526704299));
        QVERIFY(near(two.effects[1].p, 1.25894070996e-04) && near(two.effects[1].epsilonGg, 0.794369709995));
        QVERIFY(near(two.effects[1].pGg, 0.000516388818946) && near(two.effects[1].epsilonHf, 1.56657338687));
        QVERIFY(near(two.effects[1].mauchly.w, 0.531622711967) && near(two.effects[1].pHf, *two.effects[1].p));
        QVERIFY(near(two.effects[2].ss, 0.250238095238) && near(two.effects[2].df1, 3) && near(two.effects[2].df2, 15));
        QVERIFY(near(two.effects[2].pGg, 0.873922686185736) && near(two.effects[2].generalizedEtaSquared, 0.008772515567));
        const TwoWayAnova three = anovaOfMixed(mixed, SumsOfSquares::TypeIII);
        QVERIFY(near(three.effects[1].ss, 19.135952380952) && near(three.effects[1].f, 13.422458999967));
        QVERIFY(near(three.effects[1].generalizedEtaSquared, 0.403618814218));
        QVERIFY(near(three.effects[2].f, 0.175523564581));
    }

    void interactionWithThreeGroupsHasTheirDegrees()
    {
        // R, package afex: aov_ez("who", "y", mixed, between = "g", within = "c", type = 3) with groups of 2, 2 and 3
        // participants.
        const TwoWayAnova anova =
            stats::twoWayMixed(mixed, cycling("who", 28, 7, 4), labelled("g", "1111111122222222333333333333"),
                               cycling("c", 28, 4, 1), SumsOfSquares::TypeIII);
        QVERIFY(near(anova.effects[2].df1, 6) && near(anova.effects[2].df2, 12) && near(anova.effects[0].df1, 2));
        QVERIFY(near(anova.effects[2].ss, 1.60148809523810) && near(anova.effects[2].f, 0.554427901705220));
        QVERIFY(near(anova.effects[1].ss, 19.64432291666664) && near(anova.effects[1].epsilonGg, 0.734911283167));
        QVERIFY(near(anova.effects[1].pGg, 0.00176510901233));
    }

    void sphericityNeedsParticipants()
    {
        const std::vector<double> three(within.begin(), within.begin() + 12);
        const TwoWayAnova anova = anovaOfWithin(three);
        QVERIFY(anova.effects[1].f.exists() && !anova.effects[1].mauchly.w.exists());
        QVERIFY(anova.effects[1].mauchly.why.find("fewer blocks") != std::string::npos);
    }

    void designsWithoutAnAnswerSayWhy()
    {
        const Factor one = labelled("a", "xxxx"), two = labelled("b", "ppqq"), who = labelled("who", "1122");
        const std::vector<double> four{1, 2, 4, 3};
        QVERIFY(isRefused(stats::twoWayBetween(four, one, two, SumsOfSquares::TypeII), "at least 2 levels"));
        QVERIFY(
            isRefused(stats::twoWayBetween(four, labelled("a", "xyxy"), two, SumsOfSquares::TypeIII), "one value in each cell"));
        const Factor a = labelled("a", "xxyyxxyy"), b = labelled("b", "ppppqqqq");
        const std::vector<double> same{1, 1, 2, 2, 3, 3, 5, 5};
        QVERIFY(isRefused(stats::twoWayBetween(same, a, b, SumsOfSquares::TypeII), "no variation within"));
        const std::vector<double> apart{1, 2, 3, 4};
        QVERIFY(isRefused(stats::twoWayBetween(apart, labelled("a", "xxyy"), labelled("b", "ppqq"), SumsOfSquares::TypeII),
                          "separate some levels"));
        QVERIFY(isRefused(stats::twoWayBetween({}, {}, {}, SumsOfSquares::TypeII), "at least 2 levels"));
        const double infinity = std::numeric_limits<double>::infinity();
        QVERIFY(isRefused(stats::twoWayBetween(std::vector<double>{1, infinity, 3, 4}, a, b, SumsOfSquares::TypeII), "values"));
        QVERIFY(isRefused(anovaOfWithin({1, 2, 3, 4, 5, 6}), "at least 2 participants"));
        QVERIFY(isRefused(anovaOfWithin({1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6}), "no error variance"));
        QVERIFY(isRefused(stats::twoWayMixed(four, who, labelled("g", "1222"), labelled("c", "1212"), SumsOfSquares::TypeII),
                          "more than one level"));
        QVERIFY(isRefused(stats::twoWayMixed(four, who, labelled("g", "1122"), labelled("c", "1212"), SumsOfSquares::TypeII),
                          "one complete participant"));
    }
};

QTEST_APPLESS_MAIN(TwoWayAnovaTest)
#include "two_way_anova_test.moc"
