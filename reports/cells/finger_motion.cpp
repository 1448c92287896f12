#include "reports/cells/finger_motion.h"

#include <algorithm>
#include <cmath>

namespace reports {
namespace {

using protocols::FingerSample;

constexpr double nsPerSecond = 1e9;

bool touches(const FingerSample& sample) { return !sample.forceN || *sample.forceN > 0; }

bool hasPlace(const FingerSample& sample) { return sample.xMm && sample.yMm; }

double secondsBetween(const FingerSample& from, const FingerSample& to)
{
    return static_cast<double>(to.atNs - from.atNs) / nsPerSecond;
}

double distanceMm(const FingerSample& from, const FingerSample& to)
{
    return std::hypot(*to.xMm - *from.xMm, *to.yMm - *from.yMm);
}

/// Sums over the contacts of a presentation.
struct MotionSums {
    double contactSeconds = 0;
    double pathMm = 0, pathSeconds = 0;
    double forceNSeconds = 0, forceSeconds = 0;
};

/// One contact, from its first to its last sample.
void addContact(std::span<const FingerSample> contact, MotionSums& sums)
{
    sums.contactSeconds += secondsBetween(contact.front(), contact.back());
    const FingerSample* place = nullptr;  // the last one on the path
    const FingerSample* force = nullptr;
    for (const FingerSample& sample : contact) {
        if (hasPlace(sample) && place == nullptr) place = &sample;
        if (hasPlace(sample) && secondsBetween(*place, sample) >= leastStepSeconds) {
            sums.pathMm += distanceMm(*place, sample);
            sums.pathSeconds += secondsBetween(*place, sample);
            place = &sample;
        }
        if (!sample.forceN) continue;
        if (force != nullptr) {
            sums.forceNSeconds += (*force->forceN + *sample.forceN) / 2 * secondsBetween(*force, sample);
            sums.forceSeconds += secondsBetween(*force, sample);
        }
        force = &sample;
    }
}

std::optional<double> quotient(double sum, double seconds)
{
    return seconds >= leastContactSeconds ? std::optional(sum / seconds) : std::nullopt;
}

}  // namespace

FingerMotion motionOf(std::span<const FingerSample> samples)
{
    MotionSums sums;
    std::size_t begin = 0;
    while (begin < samples.size()) {
        std::size_t end = begin;
        while (end < samples.size() && touches(samples[end]) &&
               (end == begin || secondsBetween(samples[end - 1], samples[end]) <= longestGapSeconds))
            ++end;
        if (end > begin) addContact(samples.subspan(begin, end - begin), sums);
        begin = std::max(end, begin + 1);
    }
    return {sums.contactSeconds, quotient(sums.pathMm, sums.pathSeconds), quotient(sums.forceNSeconds, sums.forceSeconds)};
}

}  // namespace reports
