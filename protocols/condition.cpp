#include "protocols/condition.h"

#include <algorithm>
#include <array>

#include "protocols/files/errors.h"

namespace protocols {

namespace {

constexpr std::array<Condition, 10> conditions{{
    {"v_grey", ConditionGroup::Vision, ReliefSource::GreyPhotograph, FrictionSource::None},
    {"v_shape", ConditionGroup::Vision, ReliefSource::ShapeFromShading, FrictionSource::None},
    {"f_g", ConditionGroup::Generated, ReliefSource::None, FrictionSource::GeneratedTrace},
    {"h_g", ConditionGroup::Generated, ReliefSource::GeneratedHeight, FrictionSource::None},
    {"h_g&f_g", ConditionGroup::Generated, ReliefSource::GeneratedHeight, FrictionSource::GeneratedTrace},
    {"t_grey", ConditionGroup::Measured, ReliefSource::GreyTactile, FrictionSource::None},
    {"f", ConditionGroup::Measured, ReliefSource::None, FrictionSource::MeasuredTrace},
    {"h", ConditionGroup::Measured, ReliefSource::PhotometricHeight, FrictionSource::None},
    {"h&f", ConditionGroup::Measured, ReliefSource::PhotometricHeight, FrictionSource::MeasuredTrace},
    {"gradient", ConditionGroup::Measured, ReliefSource::HeightGradient, FrictionSource::None, false},
}};

std::string knownIds()
{
    std::string text = "one of ";
    for (const Condition& condition : conditions) {
        if (&condition != &conditions.front()) text += ", ";
        text += condition.id;
    }
    return text;
}

std::string withAmpersand(std::string_view id)
{
    std::string text(id);
    std::replace(text.begin(), text.end(), '+', '&');
    return text;
}

}  // namespace

ConditionId catchTrialId() { return ConditionId("catch"); }

std::span<const Condition> allConditions() { return conditions; }

const Condition& conditionNamed(std::string_view id)
{
    const std::string wanted = withAmpersand(id);
    const auto found = std::find_if(conditions.begin(), conditions.end(), [&](const Condition& c) { return c.id == wanted; });
    if (found == conditions.end())
        throw badInput(
            {.what = "unknown condition '" + std::string(id) + "'", .where = "", .expected = knownIds(), .nextStep = ""});
    return *found;
}

std::string fileNameOf(const ConditionId& id)
{
    std::string name = id.value;
    std::replace(name.begin(), name.end(), '&', '+');
    return name;
}

std::vector<ConditionId> conditionList(std::string_view text)
{
    std::vector<ConditionId> ids;
    if (text == "all") {
        for (const Condition& condition : conditions)
            if (condition.ofThePaper) ids.push_back(condition.conditionId());
        return ids;
    }
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const ConditionId id = conditionNamed(text.substr(begin, end - begin)).conditionId();
        if (std::find(ids.begin(), ids.end(), id) != ids.end())
            throw badInput({.what = "condition '" + id.value + "' is named twice",
                            .where = std::string(text),
                            .expected = "each condition once",
                            .nextStep = ""});
        ids.push_back(id);
        begin = end + 1;
    }
    return ids;
}

}  // namespace protocols
