// A guesser who collects everything visible in a choice phase, over all participants and presentations, finds the true slot only
// by chance.
#include <QTest>
#include <algorithm>
#include <cmath>
#include <utility>

#include "protocols/protocol_json.h"
#include "study/leaks/tray_guessers.h"

using namespace protocols;

namespace {

constexpr int presentations = 10 * 63;

/// Proportion of true slots that a guesser finds, over new designs of the paper's study.
struct Share {
    double hits = 0;
    int trials = 0;
    double rate() const { return hits / trials; }
    double standardErrors() const { return (rate() - 1.0 / 3) / std::sqrt(2.0 / 9 / trials); }
};

bool isAtChance(const Share& share, double most)
{
    qInfo("%.2f %% of %d, chance 33.33 %%: %+.1f standard errors", 100 * share.rate(), share.trials, share.standardErrors());
    return share.standardErrors() < most;
}

/// Fabrics on two trays in a row: how often they were true on the earlier and on the later one.
struct Repeated {
    Share earlierTrue, laterTrue;
    Repeated& operator+=(const Repeated& more)
    {
        for (const auto& [own, other] : {std::pair{&earlierTrue, &more.earlierTrue}, std::pair{&laterTrue, &more.laterTrue}}) {
            own->hits += other->hits;
            own->trials += other->trials;
        }
        return *this;
    }
};

Repeated repeatedIn(const Design& design)
{
    Repeated repeated;
    for (const auto& trials : design.participants)
        for (std::size_t at = 1; at < trials.size() && trials[at].phase == 0; ++at)
            for (const int fabric : trials[at].alternatives) {
                const auto& earlier = trials[at - 1].alternatives;
                if (std::ranges::find(earlier, fabric) == earlier.end()) continue;
                repeated.earlierTrue.hits += fabric == trials[at - 1].fabric;
                repeated.laterTrue.hits += fabric == trials[at].fabric;
                ++repeated.earlierTrue.trials;
                ++repeated.laterTrue.trials;
            }
    return repeated;
}

Protocol paper(TrayAim aim = TrayAim::EvenSlots)
{
    Protocol protocol = protocolFromJson(paperProtocolJson(), "paper");
    protocol.phases[0].trayAim = aim;
    return protocol;
}

void addTrayAims()
{
    QTest::addColumn<bool>("fewSwaps");
    QTest::newRow("even slots") << false;
    QTest::newRow("few swaps") << true;
}

TrayAim trayAim()
{
    QFETCH(const bool, fewSwaps);
    return fewSwaps ? TrayAim::FewSwaps : TrayAim::EvenSlots;
}

quint64 designs() { return qEnvironmentVariableIsSet("VIS2HAP_ALL_SEEDS") ? 40 : 6; }

}  // namespace

class TrayLeakTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void aGuesserWhoKnowsTheOrdersStaysAtChance_data() { addTrayAims(); }
    void aGuesserWhoKnowsTheOrdersStaysAtChance()
    {
        const Protocol protocol = paper(trayAim());
        Share share;
        for (quint64 seed = 1; seed <= designs(); ++seed) {
            const Design design = drawDesign(protocol, seed);
            share.hits += study::leaks::hitsOf(study::leaks::beliefOfChain(study::leaks::seenOf(design)), design);
            share.trials += presentations;
        }
        QVERIFY(isAtChance(share, 3));
    }

    /// VIS2HAP_TRAY_MOVES=20000000 lets the sampler search longer.
    void aGuesserWhoKnowsEveryRuleOfBalanceStaysAtChance_data() { addTrayAims(); }
    void aGuesserWhoKnowsEveryRuleOfBalanceStaysAtChance()
    {
        const Protocol protocol = paper(trayAim());
        const auto moves = static_cast<std::int64_t>(qEnvironmentVariableIntValue("VIS2HAP_TRAY_MOVES"));
        Share share;
        for (quint64 seed = 1; seed <= 5; ++seed) {
            const Design design = drawDesign(protocol, seed);
            const auto trays = study::leaks::seenOf(design);
            Random random(seed);
            const auto belief = study::leaks::beliefOfSampler(trays, moves > 0 ? moves : 1'000'000, random);
            share.hits += study::leaks::hitsOf(belief, design);
            share.trials += presentations;
        }
        QVERIFY(isAtChance(share, 3));
    }

    void aFabricThatLiesInTwoTraysRunningIsTrueAsOftenAsAnother_data() { addTrayAims(); }
    void aFabricThatLiesInTwoTraysRunningIsTrueAsOftenAsAnother()
    {
        const Protocol protocol = paper(trayAim());
        Repeated all;
        for (quint64 seed = 1; seed <= designs(); ++seed) all += repeatedIn(drawDesign(protocol, seed));
        // Both directions from chance: "seldom true" reveals as much as "often true".
        QVERIFY(isAtChance(all.laterTrue, 3) && all.laterTrue.standardErrors() > -3);
        QVERIFY(isAtChance(all.earlierTrue, 3) && all.earlierTrue.standardErrors() > -3);
    }

    /// Foils drawn without regard to the trays before and after would often include the true fabric of the tray before. This
    /// measure then finds it.
    void foilsDrawnCarelesslyAreSeenThrough()
    {
        Design design = drawDesign(paper(), 1);
        for (auto& trials : design.participants)
            for (std::size_t at = 0; at + 1 < trials.size() && trials[at + 1].phase == 0; ++at) {
                auto& tray = trials[at + 1].alternatives;
                if (std::ranges::find(tray, trials[at].fabric) == tray.end())
                    *std::ranges::find_if(tray, [&](int fabric) { return fabric != trials[at + 1].fabric; }) = trials[at].fabric;
            }
        QVERIFY(!isAtChance(repeatedIn(design).earlierTrue, 3));
    }
};

QTEST_APPLESS_MAIN(TrayLeakTest)
#include "tray_leak_test.moc"
