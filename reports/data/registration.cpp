#include "reports/data/registration.h"

#include "reports/text/plain_words.h"

namespace reports {

std::string timingText(std::size_t answersBefore, bool afterUnblinding)
{
    const std::string before = answersBefore == 0 ? "before the first answer" : "after " + counted(answersBefore, "answer");
    return before + (afterUnblinding ? " and after the unblinding" : "");
}

bool isInTime(const Registration& registration) { return registration.answersBefore == 0 && !registration.afterUnblinding; }

}  // namespace reports
