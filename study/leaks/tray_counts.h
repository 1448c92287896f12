// What can be counted on the trays of one participant: how often pieces and sets of pieces lie there, and in which slot, what
// lies before and after, and where the tray stands in the list. And guessers of anchors by these counts.
#pragma once

#include <vector>

#include "study/leaks/guessers.h"
#include "study/leaks/seen_study.h"

namespace study::leaks {

/// Counts over the list that a trial belongs to, as readable values beside each trial.
std::vector<Feature> trayCounts(const SeenStudy& study);

/// Guessers who know how many anchors each list has. They learn from the slots of one parity how much likelier each count is for
/// an anchor, and name as many of the likeliest trials of each other list. A hit is an anchor. Trials of the first block of a
/// list are left out, because no repetition stands there. The chance is the share of anchors among the others. So a hint is found
/// that never makes an anchor likelier than not, and that the commonest class therefore hides.
std::vector<Guess> guessesOfAnchors(const SeenStudy& study, const Truth& truth);

}  // namespace study::leaks
