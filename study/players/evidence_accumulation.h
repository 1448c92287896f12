// How a simulated participant trades speed for accuracy where a block instructs it: a race of accumulators of evidence.
//
// One accumulator for each alternative i gathers noisy evidence from 0 (racing diffusion: Tillman, Van Zandt and Logan 2020,
// Psychon Bull Rev 27, 911):
//     dX_i = v_i dt + dW_i,    v_i = gain exp(-d_i / fall)
// d_i is the distance of stimulus and alternative in just-noticeable differences. The first accumulator at the bound a decides:
//     answer = argmin_i T_i,   response time = t0 + min_i T_i
// T_i is inverse Gaussian with mean a / v_i and shape a^2 (Schrödinger 1915), so times are drawn exactly, without steps.
// The instruction sets the bound: lower for speed, higher for accuracy. Under a deadline D the bound collapses, as a(t) =
// a (1 - t / (D - t0)) (linear form; Hawkins et al. 2015, J Neurosci 35, 2476). A linear bound is a constant one for the drift
// v_i + a / (D - t0), so that these times are exact, too. Some answers are still late, as those of people are.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "protocols/protocol.h"
#include "protocols/random.h"

namespace study::players {

struct SpeedAccuracySetting {
    double nonDecisionSeconds = 1.2;  ///< t0: the first stroke, and the beginning of the answer
    double bound = 2.0;               ///< a without an aim, square root of seconds
    double speedFactor = 0.5;         ///< of the bound where speed is instructed
    double accuracyFactor = 1.75;     ///< ... where accuracy is
    double gain = 1.2;                ///< drift at distance 0, evidence per second
    double fall = 2.5;                ///< distance at which the drift has fallen to 1/e, just-noticeable differences
    double personSpread = 0.15;       ///< SD between persons of log a
};

double driftAt(const SpeedAccuracySetting& setting, double distance);

/// The bound a under an instruction.
double boundUnder(const SpeedAccuracySetting& setting, protocols::SpeedAim aim);

struct Decision {
    std::size_t winner = 0;  ///< place among the drifts
    double seconds = 0;      ///< with the non-decision time
};

/// `drifts`: at least one, each above 0. `deadlineSeconds`: from the first touch; the bound reaches 0 there.
Decision race(std::span<const double> drifts, double bound, double nonDecisionSeconds, std::optional<double> deadlineSeconds,
              protocols::Random& random);

}  // namespace study::players
