// Generated against measured signals of a study's fabrics, as the report shows them. A number that does not exist carries
// its reason.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "stats/kernels/value.h"

namespace reports {

/// Two one-sided tests of the mean difference against bounds in the unit of the signal.
struct SignalEquivalence {
    stats::Interval bounds;
    std::string boundsAre;  ///< how the bounds were chosen, in words
    stats::Value pLower;
    stats::Value pUpper;
    stats::Value p;
    stats::Interval ci90;
    std::optional<bool> equivalent;
    std::string whyNoVerdict;  ///< reason where `equivalent` is missing
    std::string verdict;
};

/// Paired t test of generated minus measured means, one pair a fabric.
struct SignalTest {
    std::string signal;  ///< "friction" or "height"
    std::string unit;    ///< what one pair is: "fabric"
    std::size_t n = 0;
    stats::Value meanDifference;
    stats::Value statistic;
    stats::Value df;
    stats::Value p;
    stats::Interval ci95;
    SignalEquivalence equivalence;
};

/// Measures that generated signals and controls have, in the order of the table.
enum class SignalMeasure {
    FrictionMae,
    FrictionMaeOverMean,
    MeanFrictionError,
    FrictionSpectrum,
    HeightSsim,
    HeightSsimRegistered,
    HeightSpectrum,
    HeightSqRatio,
};

enum class BestValue { Smallest, Largest, One };

struct SignalMeasureRow {
    SignalMeasure measure;
    const char* field;    ///< in JSON
    const char* heading;  ///< in tables, with its unit
    double factor;        ///< from the value in JSON to the one in tables
    int decimals;         ///< in tables
    BestValue best;
};

inline constexpr std::array<SignalMeasureRow, 8> signalMeasureRows{{
    {SignalMeasure::FrictionMae, "friction_mae", "friction MAE", 1, 4, BestValue::Smallest},
    {SignalMeasure::FrictionMaeOverMean, "friction_mae_over_mean", "MAE / mean, %", 100, 1, BestValue::Smallest},
    {SignalMeasure::MeanFrictionError, "mean_friction_error", "error of the mean, %", 100, 1, BestValue::Smallest},
    {SignalMeasure::FrictionSpectrum, "friction_spectrum_db", "friction spectrum, dB", 1, 2, BestValue::Smallest},
    {SignalMeasure::HeightSsim, "height_ssim", "SSIM, plain", 1, 3, BestValue::Largest},
    {SignalMeasure::HeightSsimRegistered, "height_ssim_registered", "SSIM, registered", 1, 3, BestValue::Largest},
    {SignalMeasure::HeightSpectrum, "height_spectrum_db", "height spectrum, dB", 1, 2, BestValue::Smallest},
    {SignalMeasure::HeightSqRatio, "height_sq_ratio", "Sq / measured", 1, 3, BestValue::One},
}};

inline const SignalMeasureRow& rowOf(SignalMeasure measure) { return signalMeasureRows[static_cast<std::size_t>(measure)]; }

struct SignalValues {
    std::array<stats::Value, signalMeasureRows.size()> values;
    stats::Value& operator[](SignalMeasure measure) { return values[static_cast<std::size_t>(measure)]; }
    const stats::Value& operator[](SignalMeasure measure) const { return values[static_cast<std::size_t>(measure)]; }
};

/// Generated minus a control: paired t test, one difference a fabric.
struct SignalDifference {
    std::size_t n = 0;
    stats::Value meanDifference;
    stats::Interval ci95;
    stats::Value p;
    stats::Value pHolm;  ///< corrected over the controls of the measure
};

/// "better", "worse" or "not decided": what a difference says of the generated signals at p < .05 after correction. "undefined"
/// where there is no difference.
std::string wordFor(SignalMeasure measure, const SignalDifference& difference);

struct FabricSignalValues {
    std::string fabric;
    SignalValues values;
};

/// The generated signals, or a control, against the measured signals.
struct SignalSource {
    std::string id;
    std::string name;
    std::optional<int> steps;                               ///< of training, for a network
    std::string whyUnfair;                                  ///< reason why a control is not fair; empty if it is
    SignalValues mean;                                      ///< over fabrics
    std::map<SignalMeasure, SignalDifference> differences;  ///< of a fair control
    std::vector<FabricSignalValues> fabrics;
};

/// The comparison beside controls, as `vis2hap evaluate` defines it.
struct SignalControls {
    std::string pairing;                                    ///< "weak" or "aligned"
    std::size_t photographs = 0, presses = 0, strokes = 0;  ///< samples that the controls know
    std::vector<std::string> notes;                         ///< sentences
    SignalSource generated;
    SignalSource generatedMean;  ///< the generated mean friction as a constant
    std::vector<SignalSource> controls;
};

struct SignalComparison {
    stats::Value frictionMae;
    stats::Value frictionMaeOverMean;
    stats::Value heightSsim;
    stats::Value heightRangeMm;  ///< L of the SSIM
    std::vector<SignalTest> tests;
    std::optional<SignalControls> controls;
    std::string whyNoControls;  ///< reason where `controls` is missing
};

}  // namespace reports
