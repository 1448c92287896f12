// Mauchly's test of sphericity (1940), only where it is defined: at least as many blocks as conditions, and no
// difference between conditions that is a linear combination of others.
#pragma once

#include <optional>

#include "stats/kernels/two_way.h"
#include "stats/kernels/value.h"

namespace stats {

struct MauchlyTest {
    std::string why;     ///< empty when p exists
    Value w;             ///< 1 when spherical
    Value chiSquared;    ///< -(n - 1) rho log w
    Value df;            ///< k (k - 1)/2 - 1
    Value pChiSquared;   ///< first order
    Value pSecondOrder;  ///< with the second term of Box's expansion (1949); R's mauchly.test has k for k - 1 in one place
};

MauchlyTest mauchlyTest(const TwoWayEffects& effects);
MauchlyTest mauchlyTest(const BlockTable& table);

/// From the logarithm of W (none where some contrasts determine others) of `contrasts` orthonormal contrasts, whose covariance
/// has `errorDegrees` degrees of freedom.
MauchlyTest mauchlyTest(std::optional<double> logW, double contrasts, double errorDegrees);

}  // namespace stats
