// A guesser who searches which presentations leave even orders when they are taken out finds catch trials and anchors no better
// than by counting pieces.
#include "study/leaks/removal_search.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "protocols/condition.h"
#include "protocols/orders/running_orders.h"
#include "protocols/protocol_json.h"
#include "study/leaks/leak_report.h"

using namespace protocols;
using study::leaks::Guess;
using study::leaks::SeenStudy;
using study::leaks::Truth;

namespace {

/// One phase with a few additional presentations.
Protocol withFewOthers(const std::string& others, int participants = 6, int fabrics = 7,
                       const std::string& conditions = R"("v_grey", "f", "h", "h&f")")
{
    return protocolFromJson(R"({"schema": "vis2hap.protocol/1", "name": "Removals", "participants": )" +
                                std::to_string(participants) + R"(, "fabrics": )" + std::to_string(fabrics) +
                                R"(, "conditions": [)" + conditions + R"(], "break_after": 10,
                                    "phases": [{"questions": ["Q2"], )" +
                                others + "}]}",
                            "test");
}

/// Whom the search finds in one study. The pieces are what an operator sees.
Guess foundByRemovals(const Design& design, const Protocol& protocol)
{
    SeenStudy seen;
    Truth truth;
    seen.protocol = protocol;
    for (int fabric = 0; fabric < protocol.fabricCount; ++fabric) seen.fabrics.push_back("F" + std::to_string(fabric));
    int slot = 0;
    for (const auto& list : design.participants) {
        ++slot;
        for (std::size_t at = 0; at < list.size(); ++at) {
            const auto piece = static_cast<std::size_t>(list[at].alternatives.front());
            seen.trials.push_back({slot, static_cast<int>(at) + 1, 0, "", "", {seen.fabrics[piece]}});
            const bool isCaught = list[at].label == catchTrialLabel;
            truth.trials.push_back({seen.fabrics[static_cast<std::size_t>(list[at].fabric)],
                                    isCaught ? catchTrialId().value : "K" + std::to_string(list[at].label),
                                    list[at].anchor == AnchorKind::None ? std::string() : nameOf(list[at].anchor)});
        }
    }
    const auto guesses = study::leaks::guessesOfRemovals(seen, truth);
    return guesses.empty() ? Guess{} : guesses.front();
}

/// As formerly: catch trials are put into a finished list, each between two presentations with other pieces.
Design putIntoFinishedLists(const Protocol& protocol, std::uint64_t seed)
{
    Random random(seed);
    const StudySize size{protocol.participants, static_cast<int>(protocol.conditions.size()), protocol.fabricCount};
    Design design;
    for (const auto& order : drawRunningOrders(size, FabricOrder::Even, random)) {
        auto& list = design.participants.emplace_back();
        for (const auto& [label, fabric] : order) list.push_back({0, label, fabric, {fabric}});
        std::vector<int> pieces;
        for (int piece = 0; piece < size.fabrics; ++piece) pieces.push_back(piece);
        random.shuffle(pieces);
        for (int i = 0; i < protocol.phases[0].catchTrials; ++i) {
            const int piece = pieces[static_cast<std::size_t>(i)];
            std::size_t at = 0;
            do at = 1 + random.below(list.size() - 1);
            while (list[at - 1].fabric == piece || list[at].fabric == piece);
            list.insert(list.begin() + static_cast<std::ptrdiff_t>(at), {0, catchTrialLabel, piece, {piece}});
        }
    }
    return design;
}

}  // namespace

class RemovalSearchTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// Formerly the search named 80 to 94 % of a few additional presentations.
    void noRemovalThatLeavesEvenOrdersNamesAnAdditionalPresentation_data()
    {
        QTest::addColumn<QString>("others");
        QTest::addColumn<int>("participants");
        QTest::addColumn<int>("fabrics");
        const QString scale = R"("scale": {"min": 0, "max": 10}, )";
        QTest::newRow("catch trials") << scale + R"("catch_trials": 3)" << 6 << 7;
        QTest::newRow("mismatched") << scale + R"("anchors": {"mismatched": 3})" << 6 << 7;
        QTest::newRow("as many as fabrics") << scale + R"("catch_trials": 7)" << 6 << 7;
        QTest::newRow("as many as fabrics, few conditions") << scale + R"("catch_trials": 5)" << 8 << 5;
        QTest::newRow("repetitions") << scale + R"("anchors": {"repeated": 3})" << 6 << 7;
        QTest::newRow("one participant") << scale + R"("catch_trials": 2)" << 1 << 5;
        QTest::newRow("same or different") << R"("same_different": true, "catch_trials": 3)" << 6 << 7;
    }

    void noRemovalThatLeavesEvenOrdersNamesAnAdditionalPresentation()
    {
        QFETCH(QString, others);
        QFETCH(int, participants);
        QFETCH(int, fabrics);
        const Protocol protocol = fabrics == 5 ? withFewOthers(others.toStdString(), participants, 5, R"("v_grey", "f", "h")")
                                               : withFewOthers(others.toStdString(), participants, fabrics);
        double hits = 0, named = 0, expected = 0, variance = 0;
        for (std::uint64_t seed = 1; seed <= (participants == 1 ? 100 : 12); ++seed) {
            const Guess guess = foundByRemovals(drawDesign(protocol, seed), protocol);
            QVERIFY(guess.trials > 0);
            const auto trials = static_cast<double>(guess.trials);
            hits += static_cast<double>(guess.hits);
            named += trials;
            expected += guess.chance * trials;
            variance += guess.chance * (1 - guess.chance) * trials;
        }
        qInfo("%.1f %% of %.0f, chance %.1f %%", 100 * hits / named, named, 100 * expected / named);
        QVERIFY(std::abs(hits - expected) < 4 * std::sqrt(variance));
    }

    /// A repetition comes a block later, so that the last presentation of a piece is one more often: a price of the distance.
    void aRepetitionIsLate()
    {
        const Protocol protocol = withFewOthers(R"("scale": {"min": 0, "max": 10}, "anchors": {"repeated": 3})");
        int named = 0, hits = 0;
        for (std::uint64_t seed = 1; seed <= 40; ++seed)
            for (const auto& list : drawDesign(protocol, seed).participants)
                for (int piece = 0; piece < protocol.fabricCount; ++piece) {
                    std::vector<DesignTrial> own;
                    std::ranges::copy_if(list, std::back_inserter(own),
                                         [&](const DesignTrial& trial) { return trial.alternatives.front() == piece; });
                    if (own.size() == 4) continue;
                    ++named;
                    hits += own.back().anchor == AnchorKind::Repeated;
                }
        QCOMPARE(named, 40 * 6 * 3);
        qInfo("the last of a piece: %.1f %% of %d, chance of the count 20 %%", 100.0 * hits / named, named);
        QVERIFY(hits < 0.6 * named);
    }

    void presentationsPutIntoFinishedListsAreSeenThrough_data()
    {
        QTest::addColumn<int>("caught");
        QTest::addColumn<double>("most");
        QTest::newRow("a few") << 3 << study::leaks::alpha / 500;  // a report has a few hundred guessers
        QTest::newRow("as many as fabrics") << 7 << 0.001;
    }

    void presentationsPutIntoFinishedListsAreSeenThrough()
    {
        QFETCH(int, caught);
        QFETCH(double, most);
        const Protocol protocol = withFewOthers(R"("scale": {"min": 0, "max": 10}, "catch_trials": )" + std::to_string(caught));
        const Guess guess = foundByRemovals(putIntoFinishedLists(protocol, 1), protocol);
        qInfo("%lld of %lld, chance %.1f %%, p %.2g", guess.hits, guess.trials, 100 * guess.chance, guess.p);
        QVERIFY(guess.p < most);
    }
};

QTEST_APPLESS_MAIN(RemovalSearchTest)
#include "removal_search_test.moc"
