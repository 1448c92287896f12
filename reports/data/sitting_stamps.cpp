#include "reports/data/sitting_stamps.h"

#include <algorithm>

namespace reports {

namespace {

/// Answers of a sitting that tell what took them. A single one may lack its stamp by chance.
constexpr std::size_t fewestOfSitting = 2;

}  // namespace

void SittingStamps::add(const std::string& participant, const std::string& sitting, Content content, bool isStamped)
{
    const auto count = [isStamped](Count& one) {
        ++one.answers;
        one.stamped += isStamped ? 1 : 0;
    };
    count(content == Content::Number ? m_numbers : m_words);
    if (content == Content::Number) count(m_sittings[{participant, sitting}]);
}

TimesTaken SittingStamps::times() const
{
    const Count& all = m_numbers.answers > 0 ? m_numbers : m_words;
    if (all.answers > 0 && all.stamped == 0) return TimesTaken::ToEntry;
    const bool anyWithout = std::ranges::any_of(
        m_sittings, [](const auto& one) { return one.second.answers >= fewestOfSitting && one.second.stamped == 0; });
    return anyWithout ? TimesTaken::ToEntry : TimesTaken::ToBeginning;
}

}  // namespace reports
