// How the time of a piece of work grows with its size: measured at several sizes, with the exponent b of time = a * size^b.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "stats/kernels/share.h"
#include "study/bench/bench_row.h"

namespace study::bench {

struct CostPoint {
    double size = 0;
    double milliseconds = 0;  ///< median
    std::optional<double> megabytes;
};

struct CostCurve {
    std::string work;      ///< "integration, 32 bits"
    std::string sizeIs;    ///< "pixels"
    bool isLinear = true;  ///< the work is promised to be linear: an exponent of at most 1.05
    std::vector<CostPoint> points;
    std::optional<double> exponent;  ///< slope of log time on log size; none for fewer than 2 sizes
    std::optional<Quartiles> ci95;   ///< of the exponent, by Student's t; none for fewer than 3 sizes
};

/// The work at one size; returns what is timed, so that its preparation is not.
using WorkOfSize = std::function<std::function<void()>(double size)>;

/// Runs each size for about `wantedMs`, and at least once. The time of a size is the median of its runs.
CostCurve measuredCurve(const std::string& work, const std::string& sizeIs, bool isLinear, const std::vector<double>& sizes,
                        const WorkOfSize& workOf, double wantedMs = 300);

/// Fits exponent and interval to the points.
void fitExponent(CostCurve& curve);

/// All curves: pixels from 128 x 128 to 4096 x 4096, fabrics from 7 to 100, conditions from 9 to 40, participants from 10 to
/// 10,000; one thread. Takes a few minutes. `begins` gets the name of each curve before it is measured. A share has whole curves.
std::vector<CostCurve> costCurves(const std::function<void(const std::string&)>& begins = {}, const stats::Share& share = {});

nlohmann::ordered_json jsonOf(const CostCurve& curve);
/// Fits the exponent anew. Throws badInput, naming `where`, for other JSON than jsonOf() gives.
CostCurve curveFrom(const nlohmann::ordered_json& json, const std::string& where);
/// Number of all curves.
std::size_t costCurveCount();
std::string tableOf(const std::vector<CostCurve>& curves);

}  // namespace study::bench
