#include "stats/power/calibration.h"

#include <algorithm>
#include <cmath>

#include "stats/power/calibration_families.h"
#include "stats/power/claim_nulls.h"

namespace stats {
namespace {

std::vector<Rejections> countsOf(const CalibrationFamily& family, const SimulationOptions& simulation,
                                 const CalibrationOptions& options)
{
    if (options.counted)
        if (std::vector<Rejections> counts = options.counted(family.truth, simulation.ownStudies());
            counts.size() == family.tests.size()) {
            if (simulation.done) simulation.done(simulation.ownStudies());
            return counts;
        }
    std::vector<Rejections> counts = simulateTests(family.tests.size(), family.analysis, simulation);
    if (options.finished) options.finished(family.truth, counts);
    return counts;
}

void run(std::vector<CalibrationRow>& rows, CalibrationFamily family, const CalibrationOptions& options)
{
    SimulationOptions simulation = options.simulation;
    simulation.studies = family.studies;
    simulation.alpha = nominalAlpha;
    const auto results = countsOf(family, simulation, options);
    for (std::size_t t = 0; t < results.size(); ++t) {
        family.tests[t].truth = family.truth;
        family.tests[t].result = results[t];
        rows.push_back(std::move(family.tests[t]));
    }
}

std::vector<CalibrationFamily> claimFamiliesOf(const CalibrationOptions& options)
{
    const StudyDesign& design = options.design;
    if (design.participants < 2 || design.fabrics < 2 || design.conditions < 2) return {};
    std::vector<CalibrationFamily> families = claimFamilies(options);
    for (CalibrationFamily& family : families) family.studies = options.simulation.studies;
    return families;
}

/// Largest distance of a rate from 5 %: 0.9 points, or more where there are fewer than 10,000 studies.
double tolerance(std::size_t studies)
{
    return std::max(0.009,
                    4.2 * std::sqrt(nominalAlpha * (1 - nominalAlpha) / static_cast<double>(std::max<std::size_t>(studies, 1))));
}

}  // namespace

bool CalibrationRow::kept() const
{
    const double reach = tolerance(result.studies);
    if (promise == Promise::Exact) return std::fabs(result.rate() - nominalAlpha) <= reach;
    return promise != Promise::AtMost || result.rate() <= nominalAlpha + reach;
}

std::string CalibrationRow::verdict() const
{
    if (!kept()) return "broken";
    if (antiConservative() && promise != Promise::AtMost) return "anti-conservative";
    return promise == Promise::Exact || promise == Promise::AtMost ? "kept" : "";
}

std::vector<CalibrationRow> calibration(const CalibrationOptions& options)
{
    std::vector<CalibrationRow> rows;
    for (const CalibrationFamily& family : calibrationFamilies(options)) run(rows, family, options);
    return rows;
}

std::vector<CalibrationRow> claimCalibration(const CalibrationOptions& options)
{
    std::vector<CalibrationRow> rows;
    for (CalibrationFamily& family : claimFamiliesOf(options)) run(rows, std::move(family), options);
    return rows;
}

std::size_t calibrationStudies(const CalibrationOptions& options)
{
    std::size_t studies = 0;
    for (const CalibrationFamily& family : calibrationFamilies(options))
        studies += options.simulation.share.sizeOf(family.studies);
    for (const CalibrationFamily& family : claimFamiliesOf(options)) studies += options.simulation.share.sizeOf(family.studies);
    return studies;
}

}  // namespace stats
