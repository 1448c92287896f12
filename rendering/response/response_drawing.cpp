#include "rendering/response/response_drawing.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "protocols/files/svg_drawing.h"
#include "rendering/response/response_file.h"

namespace rendering {

namespace {

using protocols::SvgAnchor;
using protocols::SvgDrawing;
using protocols::SvgPoint;

constexpr double width = 760, height = 460, left = 80, right = 24, top = 64, bottom = 64;
constexpr const char *ink = "#22303a", *faint = "#d8dee3", *curveColour = "#1f6f8b", *upColour = "#c06014",
                     *downColour = "#5b4b8a";

/// The next of 1, 2, 5, 10 … times a power of ten, so that a range has 4 to 8 of it.
double tickStep(double range)
{
    const double power = std::pow(10, std::floor(std::log10(range / 4)));
    for (const double factor : {5.0, 2.0})
        if (factor * power <= range / 4) return factor * power;
    return power;
}

class ResponsePlot {
public:
    explicit ResponsePlot(const DisplayResponse& response)
        : m_response(response),
          m_drawing(width, height, "Response of the display " + response.setting.display,
                    "Friction coefficient over grey level, " + measuredText(response.setting))
    {
        m_low = response.friction.front();
        m_high = response.friction.back();
        for (const auto& level : response.measured)
            for (const double value : {level.mean - level.halfWidth.value_or(0), level.mean + level.halfWidth.value_or(0),
                                       level.up.value_or(level.mean), level.down.value_or(level.mean)}) {
                m_low = std::min(m_low, value);
                m_high = std::max(m_high, value);
            }
        const double margin = 0.05 * (m_high - m_low);
        m_low = std::max(0.0, m_low - margin);
        m_high += margin;
    }

    std::string text()
    {
        zones();
        axes();
        measurements();
        curve();
        legend();
        return m_drawing.finished();
    }

private:
    double x(double level) const { return left + level / 255 * (width - left - right); }
    double y(double friction) const { return height - bottom - (friction - m_low) / (m_high - m_low) * (height - top - bottom); }

    /// Levels that change nothing: below the threshold, and where the curve is flat at its end.
    void zones()
    {
        const auto zone = [&](double from, double to) {
            if (to <= from) return;
            m_drawing.rectangle({x(from), top}, x(to) - x(from), height - top - bottom, "#eef1f3");
            if (x(to) - x(from) > 80) m_drawing.text({x((from + to) / 2), height - bottom - 10}, "no change", {.size = 12});
        };
        zone(m_response.lowestLevel(), m_response.deadUpTo);
        zone(m_response.saturatedFrom, m_response.highestLevel());
    }

    void axes()
    {
        const double step = tickStep(m_high - m_low);
        const auto decimals = static_cast<int>(std::clamp(std::ceil(-std::log10(step) - 1e-9), 0.0, 300.0));
        for (const double value : protocols::multiplesBetween(m_low, m_high, step)) {
            m_drawing.line({left, y(value)}, {width - right, y(value)}, faint, 1);
            m_drawing.text({left - 8, y(value) + 5}, protocols::fixed(value, decimals), {.anchor = SvgAnchor::End});
        }
        for (const int level : {0, 32, 64, 96, 128, 160, 192, 224, 255}) {
            m_drawing.line({x(level), height - bottom}, {x(level), height - bottom + 5}, ink, 1);
            m_drawing.text({x(level), height - bottom + 22}, std::to_string(level));
        }
        m_drawing.line({left, height - bottom}, {width - right, height - bottom}, ink, 1);
        m_drawing.line({left, top}, {left, height - bottom}, ink, 1);
        m_drawing.text({(left + width - right) / 2, height - 16}, "grey level");
        m_drawing.text({22, (top + height - bottom) / 2}, "friction coefficient", {.rotation = -90});
    }

    void measurements()
    {
        for (const auto& level : m_response.measured) {
            const double at = x(level.level);
            if (level.halfWidth)
                m_drawing.line({at, y(level.mean - *level.halfWidth)}, {at, y(level.mean + *level.halfWidth)}, ink, 1.5);
            if (level.up && level.down) {
                const double u = y(*level.up), d = y(*level.down);
                m_drawing.polygon({{at - 5, u + 4}, {at + 5, u + 4}, {at, u - 5}}, upColour, "none");
                m_drawing.polygon({{at - 5, d - 4}, {at + 5, d - 4}, {at, d + 5}}, downColour, "none");
            } else {
                m_drawing.circle({at, y(level.mean)}, 4, "white", ink);
            }
        }
    }

    void curve()
    {
        std::vector<SvgPoint> points;
        for (std::size_t i = 0; i < m_response.friction.size(); ++i)
            points.push_back({x(m_response.lowestLevel() + static_cast<double>(i)), y(m_response.friction[i])});
        m_drawing.polyline(points, curveColour, 2.5);
    }

    void legend()
    {
        m_drawing.text({left, 24}, protocols::escapedMarkup("Response of " + m_response.setting.display),
                       {.size = 16, .anchor = SvgAnchor::Start, .bold = true});
        m_drawing.text({left, 46},
                       protocols::escapedMarkup(protocols::shortest(m_response.setting.loadN) + " N, " +
                                                protocols::shortest(m_response.setting.speedMmPerS) + " mm/s, " +
                                                m_response.setting.finger + ", " + m_response.setting.date),
                       {.size = 13, .anchor = SvgAnchor::Start});
        if (!m_response.hysteresis) return;
        const double at = width - right - 190;
        m_drawing.polygon({{at, 28}, {at + 10, 28}, {at + 5, 19}}, upColour, "none");
        m_drawing.text({at + 16, 28}, "levels rising", {.size = 13, .anchor = SvgAnchor::Start});
        m_drawing.polygon({{at + 100, 19}, {at + 110, 19}, {at + 105, 28}}, downColour, "none");
        m_drawing.text({at + 116, 28}, "levels falling", {.size = 13, .anchor = SvgAnchor::Start});
    }

    const DisplayResponse& m_response;
    SvgDrawing m_drawing;
    double m_low = 0, m_high = 1;
};

}  // namespace

std::string responseDrawing(const DisplayResponse& response) { return ResponsePlot(response).text(); }

}  // namespace rendering
