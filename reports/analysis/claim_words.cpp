#include "reports/analysis/claim_words.h"

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

std::string wordsOf(stats::Generalisation generalisation)
{
    return generalisation == stats::Generalisation::TheseFabrics ? "these fabrics" : "fabrics like these";
}

}  // namespace reports
