#include "tests/promises/mid_session.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <algorithm>
#include <functional>
#include <system_error>

#include "database/rescue_files.h"
#include "protocols/files/errors.h"
#include "tests/promises/kept_answers.h"
#include "tests/support/counting_vfs.h"
#include "tests/support/folder_harm.h"
#include "tests/support/played_session.h"

namespace tests::promises {

namespace {

namespace fs = std::filesystem;
using support::CountingVfs;
using support::OpenSession;

struct Outcome {
    Losses losses;
    int tried = 0;
    int wentOn = 0;  ///< sessions that took an answer, or showed a stimulus, after the harm
};

/// True if the session takes another answer, or shows another stimulus.
bool goesOn(OpenSession& session)
{
    const int answers = session.driver->state().answersStored;
    const std::size_t shown = session.display.calls.size();
    for (int attempt = 0; attempt < 2; ++attempt) {
        try {
            session.playUntilAnswers(answers + 1);
            return true;
        } catch (const protocols::Error&) {
            // Once more, as an operator would.
        }
    }
    return session.driver->state().answersStored != answers || session.display.calls.size() != shown;
}

/// Finishes the session in a new process, so to speak, and compares.
Losses lossesAfterwards(const SessionStudy& study, const database::StudyFolder& folder, int acknowledged)
{
    OpenSession session(folder, "S01");
    Losses losses = study.lossesIn(session.store, acknowledged);
    session.playToEnd();
    losses += study.lossesIn(session.store, static_cast<int>(study.expected().size()));
    return losses;
}

void harmFolder(SessionStudy& study, support::FolderHarm harm, int answers, Outcome& outcome)
{
    const database::StudyFolder folder = study.copy();
    {
        OpenSession session(folder, "S01");
        session.playUntilAnswers(answers);
        doHarm(harm, folder);
        outcome.wentOn += goesOn(session);
    }
    putRight(harm, folder);
    ++outcome.tried;
    const auto files = database::rescueFiles(folder);
    if (files.empty()) {
        outcome.losses.lost += answers;
        return;
    }
    database::StudyStore::rescue(folder, files.front());
    outcome.losses += lossesAfterwards(study, folder, answers);
    fs::remove_all(folder.folder);
}

/// A file system of 16 MB that nobody else sees. It needs the rights of root.
class SmallFileSystem {
public:
    explicit SmallFileSystem(const fs::path& where) : m_where(where)
    {
        fs::create_directories(where);
        m_isThere = ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                    ::mount("none", where.c_str(), "tmpfs", 0, "size=16m") == 0;
    }
    ~SmallFileSystem()
    {
        if (m_isThere) ::umount2(m_where.c_str(), MNT_DETACH);
    }
    SmallFileSystem(const SmallFileSystem&) = delete;
    SmallFileSystem& operator=(const SmallFileSystem&) = delete;

    bool isThere() const { return m_isThere; }

    /// Writes a file until nothing more fits.
    void fill() const
    {
        const int file = ::open(filler().c_str(), O_CREAT | O_WRONLY, 0600);
        const std::string block(512, 'x');
        while (file >= 0 && ::write(file, block.data(), block.size()) > 0) {
        }
        if (file >= 0) ::close(file);
    }
    void makeRoom() const { fs::remove(filler()); }

private:
    fs::path filler() const { return m_where / "filler"; }
    fs::path m_where;
    bool m_isThere = false;
};

void fillFileSystem(SessionStudy& study, const SmallFileSystem& small, const fs::path& place, int answers, Outcome& outcome)
{
    const database::StudyFolder original = study.copy(), folder{place / "study"};
    fs::copy(original.folder, folder.folder, fs::copy_options::recursive);
    int acknowledged = 0;
    {
        OpenSession session(folder, "S01");
        session.playUntilAnswers(answers);
        small.fill();
        try {
            session.playToEnd();
        } catch (const protocols::Error&) {
            outcome.wentOn += goesOn(session);
        }
        acknowledged = session.driver->state().answersStored;
    }
    small.makeRoom();
    ++outcome.tried;
    outcome.losses += lossesAfterwards(study, folder, acknowledged);
    fs::remove_all(folder.folder);
    fs::remove_all(original.folder);
}

/// Every write and sync fails from one moment on, with the code that SQLite gives.
void failFileSystem(SessionStudy& study, int writeCode, int answers, Outcome& outcome)
{
    CountingVfs disk;
    const database::StudyFolder folder = study.copy();
    {
        OpenSession session(folder, "S01");
        session.playUntilAnswers(answers);
        disk.setFault({0, true, writeCode, SQLITE_IOERR_FSYNC});
        outcome.wentOn += goesOn(session);
    }
    disk.setFault({});
    ++outcome.tried;
    outcome.losses += lossesAfterwards(study, folder, answers);
    fs::remove_all(folder.folder);
}

/// No answer is acknowledged before its slow sync.
void slowFileSystem(SessionStudy& study, int answers, Outcome& outcome)
{
    constexpr int delayMs = 30;
    CountingVfs disk;
    const database::StudyFolder folder = study.copy();
    int acknowledged = 0;
    {
        OpenSession session(folder, "S01");
        session.playUntilAnswers(answers);
        disk.slowDown(std::chrono::milliseconds(delayMs));
        QElapsedTimer timer;
        timer.start();
        session.playUntilAnswers(answers + 1);
        outcome.wentOn += timer.elapsed() < delayMs;
        acknowledged = session.driver->state().answersStored;
        disk.slowDown(std::chrono::milliseconds(0));
    }
    ++outcome.tried;
    outcome.losses += lossesAfterwards(study, folder, acknowledged);
    fs::remove_all(folder.folder);
}

}  // namespace

Promise afterMidSessionHarm(const Effort& effort)
{
    SessionStudy study;
    const int answers = static_cast<int>(study.expected().size());
    const int stride = effort.midSessionMoments == 0 ? 1 : std::max(1, answers / effort.midSessionMoments);
    const QTemporaryDir place;
    const fs::path smallPlace = place.filePath("small").toStdString();
    const SmallFileSystem small(smallPlace);
    Outcome outcome;
    for (int moment = 0; moment < answers; moment += stride) {
        for (const support::NamedHarm& one : support::folderHarms()) harmFolder(study, one.harm, moment, outcome);
        if (small.isThere()) fillFileSystem(study, small, smallPlace, moment, outcome);
        failFileSystem(study, SQLITE_FULL, moment, outcome);
        failFileSystem(study, SQLITE_READONLY, moment, outcome);
        slowFileSystem(study, moment, outcome);
    }
    return {
        "database or log deleted, replaced, renamed, emptied or overwritten in place, folder moved, disk full, read-only, slow",
        withCommas(outcome.tried) + " sessions of 24 answers" +
            (small.isThere() ? "" : " (a full disk only simulated: a real one needs root)"),
        "0 lost, with the rescue file; the session stops before the next trial",
        textOf(outcome.losses) + "; " + std::to_string(outcome.wentOn) + " went on",
        outcome.losses == Losses{} && outcome.wentOn == 0};
}

}  // namespace tests::promises
