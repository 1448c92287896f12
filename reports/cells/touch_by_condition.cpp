#include "reports/cells/touch_by_condition.h"

#include <map>
#include <numeric>
#include <optional>
#include <string>

#include "stats/kernels/descriptive.h"
#include "stats/tests/t_tests.h"

namespace reports {
namespace {

using ValuesOfPeople = std::map<std::string, std::vector<double>>;

TouchQuantity quantityOf(const ValuesOfPeople& people)
{
    TouchQuantity quantity;
    quantity.participants = people.size();
    std::vector<double> all, means;
    for (const auto& [person, values] : people) {
        all.insert(all.end(), values.begin(), values.end());
        means.push_back(std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()));
    }
    quantity.presentations = all.size();
    if (all.empty()) {
        quantity.median = quantity.mean = stats::Value::undefined("no presentation of this condition was measured");
        quantity.ci95 = {quantity.mean, quantity.mean};
        return quantity;
    }
    quantity.median = stats::describe(all).median;
    const stats::TTest test = stats::oneSampleTTest(means);
    quantity.mean = test.estimate;
    quantity.ci95 = test.ci;
    return quantity;
}

}  // namespace

std::vector<ConditionTouch> touchByCondition(const StudyData& data)
{
    struct People {
        ValuesOfPeople speed, force, contact;
    };
    std::map<std::string, People> found;
    for (const TouchedPresentation& one : data.touches) {
        People& people = found[one.condition];
        if (one.speedMmPerS) people.speed[one.participant].push_back(*one.speedMmPerS);
        if (one.forceN) people.force[one.participant].push_back(*one.forceN);
        people.contact[one.participant].push_back(one.contactSeconds);
    }
    std::vector<ConditionTouch> conditions;
    for (const std::string& condition : data.conditions) {
        const People& people = found[condition];
        conditions.push_back({quantityOf(people.speed), quantityOf(people.force), quantityOf(people.contact)});
    }
    return conditions;
}

}  // namespace reports
