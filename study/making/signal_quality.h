// Generated against measured signals of a study's fabrics: the `signals` object of results.json.
#pragma once

#include <map>
#include <nlohmann/json.hpp>

#include "protocols/ids.h"
#include "rendering/composition/render_fabrics.h"

namespace study::making {

/// friction_mae and friction_mae_over_mean over the common length of the traces; height_ssim over
/// central crops of equal pitch, both maps in mm, with the range of the measured maps as L; the
/// paper's t tests with fabrics as the unit, beside the equivalence test that its sentence needs
/// (bounds: a tenth of the measured mean, our choice). What cannot be had is null with its reason.
nlohmann::ordered_json signalQuality(const std::map<protocols::FabricId, rendering::FabricSignals>& signals);

}  // namespace study::making
