// Who may read which key; a key without its committed hash is refused.
#include "database/keys.h"

#include <sys/stat.h>

#include <QTemporaryDir>
#include <QtTest>
#include <fstream>

#include "protocols/files/errors.h"
#include "tests/support/study_builder.h"

using namespace database;
using namespace tests::support;

namespace {

unsigned modeOf(const std::filesystem::path& file)
{
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 ? status.st_mode & 0777 : 0;
}

template <class Call>
QString errorOf(Call call)
{
    try {
        call();
    } catch (const protocols::Error& fault) {
        return QString("%1: %2").arg(static_cast<int>(fault.exitCode())).arg(fault.what());
    }
    return {};
}

}  // namespace

class KeysTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    StudyFolder newStudy() { return buildStudy(m_place.filePath(QString("study%1").arg(++m_studies)).toStdString()); }

private Q_SLOTS:
    void theFullKeyIsForItsOwnerOnly()
    {
        const StudyFolder folder = newStudy();
        QCOMPARE(modeOf(folder.allocationKey()), 0600u);
        QCOMPARE(modeOf(folder.maskedKey()), 0644u);
    }

    void theMaskedKeyTellsFabricAndLabelAlone()
    {
        const StudyStore store(newStudy(), StudyStore::Access::Read);
        const auto masked = readMaskedKey(store);
        const auto full = readAllocationKeyForTestDriver(store, ParticipantKind::Scripted);
        QCOMPARE(masked.entries.size(), 6u);
        QVERIFY(masked == protocols::masked(full));
        std::ifstream file(store.folder().maskedKey());
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        QVERIFY(text.find("v_grey") == std::string::npos && text.find("h&f") == std::string::npos);
    }

    void theFullKeyStaysClosedWhileAHumanTakesPart()
    {
        const StudyStore store(newStudy(), StudyStore::Access::Read);
        QVERIFY(errorOf([&] {
                    readAllocationKeyForTestDriver(store, ParticipantKind::Human);
                }).contains("must not be read for a human participant"));
        QVERIFY(readAllocationKeyForTestDriver(store, ParticipantKind::Simulated).entries.size() == 6);
    }

    void unblindingIsRecordedAndOpensTheKey()
    {
        const StudyFolder folder = newStudy();
        {
            StudyStore store(folder, StudyStore::Access::Write);
            QVERIFY(!recordedUnblinding(store));
            QVERIFY(errorOf([&] { unblind(store, "", "curious", "2026-01-01T00:00:00Z"); }).startsWith("2:"));
            QVERIFY(!recordedUnblinding(store));
            const Unblinded act = unblind(store, "A. Lab", "the study is over", "2026-01-01T00:00:00Z");
            QCOMPARE(readAllocationKey(store, act).entries.size(), 6u);
        }
        const StudyStore store(folder, StudyStore::Access::Read);
        const auto act = recordedUnblinding(store);
        QVERIFY(act.has_value());
        QCOMPARE(act->record().who, std::string("A. Lab"));
        QCOMPARE(act->record().why, std::string("the study is over"));
        QVERIFY(store.faults().empty());
    }

    void aKeyThatWasNotCommittedIsRefused_data()
    {
        QTest::addColumn<bool>("masked");
        QTest::addColumn<bool>("removed");
        QTest::newRow("allocation key altered") << false << false;
        QTest::newRow("allocation key missing") << false << true;
        QTest::newRow("masked key altered") << true << false;
        QTest::newRow("masked key missing") << true << true;
    }

    void aKeyThatWasNotCommittedIsRefused()
    {
        QFETCH(bool, masked);
        QFETCH(bool, removed);
        const StudyStore store(newStudy(), StudyStore::Access::Read);
        QVERIFY(faultsOfKeys(store).empty());
        const auto file = masked ? store.folder().maskedKey() : store.folder().allocationKey();
        if (removed)
            std::filesystem::remove(file);
        else
            std::ofstream(file, std::ios::app) << "\n";
        QVERIFY(errorOf([&] {
                    masked ? void(readMaskedKey(store)) : void(readAllocationKeyForTestDriver(store, ParticipantKind::Scripted));
                }).startsWith("1:"));
        QCOMPARE(faultsOfKeys(store).size(), 1u);
        QVERIFY(faultsOfKeys(store).front().find(file.filename().string()) != std::string::npos);
    }

    void aKeyOpenToOthersIsAFault()
    {
        const StudyStore store(newStudy(), StudyStore::Access::Read);
        ::chmod(store.folder().allocationKey().c_str(), 0644);
        QCOMPARE(faultsOfKeys(store).size(), 1u);
    }
};

QTEST_GUILESS_MAIN(KeysTest)
#include "keys_test.moc"
