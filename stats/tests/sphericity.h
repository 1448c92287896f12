// Mauchly's test of sphericity (1940), only where it is defined: more blocks than conditions, and
// differences between conditions that no other differences determine.
#pragma once

#include "stats/kernels/two_way.h"
#include "stats/kernels/value.h"

namespace stats {

struct MauchlyTest {
    std::string why;     ///< empty when p exists
    Value w;             ///< 1 when spherical
    Value chiSquared;    ///< -(n - 1) rho log w
    Value df;            ///< k (k - 1)/2 - 1
    Value pChiSquared;   ///< first order
    Value pSecondOrder;  ///< with the second term of Box's expansion (1949), which R reports with one term of k instead of k - 1
};

MauchlyTest mauchlyTest(const TwoWayEffects& effects);
MauchlyTest mauchlyTest(const BlockTable& table);

}  // namespace stats
