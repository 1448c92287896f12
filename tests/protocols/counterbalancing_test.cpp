#include "protocols/orders/counterbalancing.h"

#include <QElapsedTimer>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "protocols/protocol_json.h"
#include "protocols/records/balance.h"

using namespace protocols;

namespace {

Protocol studyOf(int participants, int conditions, int fabrics, int alternatives)
{
    Protocol protocol = protocolFromJson(paperProtocolJson(), "vis2hap.json");
    protocol.participants = participants;
    protocol.conditions.resize(static_cast<std::size_t>(conditions));
    protocol.fabricCount = fabrics;
    protocol.phases[0].task = protocol.phases[0].questions[0].kind = ForcedChoice{alternatives};
    return protocol;
}

Protocol choicesOfThePaper()
{
    Protocol protocol = studyOf(10, 9, 7, 3);
    protocol.phases.resize(1);
    return protocol;
}

using Range = BalanceCertificate::Range;

Range rangeNamed(const BalanceCertificate& certificate, const std::string& what)
{
    const auto found = std::ranges::find(certificate.ranges, what, &Range::what);
    return found == certificate.ranges.end() ? Range{"no range " + what, -1, -1} : *found;
}

/// Trials of the choice phase, in order.
std::vector<DesignTrial> choicesOf(const std::vector<DesignTrial>& trials)
{
    std::vector<DesignTrial> choices;
    std::ranges::copy_if(trials, std::back_inserter(choices), [](const DesignTrial& t) { return t.phase == 0; });
    return choices;
}

bool liesOn(const std::vector<DesignTrial>& list, std::size_t at, std::ptrdiff_t away, int fabric)
{
    const std::ptrdiff_t other = static_cast<std::ptrdiff_t>(at) + away;
    if (other < 0 || other >= static_cast<std::ptrdiff_t>(list.size())) return false;
    const auto& tray = list[static_cast<std::size_t>(other)].alternatives;
    return std::ranges::find(tray, fabric) != tray.end();
}

/// Score of a fabric on a tray, from the visible part of a participant's list. The guesser takes the highest.
using Rule = std::function<int(const std::vector<DesignTrial>& list, std::size_t at, int fabric)>;

/// Expected number of true slots that a guesser by `rule` finds, ties shared.
double hitsBy(const Rule& rule, const Design& design)
{
    double hits = 0;
    for (const auto& participant : design.participants) {
        const auto list = choicesOf(participant);
        for (std::size_t at = 0; at < list.size(); ++at) {
            std::map<int, std::vector<int>> byScore;
            for (const int fabric : list[at].alternatives) byScore[rule(list, at, fabric)].push_back(fabric);
            const auto& best = byScore.rbegin()->second;
            if (std::ranges::find(best, list[at].fabric) != best.end()) hits += 1.0 / static_cast<double>(best.size());
        }
    }
    return hits;
}

int appearances(const std::vector<DesignTrial>& list, int fabric)
{
    return static_cast<int>(std::ranges::count_if(
        list, [&](const DesignTrial& t) { return std::ranges::find(t.alternatives, fabric) != t.alternatives.end(); }));
}

int appearancesInSlot(const std::vector<DesignTrial>& list, std::size_t at, int fabric)
{
    const auto& tray = list[at].alternatives;
    const auto slot = std::ranges::find(tray, fabric) - tray.begin();
    return static_cast<int>(std::ranges::count_if(
        list, [&](const DesignTrial& t) { return t.alternatives[static_cast<std::size_t>(slot)] == fabric; }));
}

/// Number of presentations until the fabric is on a tray again, or since it was.
int distance(const std::vector<DesignTrial>& list, std::size_t at, int fabric, int direction)
{
    for (int away = 1; away < 10; ++away)
        if (liesOn(list, at, direction * away, fabric)) return away;
    return 10;
}

const std::vector<std::pair<const char*, Rule>>& guessingRules()
{
    static const std::vector<std::pair<const char*, Rule>> rules{
        {"most frequent fabric", [](auto& list, auto, int f) { return appearances(list, f); }},
        {"least frequent fabric", [](auto& list, auto, int f) { return -appearances(list, f); }},
        {"most frequent in its slot", [](auto& list, auto at, int f) { return appearancesInSlot(list, at, f); }},
        {"least frequent in its slot", [](auto& list, auto at, int f) { return -appearancesInSlot(list, at, f); }},
        {"was there before", [](auto& list, auto at, int f) { return liesOn(list, at, -1, f) ? 1 : 0; }},
        {"was not there before", [](auto& list, auto at, int f) { return liesOn(list, at, -1, f) ? 0 : 1; }},
        {"stays for the next", [](auto& list, auto at, int f) { return liesOn(list, at, 1, f) ? 1 : 0; }},
        {"goes before the next", [](auto& list, auto at, int f) { return liesOn(list, at, 1, f) ? 0 : 1; }},
        {"alone among its neighbours",
         [](auto& list, auto at, int f) { return -(liesOn(list, at, -1, f) ? 1 : 0) - (liesOn(list, at, 1, f) ? 1 : 0); }},
        {"longest away", [](auto& list, auto at, int f) { return distance(list, at, f, -1); }},
        {"soonest back", [](auto& list, auto at, int f) { return -distance(list, at, f, 1); }},
        {"lowest number", [](auto&, auto, int f) { return -f; }},
    };
    return rules;
}

}  // namespace

class CounterbalancingTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void paperStudyIsBalanced_data()
    {
        QTest::addColumn<quint64>("seed");
        const quint64 seeds = qEnvironmentVariableIsSet("VIS2HAP_ALL_SEEDS") ? 200 : 5;
        for (quint64 seed = 1; seed <= seeds; ++seed) QTest::addRow("seed %llu", seed) << seed;
    }

    void paperStudyIsBalanced()
    {
        QFETCH(const quint64, seed);
        const Protocol protocol = studyOf(10, 9, 7, 3);
        QElapsedTimer timer;
        timer.start();
        const Design design = drawDesign(protocol, seed);
        QVERIFY2(timer.elapsed() < 10'000, qPrintable(QString("%1 ms").arg(timer.elapsed())));
        const BalanceCertificate certificate = balanceOf(design, protocol);
        const QByteArray shown = QByteArray::fromStdString(describe(certificate));
        for (const std::string phase : {", Q1", ", Q2-Q4"}) {
            QCOMPARE(rangeNamed(certificate, "presentations of a rendering per participant" + phase),
                     (Range{"presentations of a rendering per participant" + phase, 1, 1}));
            QVERIFY2(lies(certificate, "ordered pairs of conditions" + phase, 8, 9), shown);
            QVERIFY2(lies(certificate, "a condition per stretch of the order" + phase, 8, 12), shown);
        }
        QVERIFY2(lies(certificate, "ordered pairs of fabrics, Q2-Q4", 14, 15), shown);
        QVERIFY2(lies(certificate, "a fabric per stretch of the order, Q2-Q4", 8, 12), shown);
        QVERIFY2(lies(certificate, "foil sets per true fabric, Q1", 6, 6), shown);
        QVERIFY2(lies(certificate, "true slots per condition, Q1", 23, 24), shown);
        QVERIFY2(lies(certificate, "a fabric as foil per participant, Q1", 18, 18), shown);
        QCOMPARE(certificate.immediateRepeats, 0);
        QCOMPARE(certificate.repeatedFoilPairs, 0);
    }

    void otherSizesComeAsNearAsTheyCan_data()
    {
        QTest::addColumn<int>("participants");
        QTest::addColumn<int>("conditions");
        QTest::addColumn<int>("fabrics");
        QTest::addColumn<int>("alternatives");
        QTest::addColumn<int>("slack");     // how far counts of a kind may differ
        QTest::addColumn<bool>("repeats");  // unavoidable
        QTest::newRow("six fabrics, five conditions") << 10 << 5 << 6 << 3 << 1 << false;
        QTest::newRow("two participants") << 2 << 9 << 7 << 3 << 1 << false;
        QTest::newRow("one participant") << 1 << 9 << 7 << 3 << 2 << false;
        QTest::newRow("four alternatives") << 10 << 9 << 7 << 4 << 1 << false;
        QTest::newRow("two alternatives") << 6 << 9 << 7 << 2 << 1 << false;
        QTest::newRow("one condition") << 10 << 1 << 7 << 3 << 1 << true;
        QTest::newRow("three fabrics") << 10 << 9 << 3 << 3 << 1 << false;
        QTest::newRow("two fabrics") << 10 << 9 << 2 << 2 << 2 << true;
        QTest::newRow("two conditions") << 10 << 2 << 6 << 3 << 1 << true;
        QTest::newRow("smallest") << 1 << 1 << 2 << 2 << 1 << true;
        QTest::newRow("twenty fabrics") << 4 << 3 << 20 << 5 << 2 << false;
    }

    void otherSizesComeAsNearAsTheyCan()
    {
        QFETCH(const int, participants);
        QFETCH(const int, conditions);
        QFETCH(const int, fabrics);
        QFETCH(const int, alternatives);
        QFETCH(const int, slack);
        QFETCH(const bool, repeats);
        const Protocol protocol = studyOf(participants, conditions, fabrics, alternatives);
        const Design design = drawDesign(protocol, 3);
        const BalanceCertificate certificate = balanceOf(design, protocol);
        const QByteArray shown = QByteArray::fromStdString(describe(certificate));
        for (const Range& range : certificate.ranges)
            if (range.what.find("stretch") == std::string::npos && range.what.find("slots of a foil") == std::string::npos &&
                range.what.find("true slots per participant") == std::string::npos)
                QVERIFY2(range.max - range.min <= slack, shown);
        QVERIFY2(lies(certificate, "presentations of a rendering per participant, Q1", 1, 1), shown);
        if (!repeats) QCOMPARE(certificate.immediateRepeats, 0);
        for (const auto& trials : design.participants)
            for (const DesignTrial& trial : choicesOf(trials)) {
                QCOMPARE(trial.alternatives.size(), static_cast<std::size_t>(alternatives));
                QCOMPARE(std::set<int>(trial.alternatives.begin(), trial.alternatives.end()).size(), trial.alternatives.size());
                QCOMPARE(std::ranges::count(trial.alternatives, trial.fabric), 1);
            }
    }

    /// Without repeats, two conditions would alternate: who knows one trial's condition knew them all, and odd trials would show
    /// each fabric once.
    void twoKindsRepeatAsOftenAsTheyChange()
    {
        int repeats = 0, pairs = 0, sameAgain = 0, fabricPairs = 0;
        for (const auto& list : drawDesign(studyOf(20, 2, 6, 3), 3).participants)
            for (std::size_t at = 1; at < 12; ++at, ++pairs) repeats += list[at].label == list[at - 1].label;
        QVERIFY2(std::abs(repeats - pairs / 2) <= 1, qPrintable(QString("%1 of %2").arg(repeats).arg(pairs)));
        for (const auto& list : drawDesign(studyOf(20, 5, 2, 2), 3).participants)
            for (std::size_t at = 1; at < 10; ++at, ++fabricPairs) sameAgain += list[at].fabric == list[at - 1].fabric;
        // 4 of the 9 other places show the same fabric; three standard errors are 20.
        QVERIFY2(std::abs(sameAgain - fabricPairs * 4 / 9) <= 20,
                 qPrintable(QString("%1 of %2").arg(sameAgain).arg(fabricPairs)));
    }

    void twoConditionsOfSameOrDifferentRepeatToo()
    {
        Protocol protocol = studyOf(20, 2, 6, 3);
        protocol.phases.resize(1);
        protocol.phases[0].task = protocol.phases[0].questions[0].kind = SameDifferent{};
        int repeats = 0, pairs = 0;
        for (const auto& list : drawDesign(protocol, 3).participants)
            for (std::size_t at = 1; at < list.size(); ++at, ++pairs) repeats += list[at].label == list[at - 1].label;
        QVERIFY2(std::abs(repeats - pairs / 2) <= pairs / 20, qPrintable(QString("%1 of %2").arg(repeats).arg(pairs)));
    }

    /// A rule of evenness for each participant or piece would tell: who counts finds the slot that is still missing.
    void slotsOfAPersonAreAsChanceMakesThem()
    {
        double squares = 0;
        int cells = 0;
        for (const Design& design : m_designs)
            for (const auto& participant : design.participants) {
                std::map<std::pair<int, std::ptrdiff_t>, int> counts;
                for (const DesignTrial& trial : choicesOf(participant))
                    ++counts[{trial.fabric, std::ranges::find(trial.alternatives, trial.fabric) - trial.alternatives.begin()}];
                for (int fabric = 0; fabric < 7; ++fabric)
                    for (std::ptrdiff_t slot = 0; slot < 3; ++slot, ++cells) squares += std::pow(counts[{fabric, slot}] - 3, 2);
            }
        // The variance of a count of 9 in 3 slots is 2; even slots have 0.
        QVERIFY2(std::abs(squares / cells - 2) < 0.4, qPrintable(QString::number(squares / cells)));
    }

    /// Who knows that each stretch of seven shows every fabric equally often finds the one that is still missing.
    void fabricsToFindAreInNoEvenStretches()
    {
        double squares = 0;
        int cells = 0;
        for (const Design& design : m_designs) {
            std::map<std::pair<std::size_t, int>, int> counts;
            for (const auto& participant : design.participants) {
                const auto list = choicesOf(participant);
                for (std::size_t at = 0; at < list.size(); ++at) ++counts[{at / 7, list[at].fabric}];
            }
            for (std::size_t stretch = 0; stretch < 9; ++stretch)
                for (int fabric = 0; fabric < 7; ++fabric, ++cells) squares += std::pow(counts[{stretch, fabric}] - 10, 2);
        }
        // Drawn without a rule, a count of 10 has a variance of 7.7; the rule against repeats makes it a little less.
        QVERIFY2(squares / cells > 4, qPrintable(QString::number(squares / cells)));
    }

    /// What is told about a blinded study holds for every study of its protocol, so that it tells nothing about this one.
    void toldBalanceIsThatOfOtherDesigns()
    {
        const Protocol protocol = studyOf(2, 3, 4, 2);
        const auto told = balanceOfExamples(protocol);
        QCOMPARE(told, balanceOfExamples(protocol));
        bool differs = false;
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            const auto one = balanceOf(drawDesign(protocol, seed), protocol);
            for (std::size_t i = 0; i < one.ranges.size(); ++i) {
                QVERIFY(told.ranges[i].min <= one.ranges[i].min && told.ranges[i].max >= one.ranges[i].max);
                differs |= told.ranges[i] != one.ranges[i];
            }
        }
        QVERIFY(differs);
    }

    void foilSetsRepeatOnlyWhereTheyMust()
    {
        // Three fabrics have one set of two foils for each true fabric: nine presentations repeat it eight times.
        const Protocol protocol = studyOf(10, 9, 3, 3);
        QCOMPARE(balanceOf(drawDesign(protocol, 5), protocol).repeatedFoilPairs, 10 * 3 * 8);
        const Protocol four = studyOf(10, 9, 7, 4);
        QCOMPARE(balanceOf(drawDesign(four, 5), four).repeatedFoilPairs, 0);
    }

    void sameSeedGivesTheSameDesign()
    {
        const Protocol protocol = studyOf(4, 5, 6, 3);
        QVERIFY(drawDesign(protocol, 9) == drawDesign(protocol, 9));
        QVERIFY(drawDesign(protocol, 9) != drawDesign(protocol, 10));
    }

    void whatCanBeSeenDoesNotNameTheTrueSlot_data()
    {
        QTest::addColumn<int>("rule");
        for (std::size_t i = 0; i < guessingRules().size(); ++i) QTest::newRow(guessingRules()[i].first) << static_cast<int>(i);
    }

    void whatCanBeSeenDoesNotNameTheTrueSlot()
    {
        QFETCH(const int, rule);
        double hits = 0;
        for (const Design& design : m_designs) hits += hitsBy(guessingRules()[static_cast<std::size_t>(rule)].second, design);
        // Chance is a third of 5 x 630 trials; blind guessing has a standard deviation of 26.
        QVERIFY2(std::abs(hits - 1050) < 45, qPrintable(QString("%1 hits, 1050 by chance").arg(hits)));
    }

    void withFewSwapsPiecesStayWhereTheyLie()
    {
        Protocol protocol = choicesOfThePaper();
        const Design even = drawDesign(protocol, 101);
        protocol.phases[0].trayAim = TrayAim::FewSwaps;
        const Design few = drawDesign(protocol, 101);
        const auto certificate = balanceOf(few, protocol), evenCertificate = balanceOf(even, protocol);
        // Nothing else of the order changes.
        for (std::size_t p = 0; p < few.participants.size(); ++p)
            for (std::size_t at = 0; at < few.participants[p].size(); ++at)
                QVERIFY(few.participants[p][at].label == even.participants[p][at].label &&
                        few.participants[p][at].fabric == even.participants[p][at].fabric);
        QVERIFY(lies(certificate, "foil sets per true fabric, Q1", 6, 6));
        QVERIFY(lies(certificate, "a fabric as foil per participant, Q1", 18, 18));
        QCOMPARE(certificate.repeatedFoilPairs, 0);
        // Even slots: 1.8 pieces are put on and 0.8 moved.
        QCOMPARE(certificate.handling.size(), 1u);
        QCOMPARE(certificate.handling[0].piecesMoved, 0.0);
        QVERIFY(certificate.handling[0].piecesPutOn < 1.65);
        QVERIFY(evenCertificate.handling[0].piecesPutOn + evenCertificate.handling[0].piecesMoved > 2.4);
        const auto price = describePrice(certificate, evenCertificate);
        QVERIFY2(price.find("true slots per condition, Q1: ") != std::string::npos, price.c_str());
        QVERIFY2(price.find(" (even slots: 23 to 24)\n") != std::string::npos, price.c_str());
        QVERIFY2(price.find("ordered pairs") == std::string::npos, price.c_str());
    }

    void withFewSwapsNothingNamesTheTrueSlot()
    {
        Protocol protocol = choicesOfThePaper();
        protocol.phases[0].trayAim = TrayAim::FewSwaps;
        std::vector<Design> designs;
        for (std::uint64_t seed = 101; seed <= 105; ++seed) designs.push_back(drawDesign(protocol, seed));
        for (const auto& [name, rule] : guessingRules()) {
            double hits = 0;
            for (const Design& design : designs) hits += hitsBy(rule, design);
            QVERIFY2(std::abs(hits - 1050) < 90, qPrintable(QString("%1: %2 hits, 1050 by chance").arg(name).arg(hits)));
        }
    }

    void certificateSeesADesignThatIsNotBalanced()
    {
        const Protocol protocol = choicesOfThePaper();
        Design design = m_designs.front();
        auto& first = design.participants[0];
        first[1].label = first[0].label;
        for (auto& list : design.participants)
            for (DesignTrial& trial : list)
                if (trial.label == 3)
                    std::iter_swap(trial.alternatives.begin(), std::ranges::find(trial.alternatives, trial.fabric));
        const BalanceCertificate certificate = balanceOf(design, protocol);
        QVERIFY(certificate.immediateRepeats > 0);
        QVERIFY(!lies(certificate, "presentations of a rendering per participant, Q1", 1, 1));
        QVERIFY(!lies(certificate, "true slots per condition, Q1", 23, 24));
        QVERIFY(describe(certificate).find("immediate repeats of a condition or fabric: 1") != std::string::npos);
    }

    void initTestCase()
    {
        for (std::uint64_t seed = 101; seed <= 105; ++seed) m_designs.push_back(drawDesign(choicesOfThePaper(), seed));
    }

private:
    static bool lies(const BalanceCertificate& certificate, const std::string& what, int low, int high)
    {
        const Range range = rangeNamed(certificate, what);
        return range.min >= low && range.max <= high;
    }

    std::vector<Design> m_designs;
};

QTEST_GUILESS_MAIN(CounterbalancingTest)
#include "counterbalancing_test.moc"
