// Draws what lies on trays that hold one piece, in a phase with catch trials or anchors: first the pieces of the whole list, and
// then which presentations are additional.
#pragma once

#include <vector>

#include "protocols/orders/running_orders.h"
#include "protocols/protocol.h"
#include "protocols/random.h"

namespace protocols {

enum class Presented { OfCondition, Caught, Mismatched, Repeated };

/// A repetition and what it repeats: places of the whole list.
struct RepetitionPlace {
    std::size_t place = 0, original = 0;
};

/// One participant's whole list.
struct LaidPieces {
    std::vector<int> pieces;
    std::vector<Presented> kinds;
    std::vector<RepetitionPlace> repetitions;  ///< ascending places
};

/// [participant]. The order of the pieces treats all presentations alike: over the study ordered pairs of pieces and the pieces
/// of each stretch are even (nearly, where repetitions need room), and of more than two pieces none comes twice in a row. Only
/// then each piece's additional presentations are drawn among all its presentations, each set equally likely. So whoever sees all
/// trays and knows these rules can only count: k of the n trays of a piece are additional. Two rules make small exceptions. No
/// additional presentation is first. At least `blockLength` others lie between a presentation and its repetition, or half of the
/// list where it is shorter; fewer where the pieces do not allow this, and one always. So the first places of repetitions are
/// rarer.
///
/// Each piece has equally many additional presentations, or one more; these pieces change from participant to participant. (If
/// nearly every presentation is repeated, those with one more have more repetitions.) Where there are fewer than fabrics, a piece
/// may have none, and shows this. Pieces of repeated and of mismatched presentations are nearly even over the study.
std::vector<LaidPieces> drawLaidPieces(const Phase& phase, const StudySize& size, int blockLength, Random& random);

}  // namespace protocols
