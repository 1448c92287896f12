#include "rendering/response/display_response.h"

#include <algorithm>
#include <cmath>

namespace rendering {

bool DisplayResponse::isFlat() const { return !(range() > flatShare * (friction.front() + friction.back()) / 2); }

LevelsOfFriction::LevelsOfFriction(const DisplayResponse& response)
{
    for (std::size_t i = 0; i < response.friction.size(); ++i) {
        const double share = (response.friction[i] - response.friction.front()) / response.range();
        const int level = response.lowestLevel() + static_cast<int>(i);
        if (m_steps.empty() || share > m_steps.back().share)
            m_steps.push_back({level, level, share});
        else
            m_steps.back().lastLevel = level;
    }
}

int LevelsOfFriction::nearest(double share) const
{
    const auto above =
        std::lower_bound(m_steps.begin(), m_steps.end(), share, [](const Step& step, double s) { return step.share < s; });
    if (above == m_steps.end()) return m_steps.back().level;
    if (above == m_steps.begin()) return above->level;
    const auto below = above - 1;
    return share - below->share <= above->share - share ? below->level : above->level;
}

double LevelsOfFriction::between(double share) const
{
    const auto above =
        std::lower_bound(m_steps.begin(), m_steps.end(), share, [](const Step& step, double s) { return step.share < s; });
    if (above == m_steps.end()) return m_steps.back().level;
    if (above == m_steps.begin()) return above->level;
    const auto below = above - 1;
    return below->lastLevel + (above->level - below->lastLevel) * (share - below->share) / (above->share - below->share);
}

double LevelsOfFriction::miss(double share) const
{
    const auto above =
        std::lower_bound(m_steps.begin(), m_steps.end(), share, [](const Step& step, double s) { return step.share < s; });
    if (above == m_steps.end()) return share - m_steps.back().share;
    if (above == m_steps.begin()) return above->share - share;
    return std::min(above->share - share, share - (above - 1)->share);
}

}  // namespace rendering
