#include "stats/power/calibration.h"

#include <algorithm>
#include <cmath>

#include "stats/power/calibration_families.h"

namespace stats {
namespace {

void run(std::vector<CalibrationRow>& rows, CalibrationFamily family, const CalibrationOptions& options)
{
    SimulationOptions simulation = options.simulation;
    simulation.studies = family.studies;
    simulation.alpha = nominalAlpha;
    const auto results = simulateTests(family.tests.size(), family.analysis, simulation);
    for (std::size_t t = 0; t < results.size(); ++t) {
        family.tests[t].truth = family.truth;
        family.tests[t].result = results[t];
        rows.push_back(std::move(family.tests[t]));
    }
}

/// How far from 5 % a rate may lie: 0.9 points, more where fewer studies than 10,000 make it uncertain.
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

std::size_t calibrationStudies(const CalibrationOptions& options)
{
    std::size_t studies = 0;
    for (const CalibrationFamily& family : calibrationFamilies(options)) studies += family.studies;
    return studies;
}

}  // namespace stats
