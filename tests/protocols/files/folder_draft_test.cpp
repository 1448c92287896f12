// A folder is always complete, either old or new, whatever happens while it is filled.
#include "protocols/files/folder_draft.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <QTemporaryDir>
#include <QTest>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <map>

#include "protocols/files/errors.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/process/owner_only.h"
#include "tests/support/error_text.h"
#include "tests/support/observed_disk.h"

using tests::support::errorOf;
using namespace protocols;
using tests::support::DiskCall;
using tests::support::DiskStep;
using tests::support::ObservedDisk;

namespace {

namespace fs = std::filesystem;
using Contents = std::map<std::string, std::string>;

/// Every file below a folder, hidden ones too.
Contents contentsOf(const fs::path& folder)
{
    Contents contents;
    if (fs::exists(folder))
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file()) contents[entry.path().lexically_relative(folder).string()] = readWholeFile(entry.path());
    return contents;
}

void fill(const fs::path& folder, const Contents& contents)
{
    for (const auto& [name, text] : contents) {
        fs::create_directories((folder / name).parent_path());
        std::ofstream(folder / name) << text;
    }
}

void fill(const FolderDraft& draft, const Contents& contents)
{
    for (const auto& [name, text] : contents) writeWholeFile(draft.file(name), text, Sync::Later);
}

void write(const fs::path& place, Earlier earlier, const Contents& contents, const std::vector<fs::path>& last = {},
           const std::vector<fs::path>& outdated = {})
{
    FolderDraft draft(place, earlier);
    fill(draft, contents);
    draft.outdates(outdated);
    draft.putInPlace(last);
}

const Contents earlierReport{{"index.html", "old"}, {"notes.txt", "mine"}, {"tables/gone.csv", "old"}, {"tables/q1.csv", "old"}};
const Contents newReport{{"index.html", "new"}, {"tables/q1.csv", "new"}, {"tables/q2.csv", "new"}};

struct Case {
    Earlier earlier;
    Contents before, after;
    std::vector<fs::path> outdated = {};
};

void write(const fs::path& place, const Case& one) { write(place, one.earlier, newReport, {}, one.outdated); }

const std::map<std::string, Case>& cases()
{
    static const std::map<std::string, Case> all{
        {"new", {Earlier::Refused, {}, newReport}},
        {"replaced", {Earlier::Replaced, earlierReport, newReport}},
        {"entries replaced",
         {Earlier::EntriesReplaced,
          earlierReport,
          {{"index.html", "new"}, {"notes.txt", "mine"}, {"tables/q1.csv", "new"}, {"tables/q2.csv", "new"}}}},
        {"files joined",
         {Earlier::FilesJoined,
          earlierReport,
          {{"index.html", "new"},
           {"notes.txt", "mine"},
           {"tables/gone.csv", "old"},
           {"tables/q1.csv", "new"},
           {"tables/q2.csv", "new"}}}},
        {"outdated entries",
         {Earlier::EntriesReplaced,
          {{"index.html", "old"}, {"notes.txt", "mine"}, {"report.pdf", "old"}, {"figures/a.svg", "old"}},
          {{"index.html", "new"}, {"notes.txt", "mine"}, {"tables/q1.csv", "new"}, {"tables/q2.csv", "new"}},
          {"index.html", "report.pdf", "figures", "report.docx"}}},
        {"an outdated file",
         {Earlier::FilesJoined,
          earlierReport,
          {{"index.html", "new"}, {"notes.txt", "mine"}, {"tables/q1.csv", "new"}, {"tables/q2.csv", "new"}},
          {"tables/gone.csv"}}}};
    return all;
}

}  // namespace

class FolderDraftTest : public QObject {
    Q_OBJECT
    std::unique_ptr<QTemporaryDir> m_folder;

    fs::path folder() const { return m_folder->path().toStdString(); }
    fs::path place() const { return folder() / "report"; }

    void eachCase() const
    {
        QTest::addColumn<QString>("name");
        for (const auto& [name, one] : cases()) QTest::newRow(name.c_str()) << QString::fromStdString(name);
    }

private Q_SLOTS:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void earlierFolderIsTreatedAsAskedFor_data() { eachCase(); }
    void earlierFolderIsTreatedAsAskedFor()
    {
        QFETCH(QString, name);
        const Case& one = cases().at(name.toStdString());
        fill(place(), one.before);
        write(place(), one);
        QCOMPARE(contentsOf(place()), one.after);
        QCOMPARE(contentsOf(folder()).size(), one.after.size());
    }

    void missingFolderIsMadeInEveryWay_data() { eachCase(); }
    void missingFolderIsMadeInEveryWay()
    {
        QFETCH(QString, name);
        write(folder() / "a" / "b" / "", cases().at(name.toStdString()));
        QCOMPARE(contentsOf(folder() / "a" / "b"), newReport);
    }

    void abandonedDraftLeavesNothing_data() { eachCase(); }
    void abandonedDraftLeavesNothing()
    {
        QFETCH(QString, name);
        const Case& one = cases().at(name.toStdString());
        fill(place(), one.before);
        const Contents before = contentsOf(folder());
        {
            const FolderDraft draft(place(), one.earlier);
            fill(draft, newReport);
            const FolderDraft deep(folder() / "x" / "y", one.earlier);
        }
        QCOMPARE(contentsOf(folder()), before);
        QVERIFY(!fs::exists(folder() / "x"));
    }

    /// The usual way to share a folder of a lab: new files in it get rights for others, whatever the umask is. The program runs
    /// in a process of its own here, because it closes its files for good.
    void anAclOfTheLabDoesNotOpenWhatIsMadeForTheOwner()
    {
        const fs::path lab = folder() / "lab";
        fs::create_directories(lab);
        // Version 2; user rwx, group r-x, others r-x: (tag, rights, id) each.
        const QByteArray acl = QByteArray::fromHex("0200000001000700ffffffff04000500ffffffff20000500ffffffff");
        if (::setxattr(lab.c_str(), "system.posix_acl_default", acl.constData(), static_cast<std::size_t>(acl.size()), 0) != 0)
            QSKIP("this file system has no access control lists");
        const pid_t child = ::fork();
        if (child == 0) {
            keepFilesToOwner();
            FolderDraft draft(lab / "study", Earlier::Refused);
            fill(draft, newReport);
            fs::create_directories(draft.path() / "plain");
            draft.putInPlace();
            writeWholeFile(lab / "single.json", "{}");
            ::_exit(0);
        }
        int status = -1;
        QCOMPARE(::waitpid(child, &status, 0), child);
        QCOMPARE(status, 0);
        QCOMPARE(fs::status(lab / "study").permissions(), fs::perms(0700));
        QCOMPARE(fs::status(lab / "single.json").permissions(), fs::perms(0600));
        for (const auto& entry : fs::recursive_directory_iterator(lab / "study"))
            QCOMPARE(entry.status().permissions(), entry.is_directory() ? fs::perms(0700) : fs::perms(0600));
    }

    /// It may hold a copy of a study.
    void aTemporaryFolderEndsWithItsProgram_data()
    {
        QTest::addColumn<int>("signal");
        QTest::newRow("Ctrl-C") << SIGINT;
        QTest::newRow("logout") << SIGTERM;
        QTest::newRow("closed terminal") << SIGHUP;
        QTest::newRow("closed pipe") << SIGPIPE;
    }
    void aTemporaryFolderEndsWithItsProgram()
    {
        QFETCH(const int, signal);
        const TemporaryFolder outer;
        fill(outer.path(), {{"mine", "stays"}});
        const pid_t child = ::fork();
        if (child == 0) {
            std::signal(signal, SIG_DFL);
            TemporaryFolder ended;
            {
                const TemporaryFolder before;
            }
            fill(ended.path(), {{"study.db", "answers"}, {"stimuli/1", "image"}});
            fs::create_directory_symlink(ended.path(), outer.path() / "link");
            ::raise(signal);
            ::_exit(0);
        }
        int status = -1;
        QCOMPARE(::waitpid(child, &status, 0), child);
        QVERIFY(WIFSIGNALED(status) && WTERMSIG(status) == signal);
        QVERIFY(fs::is_symlink(outer.path() / "link") && !fs::exists(outer.path() / "link"));
        QVERIFY(fs::exists(outer.path() / "mine"));  // of the parent
    }

    /// A thread that nobody waits for may hold one when the program ends.
    void aTemporaryFolderOfAnUnfinishedThreadEndsWithItsProgram()
    {
        const TemporaryFolder outer;
        fill(outer.path(), {{"mine", "stays"}});
        const pid_t child = ::fork();
        if (child == 0) {
            auto* unfinished = new TemporaryFolder;
            fill(unfinished->path(), {{"study.db", "answers"}, {"stimuli/1", "image"}});
            fs::create_directory_symlink(unfinished->path(), outer.path() / "link");
            removeLivingFolders();
            ::_exit(0);
        }
        int status = -1;
        QCOMPARE(::waitpid(child, &status, 0), child);
        QCOMPARE(status, 0);
        QVERIFY(fs::is_symlink(outer.path() / "link") && !fs::exists(outer.path() / "link"));
        QVERIFY(fs::exists(outer.path() / "mine"));  // of the parent
    }

    /// `nohup` lets a program go on.
    void anIgnoredSignalStaysIgnored()
    {
        const auto before = std::signal(SIGHUP, SIG_IGN);
        const TemporaryFolder folder;
        ::raise(SIGHUP);
        QVERIFY(fs::exists(folder.path()));
        std::signal(SIGHUP, before);
    }

    void folderThatIsNotEmptyIsRefused()
    {
        fill(place(), earlierReport);
        QVERIFY(errorOf([&] { write(place(), Earlier::Refused, newReport); }).startsWith("3: "));
        QCOMPARE(contentsOf(place()), earlierReport);
        fs::create_directories(folder() / "empty");
        write(folder() / "empty", Earlier::Refused, newReport);
        QCOMPARE(contentsOf(folder() / "empty"), newReport);
    }

    /// Who makes the folder of an export beforehand makes it open to others, by the usual mask.
    void anEmptyFolderIsClosedAndOneWithFilesKeepsItsMode()
    {
        const fs::path given = fs::path(m_folder->path().toStdString()) / "given";
        fs::create_directories(given);
        fs::permissions(given, fs::perms(0755));
        const auto modeAfterWriting = [&](const char* file) {
            const auto mask = ::umask(0077);
            write(given, Earlier::FilesJoined, {{file, "answers"}});
            ::umask(mask);
            return fs::status(given).permissions();
        };
        QCOMPARE(modeAfterWriting("first.csv"), fs::perms(0700));
        fs::permissions(given, fs::perms(0755));
        QCOMPARE(modeAfterWriting("second.csv"), fs::perms(0755));
        fs::remove_all(given);
        fs::create_directories(given);
        fs::permissions(given, fs::perms(0770));
        QCOMPARE(modeAfterWriting("third.csv"), fs::perms(0770));  // a group shares it on purpose
    }

    void nothingOfAnotherKindIsReplaced()
    {
        fill(folder(), {{"report", "a file"}});
        for (const auto& [name, one] : cases()) QVERIFY2(errorOf([&] { write(place(), one); }).startsWith("3: "), name.c_str());
        QCOMPARE(contentsOf(folder()), (Contents{{"report", "a file"}}));
        fill(folder() / "other", {{"index.html/mine.txt", "x"}});
        QVERIFY(errorOf([&] { write(folder() / "other", Earlier::FilesJoined, newReport); }).startsWith("3: "));
        QCOMPARE(contentsOf(folder() / "other"), (Contents{{"index.html/mine.txt", "x"}}));
    }

    void processKilledAtAnyStepOfAReplacementLeavesOneOfTheTwo_data()
    {
        QTest::addColumn<QString>("name");
        QTest::newRow("new") << "new";
        QTest::newRow("replaced") << "replaced";
    }
    void processKilledAtAnyStepOfAReplacementLeavesOneOfTheTwo()
    {
        QFETCH(QString, name);
        const Case& one = cases().at(name.toStdString());
        int withOld = 0, status = -1;
        for (std::size_t last = 0; status != 0; ++last) {
            fs::remove_all(place());
            fill(place(), one.before);
            if (one.before.empty()) fs::remove_all(place());
            const pid_t child = ::fork();
            if (child == 0) {
                ObservedDisk disk(folder());
                disk.dieBefore(last);
                write(place(), one);
                ::_exit(0);
            }
            ::waitpid(child, &status, 0);
            const Contents left = contentsOf(place());
            QVERIFY(left == one.before || left == one.after);
            withOld += left == one.before ? 1 : 0;
        }
        QVERIFY2(withOld > 8, qPrintable(QString::number(withOld)));  // three writes, their renames, the syncs
        QCOMPARE(contentsOf(place()), one.after);
        write(place(), Earlier::Replaced, newReport);
        QCOMPARE(contentsOf(folder()).size(), newReport.size());  // drafts of the killed processes are gone
    }

    void everyFailureIsUndone_data() { eachCase(); }
    void everyFailureIsUndone()
    {
        QFETCH(QString, name);
        const Case& one = cases().at(name.toStdString());
        bool isDone = false;
        int failures = 0;
        for (std::size_t step = 0; !isDone; ++step) {
            fs::remove_all(place());
            fill(place(), one.before);
            if (one.before.empty()) fs::remove_all(place());
            QString error;
            {
                ObservedDisk disk(folder());
                disk.failAt(step, EIO);
                error = errorOf([&] { write(place(), one); });
                const auto steps = disk.steps();
                isDone = error.isEmpty() && step >= steps.size();
                // The last syncs come after the names: the new folder is in place then.
                if (step < steps.size() && steps[step].call == DiskCall::Sync && contentsOf(place()) == one.after) continue;
            }
            if (isDone) break;
            ++failures;
            QVERIFY2(error.startsWith("3: "), qPrintable(QString("step %1: %2").arg(step).arg(error)));
            QCOMPARE(contentsOf(place()), one.before);
            QCOMPARE(contentsOf(folder()).size(), one.before.size());
        }
        QVERIFY2(failures >= 10, qPrintable(QString::number(failures)));
        QCOMPARE(contentsOf(place()), one.after);
    }

    void bytesAreSyncedBeforeNamesAndOnlyOnce()
    {
        const ObservedDisk disk(folder());
        write(place(), Earlier::Refused, newReport);
        const auto steps = disk.steps();
        const auto isCall = [](DiskCall call) { return [call](const DiskStep& one) { return one.call == call; }; };
        const auto renamed = std::find(steps.begin(), steps.end(), DiskStep{DiskCall::Rename, place()});
        QVERIFY(renamed != steps.end());
        for (const auto& [name, text] : newReport)
            QCOMPARE(std::count_if(steps.begin(), renamed,
                                   [&, wanted = "/" + name](const DiskStep& one) {
                                       return one.call == DiskCall::Sync && one.file.string().ends_with(wanted);
                                   }),
                     1);
        QCOMPARE(*std::prev(steps.end()), (DiskStep{DiskCall::Sync, folder()}));
        QCOMPARE(std::count_if(steps.begin(), steps.end(), isCall(DiskCall::SyncAll)), 0);
    }

    void manyFilesAreSyncedTogether()
    {
        const ObservedDisk disk(folder());
        Contents many;
        for (int i = 0; i < 200; ++i) many["F01/" + std::to_string(i) + ".png"] = "x";
        write(place(), Earlier::Refused, many);
        QCOMPARE(disk.count(DiskCall::SyncAll), std::size_t{1});
        QCOMPARE(disk.count(DiskCall::Sync), std::size_t{1});
        const auto steps = disk.steps();
        QCOMPARE(steps[steps.size() - 3].call, DiskCall::SyncAll);
        QCOMPARE(steps[steps.size() - 2], (DiskStep{DiskCall::Rename, place()}));
        QCOMPARE(steps.back(), (DiskStep{DiskCall::Sync, folder()}));
    }

    void filesThatMakeTheOthersValidComeLast()
    {
        fill(place(), {{"dataset.json", "old"}, {"F01/visual/000.png", "old"}});
        const Contents added{
            {"dataset.json", "new"}, {"samples.csv", "new"}, {"F01/visual/001.png", "new"}, {"F02/visual/000.png", "new"}};
        const ObservedDisk disk(folder());
        write(place(), Earlier::FilesJoined, added, {"samples.csv", "dataset.json"});
        std::vector<std::string> moved;
        for (const DiskStep& step : disk.steps())
            if ((step.call == DiskCall::Rename || step.call == DiskCall::Exchange) &&
                step.file.string().find("unfinished") == std::string::npos)
                moved.push_back(step.file.lexically_relative(place()).string());
        QCOMPARE(moved, (std::vector<std::string>{"F01/visual/001.png", "F02", "samples.csv", "dataset.json"}));
    }

    void exchangesAreMadeByRenamesWhereTheFileSystemHasNone()
    {
        fill(place(), earlierReport);
        FolderDraft draft(place(), Earlier::Replaced);
        fill(draft, newReport);
        {
            ObservedDisk disk(folder());
            disk.failAt(5, EINVAL);  // three files and two folders are synced first
            draft.putInPlace();
            QCOMPARE(disk.steps()[5].call, DiskCall::Exchange);
        }
        QCOMPARE(contentsOf(place()), newReport);
    }

    void temporaryFolderVanishes()
    {
        fs::path path;
        {
            const TemporaryFolder temporary;
            path = temporary.path();
            fill(path, newReport);
            QVERIFY(fs::exists(path / "index.html"));
        }
        QVERIFY(!fs::exists(path));
    }
};

QTEST_GUILESS_MAIN(FolderDraftTest)
#include "folder_draft_test.moc"
