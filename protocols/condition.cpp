#include "protocols/condition.h"

#include <algorithm>
#include <array>
#include <utility>

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

const Condition* rowNamed(std::string_view id)
{
    const auto found = std::find_if(conditions.begin(), conditions.end(), [&](const Condition& c) { return c.id == id; });
    return found == conditions.end() ? nullptr : &*found;
}

/// An id in its two parts: "h_g@fast" -> "h_g", "fast".
struct IdParts {
    std::string row;
    std::optional<std::string> quality;
};

IdParts partsOf(std::string_view id)
{
    const std::size_t at = id.find('@');
    if (at == std::string_view::npos) return {withAmpersand(id), std::nullopt};
    return {withAmpersand(id.substr(0, at)), std::string(id.substr(at + 1))};
}

struct KnownCondition {
    const Condition* row;
    std::optional<Quality> quality;
};

KnownCondition known(std::string_view id)
{
    if (const auto fault = faultOf(id))
        throw badInput({.what = fault->what, .where = "", .expected = fault->expected, .nextStep = ""});
    const IdParts parts = partsOf(id);
    return {rowNamed(parts.row), parts.quality ? qualityFrom(*parts.quality) : std::nullopt};
}

}  // namespace

bool Condition::hasQuality() const
{
    switch (relief) {
        case ReliefSource::ShapeFromShading:
        case ReliefSource::GeneratedHeight:
        case ReliefSource::PhotometricHeight:
        case ReliefSource::HeightGradient:
            return true;
        case ReliefSource::None:
        case ReliefSource::GreyPhotograph:
        case ReliefSource::GreyTactile:
            return friction == FrictionSource::GeneratedTrace;
    }
    return false;
}

ConditionId catchTrialId() { return ConditionId("catch"); }

std::span<const Condition> allConditions() { return conditions; }

const Condition& conditionNamed(std::string_view id) { return *known(id).row; }

std::optional<Quality> qualityOf(const ConditionId& id) { return known(id.value).quality; }

ConditionId conditionIdFrom(std::string_view text)
{
    const KnownCondition condition = known(text);
    return condition.quality ? withQuality(*condition.row, *condition.quality) : condition.row->conditionId();
}

ConditionId withQuality(const Condition& row, Quality quality)
{
    return ConditionId(std::string(row.id) + "@" + nameOf(quality));
}

std::optional<ConditionFault> faultOf(std::string_view id)
{
    const IdParts parts = partsOf(id);
    const Condition* row = rowNamed(parts.row);
    if (row == nullptr) return ConditionFault{"unknown condition '" + std::string(id) + "'", knownIds()};
    if (!parts.quality) return std::nullopt;
    if (!qualityFrom(*parts.quality))
        return ConditionFault{"unknown quality '" + *parts.quality + "' in '" + std::string(id) + "'",
                              "fast, balanced or accurate after the @"};
    if (!row->hasQuality())
        return ConditionFault{"'" + std::string(id) + "' has a quality, which changes nothing of " + parts.row,
                              "'" + parts.row + "'"};
    return std::nullopt;
}

std::string faultOfOwnId(std::string_view id)
{
    constexpr std::size_t longest = 40;
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    const auto isAllowed = [&](char c) { return isLetter(c) || isDigit(c) || c == '_' || c == '-'; };
    const std::string quoted = "'" + std::string(id) + "'";
    if (id.empty() || id.size() > longest || !isLetter(id.front()) || !std::ranges::all_of(id, isAllowed))
        return quoted + ", expected a letter, then letters, digits, _ and -, at most " + std::to_string(longest) + " characters";
    if (!faultOf(id)) return quoted + " is a condition of the program, expected another id";
    const bool isLabel = (id.front() == 'K' || id.front() == 'k') && id.size() > 1 && std::ranges::all_of(id.substr(1), isDigit);
    if (isLabel || id == catchTrialId().value) return quoted + " has a meaning in result files, expected another id";
    return {};
}

bool comesBefore(const ConditionId& a, const ConditionId& b)
{
    const auto place = [](const ConditionId& id) {
        const KnownCondition condition = known(id.value);
        return std::pair(condition.row - conditions.data(), condition.quality);  // no quality comes before every quality
    };
    return place(a) < place(b);
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
        const ConditionId id = conditionIdFrom(text.substr(begin, end - begin));
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
