// The open study of a StudyStore: its connection, its lock, and what keeps its answers where its files are replaced.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>

#include "database/disk/open_files.h"
#include "database/disk/write_lock.h"
#include "database/sqlite_connection.h"
#include "database/study_store.h"
#include "protocols/files/errors.h"
#include "protocols/files/temporary_folder.h"

namespace database {

struct StudyStore::Connection {
    enum class Moment { BeforeStep, AfterStep };  ///< when the open files are looked at

    std::unique_ptr<protocols::TemporaryFolder> copy;  ///< of a study of an earlier version that is only read
    StudyFolder folder;
    std::unique_ptr<WriteLock> lock;  ///< null for a reader
    SqliteConnection sqlite;
    std::filesystem::path serverFolder = {};  ///< of a study on a server, of which this is a copy
    std::optional<OpenFiles> files = {};      ///< of a writer
    std::filesystem::path keptAside = {};     ///< the rescue file, once the open files are no longer in place
    LogHead keptHead = {};                    ///< end of the log in the rescue file
    std::optional<StudyFacts> facts = {};     ///< once they were asked for
    /// Participants that the open batch may store; none without a batch.
    std::optional<std::set<protocols::ParticipantId>> batch = {};
    bool isGivenUp = false;                   ///< the files hold bytes of somebody else
    bool isTold = false;                      ///< that the files are not in place
    std::filesystem::path upgradedFrom = {};  ///< the study of which this is an upgraded copy
    bool isChainedAnew = false;               ///< the log of this copy

    /// A database that somebody overwrote, deleted or replaced since the last step is noticed at the end, too. The bytes that
    /// stand there then are not mixed with older ones. Where only its log is gone, the close moves what the open log holds into
    /// the database.
    ~Connection();

    /// Keeps aside what the close might lose. A folder that was moved has its files with it, and one that was removed is not
    /// wanted any more. A file system that does not answer may have lost them.
    void lookAtTheEnd();

    /// Throws workFailed for a participant whom the open batch may not store.
    void requireInBatch(bool belongs, const protocols::ParticipantId& participant) const;

    /// False for a writer whose files somebody deleted, replaced, overwrote or moved. Everything stored so far is kept aside
    /// then. Before a step, throws environmentFault where the file system does not say; the same step can then be done again.
    bool hasFilesInPlace(Moment moment = Moment::BeforeStep);

    /// The error that tells a writer, whose files are not in place, where everything stored so far is kept.
    protocols::Error displaced() const;

    /// Stops a writer whose files, or whose lock, are no longer in place.
    void requireFilesInPlace(Moment moment = Moment::BeforeStep);
};

}  // namespace database
