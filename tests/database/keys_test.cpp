// Who may read which key; a key without its committed hash is refused.
#include "database/keys.h"

#include <sys/stat.h>

#include <QTemporaryDir>
#include <QTest>
#include <fstream>
#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "tests/support/error_text.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using namespace database;
using namespace tests::support;

namespace {

constexpr const char* passphrase = "four plain short words";

unsigned modeOf(const std::filesystem::path& file)
{
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 ? status.st_mode & 0777 : 0;
}

}  // namespace

class KeysTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    StudyFolder newStudy(const char* sealedWith = nullptr)
    {
        StudyRecipe recipe;
        if (sealedWith) recipe.passphrase = sealedWith;
        return buildStudy(m_place.filePath(QString("study%1").arg(++m_studies)).toStdString(), recipe);
    }

private Q_SLOTS:
    void keysAreForTheirOwnerOnly()
    {
        const StudyFolder open = newStudy(), sealed = newStudy(passphrase);
        QCOMPARE(modeOf(open.allocationKey()), 0600u);
        QCOMPARE(modeOf(open.stationKey()), 0600u);
        QCOMPARE(modeOf(sealed.sealedAllocationKey()), 0600u);
        QVERIFY(!std::filesystem::exists(sealed.allocationKey()));
    }

    void aSealedKeyNamesNothing()
    {
        const StudyFolder folder = newStudy(passphrase);
        const std::string text = protocols::readWholeFile(folder.sealedAllocationKey());
        for (const char* name : {"v_grey", "h&f", "F01", "K1"}) QVERIFY2(text.find(name) == std::string::npos, name);
    }

    void thePassphraseOpensTheKey()
    {
        const StudyStore store(newStudy(passphrase), StudyStore::Access::Read);
        const auto giving = [](const char* text) { return [text] { return std::optional<std::string>(text); }; };
        QCOMPARE(readKeyForAggregates(store, giving(passphrase))->entries.size(), 6u);
        QVERIFY(!readKeyForAggregates(store, {}));
        QVERIFY(!readKeyForAggregates(store, [] { return std::optional<std::string>(); }));
        QVERIFY(errorOf([&] { readKeyForAggregates(store, giving("another passphrase")); }).startsWith("2:"));
        QVERIFY(errorOf([&] {
                    readAllocationKeyForTestDriver(store, ParticipantKind::Scripted, {});
                }).contains("needs the owner's passphrase"));
    }

    void theFullKeyStaysClosedWhileAHumanTakesPart()
    {
        const StudyStore store(newStudy(), StudyStore::Access::Read);
        QVERIFY(errorOf([&] {
                    readAllocationKeyForTestDriver(store, ParticipantKind::Human, {});
                }).contains("must not be read for a human participant"));
        QVERIFY(readAllocationKeyForTestDriver(store, ParticipantKind::Simulated, {}).entries.size() == 6);
    }

    void unblindingIsRecordedAndOpensTheKey_data()
    {
        QTest::addColumn<bool>("sealed");
        QTest::newRow("without a passphrase") << false;
        QTest::newRow("with one") << true;
    }

    void unblindingIsRecordedAndOpensTheKey()
    {
        QFETCH(bool, sealed);
        const StudyFolder folder = newStudy(sealed ? passphrase : nullptr);
        const Passphrase given = [] { return std::optional<std::string>(passphrase); };
        {
            StudyStore store(folder, StudyStore::Access::Write);
            QVERIFY(!recordedUnblinding(store));
            QVERIFY(errorOf([&] { unblind(store, {"", "curious", "2026-01-01T00:00:00Z"}, {}); }).startsWith("2:"));
            QVERIFY(!recordedUnblinding(store));
            if (sealed) {
                QVERIFY(errorOf([&] { unblind(store, {"A. Lab", "curious", "2026"}, {}); }).startsWith("2:"));
                QVERIFY(!recordedUnblinding(store));
            }
            const Unblinded act = unblind(store, {"A. Lab", "the study is over", "2026-01-01T00:00:00Z"}, given);
            QCOMPARE(readAllocationKey(store, act).entries.size(), 6u);
        }
        const StudyStore store(folder, StudyStore::Access::Read);
        const auto act = recordedUnblinding(store);
        QVERIFY(act.has_value());
        QCOMPARE(act->record().who, std::string("A. Lab"));
        QCOMPARE(act->record().why, std::string("the study is over"));
        QCOMPARE(readAllocationKey(store, *act).entries.size(), 6u);
        QVERIFY(store.faults().empty() && findingsOfKeys(store, given).faults.empty());
    }

    /// The disk was full when the open key should have been written, or somebody removed it.
    void anUnblindingWithoutItsOpenKeyIsCompleted()
    {
        const StudyFolder folder = newStudy(passphrase);
        const Passphrase given = [] { return std::optional<std::string>(passphrase); };
        StudyStore store(folder, StudyStore::Access::Write);
        const Unblinded act = unblind(store, {"A. Lab", "the study is over", "2026-01-01T00:00:00Z"}, given);
        QVERIFY(!completeUnblinding(store, given));
        std::filesystem::remove(folder.allocationKey());
        const auto faults = findingsOfKeys(store, given).faults;
        QVERIFY(faults.size() == 1 && faults.front().find("its open allocation key is missing") != std::string::npos);
        const QString told = errorOf([&] { readAllocationKey(store, act); });
        QVERIFY2(told.contains("run vis2hap unblind again with the passphrase"), qPrintable(told));
        QVERIFY(errorOf([&] { completeUnblinding(store, {}); }).startsWith("2:"));
        QVERIFY(completeUnblinding(store, given));
        QCOMPARE(readAllocationKey(store, act).entries.size(), 6u);
        QVERIFY(findingsOfKeys(store, given).faults.empty());
    }

    void aKeyThatWasNotCommittedIsRefused_data()
    {
        QTest::addColumn<bool>("station");
        QTest::addColumn<bool>("removed");
        QTest::newRow("allocation key altered") << false << false;
        QTest::newRow("allocation key missing") << false << true;
        QTest::newRow("station key altered") << true << false;
        QTest::newRow("station key missing") << true << true;
    }

    void aKeyThatWasNotCommittedIsRefused()
    {
        QFETCH(bool, station);
        QFETCH(bool, removed);
        const StudyStore store(newStudy(), StudyStore::Access::Read);
        QVERIFY(findingsOfKeys(store).faults.empty());
        const auto file = station ? store.folder().stationKey() : store.folder().allocationKey();
        if (removed)
            std::filesystem::remove(file);
        else
            std::ofstream(file, std::ios::app) << "\n";
        QVERIFY(errorOf([&] {
                    station ? void(readStationKey(store.folder(), store.facts().stationKeySha256))
                            : void(readAllocationKeyForTestDriver(store, ParticipantKind::Scripted, {}));
                }).startsWith("1:"));
        const auto faults = findingsOfKeys(store).faults;
        QCOMPARE(faults.size(), 1u);
        QVERIFY(faults.front().find(file.filename().string()) != std::string::npos);
    }

    void aSealedKeyIsCheckedWithoutThePassphraseToo()
    {
        const StudyFolder folder = newStudy(passphrase);
        const StudyStore store(folder, StudyStore::Access::Read);
        const auto giving = [](const char* text) { return [text] { return std::optional<std::string>(text); }; };
        for (const Passphrase& given : {Passphrase(), Passphrase(giving(passphrase))}) {
            const auto findings = findingsOfKeys(store, given);
            QVERIFY(findings.faults.empty() && findings.notes.empty());
        }
        const auto findings = findingsOfKeys(store, giving("another passphrase"));
        QVERIFY(findings.faults.empty() && findings.notes.size() == 1);
        QVERIFY(findings.notes.front().find("another passphrase") != std::string::npos);
        std::ofstream(folder.sealedAllocationKey()) << "garbage\n";
        QVERIFY(findingsOfKeys(store).faults.front().find("not the file that the log names") != std::string::npos);
        QVERIFY(!findingsOfKeys(store, giving(passphrase)).faults.empty());
    }

    /// Versions up to now did not record the hash of the sealed file.
    void aSealedKeyOfAnOlderStudyIsCheckedAsFarAsPossible()
    {
        const StudyFolder folder = newStudy(passphrase);
        {
            RawSqlite raw(folder.database());
            raw.dropTriggers();
            QCOMPARE(raw.run("UPDATE events SET payload = json_remove(payload, '$.sealed_key_sha256') WHERE sequence = 1"),
                     std::string());
        }
        const StudyStore store(folder, StudyStore::Access::Read);
        const Passphrase given = [] { return std::optional<std::string>(passphrase); };
        QVERIFY(findingsOfKeys(store).faults.empty());
        QVERIFY(findingsOfKeys(store).notes.front().find("is not recorded") != std::string::npos);
        QVERIFY(findingsOfKeys(store, given).faults.empty() && findingsOfKeys(store, given).notes.empty());
        std::string sealed = protocols::readWholeFile(folder.sealedAllocationKey());
        char& digit = sealed[sealed.find("\"box\"") + 100];
        digit = digit == '0' ? '1' : '0';
        std::ofstream(folder.sealedAllocationKey()) << sealed;
        QVERIFY(findingsOfKeys(store).faults.empty());  // only the passphrase shows it
        QVERIFY(findingsOfKeys(store, given).faults.front().find("does not open") != std::string::npos);
        std::ofstream(folder.sealedAllocationKey()) << "garbage\n";
        QVERIFY(!findingsOfKeys(store).faults.empty());
    }
};

QTEST_GUILESS_MAIN(KeysTest)
#include "keys_test.moc"
