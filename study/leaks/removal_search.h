// A guesser of catch trials and anchors among trays of one piece. It searches which presentations, taken out of all lists, leave
// lists in which pieces follow one another as evenly as running orders do, and no piece twice in a row.
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/random.h"
#include "study/leaks/guessers.h"
#include "study/leaks/seen_study.h"

namespace study::leaks {

/// [list][presentation]: the piece, from 0.
using PieceLists = std::vector<std::vector<int>>;

/// [list][presentation]: how often the last states of several searches take it out. `kept`: presentations of each piece that
/// stay. `moves`: of one search.
std::vector<std::vector<double>> removedBySearch(const PieceLists& lists, int kept, std::int64_t moves,
                                                 protocols::Random& random);

/// Of each piece of a list, the guesser names as many presentations as are additional. Chance is what this count alone finds.
/// What everybody may know is left out: the first presentation, and the first block where a phase has repetitions.
std::vector<Guess> guessesOfRemovals(const SeenStudy& study, const Truth& truth);

}  // namespace study::leaks
