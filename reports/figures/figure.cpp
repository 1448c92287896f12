#include "reports/figures/figure.h"

#include "reports/text/plain_words.h"

namespace reports {

std::string stampedCaption(const StudyData& data, const std::string& caption)
{
    return caption + (data.simulated ? " SIMULATED participants." : "") + (data.scripted ? " SCRIPTED participants." : "");
}

std::string untestedText(const StudyData& data, const ChoiceAnalysis& choices)
{
    if (shownChance(choices) == 0) return " No line of chance: the pairs were not half the same.";
    const std::vector<std::string> untested = untestedConditions(data, choices);
    if (untested.empty()) return {};
    return " Not tested against chance under " + listed(untested) + ": the pairs were not half the same there.";
}

}  // namespace reports
