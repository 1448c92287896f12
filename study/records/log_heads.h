// Heads of the log and of the acts that were given out: on a session's end, in reports, exports and backups, on certificates. A
// study that still contains them was not rolled back, cut or chained anew.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "database/study_store.h"

namespace study::records {

/// Heads that somebody gives, and texts that look like heads and cannot be read, because a digit is missing or is none.
struct GivenHeads {
    std::vector<database::LogHead> heads;
    std::vector<std::string> unread;
};

/// The heads in `headOrFile`: SEQUENCE:HASH with at least 16 digits of the hash, or a whole hash alone (sequence 0), or else
/// every SEQUENCE:HASH in the text of this file. Capital letters and blanks after the colon are accepted, because people copy
/// heads by hand. Throws badInput where there is none, or where the file cannot be read.
GivenHeads headsIn(const std::string& headOrFile);

/// The end of the log as SEQUENCE:HASH. For a study of an earlier version that is not upgraded, words that say so: each copy of
/// it is chained anew, with a head of its own. Somebody may have altered the stored hash, so it is written as printable() does.
std::string headTextOf(const database::StudyStore& store);

/// Throws badInput for such a study.
void requireLastingHead(const database::StudyStore& store);

/// Compares heads with one study. It reads the acts once, because a file may contain thousands of heads.
class HeadCheck {
public:
    /// The store must outlive this value.
    explicit HeadCheck(const database::StudyStore& store);

    /// Why neither the log nor the acts contain the head; empty where one does.
    std::string faultOf(const database::LogHead& head);

private:
    const database::StudyStore& m_store;
    database::LogHead m_last;
    std::optional<std::map<std::int64_t, std::string>> m_hashesOfActs;  ///< by their numbers; read for the first unknown head
};

/// The same for one head.
std::string faultAgainst(const database::StudyStore& store, const database::LogHead& head);

}  // namespace study::records
