// How a sample without a known place is named as a group of its own.
#pragma once

#include <string>

#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

/// "F03/visual/17".
std::string ownGroup(const protocols::FabricId& fabric, Modality modality, int index);

}  // namespace rendering::fabrics
