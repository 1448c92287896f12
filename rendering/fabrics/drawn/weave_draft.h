// Drafts of woven fabrics, drawn at random: plain weaves, ribs, baskets, twills, herringbones, satins, crepes, dobby drafts,
// honeycombs and damasks. `runs` tells how long a yarn stays on one side, which shapes its relief.
#pragma once

#include <string>
#include <vector>

#include "protocols/random.h"
#include "rendering/fabrics/procedural/structures.h"

namespace rendering::fabrics {

struct NamedDraft {
    Draft draft;
    std::string name;         ///< "twill 2/2", "satin 5", "dobby 8×10"
    double longestFloat = 1;  ///< crossings that the longest float passes
    bool isFine = false;      ///< true for weaves that are made of fine, dense yarns: satins and damasks
};

/// Draws a draft of at most 64 × 64 crossings without floats longer than 12.
NamedDraft drawDraft(protocols::Random& random);

/// Where one crossing lies in the float of its yarn.
struct FloatPlace {
    float length = 1;  ///< crossings of the float, 1 to 12 or more
    float middle = 0;  ///< 0 at the ends of the float, 1 in its middle; 0 where length is 1
};

/// One entry a crossing, as in Draft::ups: for the warp, or for the weft.
std::vector<FloatPlace> floatPlaces(const Draft& draft, bool ofWarp);

}  // namespace rendering::fabrics
