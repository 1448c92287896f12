#include "study/analyse/power/planned_power.h"

#include <algorithm>

#include "protocols/files/number_text.h"

namespace study::analyse {

namespace {

// The defaults of stats::RatingTruth hold for a scale of this length. Other scales are stretched to it.
constexpr double hapticScale = 10;

}  // namespace

stats::RatingTruth ratingTruthOf(const protocols::RatingScale& scale)
{
    stats::RatingTruth truth;
    truth.scaleMin = scale.min.inScaleUnits();
    truth.scaleMax = scale.max.inScaleUnits();
    truth.scaleStep = scale.step.inScaleUnits();
    const double stretch = (truth.scaleMax - truth.scaleMin) / hapticScale;
    truth.centre = truth.scaleMin + stretch * truth.centre;
    for (double* variance :
         {&truth.participant, &truth.fabric, &truth.participantCondition, &truth.fabricCondition, &truth.residual})
        *variance *= stretch * stretch;
    return truth;
}

stats::PowerOptions powerOptionsOf(const protocols::Protocol& protocol, const TestedQuestions& tested)
{
    stats::PowerOptions options;
    options.design.participants = static_cast<std::size_t>(protocol.participants);
    options.design.fabrics = static_cast<std::size_t>(protocol.fabricCount);
    options.design.conditions = protocol.conditions.size();
    options.equivalenceBounds = protocol.equivalenceBounds;
    options.hasChoices = tested.choices.has_value();
    options.hasRatings = tested.ratings.has_value();
    if (tested.choices) options.design.alternatives = tested.choices->alternatives;
    if (tested.ratings) {
        options.ratings = ratingTruthOf(tested.ratings->scale);
        options.ratings.residual /= tested.ratings->runs;  // the tests take the mean over the instructions
    }
    return options;
}

std::string boundsWarning(const protocols::Protocol& protocol)
{
    const stats::PowerOptions options = powerOptionsOf(protocol, testedQuestions(protocol));
    if (!options.hasRatings || options.design.participants < 2 || options.design.conditions < 2) return {};
    const stats::Value reached = stats::narrowestBounds(options);
    const auto [low, high] = protocol.equivalenceBounds;
    if (reached.exists() && *reached <= std::min(-low, high)) return {};
    const std::string people =
        std::to_string(protocol.participants) + (protocol.participants == 1 ? " participant" : " participants");
    const std::string bounds = protocols::shortest(low) + " and " + protocols::shortest(high);
    const std::string from =
        reached.exists() ? "only from +-" + protocols::fixed(*reached, 2) + " scale points on" : "for no bounds of the scale";
    return "equivalence within " + bounds + " will rarely be shown: with " + people + " the power is 80 % " + from +
           " (assumed variances; see vis2hap power)";
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
