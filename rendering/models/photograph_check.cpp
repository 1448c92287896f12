#include "rendering/models/photograph_check.h"

#include "rendering/models/model_card_fields.h"
#include "rendering/models/photograph_at_pitch.h"
#include "rendering/signals/dominant_wave.h"

namespace rendering::models {

CheckedPhotograph checkPhotograph(const InputPhotograph& photograph, const ModelCardFields& card)
{
    const Architecture& architecture = card.architecture;
    const double pitch = photograph.mmPerPixel.value_or(assumedMmPerPixel(photograph.photograph, architecture));
    CheckedPhotograph checked;
    checked.facts.middleOnly =
        photographAtPitch({photograph.photograph, pitch}, architecture.sees ? pitch : architecture.mmPerPixel).middleOnly;
    if (!photograph.mmPerPixel) checked.facts.assumedMmPerPixel = pitch;
    checked.finestWeaveMm = finestWeaveMm(architecture);
    if (const auto wave = signals::dominantWave(photograph.photograph)) checked.weaveMm = wave->periodPx * pitch;
    return checked;
}

}  // namespace rendering::models
