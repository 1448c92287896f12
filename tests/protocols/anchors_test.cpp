// Anchor trials: what a protocol may ask for, where they stand in the running orders, and how the key recognises them.
#include <QTest>
#include <cmath>
#include <map>
#include <set>

#include "protocols/orders/allocation.h"
#include "protocols/orders/counterbalancing.h"
#include "protocols/protocol_json.h"
#include "protocols/records/anchor_trials.h"
#include "protocols/records/balance.h"

using namespace protocols;

namespace {

std::string protocolWith(const std::string& anchors, const std::string& conditions = R"("v_grey", "f", "h", "h&f")",
                         int fabrics = 5)
{
    return R"({"schema": "vis2hap.protocol/1", "name": "Anchored", "participants": 6, "fabrics": )" + std::to_string(fabrics) +
           R"(, "conditions": [)" + conditions + R"(], "break_after": 6,
               "phases": [{"questions": ["Q1"], "alternatives": 2, "anchors": {"repeated": 3}},
                          {"questions": ["Q2"], "scale": {"min": 0, "max": 10}, "catch_trials": 2)" +
           anchors + "}]}";
}

constexpr const char* both = R"(, "anchors": {"mismatched": 4, "repeated": 5})";

Protocol anchored(const std::string& anchors = both) { return protocolFromJson(protocolWith(anchors), "test"); }

std::string faultsIn(const std::string& json)
{
    try {
        protocolFromJson(json, "test");
    } catch (const std::exception& fault) {
        return fault.what();
    }
    return "";
}

std::vector<FabricId> fabricIds(int count)
{
    std::vector<FabricId> ids;
    for (int i = 1; i <= count; ++i) ids.emplace_back("F" + std::to_string(i));
    return ids;
}

/// Place of the presentation that `list[at]` repeats.
std::size_t originalOf(const std::vector<DesignTrial>& list, std::size_t at)
{
    for (std::size_t i = 0; i < at; ++i)
        if (list[i].phase == list[at].phase && list[i].label == list[at].label && list[i].fabric == list[at].fabric) return i;
    return at;
}

int spreadOf(const std::map<int, int>& counts, int kinds)
{
    int least = static_cast<int>(counts.size()) < kinds ? 0 : counts.begin()->second, most = 0;
    for (const auto& [kind, count] : counts) {
        least = std::min(least, count);
        most = std::max(most, count);
    }
    return most - least;
}

}  // namespace

class AnchorsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void countsBelongToTheSession()
    {
        const Protocol protocol = anchored();
        QVERIFY(hasAnchors(protocol));
        QCOMPARE(protocol.phases[1].anchors.mismatched, 4);
        QCOMPARE(protocol.presentationsPerPhase(), 20);
        QCOMPARE(protocol.presentations(), 20 + 3 + 20 + 2 + 4 + 5);
        QCOMPARE(protocol.answersPerParticipant(), protocol.presentations());
        for (const auto& list : drawDesign(protocol, 1).participants)
            QCOMPARE(static_cast<int>(list.size()), protocol.presentations());
        QVERIFY(!hasAnchors(protocolFromJson(paperProtocolJson(), "paper")));
    }

    // A script answers a mismatched image once, so an image that came twice could not be replayed.
    void noParticipantFeelsAMismatchedImageTwice()
    {
        const Protocol protocol = anchored();
        for (std::uint64_t seed = 1; seed <= 20; ++seed)
            for (const auto& list : drawDesign(protocol, seed).participants) {
                std::set<int> images;
                for (const DesignTrial& trial : list)
                    if (trial.label == mismatchedLabel) QVERIFY(images.insert(trial.fabric).second);
                QCOMPARE(images.size(), std::size_t(4));
            }
    }

    void theBestMeasuredConditionIsTheReference_data()
    {
        QTest::addColumn<QString>("conditions");
        QTest::addColumn<QString>("anchors");
        QTest::addColumn<QString>("reference");
        const QString some = R"(, "anchors": {"mismatched": 1})";
        QTest::newRow("both signals") << R"("v_grey", "f", "h&f", "h")" << some << "h&f";
        QTest::newRow("height before friction") << R"("f", "h", "h_g")" << some << "h";
        QTest::newRow("the best quality") << R"("h@fast", "h@accurate", "f")" << some << "h@accurate";
        QTest::newRow("a named one") << R"("v_grey", "h&f")"
                                     << R"(, "anchors": {"mismatched": 1, "condition": "v_grey"})"
                                     << "v_grey";
        QTest::newRow("the name of files") << R"("v_grey", "h&f")"
                                           << R"(, "anchors": {"mismatched": 1, "condition": "h+f"})"
                                           << "h&f";
    }

    void theBestMeasuredConditionIsTheReference()
    {
        QFETCH(QString, conditions);
        QFETCH(QString, anchors);
        QFETCH(QString, reference);
        const Protocol protocol = protocolFromJson(protocolWith(anchors.toStdString(), conditions.toStdString()), "test");
        QCOMPARE(QString::fromStdString(anchorConditionOf(protocol, protocol.phases[1].anchors).value), reference);
    }

    void everyImpossibleAnchorIsNamed_data()
    {
        QTest::addColumn<QString>("json");
        QTest::addColumn<QString>("fault");
        const auto row = [](const char* name, const std::string& json, const char* fault) {
            QTest::newRow(name) << QString::fromStdString(json) << fault;
        };
        row("too many mismatched", protocolWith(R"(, "anchors": {"mismatched": 21})"),
            "phases[1].anchors.mismatched: 21, expected 0 to 20, the presentations of the phase");
        row("too many repeated", protocolWith(R"(, "anchors": {"repeated": 21})"),
            "phases[1].anchors.repeated: 21, expected 0 to 20");
        row("below 0", protocolWith(R"(, "anchors": {"repeated": -1})"),
            "phases[1].anchors.repeated: -1, expected a whole number");
        row("an unknown key", protocolWith(R"(, "anchors": {"floor": 1})"), "phases[1].anchors: unknown key 'floor'");
        row("no number", protocolWith(R"(, "anchors": {"mismatched": "four"})"), "phases[1].anchors.mismatched: \"four\"");
        row("a condition of another study", protocolWith(R"(, "anchors": {"mismatched": 1, "condition": "t_grey"})"),
            "phases[1].anchors.condition: 't_grey' is not among the conditions");
        row("nothing measured", protocolWith(R"(, "anchors": {"mismatched": 1})", R"("v_grey", "h_g")"),
            "phases[1].anchors.condition: is missing, expected one of the protocol's conditions");
        row("one fabric",
            R"({"schema": "vis2hap.protocol/1", "name": "a", "participants": 1, "fabrics": 1, "conditions": ["h", "f"],
                "phases": [{"questions": ["Q2"], "scale": {"min": 0, "max": 10}, "anchors": {"mismatched": 1}}]})",
            "phases[0].anchors.mismatched: 1, expected 0: the study has one fabric");
        row("one presentation",
            R"({"schema": "vis2hap.protocol/1", "name": "a", "participants": 1, "fabrics": 1, "conditions": ["h"],
                "phases": [{"questions": ["Q2"], "scale": {"min": 0, "max": 10}, "anchors": {"repeated": 1}}]})",
            "phases[0].anchors.repeated: 1, expected 0: the phase has one presentation");
        row("a choice",
            R"({"schema": "vis2hap.protocol/1", "name": "a", "participants": 1, "fabrics": 3, "conditions": ["h"],
                "phases": [{"questions": ["Q1"], "alternatives": 3, "anchors": {"mismatched": 1}}]})",
            "phases[0].anchors.mismatched: 1, expected 0: only a phase with a scale");
    }

    void everyImpossibleAnchorIsNamed()
    {
        QFETCH(QString, json);
        QFETCH(QString, fault);
        const QString told = QString::fromStdString(faultsIn(json.toStdString()));
        QVERIFY2(told.contains(fault), qPrintable(told));
        QVERIFY2(told.contains("1 fault"), qPrintable(told));
    }

    void anchorsLeaveTheOtherChoicesWhereTheyWere()
    {
        const Protocol with = anchored();
        Protocol without = with;
        for (Phase& phase : without.phases) phase.anchors = {};
        Design design = drawDesign(with, 5), plain = drawDesign(without, 5);
        for (auto* one : {&design, &plain})
            for (auto& list : one->participants) {
                std::set<std::pair<int, int>> rated;
                for (const DesignTrial& trial : list)
                    if (trial.phase == 1 && trial.anchor == AnchorKind::None && trial.label >= 0)
                        QVERIFY(rated.emplace(trial.label, trial.fabric).second);
                QCOMPARE(rated.size(), 20u);
                std::erase_if(list, [](const DesignTrial& trial) {
                    return trial.phase == 1 || trial.anchor != AnchorKind::None || trial.label == catchTrialLabel;
                });
                // Foils of choices are drawn for all presentations together.
                for (DesignTrial& trial : list) trial.alternatives.clear();
            }
        QVERIFY(design == plain);
        QVERIFY(drawDesign(with, 5) == drawDesign(with, 5));
        QVERIFY(drawDesign(with, 5) != drawDesign(with, 6));
    }

    /// Conditions follow the pieces, and stay as even as without anchors.
    void conditionsStayEvenBesideAnchors()
    {
        const Protocol protocol = anchored();
        for (const std::uint64_t seed : {1, 2, 3}) {
            const BalanceCertificate certificate = balanceOf(drawDesign(protocol, seed), protocol);
            QCOMPARE(certificate.immediateRepeats, 0);
            for (const auto& range : certificate.ranges) {
                if (range.what == "presentations of a rendering per participant, Q2")
                    QCOMPARE(std::pair(range.min, range.max), std::pair(1, 1));
                if (range.what.starts_with("ordered pairs of")) QVERIFY2(range.max - range.min <= 2, range.what.c_str());
            }
        }
    }

    void aRepetitionStandsInAnotherBlock()
    {
        const Protocol protocol = anchored();
        for (const std::uint64_t seed : {1, 2, 3, 4})
            for (const auto& list : drawDesign(protocol, seed).participants) {
                std::set<std::size_t> originals;
                for (std::size_t at = 0; at < list.size(); ++at) {
                    if (list[at].anchor != AnchorKind::Repeated) continue;
                    const std::size_t first = originalOf(list, at);
                    QVERIFY(first < at && list[first].anchor == AnchorKind::None);
                    QVERIFY(at - first > static_cast<std::size_t>(protocol.breakAfterPresentations));
                    QVERIFY(originals.insert(first).second);  // none comes a third time
                    // A choice comes again beside other foils, as any other does: the same pieces would name it.
                    if (list[at].phase == 1) QCOMPARE(list[at].alternatives, list[first].alternatives);
                    QVERIFY(std::ranges::find(list[at].alternatives, list[at].fabric) != list[at].alternatives.end());
                    QVERIFY(list[at - 1].label != list[at].label);
                    const bool hasNext = at + 1 < list.size() && list[at + 1].phase == list[at].phase;
                    QVERIFY(!hasNext || list[at + 1].label != list[at].label);
                }
                QCOMPARE(originals.size(), 3u + 5u);
            }
    }

    /// With one condition a piece has one original, which must stand early enough for its repetition.
    void aRepetitionKeepsItsDistanceWithFewConditions_data()
    {
        QTest::addColumn<int>("fabrics");
        QTest::addColumn<QString>("conditions");
        QTest::addColumn<int>("caught");
        QTest::addColumn<int>("repeated");
        QTest::addColumn<QString>("answer");
        const QString choice = QStringLiteral(R"("alternatives": 3)"),
                      rating = QStringLiteral(R"("scale": {"min": 0, "max": 10})");
        QTest::newRow("one condition") << 8 << R"("h")" << 0 << 3 << choice;
        QTest::newRow("one condition and a catch trial") << 6 << R"("h")" << 1 << 1 << choice;
        QTest::newRow("two conditions") << 6 << R"("h", "f")" << 1 << 2 << choice;
        QTest::newRow("ratings of one condition") << 9 << R"("h")" << 0 << 5 << rating;
        QTest::newRow("ratings of two conditions") << 6 << R"("h", "f")" << 1 << 2 << rating;
    }

    void aRepetitionKeepsItsDistanceWithFewConditions()
    {
        QFETCH(int, fabrics);
        QFETCH(QString, conditions);
        QFETCH(int, caught);
        QFETCH(int, repeated);
        QFETCH(QString, answer);
        const QString json = QStringLiteral(R"({"schema": "vis2hap.protocol/1", "name": "a", "participants": 8, "fabrics": %1,
            "conditions": [%2], "phases": [{"questions": ["Q1"], %5, "catch_trials": %3,
            "anchors": {"repeated": %4}}]})")
                                 .arg(fabrics)
                                 .arg(conditions)
                                 .arg(caught)
                                 .arg(repeated)
                                 .arg(answer);
        const Protocol protocol = protocolFromJson(json.toStdString(), "test");
        const auto distance =
            static_cast<std::size_t>(std::min(protocol.breakAfterPresentations + 1, (protocol.presentations() - repeated) / 2));
        for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6})
            for (const auto& list : drawDesign(protocol, seed).participants) {
                std::map<int, int> pieces;
                for (std::size_t at = 0; at < list.size(); ++at) {
                    if (list[at].label < 0 || list[at].anchor != AnchorKind::None) ++pieces[list[at].fabric];
                    if (list[at].anchor == AnchorKind::Repeated) QVERIFY(at - originalOf(list, at) >= distance);
                }
                QVERIFY2(spreadOf(pieces, fabrics) <= 1, "pieces of additional presentations");
            }
        if (answer.contains("scale"))
            for (const auto& range : balanceOf(drawDesign(protocol, 1), protocol).ranges)
                if (range.what.starts_with("ordered pairs of fabrics")) QVERIFY2(range.max - range.min <= 3, range.what.c_str());
    }

    /// Formerly the last trial was a repetition in 53 to 91 % of the lists, and the second a catch trial in 65 %.
    void eachPlaceIsEquallyLikely_data()
    {
        QTest::addColumn<QString>("phase");
        QTest::addColumn<QString>("conditions");
        QTest::newRow("one condition") << R"("alternatives": 3, "catch_trials": 2, "anchors": {"repeated": 2})"
                                       << R"("h")";
        QTest::newRow("two conditions") << R"("scale": {"min": 0, "max": 10}, "catch_trials": 4, "anchors": {"repeated": 2})"
                                        << R"("h", "f")";
        QTest::newRow("three conditions") << R"("alternatives": 2, "catch_trials": 3, "anchors": {"repeated": 3})"
                                          << R"("v_grey", "h", "f")";
    }

    void eachPlaceIsEquallyLikely()
    {
        QFETCH(QString, phase);
        QFETCH(QString, conditions);
        const QString json = QStringLiteral(R"({"schema": "vis2hap.protocol/1", "name": "a", "participants": 8, "fabrics": 6,
            "conditions": [%1], "break_after": 10, "phases": [{"questions": ["Q1"], %2}]})")
                                 .arg(conditions, phase);
        const Protocol protocol = protocolFromJson(json.toStdString(), "test");
        const Phase& asked = protocol.phases.front();
        const int length = protocol.presentations(), others = length - asked.anchors.repeated, gap = std::min(11, others / 2);
        int last = 0, second = 0, lists = 0;
        for (std::uint64_t seed = 1; seed <= 20; ++seed)
            for (const auto& list : drawDesign(protocol, seed).participants) {
                last += list.back().anchor == AnchorKind::Repeated;
                second += list[1].label == catchTrialLabel;
                ++lists;
            }
        const auto isNear = [&](int count, double share) {
            return std::abs(count - share * lists) < 4 * std::sqrt(share * (1 - share) * lists);
        };
        QVERIFY2(isNear(last, static_cast<double>(asked.anchors.repeated) / (length - gap)), qPrintable(QString::number(last)));
        QVERIFY2(isNear(second, static_cast<double>(asked.catchTrials) / (others - 1)), qPrintable(QString::number(second)));
    }

    void anotherFabricLiesOnTheTrayOfAMismatch()
    {
        const Design design = drawDesign(anchored(), 5);
        std::map<int, int> images, pairs;
        for (const auto& list : design.participants) {
            QVERIFY(list.front().anchor == AnchorKind::None);
            for (std::size_t at = 1; at < list.size(); ++at) {
                if (list[at].anchor != AnchorKind::Mismatched) continue;
                QCOMPARE(list[at].phase, 1);
                QCOMPARE(list[at].alternatives.size(), 1u);
                QVERIFY(list[at].alternatives.front() != list[at].fabric);
                ++images[list[at].fabric];
                ++pairs[list[at].fabric * 5 + list[at].alternatives.front()];
            }
        }
        QVERIFY2(spreadOf(images, 5) <= 1, "24 mismatched presentations of 5 images");
        QVERIFY2(spreadOf(pairs, 20) <= 2, "24 mismatched presentations of 20 pairs");
    }

    void repetitionsAreEvenOverConditionsAndFabrics()
    {
        std::map<int, int> labels, fabrics;
        for (const auto& list : drawDesign(anchored(), 9).participants)
            for (const DesignTrial& trial : list)
                if (trial.anchor == AnchorKind::Repeated && trial.phase == 1) {
                    ++labels[trial.label];
                    ++fabrics[trial.fabric];
                }
        QVERIFY2(spreadOf(labels, 4) <= 2, "30 repetitions of 4 conditions");
        QVERIFY2(spreadOf(fabrics, 5) <= 3, "30 repetitions of 5 fabrics");
    }

    void evenTheSmallestAndTheFullestListHaveAPlaceForEach_data()
    {
        QTest::addColumn<int>("fabrics");
        QTest::addColumn<QString>("conditions");
        QTest::addColumn<int>("mismatched");
        QTest::addColumn<int>("repeated");
        QTest::newRow("two presentations") << 2 << R"("h")" << 2 << 2;
        QTest::newRow("every one twice") << 3 << R"("h", "f")" << 6 << 6;
        QTest::newRow("one fabric") << 1 << R"("h", "f")" << 0 << 2;
    }

    void evenTheSmallestAndTheFullestListHaveAPlaceForEach()
    {
        QFETCH(int, fabrics);
        QFETCH(QString, conditions);
        QFETCH(int, mismatched);
        QFETCH(int, repeated);
        const QString json = QStringLiteral(R"({"schema": "vis2hap.protocol/1", "name": "a", "participants": 4, "fabrics": %1,
            "conditions": [%2], "phases": [{"questions": ["Q2"], "scale": {"min": 0, "max": 10},
            "anchors": {"mismatched": %3, "repeated": %4}}]})")
                                 .arg(fabrics)
                                 .arg(conditions)
                                 .arg(mismatched)
                                 .arg(repeated);
        const Protocol protocol = protocolFromJson(json.toStdString(), "test");
        for (const std::uint64_t seed : {1, 2, 3, 4, 5})
            for (const auto& list : drawDesign(protocol, seed).participants) {
                QCOMPARE(static_cast<int>(list.size()), protocol.presentations());
                for (std::size_t at = 0; at < list.size(); ++at)
                    if (list[at].anchor == AnchorKind::Repeated) QVERIFY(at - originalOf(list, at) >= 2);
            }
    }

    void theKeyFindsThemAgain()
    {
        const Protocol protocol = anchored();
        const Design design = drawDesign(protocol, 3);
        const Allocation allocation = allocate(protocol, design, fabricIds(5), SecretKey::ofSeed(4));
        for (std::size_t person = 0; person < design.participants.size(); ++person) {
            AnchorFinder finder(protocol);
            std::set<std::string> presentationCodes, sealedCodes;
            for (std::size_t at = 0; at < design.participants[person].size(); ++at) {
                const BlindedTrial& trial = allocation.participants[person][at];
                const auto& shown = allocation.key.entryOf(trial);
                QVERIFY(finder.next(trial, shown) == design.participants[person][at].anchor);
                if (design.participants[person][at].anchor == AnchorKind::Mismatched)
                    QCOMPARE(shown.condition, ConditionId("h&f"));
                // A repetition has codes of its own.
                QVERIFY(presentationCodes.insert(trial.presentationCode.value).second);
                QVERIFY(sealedCodes.insert(trial.sealedCode.value).second);
            }
        }
    }

    void withoutAnchorsNoPresentationIsOne()
    {
        Protocol protocol = anchored();
        const Allocation allocation = allocate(protocol, drawDesign(protocol, 3), fabricIds(5), SecretKey::ofSeed(4));
        for (Phase& phase : protocol.phases) phase.anchors = {};
        AnchorFinder finder(protocol);
        for (const BlindedTrial& trial : allocation.participants[0])
            QVERIFY(finder.next(trial, allocation.key.entryOf(trial)) == AnchorKind::None);
    }

    void anchorsCannotChangeLater()
    {
        const Protocol kept = anchored();
        Protocol changed = kept;
        changed.phases[1].anchors.mismatched = 3;
        QCOMPARE(fixedPartsChanged(kept, changed), std::vector<std::string>{"phases"});
        // Repetitions lie a block after their originals.
        changed = kept;
        ++changed.breakAfterPresentations;
        QCOMPARE(fixedPartsChanged(kept, changed), std::vector<std::string>{"break_after"});
        Protocol plain = kept;
        for (Phase& phase : plain.phases) phase.anchors.repeated = 0;
        changed = plain;
        ++changed.breakAfterPresentations;
        QVERIFY(fixedPartsChanged(plain, changed).empty());
    }

    void kindsHaveNames()
    {
        for (const AnchorKind kind : {AnchorKind::Mismatched, AnchorKind::Repeated})
            QVERIFY(anchorKindNamed(nameOf(kind)) == kind);
        QVERIFY(!anchorKindNamed(""));
        QVERIFY(!anchorKindNamed("catch"));
    }
};

QTEST_APPLESS_MAIN(AnchorsTest)
#include "anchors_test.moc"
