// Draws the order of a phase in which a participant compares the rendering with one piece: which piece lies on the tray, and
// which rendering is shown beside it.
#pragma once

#include <vector>

#include "protocols/orders/repetition_counts.h"
#include "protocols/orders/running_orders.h"
#include "protocols/orders/trays.h"
#include "protocols/random.h"

namespace protocols {

struct SameDifferentOrders {
    std::vector<std::vector<Rendering>> orders;  ///< [participant][position]: what is shown
    std::vector<std::vector<Tray>> trays;        ///< [participant][position]: the one piece on the tray
};

/// `drawnPieces`: the pieces on the trays, as a running order whose labels are not read. Everything an operator sees is drawn
/// before the truth: which half of a piece's trays hold the fabric of the rendering is a draw of its own, so that trays tell
/// nothing. The half is exact per participant x fabric (of the tray and of the rendering), per participant x label, and per label
/// x fabric over participants; odd counts differ by at most one, and a draw says which way. The other renderings are exchanged
/// among the trays that are left, so that each rendering is shown once, each other fabric lies beside a fabric equally often, and
/// the orders of fabrics and labels are balanced as a search can make them.
///
/// With two fabrics and an odd number of labels, or three fabrics and one label, halves of one participant are impossible if each
/// piece lies there equally often. There a piece lies once more and another once less, in turn over the participants, and both
/// may lie twice in a row. Two labels, or two fabrics, always may (mayRepeat()). With two fabrics half of the trays of each are
/// the same. With three, one of the two trays of the first piece is the same, and the tray of the second is so for every other
/// participant; the third piece does not lie there.
SameDifferentOrders drawSameDifferent(const std::vector<std::vector<Rendering>>& drawnPieces, const StudySize& size,
                                      Random& random, const Copies& copies = {});

}  // namespace protocols
