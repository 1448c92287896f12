// A stroke as a rig records it, written as text: rest, approach, breakaway, slide, stop, rest, with offsets of the
// sensor. The times of all parts are known.
#pragma once

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "protocols/random.h"

namespace stroke_text {

/// Seconds: rest to 0.5, load to 0.8, sticking to 1.2, breakaway to 1.3, slide to 7.5, stop to 7.8, lift 8.0 to 8.2, rest to 9.
struct Stroke {
    double rateHz = 500;
    double jitter = 0;                                           ///< standard deviation of each step, as a share of it
    double load = 2, zeroNormal = 0.12, zeroTangential = -0.08;  ///< N
    double mu = 0.5, texture = 0.05;
    double noise = 0.004;               ///< N
    double lostFromS = 0, lostToS = 0;  ///< no contact between these times
    double unit = 1;                    ///< factor from newtons to the written numbers
};

struct WrittenSample {
    double timeS, normalN, tangentialN;
};

inline WrittenSample sampleAt(const Stroke& stroke, double t, protocols::Random& random)
{
    double normal = t < 0.5 || t >= 8.2 ? 0 : t < 0.8 ? (t - 0.5) / 0.3 : t < 8.0 ? 1 : (8.2 - t) / 0.2;
    double mu = 0;
    if (t >= 0.8 && t < 1.2) mu = 1.5 * stroke.mu * (t - 0.8) / 0.4;
    if (t >= 1.2 && t < 1.3) mu = stroke.mu * (1.5 - 0.5 * (t - 1.2) / 0.1);
    if (t >= 1.3 && t < 7.5) mu = stroke.mu + stroke.texture * std::sin(2 * std::numbers::pi * 6.25 * t);
    if (t >= 7.5 && t < 7.8) mu = stroke.mu * (7.8 - t) / 0.3;
    if (t >= stroke.lostFromS && t < stroke.lostToS) normal = 0;
    normal *= stroke.load;
    return {t, normal + stroke.zeroNormal + stroke.noise * random.normal(),
            mu * normal + stroke.zeroTangential + stroke.noise * random.normal()};
}

/// Text of `header` and one line for each sample, made by `line(WrittenSample)`.
template <class Line>
std::string written(const Stroke& stroke, const std::string& header, const Line& line)
{
    protocols::Random random(12);
    std::string text = header + "\n";
    for (double t = 0; t < 9; t += (1 + stroke.jitter * (random.uniform() - 0.5)) / stroke.rateHz)
        text += line(sampleAt(stroke, t, random)) + "\n";
    return text;
}

inline std::string number(double value)
{
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.9g", value);
    return buffer;
}

inline std::string twoForces(const Stroke& stroke = {}, const std::string& header = "t_s,fn,ft")
{
    return written(stroke, header, [&](const WrittenSample& s) {
        return number(s.timeS) + "," + number(stroke.unit * s.normalN) + "," + number(stroke.unit * s.tangentialN);
    });
}

}  // namespace stroke_text
