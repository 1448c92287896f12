// Errors of a generated trace against the true one, value by value.
#pragma once

#include <cstddef>
#include <span>

#include "stats/kernels/value.h"

namespace stats {

struct TraceError {
    std::string why;  ///< empty when the traces can be compared
    std::size_t n = 0;
    Value mae;  ///< mean absolute error, in the unit of the traces
    Value meanTruth;
    Value maeOverMean;  ///< undefined where the mean of the truth is not positive
    Value rmse;
    Value bias;  ///< mean of generated - truth
    Value maxAbs;
};

TraceError traceError(std::span<const double> generated, std::span<const double> truth);

}  // namespace stats
