// Test-retest reliability and the ceilings that follow from it: numbers of a second program, coverage of the intervals over
// simulated studies with planted noise, and the ceilings against simulated answers.
#include "stats/tests/reliability.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stats/kernels/draws.h"

using namespace stats;

namespace {

/// Levels of the renderings with mean 0 and SD 1. They are the same in every study: intervals are for other participants.
const std::vector<double>& renderings()
{
    static const std::vector<double> levels = [] {
        std::vector<double> drawn;
        for (std::size_t i = 0; i < 63; ++i) drawn.push_back(static_cast<double>(i % 9) + 0.1 * static_cast<double>(i / 9));
        double sum = 0, squares = 0;
        for (const double level : drawn) sum += level / 63;
        for (const double level : drawn) squares += (level - sum) * (level - sum) / 63;
        for (double& level : drawn) level = (level - sum) / std::sqrt(squares);
        return drawn;
    }();
    return levels;
}

/// What a simulated study is made of, SDs in scale points.
struct Planted {
    std::size_t participants = 10, pairs = 6;
    double person = 0.8, rendering = 1.5, personByRendering = 0.7, noise = 1;
    double spreadOfNoise = 0;  ///< SD of the logarithm of a participant's noise
    double shift = 0;          ///< of the second answer

    double between() const { return person * person + rendering * rendering + personByRendering * personByRendering; }
    /// ICC(2,1) of a large study. The mean of the squared noise is that of a log-normal variable.
    double icc() const
    {
        const double error = noise * noise * std::exp(2 * spreadOfNoise * spreadOfNoise);
        return between() / (between() + error + shift * shift / 2);
    }
    double withinSd() const { return std::sqrt(noise * noise * std::exp(2 * spreadOfNoise * spreadOfNoise) + shift * shift / 2); }
};

std::vector<RatingPairs> drawn(const Planted& planted, Draws& draws)
{
    std::vector<RatingPairs> participants;
    for (std::size_t p = 0; p < planted.participants; ++p) {
        const double person = draws.normal(planted.person), noise = planted.noise * std::exp(draws.normal(planted.spreadOfNoise));
        RatingPairs& pairs = participants.emplace_back();
        for (std::size_t i = 0; i < planted.pairs; ++i) {
            const auto rendering = static_cast<std::size_t>(draws.uniform() * 63);
            const double felt =
                5 + person + planted.rendering * renderings()[rendering] + draws.normal(planted.personByRendering);
            pairs.emplace_back(felt + draws.normal(noise), felt + planted.shift + draws.normal(noise));
        }
    }
    return participants;
}

bool holds(const Interval& interval, double truth) { return *interval.low <= truth && truth <= *interval.high; }

}  // namespace

class ReliabilityTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // python3:
    //   x=[(2,3),(5,5),(7,6),(4,6),(8,8),(1,3)]; n=6; m=sum(a+b for a,b in x)/12; r=[(a+b)/2 for a,b in x]
    //   c=[sum(a for a,b in x)/6,sum(b for a,b in x)/6]; msr=2*sum((v-m)**2 for v in r)/5; msc=6*sum((v-m)**2 for v in c)
    //   mse=sum((x[i][j]-r[i]-c[j]+m)**2 for i in range(6) for j in (0,1))/5
    //   (msr-mse)/(msr+mse+2*(msc-mse)/6)                     0.8546511627906974
    //   d=[b-a for a,b in x]; (sum(v*v for v in d)/12)**.5    0.9128709291752769
    //   sum(d)/6, 1.959963984540054*(sum((v-sum(d)/6)**2 for v in d)/5)**.5    0.6666666666666666 2.3736342607244105
    void numbersAreThoseOfASecondProgram()
    {
        const std::vector<RatingPairs> participants{{{2, 3}, {5, 5}}, {{7, 6}, {4, 6}}, {}, {{8, 8}, {1, 3}}};
        const RatingReliability found = ratingReliability(participants, 10, {-1, 1});
        QCOMPARE(found.pairs, 6u);
        QCOMPARE(found.participants, 3u);
        QCOMPARE(*found.icc.value, 0.8546511627906974);
        QCOMPARE(*found.withinSd.value, 0.9128709291752769);
        QCOMPARE(*found.bias.estimate, 2.0 / 3);
        QCOMPARE(*found.limitsOfAgreement.high - *found.limitsOfAgreement.low, 2 * 2.3736342607244105);
        QCOMPARE(*found.correlationCeiling.value, std::sqrt(0.8546511627906974));
        QCOMPARE(*found.meanCeiling.value, 10 - 0.9128709291752769 / std::sqrt(2 * std::numbers::pi));
        QVERIFY(*found.icc.ci95.low < *found.icc.value && *found.icc.value < *found.icc.ci95.high);
        QVERIFY(*found.meanCeiling.ci95.low < *found.meanCeiling.value &&
                *found.meanCeiling.value < *found.meanCeiling.ci95.high);
        QCOMPARE(found.biasEquivalence.n, 3u);
    }

    // python3: a=14/20; m=3; k=(m*a-1)/(m-1); k, (1+(m-1)*k**.5)/m     0.5499999999999998 0.8277465658063775
    // R: prop.test(14, 20, correct=FALSE)$conf.int                     0.4810271816 0.8545227551
    void choicesAgreeBeyondChance()
    {
        const std::vector<RepeatedChoices> participants{{5, 4}, {5, 3}, {5, 3}, {5, 4}, {0, 0}};
        const ChoiceReliability found = choiceReliability(participants, 3);
        QCOMPARE(found.pairs, 20u);
        QCOMPARE(found.participants, 4u);
        QCOMPARE(*found.agreement.value, 0.7);
        QVERIFY(std::abs(*found.agreement.ci95.low - 0.4810271816) < 1e-9 &&
                std::abs(*found.agreement.ci95.high - 0.8545227551) < 1e-9);
        QCOMPARE(*found.kappa.value, 0.55);
        QCOMPARE(*found.shareCeiling.value, 0.8277465658063775);
        QCOMPARE(*choiceReliability(std::vector<RepeatedChoices>{{4, 4}}, 2).shareCeiling.value, 1.0);
        QCOMPARE(*choiceReliability(std::vector<RepeatedChoices>{{4, 1}}, 2).shareCeiling.value, 0.5);
    }

    /// Four participants, each with one pair alike and one that differs by 1: "0.50 (95 % interval 0.50 to 0.50)".
    void anIntervalOfOnePointIsNone()
    {
        const std::vector<RatingPairs> participants{{{3, 3}, {5, 6}}, {{4, 4}, {7, 6}}, {{2, 2}, {6, 7}}, {{8, 8}, {4, 3}}};
        const RatingReliability found = ratingReliability(participants, 10, {.low = -0.5, .high = 0.5});
        QCOMPARE(*found.withinSd.value, 0.5);
        QVERIFY(!found.withinSd.ci95.low.exists() && !found.meanCeiling.ci95.high.exists());
        QVERIFY(found.withinSd.ci95.low.why().find("all participants show the same SD") != std::string::npos);
        QVERIFY(found.meanCeiling.value.exists() && found.icc.ci95.low.exists());
    }

    // python3: m=3; r,w,n=9,5,20; a=(r+w)/n; b=(r+w/(m-1))/n; a, (m*b-1)/(m-1), (1+(2*a-1)**.5)/2
    //   0.7 0.36249999999999993 0.816227766016838
    void outcomesAgreeBeyondGuessing()
    {
        const std::vector<RepeatedChoices> participants{{5, 4, 2}, {5, 3, 1}, {5, 3, 0}, {5, 4, 2}, {0, 0, 0}};
        const ChoiceReliability found = choiceReliability(participants, 3, ChoicesCompared::Outcomes);
        QCOMPARE(found.bothWrong, 5u);
        QCOMPARE(*found.agreement.value, 0.7);
        QCOMPARE(*found.kappa.value, 0.3625);
        QVERIFY(*found.kappa.ci95.low < *found.kappa.value && *found.kappa.value < *found.kappa.ci95.high);
        QCOMPARE(*found.shareCeiling.value, 0.816227766016838);
        const std::vector<RepeatedChoices> never{{4, 0, 0}};
        QCOMPARE(*choiceReliability(never, 3, ChoicesCompared::Outcomes).kappa.value, -0.5);
        QCOMPARE(*choiceReliability(never, 3, ChoicesCompared::Outcomes).shareCeiling.value, 0.5);
        // Of two alternatives there is one foil, so that nothing is lost.
        const std::vector<RepeatedChoices> two{{8, 6, 2}}, same{{8, 6, 0}};
        QCOMPARE(*choiceReliability(two, 2, ChoicesCompared::Outcomes).kappa.value, *choiceReliability(same, 2).kappa.value);
    }

    // Participants (pairs, same word again, first and second answers that are the word): 18 (3, 3, 3, 3) and those below.
    // python3: x=[(3,2,2,3)]*2+[(3,2,3,2)]*2+[(3,1,2,2),(3,1,1,3)]; c=[(f*s+(n-f)*(n-s)-a)/(n-1) for n,a,f,s in x]
    //   (sum(a for n,a,f,s in x)-sum(c))/(sum(n for n,a,f,s in x)-sum(c))     -0.14285714285714285
    // The interval is that of the jackknife of R (reports/scripts/analysis.R, anchorWords).
    void aHabitForOneWordIsNoReliability()
    {
        std::vector<RepeatedChoices> participants(18, {3, 3, 0, 3, 3});
        const std::vector<RepeatedChoices> both{{3, 2, 0, 2, 3}, {3, 2, 0, 2, 3}, {3, 2, 0, 3, 2},
                                                {3, 2, 0, 3, 2}, {3, 1, 0, 2, 2}, {3, 1, 0, 1, 3}};
        participants.insert(participants.end(), both.begin(), both.end());
        const ChoiceReliability found = choiceReliability(participants, 2, ChoicesCompared::Words);
        QCOMPARE(*found.agreement.value, 64.0 / 72);
        QCOMPARE(*found.kappa.value, -1.0 / 7);
        QVERIFY(std::abs(*found.kappa.ci95.low + 0.44118764352881273) < 1e-12 &&
                std::abs(*found.kappa.ci95.high - 0.18390602152349111) < 1e-12);
        QCOMPARE(*found.shareCeiling.value, 0.5);
        QVERIFY(*choiceReliability(participants, 2).kappa.value > 0.7);  // of alternatives that change from pair to pair

        const std::vector<RepeatedChoices> constant(24, {3, 3, 0, 3, 3}), single(24, {1, 1, 0, 1, 1}), exact(4, {4, 4, 0, 2, 2}),
            crossed(4, {2, 0, 0, 1, 1});
        const auto why = [](const std::vector<RepeatedChoices>& of) {
            return choiceReliability(of, 2, ChoicesCompared::Words).shareCeiling.value.why();
        };
        QCOMPARE(why(constant),
                 std::string("every participant used one word only, so that nothing tells agreement from a habit"));
        QCOMPARE(why(single), std::string("no participant has two presentations that came twice, so that nothing tells agreement "
                                          "from a habit"));
        QCOMPARE(why(crossed), std::string("second answers repeat the first ones to other presentations"));
        const ChoiceReliability all = choiceReliability(exact, 2, ChoicesCompared::Words);
        QVERIFY(*all.kappa.value == 1 && *all.shareCeiling.value == 1);
        QVERIFY(!all.kappa.ci95.low.exists());
        // Each used the other word once: no kappa of single participants differs from 0.
        const ChoiceReliability rare =
            choiceReliability(std::vector<RepeatedChoices>(8, {3, 2, 0, 3, 2}), 2, ChoicesCompared::Words);
        QCOMPARE(*rare.kappa.value, 0.0);
        QVERIFY(rare.kappa.ci95.low.why().starts_with("all participants show the same kappa"));
    }

    // python3: x=[(4,4,4,4)]*3+[(4,3,2,3)]; with the sums of the test before, over those who used both words 0.5714285714285714
    //   x=[(3,0,2,1)]*3                                                                                        -2.0
    void aMissingIntervalOfWordsHasATrueReason()
    {
        const auto kappaOf = [](const std::vector<RepeatedChoices>& participants) {
            return choiceReliability(participants, 2, ChoicesCompared::Words).kappa;
        };
        const std::string why = "without one of the participants there is no kappa, or none between -1 and 1";
        const Estimate alone = kappaOf({{4, 4, 0, 4, 4}, {4, 4, 0, 4, 4}, {4, 4, 0, 4, 4}, {4, 3, 0, 2, 3}});
        QCOMPARE(*alone.value, 4.0 / 7);
        QCOMPARE(alone.ci95.low.why(), why);
        // Without the last one, all words are the same again.
        const Estimate differing = kappaOf({{4, 4, 0, 2, 2}, {4, 4, 0, 2, 2}, {4, 3, 0, 2, 3}});
        QVERIFY(*differing.value < 1);
        QCOMPARE(differing.ci95.low.why(), why);
        // No pair agrees, and each word comes again elsewhere: the estimate may lie below the least value that it estimates.
        const std::vector<RepeatedChoices> crossing(3, {3, 0, 0, 2, 1});
        QCOMPARE(*kappaOf(crossing).value, -2.0);
        QCOMPARE(kappaOf(crossing).ci95.high.why(), why);
        QCOMPARE(*choiceReliability(crossing, 2, ChoicesCompared::Words).shareCeiling.value, 0.5);
        QCOMPARE(kappaOf({{3, 0, 0, 2, 1}, {3, 0, 0, 2, 1}}).ci95.low.why(), std::string("needs at least 3 participants"));
        const Estimate exact = kappaOf(std::vector<RepeatedChoices>(4, {4, 4, 0, 2, 2}));
        QVERIFY(exact.ci95.low.why().starts_with("the pairs agree without any difference"));
    }

    /// A participant either feels what a presentation is, or takes a word by habit. Kappa is the share of the former.
    void theKappaOfWordsIsWhatIsFeltWhateverTheHabit()
    {
        constexpr int studies = 1000;
        for (const double felt : {0.0, 0.5}) {
            int held = 0, withInterval = 0;
            double sum = 0;
            for (int study = 0; study < studies; ++study) {
                Draws draws(16, static_cast<std::uint64_t>(study));
                std::vector<RepeatedChoices> participants(25);
                for (RepeatedChoices& one : participants) {
                    const double habit = 0.75 + 0.2 * draws.uniform();
                    for (; one.pairs < 6; ++one.pairs) {
                        const bool isFelt = draws.happens(felt), word = draws.happens(habit);
                        const bool first = isFelt ? word : draws.happens(habit), second = isFelt ? word : draws.happens(habit);
                        one.agreeing += first == second;
                        one.firstWord += first;
                        one.secondWord += second;
                    }
                }
                const Estimate kappa = choiceReliability(participants, 2, ChoicesCompared::Words).kappa;
                sum += *kappa.value;
                if (!kappa.ci95.low.exists()) continue;
                ++withInterval;
                held += holds(kappa.ci95, felt);
            }
            qInfo("felt %.1f: kappa %.3f, coverage %.1f %%", felt, sum / studies, 100.0 * held / withInterval);
            QVERIFY(std::abs(sum / studies - felt) < 0.02);
            QVERIFY(withInterval > 0.98 * studies && held > 0.9 * withInterval);
        }
    }

    void participantsWhoDifferWidenTheInterval()
    {
        const Interval alike = choiceReliability(std::vector<RepeatedChoices>{{6, 4}, {6, 4}, {6, 4}, {6, 4}}, 3).agreement.ci95;
        const Interval unlike = choiceReliability(std::vector<RepeatedChoices>{{6, 6}, {6, 6}, {6, 3}, {6, 1}}, 3).agreement.ci95;
        QVERIFY(*unlike.high - *unlike.low > 1.2 * (*alike.high - *alike.low));
    }

    void whatDoesNotExistHasItsReason()
    {
        const RatingReliability none = ratingReliability({}, 10, {});
        QCOMPARE(none.withinSd.value.why(), std::string("no presentation came twice"));
        QCOMPARE(none.icc.value.why(), std::string("needs at least 2 pairs"));
        QVERIFY(!none.bias.why.empty() && !none.meanCeiling.value.exists());
        const RatingReliability one = ratingReliability(std::vector<RatingPairs>{{{1, 2}, {6, 5}, {8, 8}}}, 10, {});
        QVERIFY(one.icc.value.exists() && one.meanCeiling.value.exists());
        QCOMPARE(one.icc.ci95.low.why(), std::string("needs at least 3 participants"));
        const std::vector<RatingPairs> same{{{1, 1}, {6, 6}}, {{2, 2}, {3, 3}}, {{4, 4}, {9, 9}}};
        const RatingReliability exact = ratingReliability(same, 10, {});
        QCOMPARE(*exact.icc.value, 1.0);
        QCOMPARE(*exact.meanCeiling.value, 10.0);
        QVERIFY(!exact.icc.ci95.low.exists());
        const std::vector<RatingPairs> constant{{{5, 5}}, {{5, 5}}, {{5, 5}}};
        QVERIFY(!ratingReliability(constant, 10, {}).icc.value.exists());
        QVERIFY(!choiceReliability({}, 3).kappa.value.exists());
    }

    void intervalsHoldThePlantedReliability_data()
    {
        QTest::addColumn<Planted>("planted");
        const auto row = [](const char* name, const Planted& planted) { QTest::newRow(name) << planted; };
        row("10 participants, 6 pairs", {});
        row("10 participants, 4 pairs", {.pairs = 4});
        row("6 participants", {.participants = 6});
        row("30 participants", {.participants = 30});
        row("participants use the scale differently", {.person = 2, .rendering = 1});
        row("more noise than signal", {.person = 0.5, .rendering = 1, .personByRendering = 0.5, .noise = 2});
        row("some participants are noisier", {.spreadOfNoise = 0.4});
        row("second answers are higher", {.shift = 0.5});
    }

    void intervalsHoldThePlantedReliability()
    {
        QFETCH(Planted, planted);
        constexpr int studies = 2000;
        int icc = 0, noise = 0, correlation = 0, bias = 0;
        double widthOfIcc = 0;
        for (int study = 0; study < studies; ++study) {
            Draws draws(11, static_cast<std::uint64_t>(study));
            const RatingReliability found = ratingReliability(drawn(planted, draws), 10, {});
            icc += holds(found.icc.ci95, planted.icc());
            noise += holds(found.withinSd.ci95, planted.withinSd());
            correlation += holds(found.correlationCeiling.ci95, std::sqrt(planted.icc()));
            bias += holds(found.bias.ci, planted.shift);
            widthOfIcc += *found.icc.ci95.high - *found.icc.ci95.low;
        }
        const auto percent = [&](int hits) { return 100.0 * hits / studies; };
        qInfo("%s: ICC %.3f, coverage of the ICC %.1f %%, of the noise %.1f %%, of the bias %.1f %%; mean width %.2f",
              QTest::currentDataTag(), planted.icc(), percent(icc), percent(noise), percent(bias), widthOfIcc / studies);
        QCOMPARE(correlation, icc);
        QVERIFY2(percent(icc) > 90, "the interval of the ICC");
        QVERIFY2(percent(noise) > 90, "the interval of the noise");
        QVERIFY2(percent(bias) > 93 && percent(bias) < 97, "the interval of the bias");
    }

    void intervalsHoldThePlantedAgreement_data()
    {
        QTest::addColumn<double>("agreement");
        QTest::addColumn<double>("person");
        QTest::newRow("alike") << 0.7 << 0.0;
        QTest::newRow("nearly sure") << 0.93 << 0.0;
        QTest::newRow("participants differ") << 0.7 << 0.15;
    }

    /// `person`: half of the participants agree more often by it, half less often.
    void intervalsHoldThePlantedAgreement()
    {
        QFETCH(double, agreement);
        QFETCH(double, person);
        constexpr int studies = 4000;
        int held = 0;
        for (int study = 0; study < studies; ++study) {
            Draws draws(12, static_cast<std::uint64_t>(study));
            std::vector<RepeatedChoices> participants(10);
            for (RepeatedChoices& one : participants) {
                const double own = agreement + (draws.happens(0.5) ? person : -person);
                for (; one.pairs < 6; ++one.pairs) one.agreeing += draws.happens(own);
            }
            held += holds(choiceReliability(participants, 3).agreement.ci95, agreement);
        }
        qInfo("%s: coverage of the agreement %.1f %%", QTest::currentDataTag(), 100.0 * held / studies);
        QVERIFY(held > 0.92 * studies);
    }

    void guessersHaveNoKappa_data()
    {
        QTest::addColumn<int>("m");
        for (const int m : {2, 3, 4, 9}) QTest::addRow("%d alternatives", m) << m;
    }

    /// Ten participants, six pairs each: guessers, people who are always right, nine times of ten, or where they know the fabric.
    void guessersHaveNoKappa()
    {
        QFETCH(int, m);
        struct People {
            const char* name;
            double known, rightOfKnown;  ///< the others are guessed
            double kappa;
        };
        const double nine = (0.9 * m - 1) / (m - 1);
        for (const People& people : {People{"guess", 0, 0, 0}, People{"always right", 1, 1, 1},
                                     People{"90 % right", 1, 0.9, nine * nine}, People{"know half", 0.5, 1, 0.5}}) {
            constexpr int studies = 2000;
            int held = 0;
            double sum = 0;
            for (int study = 0; study < studies; ++study) {
                Draws draws(15, static_cast<std::uint64_t>(study));
                std::vector<RepeatedChoices> participants(10);
                for (RepeatedChoices& one : participants)
                    for (; one.pairs < 6; ++one.pairs) {
                        const double right = draws.happens(people.known) ? people.rightOfKnown : 1.0 / m;
                        const bool first = draws.happens(right), second = draws.happens(right);
                        one.agreeing += first == second;
                        one.bothWrong += !first && !second;
                    }
                const Estimate kappa = choiceReliability(participants, m, ChoicesCompared::Outcomes).kappa;
                sum += *kappa.value;
                held += *kappa.ci95.low <= people.kappa + 1e-9 && people.kappa - 1e-9 <= *kappa.ci95.high;
            }
            qInfo("%s among %d: kappa %.3f, coverage %.1f %%", people.name, m, sum / studies, 100.0 * held / studies);
            QVERIFY2(std::abs(sum / studies - people.kappa) < 0.015, people.name);
            QVERIFY2(held > 0.93 * studies, people.name);
        }
    }

    /// A rendering that is felt as 10, rated with noise: its mean is the ceiling, and no other rendering's is higher.
    void noPerfectRenderingIsRatedAboveTheCeiling()
    {
        constexpr int answers = 400'000;
        Draws draws(13, 0);
        for (const double noise : {0.5, 1.0, 2.0}) {
            double sum = 0;
            for (int i = 0; i < answers; ++i) sum += std::clamp(10 + draws.normal(noise), 0.0, 10.0);
            const double ceiling = 10 - noise / std::sqrt(2 * std::numbers::pi);
            QVERIFY2(std::abs(sum / answers - ceiling) < 4 * noise / std::sqrt(answers), qPrintable(QString::number(noise)));
        }
    }

    /// Whatever the probabilities of the alternatives are, calling one of them right gives no share above the ceiling.
    void noKeyOfRightAnswersBeatsTheCeiling()
    {
        Draws draws(14, 0);
        double closest = 1;
        for (int study = 0; study < 3000; ++study) {
            const int m = 2 + static_cast<int>(draws.uniform() * 4);
            double agreement = 0, outcomes = 0, best = 0;
            constexpr int renderings = 5;
            for (int i = 0; i < renderings; ++i) {
                std::vector<double> q;
                double sum = 0;
                for (int j = 0; j < m; ++j) sum += q.emplace_back(std::pow(draws.uniform(), study % 7));
                double squares = 0;
                for (const double one : q) squares += one * one / (sum * sum);
                agreement += squares / renderings;
                const double right = q.front() / sum;
                outcomes += (right * right + (1 - right) * (1 - right)) / renderings;
                best += std::ranges::max(q) / sum / renderings;
            }
            // A large study with this agreement.
            const auto pairs = std::size_t{1} << 40U;
            const auto ceilingAt = [&](double share, ChoicesCompared compared) {
                const std::vector<RepeatedChoices> one{{pairs, static_cast<std::size_t>(share * static_cast<double>(pairs))}};
                return *choiceReliability(one, m, compared).shareCeiling.value;
            };
            const double ceiling = ceilingAt(agreement, ChoicesCompared::Answers);
            QVERIFY(best <= ceiling + 1e-5);
            QVERIFY(best <= ceilingAt(outcomes, ChoicesCompared::Outcomes) + 1e-5);
            closest = std::min(closest, ceiling - best);
        }
        QVERIFY2(closest < 0.01, "the ceiling is reached");
    }
};

QTEST_APPLESS_MAIN(ReliabilityTest)
#include "reliability_test.moc"
