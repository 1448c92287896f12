#include "reports/data/registration.h"

#include <set>

#include "reports/text/plain_words.h"

namespace reports {

std::string timingText(std::size_t answersBefore, bool afterUnblinding)
{
    const std::string before = answersBefore == 0 ? "before the first answer" : "after " + counted(answersBefore, "answer");
    return before + (afterUnblinding ? " and after the unblinding" : "");
}

std::string usualBoundsRule(const std::vector<protocols::AnswerKind>& questions)
{
    std::set<int> lengths;
    for (const protocols::AnswerKind& kind : questions)
        if (const auto* rating = std::get_if<protocols::Rating>(&kind))
            lengths.insert(rating->scale.max.value - rating->scale.min.value);
    return std::string("a twentieth of the ") + (lengths.size() > 1 ? "shortest scale" : "scale") + " either way";
}

std::string wordingNameOf(const std::string& question) { return "wording of " + question; }

bool isInTime(const Registration& registration) { return registration.answersBefore == 0 && !registration.afterUnblinding; }

}  // namespace reports
