// Sensitivity of a same-different task. A participant says whether two things are the same. Sensitivity d' and the tendency to
// say "same" are separated by the answers to pairs that were the same and to pairs that differed (yes-no model of equal
// variances: Green and Swets 1966; Macmillan and Creelman 2005).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

/// One answer. Participants and fabrics are numbered from 0.
struct MatchAnswer {
    std::size_t participant = 0;
    std::size_t fabric = 0;
    bool wasSame = false;
    bool saidSame = false;
};

/// A hit is "same" to a pair that was the same; a false alarm is "same" to a pair that differed.
struct MatchCounts {
    std::size_t hits = 0;
    std::size_t same = 0;  ///< pairs that were the same
    std::size_t falseAlarms = 0;
    std::size_t different = 0;  ///< pairs that differed
    bool operator==(const MatchCounts&) const = default;
};

/// d' or the criterion c with intervals by the jackknife: one participant left out at a time; or a participant, a fabric, and a
/// cell of both at a time, whose variances are combined as for two-way clusters (Cameron, Gelbach and Miller 2011).
struct ClusteredIndex {
    Value estimate;
    Interval overParticipants;  ///< 95 %: new participants, these fabrics; Student's t, participants - 1 df
    Interval overBoth;          ///< 95 %: new participants and new fabrics; Student's t, the smaller number - 1 df
};

/// d' = z(hit rate) - z(false-alarm rate). c = -(z(hit rate) + z(false-alarm rate)) / 2: positive where "different" is said more
/// readily. The rates behind both have 1/2 added to each count and 1 to each number of pairs (Hautus 1995), so that they stay
/// inside 0 and 1. Answers of all participants are pooled: where their criteria differ, d' comes out somewhat too small.
struct MatchSensitivity {
    std::string why;  ///< empty when there is a d'
    MatchCounts counts;
    Value hitRate;         ///< as counted
    Value falseAlarmRate;  ///< as counted
    ClusteredIndex dPrime;
    Value seDPrime;  ///< with the answers as independent (Gourevitch and Galanter 1967)
    ClusteredIndex criterion;
};

/// Refused with a reason: no pair that was the same, or none that differed. Intervals need two participants, and two fabrics,
/// and rates that are not the same for all.
MatchSensitivity matchSensitivity(const std::vector<MatchAnswer>& answers);

}  // namespace stats
