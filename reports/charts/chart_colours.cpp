#include "reports/charts/chart_colours.h"

namespace reports {

const std::string& groupColour(protocols::ConditionGroup group)
{
    switch (group) {
        case protocols::ConditionGroup::Vision:
            return ChartColours::blue;
        case protocols::ConditionGroup::Generated:
            return ChartColours::orange;
        case protocols::ConditionGroup::Measured:
            return ChartColours::green;
    }
    return ChartColours::grey;
}

const std::string& plainColour() { return ChartColours::slate; }

const std::string& seriesColour(std::size_t k)
{
    static const std::string* const series[] = {&ChartColours::blue, &ChartColours::vermilion, &ChartColours::green,
                                                &ChartColours::purple, &ChartColours::ink};
    return *series[k % std::size(series)];
}

}  // namespace reports
