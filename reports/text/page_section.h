// The sections of the report's page. Every table and every figure names its section.
#pragma once

#include <span>
#include <string>

namespace reports {

enum class PageSection {
    Summary,
    Matches,
    Ratings,
    Words,
    Claims,
    Sentences,
    Comparisons,
    Equivalence,
    Effects,
    Groups,
    Speed,
    Chain,
    Signals,
    Plan,
    Quality,
    Methods
};

struct SectionHeading {
    PageSection section;
    std::string id;  ///< the anchor of links
    std::string title;
};

/// In the order of the page.
std::span<const SectionHeading> sectionHeadings();

}  // namespace reports
