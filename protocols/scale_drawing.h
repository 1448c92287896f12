// How the line of a rating scale is drawn: in the window, on the participant's page and on the printed card.
#pragma once

#include "protocols/answer_kind.h"

namespace protocols {

/// Sections between the marks of the line. A scale with words has one section between two neighbouring words.
inline int drawnSections(const RatingScale& scale)
{
    return scale.labels.size() > 1 ? static_cast<int>(scale.labels.size()) - 1 : scale.sections;
}

}  // namespace protocols
