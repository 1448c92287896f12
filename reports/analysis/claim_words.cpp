#include "reports/analysis/claim_words.h"

#include <string_view>

namespace reports {

std::string wordsOf(stats::Verdict verdict)
{
    switch (verdict) {
        case stats::Verdict::Different:
            return "different";
        case stats::Verdict::Equivalent:
            return "equivalent";
        case stats::Verdict::DifferentWithinBounds:
            return "different, within the bounds";
        case stats::Verdict::NotDecided:
            break;
    }
    return "not decided";
}

std::string tableWords(const std::string& verdict)
{
    constexpr std::string_view noDifference = "not different", noEquivalence = "not shown equivalent";
    std::string words = verdict;
    if (words.starts_with(noDifference)) words.replace(0, noDifference.size(), "difference not shown");
    if (words.ends_with(noEquivalence))
        words.replace(words.size() - noEquivalence.size(), noEquivalence.size(), "equivalence not shown");
    return words;
}

std::string wordsOf(stats::Generalisation generalisation)
{
    return generalisation == stats::Generalisation::TheseFabrics ? "these fabrics" : "fabrics like these";
}

}  // namespace reports
