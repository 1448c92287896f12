#include "reports/data/signal_comparison.h"

namespace reports {

std::string wordFor(SignalMeasure measure, const SignalDifference& difference)
{
    if (!difference.meanDifference.exists()) return "undefined";
    if (!difference.pHolm.exists() || !(*difference.pHolm < 0.05)) return "not decided";
    const bool larger = *difference.meanDifference > 0;
    switch (rowOf(measure).best) {
        case BestValue::Largest:
            return larger ? "better" : "worse";
        case BestValue::Smallest:
            return larger ? "worse" : "better";
        case BestValue::One:
            break;
    }
    return "not decided";
}

}  // namespace reports
