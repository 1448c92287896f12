// Draws the running orders of a whole study over abstract labels: for each presentation of each participant the label, the
// fabric, the foils and the tray slots. A label is a number without meaning. allocation.h draws in secret which condition it
// is, so the seed of a design does not reveal a condition.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "protocols/protocol.h"
#include "protocols/random.h"

namespace protocols {

/// The label of a catch trial (blank glass). Catch trials are not balanced.
constexpr int catchTrialLabel = -1;
/// The label of a mismatched presentation, whose condition the protocol names.
constexpr int mismatchedLabel = -2;

/// One presentation of the design. All numbers count from 0.
struct DesignTrial {
    int phase = 0;
    int label = 0;                        ///< label of a condition, catchTrialLabel or mismatchedLabel
    int fabric = 0;                       ///< the true fabric, which is that of the image
    std::vector<int> alternatives;        ///< fabrics in tray-slot order A, B, C ...; one entry in rating phases
    std::optional<int> instruction = {};  ///< place in Phase::instructions; none where the phase gives none
    AnchorKind anchor = AnchorKind::None;
    bool operator==(const DesignTrial&) const = default;
};

/// [participant][presentation], all phases one after another.
struct Design {
    std::vector<std::vector<DesignTrial>> participants;
    bool operator==(const Design&) const = default;
};

/// A design that is balanced over the whole study, phase by phase. Ordered pairs of labels and of fabrics follow one another
/// equally often (counts differ by at most one where possible). Nothing repeats immediately, except one of two (mayRepeat()).
/// Foil pairs are equally frequent per true fabric and do not repeat within participant x true fabric. True slots are balanced
/// per label. A phase with instructions has one such list for each of them; its lists follow one another in an order that is
/// balanced over the participants (running_orders.h). Catch trials and repetitions of choices are put between the others
/// (extra_trials.h) and change nothing of their order. Where the tray holds one piece, the pieces of the whole list are drawn
/// first, and then which presentations are catch trials and anchors (laid_pieces.h): pairs and stretches of fabrics are then even
/// over the whole list. Integer arithmetic only: the same seed gives the same design on every machine.
Design drawDesign(const Protocol& protocol, std::uint64_t seed);

}  // namespace protocols
