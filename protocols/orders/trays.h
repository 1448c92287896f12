// Draws the foils and the tray slots for each presentation of a choice phase.
#pragma once

#include <vector>

#include "protocols/answer_kind.h"
#include "protocols/orders/running_orders.h"
#include "protocols/random.h"

namespace protocols {

/// Fabrics in slot order A, B, C ...
using Tray = std::vector<int>;

/// [participant][position] for the given running orders, in which each rendering stands once per participant. Presentations with
/// the label `additionalLabel` come beside these. Foil sets are equally frequent per true fabric and do not repeat within
/// participant x true fabric; each fabric lies on the tray equally often per participant. True slots are equally frequent per
/// label over the study, and are drawn without any other rule: slots that are even per participant or per piece would tell of
/// true pieces. Additional presentations share in all of this, so that no tray and no count of trays tells which they are. A
/// participant can notice that a fabric also lay on the tray before or after, and how often it appears. All this is as frequent
/// for foils as for true fabrics, so it does not reveal the true slot. Where this is impossible, a bounded search comes as close
/// as it can.
///
/// With FewSwaps a fabric of two trays in a row keeps its slot, and trays in a row share more fabrics. True slots are then as
/// even as chance makes them. Foil sets stay as even.
std::vector<std::vector<Tray>> drawTrays(const std::vector<std::vector<Rendering>>& orders, const StudySize& size,
                                         int alternatives, TrayAim aim, Random& random);

}  // namespace protocols
