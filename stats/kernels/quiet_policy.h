// How Boost's distributions answer at the ends of their range: with 0, 1 or infinity instead of an exception.
#pragma once

#include <boost/math/policies/policy.hpp>

namespace stats {

using Quiet = boost::math::policies::policy<boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
                                            boost::math::policies::underflow_error<boost::math::policies::ignore_error>,
                                            boost::math::policies::evaluation_error<boost::math::policies::ignore_error>>;

}  // namespace stats
