// Running orders of a whole study over abstract labels: which label and fabric each participant
// meets when, beside which foils, in which tray slot. Labels are numbers without meaning; which
// condition each one is, is drawn elsewhere and secretly (allocation.h), so the seed of a design
// tells nobody a condition.
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/protocol.h"
#include "protocols/random.h"

namespace protocols {

/// The label of a catch trial, whose glass stays blank; balance is not asked of it.
constexpr int catchTrialLabel = -1;

/// One presentation of the design. All numbers count from 0.
struct DesignTrial {
    int phase = 0;
    int label = 0;                  ///< stands for a condition, or is catchTrialLabel
    int fabric = 0;                 ///< the true fabric
    std::vector<int> alternatives;  ///< fabrics in tray-slot order A, B, C ...; one entry in rating phases
    bool operator==(const DesignTrial&) const = default;
};

/// [participant][presentation], all phases one after another.
struct Design {
    std::vector<std::vector<DesignTrial>> participants;
    bool operator==(const Design&) const = default;
};

/// Balanced over the whole study, per phase: each ordered pair of labels and of fabrics follows one
/// another equally often (counts differ by at most one where that can be had), no immediate repeat,
/// foil pairs equally often per true fabric, none repeated within participant x true fabric, true
/// slots balanced per participant x fabric and per label. Integer arithmetic only: the same seed
/// gives the same design on every machine. Takes the counts from the protocol.
Design drawDesign(const Protocol& protocol, std::uint64_t seed);

}  // namespace protocols
