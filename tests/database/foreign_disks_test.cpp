// Disks that are not one's own: network shares, sticks, accounts with a quota, and folders that somebody changes after the last
// step. No acknowledged answer is lost, and no step stops a session without need.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <QProcess>
#include <QSysInfo>
#include <QTest>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "database/disk/write_lock.h"
#include "database/evidence/acts.h"
#include "database/rescue_files.h"
#include "protocols/files/whole_file.h"
#include "study/records/study_faults.h"
#include "tests/support/counting_vfs.h"
#include "tests/support/error_text.h"
#include "tests/support/new_studies.h"
#include "tests/support/played_session.h"

using tests::support::errorOf;
using namespace database;
namespace fs = std::filesystem;
using tests::support::CountingVfs;
using tests::support::OpenSession;

namespace {

/// What the disk does while a test says so.
struct ForeignDisk {
    bool isShare = false;      ///< it says that it is one of another computer
    int refusedRoom = 0;       ///< the errno of every allocation; 0: none is refused
    bool staysSilent = false;  ///< every look at study.db fails with EIO
    int looksUntilError = -1;  ///< at study.db; the next one fails once with EIO. -1: none fails
    bool refusesModes = false;
    bool keepsNoModes = false;  ///< every file is open to all, whatever mode it got
};
ForeignDisk disk;

int refused()
{
    errno = EPERM;
    return -1;
}

bool isDatabase(const char* file)
{
    const char* name = std::strrchr(file, '/');
    return name && std::strcmp(name, "/study.db") == 0;
}

}  // namespace

// The linker prefers these definitions to those of the C library.
extern "C" {

int fstatfs(int descriptor, struct statfs* status) noexcept
{
    constexpr long kindOfSmb2 = 0xFE534D42;
    const auto result = static_cast<int>(::syscall(SYS_fstatfs, descriptor, status));
    if (result == 0 && disk.isShare) status->f_type = kindOfSmb2;
    return result;
}

int posix_fallocate(int descriptor, off_t offset, off_t length)
{
    if (disk.refusedRoom != 0) return disk.refusedRoom;
    return ::syscall(SYS_fallocate, descriptor, 0, offset, length) == 0 || errno == EOPNOTSUPP ? 0 : errno;
}

int fchmod(int descriptor, mode_t mode) noexcept
{
    return disk.refusesModes ? refused() : static_cast<int>(::syscall(SYS_fchmod, descriptor, mode));
}

int fchmodat(int folder, const char* file, mode_t mode, int) noexcept
{
    return disk.refusesModes ? refused() : static_cast<int>(::syscall(SYS_fchmodat, folder, file, mode));
}

int fstat(int descriptor, struct stat* status) noexcept
{
    const auto result = static_cast<int>(::syscall(SYS_newfstatat, descriptor, "", status, AT_EMPTY_PATH));
    if (result == 0 && disk.keepsNoModes) status->st_mode |= 0077;
    return result;
}

int stat(const char* file, struct stat* status) noexcept
{
    if (isDatabase(file) && (disk.staysSilent || (disk.looksUntilError >= 0 && disk.looksUntilError-- == 0))) {
        errno = EIO;
        return -1;
    }
    return static_cast<int>(::syscall(SYS_newfstatat, AT_FDCWD, file, status, 0));
}
}

class ForeignDisksTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init() { disk = {}; }
    void cleanup() { disk = {}; }

    void aDatabaseThatGoesAfterTheLastStepIsKeptAside_data()
    {
        QTest::addColumn<bool>("isOver");
        QTest::addColumn<bool>("isReplaced");
        QTest::newRow("paused, deleted") << false << false;
        QTest::newRow("paused, replaced by an older one") << false << true;
        QTest::newRow("over, deleted") << true << false;
        QTest::newRow("over, replaced by an older one") << true << true;
    }
    void aDatabaseThatGoesAfterTheLastStepIsKeptAside()
    {
        QFETCH(const bool, isOver);
        QFETCH(const bool, isReplaced);
        const StudyFolder folder = newStudy();
        const fs::path older = folder.folder.string() + "-older.db";
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(3);
            session.store.copyTo(older);
            if (isOver) {
                session.playToEnd();
            } else {
                session.playUntilAnswers(7);
                session.send(study::session::Paused{});
            }
            fs::remove(folder.database());
            if (isReplaced) fs::copy_file(older, folder.database());
        }
        // The log of the other database is not added to the one that stands there now.
        if (isReplaced) QCOMPARE(StudyStore(folder, StudyStore::Access::Read).answers().size(), 3u);
        const auto files = rescueFiles(folder);
        QCOMPARE(files.size(), 1u);
        StudyStore::rescue(folder, files.front());
        const StudyStore store(folder, StudyStore::Access::Read);
        QVERIFY(store.faults().empty());
        QCOMPARE(store.answers().size(), isOver ? 24u : 7u);
    }

    void aFolderThatIsMovedKeepsEverythingAndOneThatIsRemovedNothing()
    {
        const StudyFolder folder = newStudy();
        const fs::path aside = folder.folder.string() + "-aside";
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(5);
            fs::rename(folder.folder, aside);
        }
        QVERIFY(rescueFiles(folder).empty());
        fs::rename(aside, folder.folder);
        QCOMPARE(StudyStore(folder, StudyStore::Access::Read).answers().size(), 5u);
        {
            OpenSession session(folder, "S01");
            fs::remove_all(folder.folder);
        }
        QVERIFY(rescueFiles(folder).empty());
    }

    /// A share that has lost its server for a moment, before a step is stored.
    void aDiskThatDoesNotAnswerStopsOneStepOnly()
    {
        const StudyFolder folder = newStudy();
        {
            StudyStore store(folder, StudyStore::Access::Write);
            disk.looksUntilError = 0;
            const QString error = errorOf([&] { store.enrol(protocols::ParticipantId("S01"), ParticipantKind::Scripted); });
            QVERIFY2(error.startsWith("3:") && error.contains("Input/output error"), qPrintable(error));
            QVERIFY(store.enrolments().empty());
            store.enrol(protocols::ParticipantId("S01"), ParticipantKind::Scripted);
            QCOMPARE(store.enrolments().size(), 1u);
        }
        QVERIFY(rescueFiles(folder).empty());
    }

    /// The same after it was stored: whoever does it again would be refused.
    void aStepThatIsStoredIsNotReportedAsFailed()
    {
        const StudyFolder folder = newStudy();
        {
            StudyStore store(folder, StudyStore::Access::Write);
            disk.looksUntilError = 1;
            store.enrol(protocols::ParticipantId("S01"), ParticipantKind::Scripted);
            QCOMPARE(disk.looksUntilError, -1);
            QCOMPARE(store.enrolments().size(), 1u);
        }
        QVERIFY(rescueFiles(folder).empty());
    }

    /// The screen of a pause shows the head of the log; a share that does not answer then must not end the program.
    void aPauseOutlivesADiskThatDoesNotAnswer()
    {
        const StudyFolder folder = newStudy();
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(3);
            session.send(study::session::Paused{});
            disk.staysSilent = true;
            (void)session.driver->view();
            const QString error = errorOf([&] { (void)session.driver->send(study::session::Resumed{}); });
            QVERIFY2(error.contains("Input/output error"), qPrintable(error));
            (void)session.driver->view();
            disk.staysSilent = false;
            session.send(study::session::Resumed{});
            session.playToEnd();
        }
        QVERIFY(rescueFiles(folder).empty());
        QCOMPARE(StudyStore(folder, StudyStore::Access::Read).answers().size(), 24u);
    }

    /// A share that never comes back may have lost the files: what the session stored is kept elsewhere.
    void aDiskThatStaysSilentLeavesARescueFile()
    {
        const StudyFolder folder = newStudy();
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(5);
            disk.staysSilent = true;
        }
        disk.staysSilent = false;
        QCOMPARE(rescueFiles(folder).size(), 1u);
        QCOMPARE(StudyStore(folder, StudyStore::Access::Read).answers().size(), 5u);
    }

    void aLogThatIsDeletedAfterTheLastStepIsInTheDatabase()
    {
        const StudyFolder folder = newStudy();
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(5);
            fs::remove(folder.database().string() + "-wal");
        }
        QVERIFY(rescueFiles(folder).empty());
        QCOMPARE(StudyStore(folder, StudyStore::Access::Read).answers().size(), 5u);
    }

    void theLockNamesItsComputer()
    {
        const StudyFolder folder = newStudy();
        {
            const WriteLock lock(folder);
            const std::string expected = std::to_string(::getpid()) + " " + QSysInfo::machineHostName().toStdString() + "\n";
            QCOMPARE(protocols::readWholeFile(folder.lock()), expected);
            const QString error = errorOf([&] { WriteLock second(folder); });
            QVERIFY2(error.contains(QString("(process %1 on %2)").arg(::getpid()).arg(QSysInfo::machineHostName())),
                     qPrintable(error));
        }
        QCOMPARE(protocols::readWholeFile(folder.lock()), std::string());
    }

    /// As somebody does who believes that the other program is gone.
    void aLockThatIsDeletedStopsTheSessionBeforeItsNextStep()
    {
        const StudyFolder folder = newStudy();
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(3);
            fs::remove(folder.lock());
            const QString alone = errorOf([&] { session.playUntilAnswers(4); });
            QVERIFY2(alone.startsWith("3:") && alone.contains("the lock of the study was deleted or replaced"),
                     qPrintable(alone));
            const WriteLock second(folder);
            QVERIFY(errorOf([&] { session.playUntilAnswers(4); }).contains("the lock of the study was deleted or replaced"));
        }
        QVERIFY(rescueFiles(folder).empty());
        OpenSession again(folder, "S01");
        again.playToEnd();
        QVERIFY(again.store.answers().size() > 4u);
    }

    void theLockOfAnotherComputerCountsOnAShare_data()
    {
        QTest::addColumn<bool>("isShare");
        QTest::addColumn<QString>("text");
        QTest::addColumn<bool>("isRefused");
        const QString own = "4711 " + QSysInfo::machineHostName() + "\n";
        QTest::newRow("another computer, on a share") << true << "4711 lab-2.example\n" << true;
        QTest::newRow("another computer, on a local disk") << false << "4711 lab-2.example\n" << false;
        QTest::newRow("this computer, on a share") << true << own << false;
        QTest::newRow("ended properly, on a share") << true << "" << false;
        QTest::newRow("of an earlier version, on a share") << true << "4711\n" << false;
        QTest::newRow("any text, on a share") << true << "somebody wrote this" << false;
    }
    void theLockOfAnotherComputerCountsOnAShare()
    {
        QFETCH(const bool, isShare);
        QFETCH(const QString, text);
        QFETCH(const bool, isRefused);
        const StudyFolder folder = newStudy();
        protocols::writeWholeFile(folder.lock(), text.toStdString());
        disk.isShare = isShare;
        const QString error = errorOf([&] { WriteLock lock(folder); });
        QCOMPARE(!error.isEmpty(), isRefused);
        if (!isRefused) return;
        QVERIFY2(error.startsWith("3:") && error.contains("process 4711 on lab-2.example") && error.contains("delete "),
                 qPrintable(error));
        QCOMPARE(protocols::readWholeFile(folder.lock()), text.toStdString());
        fs::remove(folder.lock());
        const WriteLock lock(folder);
    }

    /// An act takes no lock, and writes all the same.
    void anActIsNotRecordedWhileAnotherComputerWrites()
    {
        const StudyFolder folder = newStudy();
        const Act act{"export", "Ada", "test", "here", "/out", StudyStore(folder, StudyStore::Access::Read).head(), {}};
        protocols::writeWholeFile(folder.lock(), "4711 lab-2.example\n");
        disk.isShare = true;
        const std::string why = recordAct(folder, act).value_or("");
        QVERIFY2(why.find("process 4711 on lab-2.example") != std::string::npos, why.c_str());
        QVERIFY(actsOf(StudyStore(folder, StudyStore::Access::Read)).empty());
        fs::remove(folder.lock());
        QCOMPARE(recordAct(folder, act), std::nullopt);
    }

    /// As on shares that map no memory for two processes.
    void withoutSharedMemoryAClosedStudyCanBeRead()
    {
        const StudyFolder folder = newStudy();
        {
            OpenSession(folder, "S01").playUntilAnswers(3);
        }
        CountingVfs vfs;
        vfs.letSharedMemoryFail();
        QCOMPARE(StudyStore(folder, StudyStore::Access::Read).answers().size(), 3u);
        const QString error = errorOf([&] { StudyStore(folder, StudyStore::Access::Write); });
        QVERIFY2(error.startsWith("3:") && error.contains("does not support the write-ahead log"), qPrintable(error));
    }

    void aQuotaThatIsUsedUpIsNamed()
    {
        const StudyFolder folder = newStudy();
        CountingVfs vfs;
        OpenSession session(folder, "S01");
        session.playUntilAnswers(2);
        vfs.letWritesFailWith(SQLITE_IOERR_WRITE);
        disk.refusedRoom = EDQUOT;
        const QString error = errorOf([&] { session.playUntilAnswers(3); });
        QVERIFY2(error.startsWith("3:") && error.contains("quota of this account"), qPrintable(error));
        vfs.letWritesFailWith(SQLITE_OK);
        session.playUntilAnswers(3);
        QCOMPARE(session.store.answers().size(), 3u);
    }

    /// What is removed cannot be removed anew, so the room is asked for before.
    void anErasureFindsTheQuotaBeforeItRemovesAnything()
    {
        const StudyFolder folder = newStudy();
        OpenSession session(folder, "S01");
        session.playUntilAnswers(3);
        const Erasure erasure{protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}};
        disk.refusedRoom = EDQUOT;
        const QString error = errorOf([&] { session.store.erase(erasure); });
        QVERIFY2(error.startsWith("3:") && error.contains("quota") && error.contains("nothing was erased"), qPrintable(error));
        QCOMPARE(session.store.answers().size(), 3u);
        disk.refusedRoom = 0;
        QVERIFY(session.store.erase(erasure).found.empty());
        QVERIFY(session.store.answers().empty());
    }

    void anUpgradeNeedsNoModes()
    {
        const QString kept = VIS2HAP_SOURCE_DIR "/tests/study/kept/studies-0.5.0.tar.gz";
        QCOMPARE(QProcess::execute("tar", {"xzf", kept, "-C", m_studies.place().path()}), 0);
        const StudyFolder folder{m_studies.place().filePath("half").toStdString()};
        const auto answers = StudyStore(folder, StudyStore::Access::Read).answers().size();
        disk.refusesModes = true;
        QCOMPARE(StudyStore(folder, StudyStore::Access::Write).answers().size(), answers);
        QVERIFY(fs::exists(folder.beforeUpgrade()) && !fs::exists(folder.upgrade()));
    }

    void verifyDoesNotAdviseAModeThatIsNotKept()
    {
        const StudyFolder folder = newStudy();
        fs::permissions(folder.database(), fs::perms::others_read, fs::perm_options::add);
        const auto notes = [&] {
            QString text;
            for (const auto& note : study::records::findingsOf(StudyStore(folder, StudyStore::Access::Read)).notes)
                text += QString::fromStdString(note) + "\n";
            return text;
        };
        QVERIFY2(notes().contains("chmod"), qPrintable(notes()));
        disk.keepsNoModes = true;
        QVERIFY2(notes().contains("keeps no access rights") && !notes().contains("chmod"), qPrintable(notes()));
    }

private:
    StudyFolder newStudy() { return m_studies.make(); }
    tests::support::NewStudies m_studies;
};

QTEST_GUILESS_MAIN(ForeignDisksTest)
#include "foreign_disks_test.moc"
