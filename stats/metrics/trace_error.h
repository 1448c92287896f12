// How far a generated trace lies from the true one.
#pragma once

#include <cstddef>
#include <span>

#include "stats/kernels/value.h"

namespace stats {

struct TraceError {
    std::string why;  ///< empty when the traces can be compared
    std::size_t n = 0;
    Value mae;  ///< mean absolute error, unit of the traces
    Value meanTruth;
    Value maeOverMean;  ///< undefined where the mean of the truth is not positive
    Value rmse;
    Value bias;  ///< mean of generated - truth
    Value maxAbs;
};

TraceError traceError(std::span<const double> generated, std::span<const double> truth);

}  // namespace stats
