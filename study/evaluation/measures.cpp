#include "study/evaluation/measures.h"

namespace study::evaluation {

const std::array<MeasureRow, measureCount>& measureTable()
{
    using enum Section;
    static const std::array<MeasureRow, measureCount> table{{
        {Measure::FrictionMae, Friction, "friction_mae", "MAE", Shown::Plain4, Averaging::Arithmetic, Better::Smaller,
         "mean absolute error of the trace, sample by sample (coefficient of friction)"},
        {Measure::FrictionMaeOverMean, Friction, "friction_mae_over_mean", "MAE/mean", Shown::Percent, Averaging::Arithmetic,
         Better::Smaller, "the same over the measured stroke's mean"},
        {Measure::MeanFrictionError, Friction, "mean_friction_error", "mean off by", Shown::Percent, Averaging::Arithmetic,
         Better::Smaller, "absolute error of the trace's mean over the measured mean"},
        {Measure::FrictionSpectrum, Friction, "friction_spectrum_db", "spectrum off by", Shown::Decibels, Averaging::Arithmetic,
         Better::Smaller, "RMS difference of the two envelopes (trace over its mean, power by frequency, time-averaged)"},
        {Measure::Ssim, Height, "ssim", "SSIM", Shown::Plain4, Averaging::Arithmetic, Better::Larger,
         "structural similarity of the maps in mm, pixel on pixel"},
        {Measure::SsimNormalised, Height, "ssim_normalised", "SSIM, normalised", Shown::Plain4, Averaging::Arithmetic,
         Better::Larger, "variant: each map stretched to 0..1 by itself, so depth no longer counts"},
        {Measure::SsimRegistered, Height, "ssim_registered", "SSIM, registered", Shown::Plain4, Averaging::Arithmetic,
         Better::Larger, "after turning both maps to the fabric's axes and the best shift"},
        {Measure::HeightSpectrum, Height, "height_spectrum_db", "spectrum off by", Shown::Decibels, Averaging::Arithmetic,
         Better::Smaller,
         "RMS difference of the power in thirds of an octave from 6.4 to 0.2 mm, whatever the direction; below -40 dB all counts "
         "as equal"},
        {Measure::SqRatio, Roughness, "sq_ratio", "Sq", Shown::Ratio, Averaging::Geometric, Better::NearOne, "RMS height"},
        {Measure::SdrRatio, Roughness, "sdr_ratio", "Sdr", Shown::Ratio, Averaging::Geometric, Better::NearOne,
         "surface area gained over the flat"},
        {Measure::SalRatio, Roughness, "sal_ratio", "Sal", Shown::Ratio, Averaging::Geometric, Better::NearOne,
         "autocorrelation length"},
        {Measure::IdentifiedByHeight, Identification, "identified_by_height", "by height", Shown::Percent, Averaging::Arithmetic,
         Better::Larger, "from the height map alone"},
        {Measure::IdentifiedByFriction, Identification, "identified_by_friction", "by friction", Shown::Percent,
         Averaging::Arithmetic, Better::Larger, "from the friction trace alone"},
        {Measure::IdentifiedByBoth, Identification, "identified_by_both", "by both", Shown::Percent, Averaging::Arithmetic,
         Better::Larger, "from both"},
        {Measure::MeanFriction, Level, "mean_friction", "mean friction", Shown::Plain4, Averaging::Arithmetic, Better::Neither,
         "coefficient of friction"},
        {Measure::SqMm, Level, "sq_mm", "Sq, mm", Shown::Plain4, Averaging::Arithmetic, Better::Neither, "RMS height, mm"},
    }};
    return table;
}

const MeasureRow& rowOf(Measure measure) { return measureTable()[static_cast<std::size_t>(measure)]; }

}  // namespace study::evaluation
