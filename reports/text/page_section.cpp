#include "reports/text/page_section.h"

#include <array>

namespace reports {

std::span<const SectionHeading> sectionHeadings()
{
    static const std::array headings{
        SectionHeading{PageSection::Summary, "summary", "Summary"},
        SectionHeading{PageSection::Matches, "matches", "Matching the fabric"},
        SectionHeading{PageSection::Ratings, "ratings", "Ratings"},
        SectionHeading{PageSection::Words, "words", "Answers in words"},
        SectionHeading{PageSection::Claims, "claims", "Different, equivalent, or not decided"},
        SectionHeading{PageSection::Sentences, "sentences", "Sentences for a paper"},
        SectionHeading{PageSection::Comparisons, "comparisons", "All pairs: participants' means"},
        SectionHeading{PageSection::Equivalence, "equivalence", "All pairs: equivalence of participants' means"},
        SectionHeading{PageSection::Effects, "effects", "Effect sizes, agreement, variances"},
        SectionHeading{PageSection::Groups, "groups", "Groups of participants"},
        SectionHeading{PageSection::Speed, "speed", "Speed and accuracy"},
        SectionHeading{PageSection::Chain, "chain", "Speed against accuracy, from milliseconds to people"},
        SectionHeading{PageSection::Signals, "signals", "Generated against measured signals"},
        SectionHeading{PageSection::Plan, "plan", "Planned and done"},
        SectionHeading{PageSection::Quality, "quality", "Data quality"},
        SectionHeading{PageSection::Methods, "methods", "Methods"},
    };
    return headings;
}

}  // namespace reports
