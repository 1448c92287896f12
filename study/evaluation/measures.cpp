#include "study/evaluation/measures.h"

namespace study::evaluation {

const std::array<MeasureRow, measureCount>& measureTable()
{
    using enum Section;
    static const std::array<MeasureRow, measureCount> table{{
        {Measure::FrictionMae, Friction, "friction_mae", "MAE", NumberFormat::Plain4, Averaging::Arithmetic, Better::Smaller,
         "mean absolute error of the trace, sample by sample (coefficient of friction)"},
        {Measure::FrictionMaeOverMean, Friction, "friction_mae_over_mean", "MAE/mean", NumberFormat::Percent,
         Averaging::Arithmetic, Better::Smaller, "MAE divided by the mean of the measured stroke"},
        {Measure::MeanFrictionError, Friction, "mean_friction_error", "mean off by", NumberFormat::Percent, Averaging::Arithmetic,
         Better::Smaller, "absolute error of the mean, divided by the measured mean"},
        {Measure::FrictionSpectrum, Friction, "friction_spectrum_db", "spectrum off by", NumberFormat::Decibels,
         Averaging::Arithmetic, Better::Smaller,
         "RMS difference of the two power spectra (trace divided by its mean, averaged over time)"},
        {Measure::FrictionCovered, Friction, "interval_90_covers", "interval holds", NumberFormat::Percent, Averaging::Arithmetic,
         Better::Neither, "share of the 90 % intervals that hold the measured mean; 90 % is right"},
        {Measure::Ssim, Height, "ssim", "SSIM", NumberFormat::Plain4, Averaging::Arithmetic, Better::Larger,
         "structural similarity of the maps in mm, pixel by pixel"},
        {Measure::SsimNormalised, Height, "ssim_normalised", "SSIM, normalised", NumberFormat::Plain4, Averaging::Arithmetic,
         Better::Larger, "variant: each map is scaled to 0–1, so depth does not count"},
        {Measure::SsimRegistered, Height, "ssim_registered", "SSIM, registered", NumberFormat::Plain4, Averaging::Arithmetic,
         Better::Larger, "variant: both maps are rotated to the axes of the fabric and shifted for the best fit"},
        {Measure::HeightSpectrum, Height, "height_spectrum_db", "spectrum off by", NumberFormat::Decibels, Averaging::Arithmetic,
         Better::Smaller,
         "RMS difference of the power in third-octave bands from 6.4 to 0.2 mm, in all directions; differences below -40 dB are "
         "ignored"},
        {Measure::SqRatio, Roughness, "sq_ratio", "Sq", NumberFormat::Ratio, Averaging::Geometric, Better::NearOne, "RMS height"},
        {Measure::SdrRatio, Roughness, "sdr_ratio", "Sdr", NumberFormat::Ratio, Averaging::Geometric, Better::NearOne,
         "additional surface area compared with a flat map"},
        {Measure::SalRatio, Roughness, "sal_ratio", "Sal", NumberFormat::Ratio, Averaging::Geometric, Better::NearOne,
         "autocorrelation length"},
        {Measure::IdentifiedByHeight, Identification, "identified_by_height", "by height", NumberFormat::Percent,
         Averaging::Arithmetic, Better::Larger, "from the height map only"},
        {Measure::IdentifiedByFriction, Identification, "identified_by_friction", "by friction", NumberFormat::Percent,
         Averaging::Arithmetic, Better::Larger, "from the friction trace only"},
        {Measure::IdentifiedByBoth, Identification, "identified_by_both", "by both", NumberFormat::Percent, Averaging::Arithmetic,
         Better::Larger, "from both"},
        {Measure::MeanFriction, Level, "mean_friction", "mean friction", NumberFormat::Plain4, Averaging::Arithmetic,
         Better::Neither, "coefficient of friction"},
        {Measure::SqMm, Level, "sq_mm", "Sq, mm", NumberFormat::Plain4, Averaging::Arithmetic, Better::Neither, "RMS height, mm"},
    }};
    return table;
}

const MeasureRow& rowOf(Measure measure) { return measureTable()[static_cast<std::size_t>(measure)]; }

}  // namespace study::evaluation
