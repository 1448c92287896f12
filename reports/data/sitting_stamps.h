// What the times of a study are: whether its answers have the stamp of their beginning.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "reports/data/study_data.h"

namespace reports {

/// Collects the answers of a study, in any order. Choices and ratings decide. An answer in words may be empty, and then nobody
/// began to type it; so words decide only where there is nothing else.
class SittingStamps {
public:
    enum class Content { Number, Words };  ///< a choice or a rating, or words

    void add(const std::string& participant, const std::string& sitting, Content content, bool isStamped);

    /// To the entry where no answer has the stamp, or no answer of a whole sitting: an earlier version of the program took it,
    /// and times of two definitions must not meet in one table. Elsewhere a single answer without the stamp has no time.
    TimesTaken times() const;

private:
    struct Count {
        std::size_t answers = 0, stamped = 0;
    };
    Count m_numbers, m_words;
    std::map<std::pair<std::string, std::string>, Count> m_sittings;  ///< numbers only
};

}  // namespace reports
