#include "stats/power/claim_power.h"

#include <algorithm>
#include <cmath>

#include "stats/kernels/distributions.h"
#include "stats/kernels/noncentral.h"
#include "stats/power/power.h"

namespace stats {
namespace {

double squared(double x) { return x * x; }

ExpectedError errorOfThese(double participants, double fabrics, const CrossedVariances& variances)
{
    return {std::sqrt((variances.participant + variances.residual / fabrics) / participants), participants - 1};
}

/// The error is a sum of three mean squares: participants + fabrics - residual.
ExpectedError errorOfAlike(double participants, double fabrics, const CrossedVariances& variances)
{
    const double ofParticipants = variances.residual + fabrics * variances.participant;
    const double ofFabrics = variances.residual + participants * variances.fabric;
    const double sum = ofParticipants + ofFabrics - variances.residual;
    const double df = squared(sum) / (squared(ofParticipants) / (participants - 1) + squared(ofFabrics) / (fabrics - 1) +
                                      squared(variances.residual) / ((participants - 1) * (fabrics - 1)));
    return {std::sqrt(sum / (participants * fabrics)), df};
}

}  // namespace

CrossedVariances ofDifference(const RatingTruth& truth)
{
    return {2 * truth.participantCondition, 2 * truth.fabricCondition, 2 * truth.residual};
}

CrossedVariances ofChoices(const ChoiceTruth& truth, double probability)
{
    const double slope = probability * (1 - probability);  // of the probability in the log odds
    const double participant = squared(slope * truth.participantSd), fabric = squared(slope * truth.fabricSd);
    return {participant, fabric, std::max(0.0, slope - participant - fabric)};
}

CrossedVariances ofDifference(const ChoiceTruth& truth, double probabilityA, double probabilityB)
{
    const double slopeA = probabilityA * (1 - probabilityA), slopeB = probabilityB * (1 - probabilityB);
    return {squared((slopeA - slopeB) * truth.participantSd), squared((slopeA - slopeB) * truth.fabricSd),
            ofChoices(truth, probabilityA).residual + ofChoices(truth, probabilityB).residual};
}

ExpectedError expectedError(const StudyDesign& design, const CrossedVariances& variances, Generalisation generalisation)
{
    const auto participants = static_cast<double>(design.participants), fabrics = static_cast<double>(design.fabrics);
    return generalisation == Generalisation::TheseFabrics ? errorOfThese(participants, fabrics, variances)
                                                          : errorOfAlike(participants, fabrics, variances);
}

double differencePower(const ExpectedError& error, double difference, double alpha)
{
    const double n = error.df + 1;
    return tTestPower(n, difference / (error.se * std::sqrt(n)), alpha);
}

double abovePower(const ExpectedError& error, double excess, double alpha)
{
    return std::min(1.0, noncentralStudentUpper(studentQuantile(alpha, error.df), error.df, excess / error.se));
}

double boundsPower(const ExpectedError& error, double low, double high, double trueDifference, double alpha)
{
    const double n = error.df + 1;
    return equivalencePower({n, error.se * std::sqrt(n), low, high, alpha}, trueDifference);
}

Value narrowestBounds(const ExpectedError& error, double most, double alpha)
{
    return smallestDetectable([&](double bound) { return bound > 0 ? boundsPower(error, -bound, bound, 0, alpha) : 0.0; }, most);
}

}  // namespace stats
