#include "tests/promises/disk_faults.h"

#include <algorithm>

#include "protocols/files/errors.h"
#include "tests/promises/kept_answers.h"
#include "tests/support/counting_vfs.h"
#include "tests/support/played_session.h"

namespace tests::promises {

namespace {

using support::CountingVfs;
using support::DiskFault;
using support::OpenSession;

/// What one fault did to a session.
struct Played {
    int acknowledged = 0;
    int faults = 0;       ///< steps that failed
    bool wentOn = false;  ///< a step that failed took an answer or showed a stimulus
    bool ended = false;   ///< the session was finished all the same, without being opened again
};

/// Takes one step. False at the end of the session.
bool step(OpenSession& session, Played& played)
{
    const std::size_t shown = session.display.calls.size();
    try {
        const bool goesOn = session.step();
        played.acknowledged = session.driver->state().answersStored;
        return goesOn;
    } catch (const protocols::Error&) {
        ++played.faults;
        played.wentOn = played.wentOn || session.driver->state().answersStored != played.acknowledged ||
                        session.display.calls.size() != shown;
        return true;
    }
}

/// Plays until the end, or until a fault that lasts has stopped the session twice.
Played playIntoFault(const database::StudyFolder& folder, const DiskFault& fault)
{
    Played played;
    const int mostFaults = fault.lasts ? 2 : 10;
    try {
        OpenSession session(folder, "S01");
        while (played.faults < mostFaults && !played.ended) played.ended = !step(session, played);
    } catch (const protocols::Error&) {
        ++played.faults;  // the study could not even be opened
    }
    return played;
}

}  // namespace

Promise afterDiskFaults(const Effort& effort)
{
    SessionStudy study;
    const int answers = static_cast<int>(study.expected().size());
    CountingVfs disk;
    disk.setFault({});
    playIntoFault(study.copy(), {});
    const std::int64_t operations = disk.operations();
    const std::int64_t stride = effort.faultPositions == 0 ? 1 : std::max<std::int64_t>(1, operations / effort.faultPositions);

    Losses losses;
    int tried = 0, stopped = 0, wentOn = 0;
    for (std::int64_t position = 0; position < operations; position += stride)
        for (const DiskFault& fault : {DiskFault{position, false, SQLITE_IOERR_WRITE, SQLITE_IOERR_FSYNC},
                                       DiskFault{position, true, SQLITE_FULL, SQLITE_IOERR_FSYNC}}) {
            const database::StudyFolder folder = study.copy();
            disk.setFault(fault);
            const Played played = playIntoFault(folder, fault);
            disk.setFault({});
            ++tried;
            stopped += played.faults > 0;
            wentOn += played.wentOn;
            {
                OpenSession session(folder, "S01");
                losses += study.lossesIn(session.store, played.acknowledged);
                session.playToEnd();
                losses += study.lossesIn(session.store, answers);
            }
            std::filesystem::remove_all(folder.folder);
        }
    return {"a write or a sync fails, once or from then on",
            withCommas(tried) + " faults at " + withCommas(tried / 2) + " of " + withCommas(operations) +
                " writes and syncs of one session of 24 answers",
            "0 lost; the session stops before the next trial",
            textOf(losses) + "; " + withCommas(stopped) + " stopped the session, " + withCommas(tried - stopped) +
                " hit a checkpoint that is done again; " + std::to_string(wentOn) + " went on",
            losses == Losses{} && wentOn == 0};
}

}  // namespace tests::promises
