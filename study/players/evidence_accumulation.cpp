#include "study/players/evidence_accumulation.h"

#include <algorithm>
#include <cmath>

namespace study::players {

namespace {

/// A bound that would collapse before the finger has felt anything leaves this time.
constexpr double leastDecisionSeconds = 0.2;

/// Keeps a race of hopeless alternatives finite.
constexpr double leastDrift = 0.02;

/// First passage of drift v at bound a: an inverse Gaussian draw (Michael, Schucany and Haas 1976, Am Stat 30, 88).
double firstPassage(double drift, double bound, protocols::Random& random)
{
    const double mean = bound / drift, shape = bound * bound;
    const double normal = random.normal();
    const double y = mean * normal * normal;
    // Written as a quotient, because the difference of the textbook cancels for small roots.
    const double root = 2 * shape * mean / (2 * shape + y + std::sqrt(y * (4 * shape + y)));
    return random.uniform() * (mean + root) <= mean ? root : mean * mean / root;
}

}  // namespace

double driftAt(const SpeedAccuracySetting& setting, double distance)
{
    return std::max(leastDrift, setting.gain * std::exp(-std::max(0.0, distance) / setting.fall));
}

double boundUnder(const SpeedAccuracySetting& setting, protocols::SpeedAim aim)
{
    switch (aim) {
        case protocols::SpeedAim::Speed:
            return setting.bound * setting.speedFactor;
        case protocols::SpeedAim::Accuracy:
            return setting.bound * setting.accuracyFactor;
        case protocols::SpeedAim::None:
            break;
    }
    return setting.bound;
}

Decision race(std::span<const double> drifts, double bound, double nonDecisionSeconds, std::optional<double> deadlineSeconds,
              protocols::Random& random)
{
    const double collapse = deadlineSeconds ? bound / std::max(leastDecisionSeconds, *deadlineSeconds - nonDecisionSeconds) : 0.0;
    Decision decision;
    for (std::size_t i = 0; i < drifts.size(); ++i) {
        const double seconds = firstPassage(drifts[i] + collapse, bound, random);
        if (i == 0 || seconds < decision.seconds) decision = {i, seconds};
    }
    decision.seconds += nonDecisionSeconds;
    return decision;
}

}  // namespace study::players
