#include "study/analyse/planned_power.h"

namespace study::analyse {

namespace {

// The defaults of stats::RatingTruth hold for a scale of this length. Other scales are stretched to it.
constexpr double hapticScale = 10;

void putScale(stats::RatingTruth& truth, const protocols::RatingScale& scale)
{
    truth.scaleMin = scale.min.inScaleUnits();
    truth.scaleMax = scale.max.inScaleUnits();
    truth.scaleStep = scale.step.inScaleUnits();
    const double stretch = (truth.scaleMax - truth.scaleMin) / hapticScale;
    truth.centre = truth.scaleMin + stretch * truth.centre;
    for (double* variance :
         {&truth.participant, &truth.fabric, &truth.participantCondition, &truth.fabricCondition, &truth.residual})
        *variance *= stretch * stretch;
}

}  // namespace

stats::PowerOptions powerOptionsOf(const protocols::Protocol& protocol)
{
    stats::PowerOptions options;
    options.design.participants = static_cast<std::size_t>(protocol.participants);
    options.design.fabrics = static_cast<std::size_t>(protocol.fabricCount);
    options.design.conditions = protocol.conditions.size();
    options.equivalenceBounds = protocol.equivalenceBounds;
    options.hasChoices = options.hasRatings = false;
    for (const auto& phase : protocol.phases) {
        if (const auto* choice = std::get_if<protocols::ForcedChoice>(&phase.task); choice && !options.hasChoices) {
            options.hasChoices = true;
            options.design.alternatives = choice->alternatives;
        }
        if (const auto* rating = std::get_if<protocols::Rating>(&phase.task); rating && !options.hasRatings) {
            options.hasRatings = true;
            putScale(options.ratings, rating->scale);
        }
    }
    return options;
}

stats::CalibrationOptions calibrationOptionsOf(const stats::PowerOptions& power, std::size_t studies)
{
    stats::CalibrationOptions calibration;
    calibration.design = power.design;
    calibration.ratings = power.ratings;
    calibration.choices = power.choices;
    calibration.mixedModelStudies = studies;
    calibration.simulation.studies = studies;
    calibration.simulation.seed = power.simulation.seed;
    return calibration;
}

}  // namespace study::analyse
