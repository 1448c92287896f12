#include "rendering/models/photograph_check.h"

#include "rendering/models/model_card_fields.h"
#include "rendering/models/photograph_at_pitch.h"
#include "rendering/models/photograph_features.h"
#include "rendering/signals/dominant_wave.h"

namespace rendering::models {

CheckedPhotograph checkPhotograph(const InputPhotograph& photograph, const ModelCardFields& card)
{
    const double modelPitch = card.architecture.mmPerPixel;
    const double pitch = photograph.mmPerPixel.value_or(assumedMmPerPixel(photograph.photograph, modelPitch));
    const PhotographAtPitch seen = photographAtPitch({photograph.photograph, pitch}, modelPitch);
    CheckedPhotograph checked;
    checked.facts.middleOnly = seen.middleOnly;
    if (!photograph.mmPerPixel) checked.facts.assumedMmPerPixel = pitch;
    if (card.photographs) {
        checked.facts.distance = recognised(*card.photographs, photographFeatures(seen.rgb)).distance;
        checked.facts.usualDistance = card.photographs->threshold;
    }
    checked.finestWeaveMm = finestPeriodPx * modelPitch;
    checked.isAssumedCoarser = !photograph.mmPerPixel && pitch > modelPitch;
    if (const auto wave = signals::dominantWave(photograph.photograph)) checked.weaveMm = wave->periodPx * pitch;
    return checked;
}

}  // namespace rendering::models
