// Same/different trays and catch trials are balanced, and nothing but their number tells catch trials.
#include "protocols/orders/extra_trials.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "protocols/condition.h"
#include "protocols/orders/allocation.h"
#include "protocols/protocol_json.h"
#include "protocols/records/balance.h"
#include "protocols/records/key_json.h"
#include "tests/support/error_text.h"

using namespace protocols;

namespace {

Protocol sameDifferentProtocol(int participants, int fabrics)
{
    Protocol protocol = protocolFromJson(paperProtocolJson(), "paper");
    protocol.participants = participants;
    protocol.fabricCount = fabrics;
    Phase phase;
    phase.task = SameDifferent{};
    phase.questions = {{QuestionId("S1"), "Is it the same fabric?", phase.task}};
    protocol.phases = {phase};
    return protocol;
}

int spreadOf(const std::map<int, int>& counts)
{
    int least = counts.begin()->second, most = least;
    for (const auto& [key, count] : counts) {
        least = std::min(least, count);
        most = std::max(most, count);
    }
    return most - least;
}

/// Without the foils, which are drawn for all presentations together.
std::vector<DesignTrial> ofChoices(std::vector<DesignTrial> trials)
{
    std::erase_if(trials, [](const DesignTrial& trial) { return trial.phase != 0; });
    for (DesignTrial& trial : trials) trial.alternatives.clear();
    return trials;
}

Protocol withCatchTrials(int count)
{
    Protocol protocol = protocolFromJson(paperProtocolJson(), "paper");
    for (Phase& phase : protocol.phases) phase.catchTrials = count;
    return protocol;
}

/// Codes of the pieces of a study whose lists are empty. Lists take no part in the draw.
std::vector<SwatchLabels> swatchesOf(bool fresh, int participants, int fabrics)
{
    Protocol protocol = protocolFromJson(paperProtocolJson(), "paper");
    protocol.swatchCodes = fresh ? SwatchCodes::PerParticipant : SwatchCodes::Once;
    protocol.fabricCount = fabrics;
    std::vector<FabricId> ids;
    for (int i = 1; i <= fabrics; ++i) ids.emplace_back("F" + std::to_string(1000 + i));
    Design design;
    design.participants.resize(static_cast<std::size_t>(participants));
    return allocate(protocol, design, ids, SecretKey::ofSeed(2)).swatches;
}

}  // namespace

class ExtraTrialsTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void halfOfTheTraysHoldTheSameFabric_data()
    {
        QTest::addColumn<int>("participants");
        QTest::addColumn<int>("fabrics");
        QTest::newRow("the paper's size") << 10 << 7;
        QTest::newRow("even fabrics") << 9 << 8;
        QTest::newRow("three fabrics") << 6 << 3;
        QTest::newRow("two fabrics") << 5 << 2;
    }

    void halfOfTheTraysHoldTheSameFabric()
    {
        QFETCH(int, participants);
        QFETCH(int, fabrics);
        const Protocol protocol = sameDifferentProtocol(participants, fabrics);
        const Design design = drawDesign(protocol, 3);
        const int labels = static_cast<int>(protocol.conditions.size());
        std::map<int, int> ofCell, ofPersonAndLabel, ofPersonAndFabric, others, ofPersonAndPiece;
        for (std::size_t person = 0; person < design.participants.size(); ++person)
            for (const DesignTrial& trial : design.participants[person]) {
                QCOMPARE(trial.alternatives.size(), 1u);
                const int same = trial.alternatives[0] == trial.fabric;
                ofCell[trial.label * fabrics + trial.fabric] += same;
                ofPersonAndLabel[static_cast<int>(person) * labels + trial.label] += same;
                ofPersonAndFabric[static_cast<int>(person) * fabrics + trial.fabric] += same;
                ++ofPersonAndPiece[static_cast<int>(person) * fabrics + trial.alternatives[0]];
                if (!same) ++others[trial.fabric * fabrics + trial.alternatives[0]];
            }
        QCOMPARE(ofPersonAndPiece.size(), static_cast<std::size_t>(participants * fabrics));
        // With two fabrics and nine labels one piece lies on ten trays and the other on eight, half of each the same.
        QCOMPARE(spreadOf(ofPersonAndPiece), fabrics == 2 ? 2 : 0);
        QVERIFY(spreadOf(ofCell) <= 1);
        QVERIFY(spreadOf(ofPersonAndLabel) <= 1);
        QVERIFY(spreadOf(ofPersonAndFabric) <= 1);
        for (int fabric = 0; fabric < fabrics; ++fabric) {
            std::map<int, int> ofFabric;
            for (const auto& [pair, count] : others)
                if (pair / fabrics == fabric) ofFabric[pair] = count;
            // With three fabrics few arrangements are left that repeat no fabric.
            QVERIFY(fabrics == 3 || spreadOf(ofFabric) <= 1);
        }
    }

    /// Formerly somebody with two fabrics and one condition got only "same", or none.
    void nobodyGetsMoreSameThanAnother_data()
    {
        QTest::addColumn<int>("participants");
        QTest::addColumn<int>("conditions");
        QTest::addColumn<int>("fabrics");
        QTest::newRow("one participant, one condition, two fabrics") << 1 << 1 << 2;
        QTest::newRow("one condition, two fabrics") << 4 << 1 << 2;
        QTest::newRow("one condition, three fabrics") << 6 << 1 << 3;
        QTest::newRow("three conditions, two fabrics") << 4 << 3 << 2;
        QTest::newRow("one participant, three conditions, three fabrics") << 1 << 3 << 3;
    }

    void nobodyGetsMoreSameThanAnother()
    {
        QFETCH(int, participants);
        QFETCH(int, conditions);
        QFETCH(int, fabrics);
        Protocol protocol = sameDifferentProtocol(participants, fabrics);
        protocol.conditions.resize(static_cast<std::size_t>(conditions));
        const int presentations = conditions * fabrics, half = presentations / 2;
        std::set<int> counts;
        for (std::uint64_t seed = 1; seed <= 12; ++seed)
            for (const auto& list : drawDesign(protocol, seed).participants) {
                std::set<std::pair<int, int>> shown;
                int same = 0;
                for (const DesignTrial& trial : list) {
                    shown.emplace(trial.label, trial.fabric);
                    same += trial.alternatives.front() == trial.fabric;
                }
                QCOMPARE(static_cast<int>(shown.size()), presentations);
                QVERIFY2(same == half || same == presentations - half, qPrintable(QString::number(same)));
                counts.insert(same);
            }
        // Whether the odd one is the same is drawn.
        QCOMPARE(static_cast<int>(counts.size()), 1 + presentations % 2);
    }

    void catchTrialsLeaveTheOtherChoicesWhereTheyWere()
    {
        const Design plain = drawDesign(withCatchTrials(0), 5), with = drawDesign(withCatchTrials(4), 5);
        for (std::size_t person = 0; person < plain.participants.size(); ++person) {
            std::vector<DesignTrial> rest, caught;
            for (const DesignTrial& trial : with.participants[person])
                (trial.label == catchTrialLabel ? caught : rest).push_back(trial);
            QCOMPARE(ofChoices(rest), ofChoices(plain.participants[person]));
            QCOMPARE(rest.size(), plain.participants[person].size());
            QCOMPARE(caught.size(), 8u);
        }
        const BalanceCertificate balance = balanceOf(with, withCatchTrials(4)),
                                 plainBalance = balanceOf(plain, withCatchTrials(0));
        // The operator lays the pieces of catch trials, too.
        QVERIFY(balance.handling != plainBalance.handling);
        QCOMPARE(balance.immediateRepeats, 0);
        QCOMPARE(balance.repeatedFoilPairs, 0);
        // Foils are drawn for all presentations together, so that those of the conditions alone are a little less even.
        for (std::size_t i = 0; i < balance.ranges.size(); ++i) {
            const auto &range = balance.ranges[i], &plainRange = plainBalance.ranges[i];
            QCOMPARE(range.what, plainRange.what);
            // The trays of a piece do not go into three slots here, so that evener true slots would tell.
            const bool isOfFabric = range.what.starts_with("true slots per participant and fabric");
            const bool isOfStretch = range.what.find("per stretch of the order, Q2") != std::string::npos;
            const int slack = range.what.find("foil") != std::string::npos ? 3 : isOfFabric || isOfStretch ? 1 : 0;
            // 10 x (63 + 4 - 1) pairs of pieces in place of 10 x 62.
            const int more = range.what.starts_with("ordered pairs of fabrics") ? 1 : 0;
            QVERIFY2(range.min >= plainRange.min - slack && range.max <= plainRange.max + slack + more, range.what.c_str());
        }
    }

    /// Formerly presentations were put into a finished list. Whoever tried which ones leave an even list named up to 94 % of
    /// them.
    void whereAPieceLiesOnceMoreOnlyTheCountTells_data()
    {
        QTest::addColumn<bool>("isRating");
        QTest::newRow("ratings") << true;
        QTest::newRow("same or different") << false;
    }

    void whereAPieceLiesOnceMoreOnlyTheCountTells()
    {
        QFETCH(bool, isRating);
        Protocol protocol = sameDifferentProtocol(6, 7);
        protocol.conditions.resize(4);
        if (isRating) protocol.phases[0].task = protocol.phases[0].questions[0].kind = Rating{};
        protocol.phases[0].catchTrials = 7;
        std::map<int, int> caughtAt;
        std::map<std::pair<int, int>, int> pairs;
        int pieces = 0;
        for (std::uint64_t seed = 1; seed <= 30; ++seed)
            for (const auto& list : drawDesign(protocol, seed).participants) {
                std::map<int, int> lain;
                for (std::size_t at = 0; at < list.size(); ++at) {
                    const int piece = list[at].alternatives.front();
                    if (list[at].label == catchTrialLabel) ++caughtAt[lain[piece]];
                    ++lain[piece];
                    if (at == 0) continue;
                    QVERIFY(list[at - 1].alternatives.front() != piece);
                    if (seed == 1) ++pairs[{list[at - 1].alternatives.front(), piece}];
                }
                for (const auto& [piece, count] : lain) QCOMPARE(count, 5);
                pieces += 7;
            }
        // Of each piece the first to the fifth presentation alike; only the first of the list is never additional.
        for (int place = 0; place < 5; ++place) {
            const double share = static_cast<double>(caughtAt[place]) / pieces;
            QVERIFY2(std::abs(share - 0.2) < 0.05, qPrintable(QString("%1: %2").arg(place + 1).arg(share)));
        }
        std::map<int, int> counts;
        for (const auto& [pair, count] : pairs) counts[pair.first * 7 + pair.second] = count;
        QCOMPARE(counts.size(), 42u);
        QVERIFY2(spreadOf(counts) <= 1, "pairs of pieces, with those of catch trials");
    }

    /// A catch trial looks like the rest also when its pieces are counted: 63 + 7 trays of three pieces are 30 for each.
    void piecesOfCatchTrialsLieThereAsOftenAsTheOthers()
    {
        const Protocol protocol = withCatchTrials(7);
        for (const auto& trials : drawDesign(protocol, 5).participants) {
            std::map<int, int> ofChoices, ofRatings;
            for (const DesignTrial& trial : trials)
                for (const int piece : trial.alternatives) ++(trial.phase == 0 ? ofChoices : ofRatings)[piece];
            QCOMPARE(spreadOf(ofChoices), 0);
            QCOMPARE(spreadOf(ofRatings), 0);
        }
    }

    void aCatchTrialLooksLikeAnyOther()
    {
        const Protocol protocol = withCatchTrials(3);
        const Design design = drawDesign(protocol, 7);
        for (const auto& trials : design.participants) {
            QVERIFY(trials.front().label != catchTrialLabel);
            for (std::size_t at = 1; at < trials.size(); ++at) {
                if (trials[at].label != catchTrialLabel) continue;
                QCOMPARE(trials[at].alternatives.size(), trials[at].phase == 0 ? 3u : 1u);
                QVERIFY(std::count(trials[at].alternatives.begin(), trials[at].alternatives.end(), trials[at].fabric) == 1);
                QVERIFY(trials[at].fabric != trials[at - 1].fabric);
                if (at + 1 < trials.size()) QVERIFY(trials[at].fabric != trials[at + 1].fabric);
            }
        }
    }

    void theKeyKnowsCatchTrialsAndReadsBack()
    {
        const Protocol protocol = withCatchTrials(2);
        std::vector<FabricId> fabrics;
        for (int i = 1; i <= 7; ++i) fabrics.emplace_back("F0" + std::to_string(i));
        const Allocation allocation = allocate(protocol, drawDesign(protocol, 1), fabrics, SecretKey::ofSeed(2), 3);
        QCOMPARE(allocation.key.entries.size(), 63u + 7u);
        QCOMPARE(allocation.familiarisation.size(), 3u);
        QVERIFY(allocationKeyFromJson(toJson(allocation.key), "key").entries == allocation.key.entries);
        int caught = 0;
        for (const BlindedTrial& trial : allocation.participants[0])
            caught += allocation.key.entryOf(trial).condition == catchTrialId();
        QCOMPARE(caught, 4);
    }

    void swatchCodesAreThreeDigitsAndAllDifferent_data()
    {
        QTest::addColumn<bool>("fresh");
        QTest::newRow("labelled once") << false;
        QTest::newRow("labelled anew") << true;
    }

    void swatchCodesAreThreeDigitsAndAllDifferent()
    {
        QFETCH(bool, fresh);
        Protocol protocol = protocolFromJson(paperProtocolJson(), "paper");
        protocol.swatchCodes = fresh ? SwatchCodes::PerParticipant : SwatchCodes::Once;
        std::vector<FabricId> fabrics;
        for (int i = 1; i <= 7; ++i) fabrics.emplace_back("F0" + std::to_string(i));
        const Allocation allocation = allocate(protocol, drawDesign(protocol, 1), fabrics, SecretKey::ofSeed(2));
        QCOMPARE(allocation.swatches.size(), 10u);
        std::set<std::string> all;
        for (const SwatchLabels& labels : allocation.swatches)
            for (const auto& [fabric, code] : labels) {
                QCOMPARE(code.size(), 3u);
                all.insert(code);
            }
        QCOMPARE(all.size(), fresh ? 70u : 7u);
    }

    void swatchCodesHaveTheDigitsThatTheStudyNeeds_data()
    {
        QTest::addColumn<bool>("fresh");
        QTest::addColumn<int>("participants");
        QTest::addColumn<int>("fabrics");
        QTest::addColumn<int>("digits");
        QTest::newRow("900 codes") << true << 100 << 9 << 3;
        QTest::newRow("901 codes") << true << 901 << 1 << 4;
        QTest::newRow("9000 codes") << true << 1000 << 9 << 4;
        QTest::newRow("9009 codes") << true << 1001 << 9 << 5;
        QTest::newRow("90009 codes") << true << 10001 << 9 << 6;
        QTest::newRow("901 fabrics, labelled once") << false << 2 << 901 << 4;
        QTest::newRow("many participants, labelled once") << false << 1000 << 9 << 3;
    }

    void swatchCodesHaveTheDigitsThatTheStudyNeeds()
    {
        QFETCH(bool, fresh);
        QFETCH(int, participants);
        QFETCH(int, fabrics);
        QFETCH(int, digits);
        const auto drawn = swatchesOf(fresh, participants, fabrics);
        QCOMPARE(drawn.size(), static_cast<std::size_t>(participants));
        std::set<std::string> all;
        for (const SwatchLabels& labels : drawn)
            for (const auto& [fabric, code] : labels) {
                if (code.size() != static_cast<std::size_t>(digits) || code.front() == '0') QFAIL(code.c_str());
                all.insert(code);
            }
        QCOMPARE(all.size(), static_cast<std::size_t>(fresh ? participants * fabrics : fabrics));
    }

    /// A protocol with "swatches": "fresh", 6 fabrics, 2 participants: vis2hap study new (3108c560) --key-seed 2, then
    /// SELECT code FROM swatches ORDER BY slot, fabric
    void swatchCodesOfSmallStudiesAreDrawnAsBefore()
    {
        QStringList codes;
        for (const SwatchLabels& labels : swatchesOf(true, 2, 6))
            for (const auto& [fabric, code] : labels) codes << QString::fromStdString(code);
        QCOMPARE(codes.join(' '), QString("738 472 923 491 808 717 324 175 542 677 384 381"));
    }

    void aPresentationGivenAgainHasACodeOfItsOwn()
    {
        const Protocol protocol = protocolFromJson(paperProtocolJson(), "paper");
        std::vector<FabricId> fabrics;
        for (int i = 1; i <= 7; ++i) fabrics.emplace_back("F0" + std::to_string(i));
        const auto list = allocate(protocol, drawDesign(protocol, 1), fabrics, SecretKey::ofSeed(2)).participants[0];
        std::set<std::string> codes;
        for (const BlindedTrial& trial : list) codes.insert(trial.presentationCode.value);
        QCOMPARE(codeOfAttempt(list, 5, 1), list[5].presentationCode);
        for (int attempt = 2; attempt < 30; ++attempt) {
            const PresentationCode code = codeOfAttempt(list, 5, attempt);
            QCOMPARE(code.value.size(), list[5].presentationCode.value.size());
            QVERIFY(codes.insert(code.value).second);
            QCOMPARE(codeOfAttempt(list, 5, attempt), code);
        }
    }

    /// Somebody wrote short codes into the list: every code of one letter is used, and no draw may go on for ever.
    void aShortCodeInAnAlteredListEndsTheDraws()
    {
        std::vector<BlindedTrial> list;
        for (const char letter : std::string("ACEFHJKLMNPRTUVWXY3479")) {
            list.emplace_back();
            list.back().number = TrialNumber{static_cast<int>(list.size())};
            list.back().presentationCode = PresentationCode(std::string(1, letter));
        }
        QCOMPARE(codeOfAttempt(list, 0, 2).value.size(), std::size_t{2});
        list[3].presentationCode = PresentationCode("");
        const QString error = tests::support::errorOf([&] { codeOfAttempt(list, 3, 2); });
        QVERIFY2(error.startsWith("1: the list of trials: trial 4 has no presentation code"), qPrintable(error));
    }
};

QTEST_APPLESS_MAIN(ExtraTrialsTest)
#include "extra_trials_test.moc"
