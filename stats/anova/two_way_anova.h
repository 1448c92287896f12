// Analysis of variance of two factors: what its three designs share. Factors count as manipulated, not measured, in the
// generalised eta squared (Olejnik and Algina 2003).
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "stats/kernels/value.h"
#include "stats/tests/sphericity.h"

namespace stats {

/// How the sums of squares of main effects treat unequal sizes. In balanced designs both are equal.
enum class SumsOfSquares {
    TypeII,   ///< each main effect adjusted for the other: means weighted by size
    TypeIII,  ///< each main effect over the unweighted means of the other factor
};

struct AnovaEffect {
    std::string name;
    std::string why;  ///< empty when F exists
    Value ss;
    Value ssError;  ///< of the effect's own error term
    Value df1;
    Value df2;
    Value f;
    Value p;  ///< for effects within participants: assumes sphericity
    Value logP;
    Value partialEtaSquared;
    Value generalizedEtaSquared;
    bool within = false;  ///< an effect within participants: only then the rest is set
    Value epsilonGg;      ///< Greenhouse and Geisser 1959
    Value pGg;
    Value logPGg;
    Value epsilonHf;  ///< Huynh and Feldt 1976 with Lecoutre's correction for groups; the test uses 1 where it exceeds 1
    Value pHf;
    Value logPHf;
    MauchlyTest mauchly;
};

struct TwoWayAnova {
    std::string why;                     ///< empty when at least one F exists
    std::size_t values = 0;              ///< values that were used
    std::size_t missing = 0;             ///< values that are NaN
    std::size_t participants = 0;        ///< designs with participants: those with a value in every cell
    std::size_t dropped = 0;             ///< the other participants
    bool balanced = false;               ///< all cells, or all groups of participants, have one size
    std::array<AnovaEffect, 3> effects;  ///< the first factor, the second, their interaction
};

}  // namespace stats
