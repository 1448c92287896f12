// Which fabrics lie beside the true one in each presentation of a choice phase, and in which slot.
#pragma once

#include <vector>

#include "protocols/random.h"
#include "protocols/running_orders.h"

namespace protocols {

/// Fabrics in slot order A, B, C ...
using Tray = std::vector<int>;

/// [participant][position] for the given running orders. Foil sets: equally often per true fabric, none
/// repeated within participant x true fabric, each foil equally often there. Slots: the true one equally
/// often per participant x fabric and per label, each foil equally often per participant. What can be
/// seen of the trays (a fabric also lay in the tray before or after, how often it appears, where it
/// lies) is as frequent among foils as among true fabrics, so that it does not name the true slot.
/// Where a demand cannot be met, as near to it as a bounded search comes.
std::vector<std::vector<Tray>> drawTrays(const std::vector<std::vector<Rendering>>& orders, const StudySize& size,
                                         int alternatives, Random& random);

}  // namespace protocols
