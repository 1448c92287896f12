// What a display makes of grey levels: the friction that was measured on a laboratory's glass, and the level that gives a wanted
// friction. Between the levels of the measurement the curve never falls.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rendering {

/// How the friction was measured. A response holds for this display, load, speed and finger only.
struct ResponseSetting {
    std::string display;  ///< name, as its driver states it in hello
    std::string finger;   ///< what slid over the glass: "index finger, dry", "silicone tip, 6 mm"
    std::string date;     ///< YYYY-MM-DD
    double loadN = 0;
    double speedMmPerS = 0;
    bool operator==(const ResponseSetting&) const = default;
};

/// All measurements at one grey level.
struct MeasuredLevel {
    int level = 0;                    ///< 0 to 255
    int count = 0;                    ///< number of measurements
    double mean = 0;                  ///< friction coefficient
    double fitted = 0;                ///< the same on the curve
    std::optional<double> halfWidth;  ///< of the 95 % interval of the mean; needs repeats
    std::optional<double> up, down;   ///< means while the levels rose and while they fell
    bool operator==(const MeasuredLevel&) const = default;
};

struct DisplayResponse {
    ResponseSetting setting;
    std::vector<MeasuredLevel> measured;  ///< by rising level, at least `fewestLevels`
    /// Friction coefficient at each level from the lowest to the highest measured one; never falls, and the last is above the
    /// first.
    std::vector<double> friction;
    std::optional<double> noise;       ///< standard deviation of one measurement about the mean of its level; needs repeats
    std::optional<double> hysteresis;  ///< mean distance of the means of falling and rising levels
    int deadUpTo = 0;                  ///< up to this level the friction cannot be told from that of the lowest one
    int saturatedFrom = 255;           ///< from this level on it cannot be told from that of the highest one
    std::string source, sourceSha256;  ///< name and hash of the table
    std::string sha256;                ///< of the response, as its file states it

    int lowestLevel() const { return measured.front().level; }
    int highestLevel() const { return measured.back().level; }
    double range() const { return friction.back() - friction.front(); }
    /// True where the friction rises by at most `flatShare` of its mean.
    bool isFlat() const;
    bool operator==(const DisplayResponse&) const = default;
};

inline constexpr std::size_t fewestLevels = 5;

/// A curve that rises by at most this share of its mean is flat: such a change is rounding, not friction.
inline constexpr double flatShare = 1e-6;

/// A wanted friction counts as reached within this share of the display's range of friction.
inline constexpr double reachTolerance = 0.02;

/// From the wanted share of the display's range of friction (0: its lowest, 1: its highest) to the level that gives it.
class LevelsOfFriction {
public:
    explicit LevelsOfFriction(const DisplayResponse& response);

    /// The level whose friction is nearest to the wanted one; the lowest of several.
    int nearest(double share) const;
    /// The same between the levels, for dithering. Levels of equal friction count as their last one, so that only two
    /// neighbouring levels of different friction are mixed.
    double between(double share) const;
    /// Share of the range that the nearest level misses.
    double miss(double share) const;

private:
    struct Step {
        int level;      ///< the lowest level of this friction
        int lastLevel;  ///< the highest one
        double share;
    };
    std::vector<Step> m_steps;  ///< one for each friction, by rising friction
};

}  // namespace rendering
