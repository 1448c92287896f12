#include "database/open_study.h"

#include <algorithm>
#include <cstdio>
#include <system_error>

#include "database/rescue.h"
#include "database/rescue_files.h"
#include "database/study_rows.h"
#include "protocols/files/safe_text.h"

namespace database {

StudyStore::Connection::~Connection()
{
    try {
        if (files && keptAside.empty()) lookAtTheEnd();
        if (!isTold && (isGivenUp || !keptAside.empty())) std::fprintf(stderr, "%s\n", displaced().what());
    } catch (const std::exception& fault) {
        std::fprintf(stderr, "%s\n", fault.what());
    }
    if (isGivenUp || (!keptAside.empty() && !files->hasDatabaseInPlace())) files->giveUp(!keptAside.empty());
}

void StudyStore::Connection::lookAtTheEnd()
{
    std::error_code unknown;
    const OpenFiles::State state = files->state();
    const bool isLost =
        state == OpenFiles::State::Gone && !files->hasDatabaseInPlace() && std::filesystem::exists(folder.folder, unknown);
    if (state == OpenFiles::State::Overwritten || isLost) hasFilesInPlace();
    if (state != OpenFiles::State::Unseen || !files->copy()) return;
    const protocols::Error fault = files->unseen();
    std::fprintf(stderr, "%s; every stored answer is kept in %s, too\n", fault.what(),
                 keepAside(sqlite, files->copy(), folder).c_str());
}

void StudyStore::Connection::requireInBatch(bool belongs, const protocols::ParticipantId& participant) const
{
    if (belongs) return;
    throw protocols::workFailed({"only simulated participants are stored in batches", participant.value,
                                 "each event of other participants in a transaction of its own", ""});
}

bool StudyStore::Connection::hasFilesInPlace(Moment moment)
{
    if (!files) return true;
    if (!keptAside.empty()) return false;
    const OpenFiles::State state = files->state();
    if (state == OpenFiles::State::InPlace) return true;
    if (state == OpenFiles::State::Unseen) {
        if (moment == Moment::AfterStep) return true;  // it is stored, so it must not be done again
        throw files->unseen();
    }
    if (state == OpenFiles::State::Overwritten && files->copy() && holdsAllOf(*files->copy(), folder.database())) {
        files->takeCopy();
        return true;
    }
    isGivenUp = isGivenUp || state == OpenFiles::State::Overwritten;
    if (isGivenUp && !files->copy()) return false;  // a very large study, or one of simulated participants
    keptAside = keepAside(sqlite, files->copy(), folder);
    keptHead = headIn(SqliteConnection(keptAside, SqliteConnection::Mode::Read));
    return false;
}

protocols::Error StudyStore::Connection::displaced() const
{
    if (keptAside.empty())
        return protocols::workFailed({"the database is damaged (overwritten while it was open)", folder.database().string(),
                                      "the file that the session began with",
                                      "keep study.db-wal, which holds the newest answers; restore study.db from a backup"});
    const auto found = rescueFiles(folder);  // none in the folder for temporary files
    const bool isFound = std::ranges::find(found, keptAside) != found.end();
    return protocols::environmentFault({"the database of the study was deleted, replaced, overwritten or moved while it was open",
                                        folder.database().string(), "the file that the session began with",
                                        "every stored answer is kept in " + keptAside.string() +
                                            "; close the study, then run vis2hap rescue " +
                                            protocols::shellWord(folder.folder.string()) +
                                            (isFound ? "" : " --from " + protocols::shellWord(keptAside.string()))});
}

void StudyStore::Connection::requireFilesInPlace(Moment moment)
{
    if (!hasFilesInPlace(moment)) {
        isTold = true;
        throw displaced();
    }
    if (lock && moment == Moment::BeforeStep) lock->requireInPlace();
}
}  // namespace database
