// Comparison of the generated with the measured signals of a study's fabrics: the object `signals` of results.json.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>

#include "protocols/ids.h"
#include "rendering/composition/render_fabrics.h"

namespace study::making {

/// friction_mae and friction_mae_over_mean are over the common length of the traces. height_ssim is over central crops of equal
/// pitch, both maps in mm, with the range of the measured maps as L. The t tests are the paper's, with fabrics as the unit. Each
/// has an equivalence test beside it, because the paper states that the means are close. Its bounds are a tenth of the measured
/// mean (our choice). Numbers that do not exist are null, with their reason.
nlohmann::ordered_json signalQuality(const std::map<protocols::FabricId, rendering::FabricSignals>& signals);

}  // namespace study::making
