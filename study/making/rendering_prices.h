// What the renderings of a study cost and what they give up, measured while the study is made: time of the signals, error against
// the accurate rendering and against the measured signal, difference under a simulated finger. Only sums over fabrics are kept.
// They name conditions but no file, label or trial, so that they tell nothing about a presentation.
#pragma once

#include <vector>

#include "rendering/composition/render_fabrics.h"
#include "reports/data/rendering_price.h"

namespace study::making {

/// The accurate renderings, beside `conditions`, with which the others are compared: h_g@accurate for h_g@fast. None where no
/// condition carries a quality, because each costs as much as a condition of the study.
std::vector<protocols::ConditionId> accurateReferences(const std::vector<protocols::ConditionId>& conditions);

/// In the order of `conditions`; empty where none carries a quality. `rendering` holds them and their accurateReferences(), whose
/// images are mapped through `response`, if there is one.
std::vector<reports::RenderingPrice> renderingPrices(const std::vector<protocols::ConditionId>& conditions,
                                                     const rendering::RenderedFabrics& rendering,
                                                     const rendering::DisplayResponse* response = nullptr);

}  // namespace study::making
