// Friction records of a data set: CSV files whose header names the quantities.
#pragma once

#include <string>
#include <vector>

#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

/// Record of one stroke: a coefficient of friction, or another quantity under its own name (never "mu").
struct FrictionRecord {
    std::string quantity = "mu";  ///< "mu" for the coefficient of friction, else a name such as "taxel_sum_counts"
    double sampleRateHz = 60;
    double speedMmPerS = 5;  ///< speed of the stroke, from the data set
    std::vector<double> timeS;
    std::vector<double> values;  ///< tangential over normal force, or the quantity
    bool isCoefficient() const { return quantity == "mu"; }
};

/// N; below it the ratio of the forces is noise.
inline constexpr double leastNormalN = 0.05;

/// Reads CSV with the columns t_s,normal_n,tangential_n, or t_s,mu, or t_s,<quantity>. Throws badInput, also where a row
/// has a normal force of at most `leastNormalN`.
FrictionRecord readFriction(const Dataset& dataset, const protocols::FabricId& fabric, int index);

}  // namespace rendering::fabrics
