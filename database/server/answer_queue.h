// What a station could not yet send to the server, in order, in a file of this disk (queue.db). An entry is synced before put()
// returns, and removed only when the server has it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "database/disk/study_folder.h"
#include "database/sqlite_connection.h"

namespace database {

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

private:
    SqliteConnection m_file;
};

}  // namespace database
