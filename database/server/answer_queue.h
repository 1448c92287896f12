// What a station could not yet send to the server, in order, in a file of this disk (queue.db). An entry is synced before put()
// returns, and removed only when the server has it. Beside it stands what the station has seen of the study's log.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "database/disk/study_folder.h"
#include "database/session_store.h"
#include "database/sqlite_connection.h"

namespace database {

/// What a station has seen of a study's log. It shows a server that lost entries, also where no session was open.
struct SeenLog {
    std::string study;  ///< identityOf() the study
    LogHead head;       ///< the newest that the server named
    /// Entry after which entries of this log are missing on the server; none where none is, or where somebody has agreed to go
    /// on.
    std::optional<std::int64_t> lostAfter = {};
    bool operator==(const SeenLog&) const = default;
};

class AnswerQueue {
public:
    struct Entry {
        std::int64_t number = 0;  ///< set by put()
        std::string participant, kind;
        std::string json;  ///< as the server's function store() takes it
    };

    explicit AnswerQueue(const StudyFolder& folder);

    void put(const Entry& entry);
    std::optional<Entry> first() const;
    void remove(std::int64_t number);
    std::size_t size() const;

    /// What was kept of this study. What was kept of another one is removed. A damaged row counts as none.
    SeenLog seenOf(const std::string& study);
    /// Participants who were enrolled here, with those that the server may have lost.
    std::set<std::string> enrolledHere() const;
    /// Both do not wait for the disk, so a power cut may take their last values. They ignore faults: no answer must fail for
    /// them.
    void keepSeen(const SeenLog& seen);
    void keepEnrolled(const std::string& participant);

private:
    /// Never throws.
    void keep(const QString& sql, const QVariantList& values);
    /// From here on a commit returns only when it is on the disk.
    void waitForDisk();

    SqliteConnection m_file;
    bool m_waitsForDisk = true;  ///< false while, or after, something is kept without waiting
};

}  // namespace database
