// Bits per second of a condition over participants: its interval, and values that compare conditions.
//
// The rate is that of all choices together. The mean of the participants' own rates will not do: with few choices each, a share
// correct above chance by accident counts as information. With 7 choices each, 10 participants at 1/3 correct, and about 5 s a
// choice, that mean is 0.010 where the truth is 0; at 1/2 correct it is 0.036 where the truth is 0.015.
#pragma once

#include <span>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

/// The choices of one participant under one condition.
struct ParticipantChoices {
    double correct = 0;
    double choices = 0;
    double totalSeconds = 0;  ///< of the timed choices
    double timed = 0;         ///< number of choices with a time
};

struct InformationRate {
    Value rate;     ///< bits per choice of the share correct of all choices / mean seconds of all timed choices
    Interval ci95;  ///< never below 0; undefined with a reason where participants do not vary
};

/// `alternatives`: m >= 2. The interval is that of a ratio by MOVER (Donner and Zou 2012, Stat Methods Med Res 21, 347): the
/// limits of the share correct and of the mean time are Student's t over participants, those of the share are turned into bits.
/// Measured coverage: 93 to 96 % for shares from 1/3 to .95, 10 participants and 7 choices each.
InformationRate informationRate(std::span<const ParticipantChoices> participants, int alternatives);

/// Jackknife pseudo-values of the rate, one for each participant (Tukey 1958): n rate - (n - 1) rate without the participant.
/// Undefined for participants without choices or times.
std::vector<Value> ratePseudoValues(std::span<const ParticipantChoices> participants, int alternatives);

}  // namespace stats
