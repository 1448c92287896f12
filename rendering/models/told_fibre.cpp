#include "rendering/models/told_fibre.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rendering::models {

namespace {

constexpr std::size_t leastFabrics = 40;
constexpr double leastGain = 0.1, mostGain = 4;
/// No line goes below this share of what was read: far from the drawn fabrics it might end below zero.
constexpr double leastToldShare = 0.25;

double toldMean(const FibreReading& reading, double mean)
{
    return std::max(reading.constant + reading.gain * mean, leastToldShare * mean);
}

/// Weighted regression of the known friction on the read one; each weight is one over the square of the known friction.
FibreReading fitted(const std::vector<DrawnReading>& drawn)
{
    double weights = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const DrawnReading& one : drawn) {
        const double read = std::exp(one.read.logMean), known = std::exp(one.logFriction), weight = 1 / (known * known);
        weights += weight;
        x += weight * read;
        y += weight * known;
        xx += weight * read * read;
        xy += weight * read * known;
    }
    const double spread = weights * xx - x * x;
    FibreReading reading;
    reading.gain = std::clamp(spread > 0 ? (weights * xy - x * y) / spread : leastGain, leastGain, mostGain);
    reading.constant = (y - reading.gain * x) / weights;
    std::vector<double> shares;
    for (const DrawnReading& one : drawn)
        shares.push_back(std::abs(std::log(toldMean(reading, std::exp(one.read.logMean))) - one.logFriction) /
                         one.read.halfWidth);
    const auto ninth = shares.begin() + std::ptrdiff_t(0.9 * double(shares.size()));
    std::ranges::nth_element(shares, ninth);
    reading.narrowing = std::clamp(*ninth, 0.1, 2.0);
    return reading;
}

}  // namespace

ReadFriction withToldFibre(const ReadFriction& read, const FibreReadings& readings, const std::optional<fabrics::Fibre>& fibre)
{
    if (!fibre || !readings[std::size_t(*fibre)]) return read;
    const FibreReading& reading = *readings[std::size_t(*fibre)];
    return {std::log(toldMean(reading, std::exp(read.logMean))), read.halfWidth * reading.narrowing};
}

double logMeanToRead(double logFriction, const FibreReadings& readings, const std::optional<fabrics::Fibre>& fibre)
{
    if (!fibre || !readings[std::size_t(*fibre)] || std::isnan(logFriction)) return logFriction;
    const FibreReading& reading = *readings[std::size_t(*fibre)];
    const double friction = std::exp(logFriction);
    return std::log(
        std::clamp((friction - reading.constant) / reading.gain, leastToldShare * friction, friction / leastToldShare));
}

FibreReadings fibreReadings(std::span<const DrawnReading> drawn)
{
    FibreReadings readings;
    for (std::size_t fibre = 0; fibre < fabrics::fibreCount; ++fibre) {
        std::vector<DrawnReading> own;
        std::ranges::copy_if(drawn, std::back_inserter(own),
                             [&](const DrawnReading& one) { return std::size_t(one.fibre) == fibre; });
        if (own.size() >= leastFabrics) readings[fibre] = fitted(own);
    }
    return readings;
}

}  // namespace rendering::models
