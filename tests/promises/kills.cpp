#include "tests/promises/kills.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QProcess>
#include <algorithm>
#include <cstdio>

#include "protocols/random.h"
#include "tests/promises/kept_answers.h"
#include "tests/support/played_session.h"

namespace tests::promises {

namespace {

/// What a killed child said.
struct Sitting {
    int found = -1;          ///< answers in the study when it was opened; -1: it was killed before
    int acknowledged = 0;    ///< answers in the end
    bool ended = false;      ///< the session was over before the kill
    double openSeconds = 0;  ///< from the start of the process until the session was open
};

class Child {
public:
    explicit Child(const database::StudyFolder& folder)
    {
        m_process.start(QCoreApplication::applicationDirPath() + "/session_child",
                        {"play", QString::fromStdString(folder.folder.string()), "S01"});
        m_timer.start();
        m_process.waitForStarted();
    }

    /// Reads until the process ends or `seconds` have passed since its start.
    void readFor(double seconds)
    {
        while (m_process.state() != QProcess::NotRunning) {
            const double left = seconds - secondsSinceStart();
            if (left <= 0) break;
            m_process.waitForReadyRead(std::max(1, static_cast<int>(left * 1000)));
            readLines();
        }
    }

    Sitting kill()
    {
        m_process.kill();
        m_process.waitForFinished();
        readLines();
        return m_said;
    }

private:
    double secondsSinceStart() const { return static_cast<double>(m_timer.nsecsElapsed()) / 1e9; }

    void readLines()
    {
        while (m_process.canReadLine()) {
            const QByteArray line = m_process.readLine().trimmed();
            if (line.startsWith("open ")) {
                m_said.found = m_said.acknowledged = line.mid(5).toInt();
                m_said.openSeconds = secondsSinceStart();
            }
            if (line.startsWith("answer ")) m_said.acknowledged = line.mid(7).toInt();
            if (line == "end") m_said.ended = true;
            if (line.startsWith("fault")) std::fprintf(stderr, "%s\n", line.constData());
        }
    }

    QProcess m_process;
    QElapsedTimer m_timer;
    Sitting m_said;
};

}  // namespace

Promise afterKills(const Effort& effort)
{
    SessionStudy study(paperStudy());
    protocols::Random random(20260101);
    Losses losses;
    double longestOpening = 0, wholeSeconds = 0;
    database::StudyFolder folder = study.copy();
    {
        Child undisturbed(folder);
        QElapsedTimer timer;
        timer.start();
        undisturbed.readFor(600);
        wholeSeconds = static_cast<double>(timer.nsecsElapsed()) / 1e9;
        if (undisturbed.kill().acknowledged != static_cast<int>(study.expected().size())) ++losses.lost;
    }
    folder = study.copy();
    int kills = 0, studies = 1, acknowledged = 0;
    while (kills < effort.kills) {
        Child child(folder);
        child.readFor(wholeSeconds * random.uniform(0, 0.5));
        const Sitting said = child.kill();
        kills += !said.ended;
        longestOpening = std::max(longestOpening, said.openSeconds);
        // At most the answer that was under way at the kill is stored without an acknowledgement.
        if (said.found >= 0) {
            losses.lost += std::max(0, acknowledged - said.found);
            losses.wrong += std::max(0, said.found - acknowledged - 1);
            acknowledged = said.acknowledged;
        }
        if (!said.ended && kills < effort.kills) continue;
        {
            support::OpenSession session(folder, "S01");
            losses += study.lossesIn(session.store, acknowledged);
            session.playToEnd();
            losses += study.lossesIn(session.store, static_cast<int>(study.expected().size()));
        }
        std::filesystem::remove_all(folder.folder);
        folder = study.copy();
        acknowledged = 0;
        ++studies;
    }
    char seconds[40];
    std::snprintf(seconds, sizeof seconds, "; slowest start with resume %.2f s", longestOpening);
    const bool keeps = losses == Losses{};
    return {"kill -9 of a session", withCommas(kills) + " kills in " + withCommas(studies - 1) + " sessions of 252 answers",
            "0 lost, 0 doubled, resume < 1 s", textOf(losses) + seconds,
            keeps && effort.decidesTimes ? longestOpening < 1 : keeps};
}

}  // namespace tests::promises
