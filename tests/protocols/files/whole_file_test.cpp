// A file is always complete, either old or new, whatever happens while it is written.
#include "protocols/files/whole_file.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QSysInfo>
#include <QTemporaryDir>
#include <QTest>
#include <cerrno>

#include "protocols/files/errors.h"
#include "tests/support/error_text.h"
#include "tests/support/observed_disk.h"

using tests::support::errorOf;
using namespace protocols;
using tests::support::DiskCall;
using tests::support::DiskStep;
using tests::support::ObservedDisk;

namespace {

namespace fs = std::filesystem;

std::vector<std::string> namesIn(const fs::path& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

unsigned modeOf(const fs::path& file)
{
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 ? status.st_mode & 0777 : 0;
}

/// The exit status of `call` in a separate process.
template <class Call>
int statusOfChild(Call call)
{
    const pid_t child = ::fork();
    if (child == 0) {
        call();
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

class WholeFileTest : public QObject {
    Q_OBJECT
    std::unique_ptr<QTemporaryDir> m_folder;

    fs::path folder() const { return m_folder->path().toStdString(); }
    fs::path file() const { return folder() / "answers.csv"; }
    fs::path unfinished(const std::string& computer = QSysInfo::machineHostName().toStdString(), pid_t process = ::getpid()) const
    {
        return folder() / (".answers.csv.unfinished-" + computer + "-" + std::to_string(process));
    }

private Q_SLOTS:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void bytesReadBack()
    {
        const std::string bytes("a\0b\r\n\xff", 6);
        writeWholeFile(file(), bytes);
        QCOMPARE(readWholeFile(file()), bytes);
        std::string inBlocks;
        readInBlocks(file(), [&](std::string_view block) { inBlocks += block; });
        QCOMPARE(inBlocks, bytes);
        writeWholeFile(file(), "");
        QCOMPARE(readWholeFile(file()), std::string());
    }

    void whatCannotBeReadIsBadInput()
    {
        QVERIFY(errorOf([&] { readWholeFile(file()); }).startsWith("2: " + QString::fromStdString(file().string())));
        QVERIFY(errorOf([&] { readWholeFile(folder()); }).contains("Is a directory"));
        QVERIFY(!readIfPossible(file()));
        QVERIFY(!readIfPossible(folder()));
    }

    void whatNeverEndsIsNotRead()
    {
        fs::create_symlink("/dev/zero", file());
        QVERIFY(errorOf([&] { readWholeFile(file()); }).contains("is a device"));
        QVERIFY(errorOf([&] { readInBlocks(file(), [](std::string_view) {}); }).contains("is a device"));
        const fs::path sparse = folder() / "sparse";
        QCOMPARE(::truncate((writeWholeFile(sparse, ""), sparse.c_str()), static_cast<off_t>(largestFile) + 1), 0);
        QCOMPARE(errorOf([&] { readWholeFile(sparse); }),
                 "2: " + QString::fromStdString(sparse.string()) +
                     ": has more than 2147483648 bytes; expected at most 2147483648 bytes; check the path");
        QVERIFY(!readIfPossible(sparse));
    }

    /// A sparse protocol of 2 GiB took 27 s and 6.3 GB until it was refused.
    void eachKindOfFileHasALimitOfItsOwn()
    {
        writeWholeFile(file(), "12345");
        QCOMPARE(readWholeFile(file(), 5), std::string("12345"));
        QCOMPARE(errorOf([&] { readWholeFile(file(), 4); }),
                 "2: " + QString::fromStdString(file().string()) +
                     ": has more than 4 bytes; expected at most 4 bytes; check the path");
        const fs::path pipe = folder() / "pipe";
        QCOMPARE(::mkfifo(pipe.c_str(), 0600), 0);
        const pid_t writer = ::fork();
        if (writer == 0) {
            ::signal(SIGPIPE, SIG_DFL);
            const int end = ::open(pipe.c_str(), O_WRONLY);
            const std::string much(1 << 16, 'x');
            while (::write(end, much.data(), much.size()) > 0) continue;  // until the reader has had enough
            ::_exit(0);
        }
        QVERIFY(errorOf([&] { readWholeFile(pipe, 1 << 20); }).contains("has more than 1048576 bytes"));
        ::waitpid(writer, nullptr, 0);
    }

    void pipeWithoutAWriterIsNamed()
    {
        QCOMPARE(::mkfifo(file().c_str(), 0600), 0);
        QVERIFY(errorOf([&] { readWholeFile(file()); }).contains("nobody wrote into this pipe for 10 s"));
    }

    void tooManyOpenFilesAreNoFaultOfTheFile()
    {
        writeWholeFile(file(), "x");
        rlimit before{};
        QCOMPARE(::getrlimit(RLIMIT_NOFILE, &before), 0);
        const rlimit none{3, before.rlim_max};
        QCOMPARE(::setrlimit(RLIMIT_NOFILE, &none), 0);
        const QString whole = errorOf([&] { readWholeFile(file()); }), ifPossible = errorOf([&] { readIfPossible(file()); }),
                      written = errorOf([&] { writeWholeFile(folder() / "new", "x"); });
        QCOMPARE(::setrlimit(RLIMIT_NOFILE, &before), 0);
        for (const QString& error : {whole, ifPossible, written}) {
            QVERIFY2(error.startsWith("3: "), qPrintable(error));
            QVERIFY2(error.contains("ulimit -n"), qPrintable(error));
        }
    }

    void fileIsSyncedBeforeItsRenameAndItsFolderAfterwards()
    {
        const ObservedDisk disk(folder());
        writeWholeFile(file(), "new");
        QCOMPARE(disk.steps(), (std::vector<DiskStep>{{DiskCall::Write, unfinished()},
                                                      {DiskCall::Sync, unfinished()},
                                                      {DiskCall::Rename, file()},
                                                      {DiskCall::Sync, folder()}}));
    }

    void laterMeansNoSync()
    {
        const ObservedDisk disk(folder());
        writeWholeFile(file(), "new", Sync::Later);
        QCOMPARE(disk.count(DiskCall::Sync), std::size_t{0});
        QCOMPARE(disk.count(DiskCall::Rename), std::size_t{1});
    }

    void piecesMakeOneFile()
    {
        const ObservedDisk disk(folder());
        writeInPieces(file(), [](const TakeBytes& take) {
            for (const char* piece : {"a,", "", "b\n", "c"}) take(piece);
        });
        QCOMPARE(readWholeFile(file()), std::string("a,b\nc"));
        QCOMPARE(disk.count(DiskCall::Rename), std::size_t{1});
        QCOMPARE(disk.count(DiskCall::Sync), std::size_t{2});
    }

    void faultBetweenPiecesLeavesTheOldFile()
    {
        writeWholeFile(file(), "old");
        const QString fault = errorOf([&] {
            writeInPieces(file(), [](const TakeBytes& take) {
                take("half");
                throw badInput({"the second half is missing", "here", "", ""});
            });
        });
        QVERIFY(fault.contains("the second half is missing"));
        QCOMPARE(readWholeFile(file()), std::string("old"));
        QCOMPARE(namesIn(folder()), std::vector<std::string>{"answers.csv"});
    }

    void processKilledAtAnyStepLeavesTheOldFileOrTheNewOne()
    {
        const std::string earlier(2500, 'o'), later(3500, 'n');
        std::size_t steps = 0;
        int withOld = 0;
        for (std::size_t last = 0; steps == 0; ++last) {
            writeWholeFile(file(), earlier);
            const int status = statusOfChild([&] {
                ObservedDisk disk(folder());
                disk.dieBefore(last);
                writeWholeFile(file(), later);
            });
            const std::string left = readWholeFile(file());
            QVERIFY2(left == earlier || left == later, left.c_str());
            if (left == earlier) ++withOld;
            if (status == 0) steps = last;
        }
        QCOMPARE(steps, std::size_t{7});  // four writes of at most 1,000 bytes, a sync, the rename, the sync of the folder
        QCOMPARE(withOld, 6);
    }

    void whatAKilledProcessLeftVanishesWithTheNextWriting()
    {
        QCOMPARE(statusOfChild([&] {
                     ObservedDisk disk(folder());
                     disk.dieBefore(1);
                     writeWholeFile(file(), "never finished");
                 }),
                 7);
        QCOMPARE(namesIn(folder()).size(), std::size_t{1});
        writeWholeFile(folder() / "other.csv", "x");
        QCOMPARE(namesIn(folder()).size(), std::size_t{2});  // only leftovers of the same file are removed
        writeWholeFile(file(), "finished");
        QCOMPARE(namesIn(folder()), (std::vector<std::string>{"answers.csv", "other.csv"}));
    }

    void unfinishedFilesOfLivingProcessesAndOtherComputersStay()
    {
        const std::string here = QSysInfo::machineHostName().toStdString();
        const pid_t dead = ::fork();
        if (dead == 0) ::_exit(0);
        ::waitpid(dead, nullptr, 0);
        for (const fs::path& other : {unfinished(here, ::getppid()), unfinished("elsewhere", dead), unfinished(here, dead)})
            writeWholeFile(other, "being written", Sync::Later);
        writeWholeFile(file(), "finished");
        QVERIFY(fs::exists(unfinished(here, ::getppid())));
        QVERIFY(fs::exists(unfinished("elsewhere", dead)));
        QVERIFY(!fs::exists(unfinished(here, dead)));
    }

    void everyFailureIsAnEnvironmentFaultThatLeavesTheOldFile()
    {
        writeWholeFile(file(), "old");
        for (std::size_t step = 0; step < 3; ++step) {
            ObservedDisk disk(folder());
            disk.failAt(step, step == 0 ? ENOSPC : EIO);
            const QString error = errorOf([&] { writeWholeFile(file(), "new"); });
            QVERIFY2(error.startsWith("3: ") && error.contains("answers.csv") && error.contains("cannot be written"),
                     qPrintable(error));
            QCOMPARE(error.contains("No space left on device"), step == 0);
            QCOMPARE(readWholeFile(file()), std::string("old"));
            QCOMPARE(namesIn(folder()), std::vector<std::string>{"answers.csv"});
        }
    }

    void fileSystemsThatCannotSyncFoldersAreGoodEnough()
    {
        ObservedDisk disk(folder());
        disk.failAt(3, EINVAL);
        writeWholeFile(file(), "new");
        QCOMPARE(readWholeFile(file()), std::string("new"));
    }

    void readersOfANewFileAreAsAskedFor()
    {
        const mode_t usual = ::umask(0027);
        writeWholeFile(file(), "x");
        writeWholeFile(folder() / "key", "x", Sync::Now, Readers::OwnerOnly);
        ::umask(usual);
        QCOMPARE(modeOf(file()), 0640u);
        QCOMPARE(modeOf(folder() / "key"), 0600u);
    }

    void deviceStaysADevice()
    {
        writeWholeFile("/dev/null", "nothing");
        QVERIFY(fs::is_character_file("/dev/null"));
        if (fs::exists("/dev/full")) QVERIFY(errorOf([] { writeWholeFile("/dev/full", "x"); }).startsWith("3: /dev/full"));
    }

    /// A rename would replace /dev/stdout by a file. The bytes go where this process already writes.
    void openFileOfThisProcessIsWrittenTo()
    {
        const int other = ::open(file().c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
        QVERIFY(other >= 0);
        const std::string number = std::to_string(other);
        requireWritable("/proc/self/fd/" + number);
        writeWholeFile("/proc/self/fd/" + number, "one\n");
        QCOMPARE(::write(other, "two\n", 4), ssize_t{4});
        if (fs::exists("/dev/fd")) writeWholeFile("/dev/fd/" + number, "three\n");
        ::close(other);
        QCOMPARE(readWholeFile(file()), std::string(fs::exists("/dev/fd") ? "one\ntwo\nthree\n" : "one\ntwo\n"));
        QCOMPARE(namesIn(folder()), std::vector<std::string>{"answers.csv"});
    }

    void standardOutputCanBeAFile()
    {
        if (!fs::is_symlink("/dev/stdout")) QSKIP("this system has no /dev/stdout");
        const int status = statusOfChild([&] {
            ::close(STDOUT_FILENO);
            if (::open(file().c_str(), O_WRONLY | O_CREAT, 0600) != STDOUT_FILENO) ::_exit(8);
            requireWritable("/dev/stdout");
            writeWholeFile("/dev/fd/1", "{}\n");
        });
        QCOMPARE(status, 0);
        QCOMPARE(readWholeFile(file()), std::string("{}\n"));
    }

    void anyOtherLinkIsReplaced_data()
    {
        QTest::addColumn<QString>("target");
        QTest::newRow("to a file") << "answers.csv";
        QTest::newRow("to nothing") << "missing.csv";
        QTest::newRow("to itself") << "link";
    }
    void anyOtherLinkIsReplaced()
    {
        QFETCH(const QString, target);
        const fs::path link = folder() / "link";
        writeWholeFile(file(), "somebody's");
        fs::create_symlink(target.toStdString(), link);
        writeWholeFile(link, "new");
        QVERIFY(!fs::is_symlink(link));
        QCOMPARE(readWholeFile(link), std::string("new"));
        QCOMPARE(readWholeFile(file()), std::string("somebody's"));
    }

    /// Somebody may have put it into a folder in which this program writes.
    void linkToAnOpenFileIsReplaced()
    {
        writeWholeFile(file(), "somebody's");
        const int other = ::open(file().c_str(), O_RDWR | O_CLOEXEC);
        const fs::path link = folder() / "link";
        fs::create_symlink("/proc/self/fd/" + std::to_string(other), link);
        writeWholeFile(link, "new");
        ::close(other);
        QVERIFY(!fs::is_symlink(link));
        QCOMPARE(readWholeFile(file()), std::string("somebody's"));
    }

    void copyForAFolderIsItsOwnersAndNew()
    {
        writeWholeFile(file(), "bytes");
        copyBytes(file(), folder() / "copy");
        QCOMPARE(readWholeFile(folder() / "copy"), std::string("bytes"));
        QCOMPARE(modeOf(folder() / "copy"), 0600u);
        QVERIFY(errorOf([&] { copyBytes(file(), folder() / "copy"); }).startsWith("3: "));
        QVERIFY(errorOf([&] { copyBytes(folder() / "missing", folder() / "other"); }).startsWith("2: "));
        QVERIFY(!fs::exists(folder() / "other"));
    }

    void finishedFileGetsItsName()
    {
        writeWholeFile(folder() / "draft", "whole", Sync::Later);
        const ObservedDisk disk(folder());
        putFileInPlace(folder() / "draft", file());
        QCOMPARE(disk.steps(),
                 (std::vector<DiskStep>{
                     {DiskCall::Sync, folder() / "draft"}, {DiskCall::Rename, file()}, {DiskCall::Sync, folder()}}));
        QCOMPARE(readWholeFile(file()), std::string("whole"));
    }

    void newFileDoesNotReplaceOneMadeMeanwhile()
    {
        writeWholeFile(folder() / "draft", "second", Sync::Later);
        writeWholeFile(file(), "first", Sync::Later);
        QCOMPARE(errorOf([&] { putNewFileInPlace(folder() / "draft", file()); }).left(2), QString("2:"));
        QCOMPARE(readWholeFile(file()), std::string("first"));
        fs::remove(file());
        putNewFileInPlace(folder() / "draft", file());
        QCOMPARE(readWholeFile(file()), std::string("second"));
    }

    /// Some shares and file systems know no renaming to a new name only.
    void newFileReplacesNothingOnAnOldFileSystemEither()
    {
        writeWholeFile(folder() / "draft", "second", Sync::Later);
        writeWholeFile(file(), "first", Sync::Later);
        const auto put = [&] {
            ObservedDisk disk(folder());
            disk.failAt(1, EINVAL);  // after the sync
            putNewFileInPlace(folder() / "draft", file());
        };
        QCOMPARE(errorOf(put).left(2), QString("2:"));
        QCOMPARE(readWholeFile(file()), std::string("first"));
        QCOMPARE(namesIn(folder()), (std::vector<std::string>{"answers.csv", "draft"}));
        fs::remove(file());
        QCOMPARE(errorOf(put), QString());
        QCOMPARE(readWholeFile(file()), std::string("second"));
        QCOMPARE(namesIn(folder()), std::vector<std::string>{"answers.csv"});
    }

    void longWorkAsksBeforeItBegins()
    {
        requireWritable(file());
        QVERIFY(namesIn(folder()).empty());
        QVERIFY(errorOf([&] { requireWritable(folder()); }).startsWith("2: "));
        QVERIFY(errorOf([&] { requireWritable(folder() / "missing" / "model.safetensors"); }).startsWith("3: "));
    }
};

QTEST_GUILESS_MAIN(WholeFileTest)
#include "whole_file_test.moc"
