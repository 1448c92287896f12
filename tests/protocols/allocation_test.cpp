#include "protocols/orders/allocation.h"

#include <QTest>
#include <algorithm>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/protocol_json.h"
#include "protocols/records/key_json.h"

using namespace protocols;

namespace {

Protocol smallStudy()
{
    Protocol protocol = protocolFromJson(paperProtocolJson(), "vis2hap.json");
    protocol.participants = 3;
    protocol.fabricCount = 4;
    return protocol;
}

std::vector<FabricId> fabricIds(int count)
{
    std::vector<FabricId> ids;
    for (int i = 1; i <= count; ++i) ids.emplace_back("F0" + std::to_string(i));
    return ids;
}

/// What a session sees of each presentation, and the file that it shows.
std::vector<std::string> listsIn(const Allocation& allocation)
{
    std::vector<std::string> lines;
    for (const auto& list : allocation.participants)
        for (const BlindedTrial& trial : list) {
            lines.push_back(trial.presentationCode.value + " " +
                            opened(trial.sealedCode, stationKeyOf(allocation.key.secret)).value);
            for (const FabricId& fabric : trial.alternatives) lines.back() += " " + fabric.value;
        }
    return lines;
}

}  // namespace

class AllocationTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_design = drawDesign(m_protocol, 11);
        m_allocation = allocate(m_protocol, m_design, m_fabrics, SecretKey::ofSeed(12));
    }

    void keyAnswersForEachRenderingOnce()
    {
        std::set<std::pair<FabricId, ConditionId>> renderings;
        std::map<ConditionLabel, std::set<ConditionId>> meanings;
        for (const auto& [code, entry] : m_allocation.key.entries) {
            QCOMPARE(code.value.size(), std::size_t{8});
            renderings.insert({entry.fabric, entry.condition});
            meanings[entry.label].insert(entry.condition);
        }
        QCOMPARE(m_allocation.key.entries.size(), std::size_t{36});
        QCOMPARE(renderings.size(), std::size_t{36});
        QCOMPARE(meanings.size(), std::size_t{9});
        for (const auto& [label, conditions] : meanings) QCOMPARE(conditions.size(), std::size_t{1});
    }

    void listsFollowTheDesign()
    {
        for (std::size_t participant = 0; participant < m_design.participants.size(); ++participant) {
            const auto& list = m_allocation.participants[participant];
            QCOMPARE(list.size(), m_design.participants[participant].size());
            for (std::size_t i = 0; i < list.size(); ++i) {
                const DesignTrial& planned = m_design.participants[participant][i];
                QCOMPARE(list[i].number.value, static_cast<int>(i) + 1);
                QCOMPARE(list[i].phase, planned.phase);
                const FabricId shown = m_allocation.key.entryOf(list[i]).fabric;
                QCOMPARE(shown, m_fabrics[static_cast<std::size_t>(planned.fabric)]);
                QCOMPARE(list[i].alternatives.size(), planned.alternatives.size());
                QCOMPARE(std::ranges::count(list[i].alternatives, shown), 1);
            }
        }
    }

    void labelOfTheDesignIsOneConditionThroughout()
    {
        std::map<int, std::set<ConditionId>> meanings;
        for (std::size_t participant = 0; participant < m_design.participants.size(); ++participant)
            for (std::size_t i = 0; i < m_design.participants[participant].size(); ++i)
                meanings[m_design.participants[participant][i].label].insert(
                    m_allocation.key.entryOf(m_allocation.participants[participant][i]).condition);
        QCOMPARE(meanings.size(), std::size_t{9});
        for (const auto& [label, conditions] : meanings) QCOMPARE(conditions.size(), std::size_t{1});
    }

    void presentationCodesNeverComeTwice()
    {
        std::set<PresentationCode> codes;
        std::size_t trials = 0;
        for (const auto& list : m_allocation.participants)
            for (const BlindedTrial& trial : list) {
                ++trials;
                codes.insert(trial.presentationCode);
                QCOMPARE(trial.presentationCode.value.size(), std::size_t{4});
                QVERIFY(trial.presentationCode.value.find_first_of("0OQDI1B8S5Z2G6") == std::string::npos);
            }
        QCOMPARE(codes.size(), trials);
    }

    void listsDoNotDependOnWhatTheLabelsStandFor()
    {
        Protocol other = m_protocol;
        std::ranges::reverse(other.conditions);
        const Allocation swapped = allocate(other, m_design, m_fabrics, SecretKey::ofSeed(12));
        QCOMPARE(listsIn(swapped), listsIn(m_allocation));
        QVERIFY(swapped.key.entries != m_allocation.key.entries);
    }

    void seedOfTheDesignDoesNotTellTheConditions()
    {
        // The same design with many secrets: a label must get many conditions. Neither the order of the file codes nor the
        // K-labels may follow the conditions.
        std::set<ConditionId> meanings;
        std::set<ConditionLabel> masks;
        std::set<ConditionId> firstInOrder;
        for (std::uint64_t secret = 0; secret < 60; ++secret) {
            const Allocation allocation = allocate(m_protocol, m_design, m_fabrics, SecretKey::ofSeed(secret));
            const auto& entry = allocation.key.entryOf(allocation.participants[0][0]);
            meanings.insert(entry.condition);
            masks.insert(entry.label);
            firstInOrder.insert(allocation.key.entries.begin()->second.condition);
        }
        QCOMPARE(meanings.size(), std::size_t{9});
        QCOMPARE(masks.size(), std::size_t{9});
        QCOMPARE(firstInOrder.size(), std::size_t{9});
    }

    void sameSecretGivesTheSameAllocation()
    {
        const Allocation again = allocate(m_protocol, drawDesign(m_protocol, 11), m_fabrics, SecretKey::ofSeed(12));
        QCOMPARE(listsIn(again), listsIn(m_allocation));
        QVERIFY(again.key.entries == m_allocation.key.entries);
    }

    void keysReadBackAsWritten()
    {
        const std::string text = toJson(m_allocation.key);
        const AllocationKey read = allocationKeyFromJson(text, "key");
        QVERIFY(read.entries == m_allocation.key.entries);
        QCOMPARE(read.secret.hex(), m_allocation.key.secret.hex());
        QVERIFY(text.starts_with("{\n  \"schema\": \"vis2hap.allocation-key/2\""));
    }

    void noTwoPresentationsHaveEqualSealedCodes()
    {
        std::set<SealedCode> codes;
        std::set<std::size_t> lengths;
        std::size_t trials = 0;
        for (const auto& list : m_allocation.participants)
            for (const BlindedTrial& trial : list) {
                ++trials;
                codes.insert(trial.sealedCode);
                lengths.insert(trial.sealedCode.value.size());
            }
        QCOMPARE(codes.size(), trials);
        QCOMPARE(lengths.size(), std::size_t{1});
    }

    void onlyTheStationKeyOpensASealedCode()
    {
        const SealedCode code = m_allocation.participants[0][0].sealedCode;
        QVERIFY(m_allocation.key.entries.contains(opened(code, stationKeyOf(m_allocation.key.secret))));
        QVERIFY_EXCEPTION_THROWN(opened(code, stationKeyOf(SecretKey::ofSeed(13))), protocols::Error);
        QVERIFY_EXCEPTION_THROWN(opened(code, m_allocation.key.secret), protocols::Error);
    }

    void thePublicSeedDoesNotDrawTheDesignAgain()
    {
        std::set<std::uint64_t> seeds{1};
        for (std::uint64_t secret = 0; secret < 20; ++secret) seeds.insert(designSeedOf(SecretKey::ofSeed(secret), 1));
        QCOMPARE(seeds.size(), std::size_t{21});
        QVERIFY(designSeedOf(SecretKey::ofSeed(1), 1) != designSeedOf(SecretKey::ofSeed(1), 2));
    }

    void malformedKeysAreRefused_data()
    {
        QTest::addColumn<QByteArray>("text");
        const auto key = [](const char* entries) {
            return QByteArray(R"({"schema": "vis2hap.allocation-key/2", "secret": ")") + QByteArray(64, '0') +
                   "\", \"entries\": {" + entries + "}}";
        };
        QTest::newRow("not JSON") << QByteArray("{");
        QTest::newRow("masked key in its place") << QByteArray(R"({"schema": "vis2hap.masked-key/1", "entries": {}})");
        QTest::newRow("no entries") << QByteArray(R"({"schema": "vis2hap.allocation-key/2"})");
        const auto entry = [](const char* code, const char* fabric, const char* condition) {
            return QStringLiteral(R"("%1": {"fabric": "%2", "condition": "%3", "label": "K1"})").arg(code, fabric, condition);
        };
        const auto two = [&](const QString& one, const QString& other) { return key(qPrintable(one + ", " + other)); };
        QTest::newRow("no label") << key(R"("aa": {"fabric": "F01", "condition": "f"})");
        QTest::newRow("number for a fabric") << key(R"("aa": {"fabric": 1, "condition": "f", "label": "K1"})");
        QTest::newRow("impossible condition") << key(qPrintable(entry("aa", "F01", "g@fast")));
        QTest::newRow("file code twice") << two(entry("aa", "F01", "f"), entry("aa", "F02", "f"));
        QTest::newRow("rendering twice") << two(entry("aa", "F01", "f"), entry("ab", "F01", "f"));
        QTest::newRow("label with two meanings") << two(entry("aa", "F01", "f"), entry("ab", "F01", "h"));
    }

    void malformedKeysAreRefused()
    {
        QFETCH(const QByteArray, text);
        try {
            allocationKeyFromJson(text.toStdString(), "allocation-key.json");
            QFAIL("a malformed key was accepted");
        } catch (const Error& error) {
            QCOMPARE(error.exitCode(), ExitCode::BadInput);
            QVERIFY2(QString(error.what()).startsWith("allocation-key.json"), error.what());
        }
    }

private:
    Protocol m_protocol = smallStudy();
    std::vector<FabricId> m_fabrics = fabricIds(4);
    Design m_design;
    Allocation m_allocation;
};

QTEST_GUILESS_MAIN(AllocationTest)
#include "allocation_test.moc"
