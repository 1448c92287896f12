#include "study/analyse/analyse_inputs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/condition.h"
#include "protocols/files/number_text.h"
#include "study/analyse/analyse_recipe.h"

namespace study::analyse {

namespace {

using nlohmann::json;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// "nan", "-inf" and their other spellings.
std::optional<double> specialNumber(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (text == "nan" || text == "na") return std::numeric_limits<double>::quiet_NaN();
    if (text == "inf" || text == "+inf" || text == "infinity") return infinity;
    if (text == "-inf" || text == "-infinity") return -infinity;
    return std::nullopt;
}

/// A decimal. Beyond the range of double it is infinity, or 0 where its exponent is negative.
std::optional<double> decimal(const std::string& text)
{
    double number = 0;
    const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* end = text.data() + text.size();
    const auto parsed = std::from_chars(begin, end, number);
    if (parsed.ptr != end || begin == end) return std::nullopt;
    if (parsed.ec == std::errc{}) return number;
    if (parsed.ec != std::errc::result_out_of_range) return std::nullopt;
    const bool isTiny = text.find("e-") != std::string::npos || text.find("E-") != std::string::npos;
    return (isTiny ? 0.0 : infinity) * (text.starts_with('-') ? -1 : 1);
}

double numberOfText(const std::string& text, const std::string& where)
{
    if (const auto special = specialNumber(text)) return *special;
    if (const auto number = decimal(text)) return *number;
    try {
        return valueOfFormula(text);
    } catch (const RequestFault&) {
        throw RequestFault(where + " is \"" + text + "\"; expected a number");
    }
}

/// "h_g+f_g" as "h_g&f_g"; names that are no ids of this program as they are.
std::string usualSpelling(const std::string& condition)
{
    return protocols::faultOf(condition) ? condition : protocols::conditionIdFrom(condition).value;
}

std::optional<std::size_t> placeOfName(const std::vector<std::string>& names, const std::string& name)
{
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
}

const json& fieldOf(const json& object, const std::string& field)
{
    if (!object.is_object() || !object.contains(field)) throw RequestFault("the inputs have no " + field);
    return object.at(field);
}

bool has(const json& object, const std::string& field)
{
    return object.is_object() && object.contains(field) && !object.at(field).is_null();
}

/// The array of the recipe with the name of the field, else its last array.
std::vector<double> madeByRecipe(const json& object, const std::string& field, bool onlyByName)
{
    if (!object.at("recipe").is_string()) throw RequestFault("the recipe of " + field + " is not a string");
    RecipeArrays made = arraysOfRecipe(object.at("recipe").get<std::string>(), constantsIn(object));
    if (const auto found = made.arrays.find(field); found != made.arrays.end()) return std::move(found->second);
    if (onlyByName) throw RequestFault("the recipe does not define " + field);
    return std::move(made.arrays.at(made.last));
}

std::vector<double> numbersOf(const json& value, const std::string& field)
{
    if (value.is_object() && value.contains("recipe")) return madeByRecipe(value, field, false);
    if (!value.is_array()) throw RequestFault(field + " is not an array of numbers");
    std::vector<double> numbers;
    numbers.reserve(value.size());
    for (const json& entry : value)
        numbers.push_back(numberOf(entry, "value " + std::to_string(numbers.size() + 1) + " of " + field));
    return numbers;
}

long long wholeOf(const json& value, const std::string& field)
{
    const double number = numberOf(value, field);
    if (!(std::floor(number) == number && std::fabs(number) <= 9007199254740992.0))
        throw RequestFault(field + " is not a whole number");
    return static_cast<long long>(number);
}

}  // namespace

double numberOf(const json& value, const std::string& where)
{
    if (value.is_number()) return value.get<double>();
    if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
    if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
    if (value.is_string()) return numberOfText(value.get<std::string>(), where);
    throw RequestFault(where + " is not a number");
}

double numberAt(const json& object, const std::string& field) { return numberOf(fieldOf(object, field), field); }

double numberOr(const json& object, const std::string& field, double otherwise)
{
    return has(object, field) ? numberOf(object.at(field), field) : otherwise;
}

long long wholeAt(const json& object, const std::string& field) { return wholeOf(fieldOf(object, field), field); }

long long wholeOr(const json& object, const std::string& field, long long otherwise)
{
    return has(object, field) ? wholeOf(object.at(field), field) : otherwise;
}

std::string textOr(const json& object, const std::string& field, const std::string& otherwise)
{
    if (!has(object, field)) return otherwise;
    if (!object.at(field).is_string()) throw RequestFault(field + " is not a string");
    return object.at(field).get<std::string>();
}

std::map<std::string, double> constantsIn(const json& object)
{
    std::map<std::string, double> constants;
    for (const auto& [name, value] : object.items())
        if (value.is_number()) constants[name] = value.get<double>();
    return constants;
}

std::vector<double> numbersAt(const json& inputs, const std::string& field)
{
    if (!has(inputs, field) && has(inputs, "recipe")) return madeByRecipe(inputs, field, true);
    return numbersOf(fieldOf(inputs, field), field);
}

std::vector<double> numbersOrNone(const json& inputs, const std::string& field)
{
    return has(inputs, field) ? numbersOf(inputs.at(field), field) : std::vector<double>();
}

std::vector<std::vector<double>> rowsAt(const json& inputs, const std::string& field)
{
    const json& value = fieldOf(inputs, field);
    if (!value.is_array()) throw RequestFault(field + " is not an array of rows");
    std::vector<std::vector<double>> rows;
    for (const json& row : value) rows.push_back(numbersOf(row, "row " + std::to_string(rows.size() + 1) + " of " + field));
    return rows;
}

stats::Factor factorAt(const json& inputs, const std::string& field)
{
    const json& value = fieldOf(inputs, field);
    if (!value.is_array()) throw RequestFault(field + " is not an array of labels");
    std::vector<std::string> labels;
    labels.reserve(value.size());
    for (const json& label : value) {
        if (!label.is_string() && !label.is_number() && !label.is_boolean())
            throw RequestFault("value " + std::to_string(labels.size() + 1) + " of " + field +
                               " is not a label; expected a text or a number");
        labels.push_back(label.is_string() ? label.get<std::string>() : label.dump());
    }
    return stats::factorOf(field, labels);
}

void checkSize(const std::string& what, double size, double most)
{
    if (size > most)
        throw RequestFault(protocols::fixed(size, 0) + " " + what + "; expected smaller inputs, at most " +
                           protocols::fixed(most, 0));
}

stats::CrossedStudy crossedRowsAt(const json& inputs, const std::string& value)
{
    stats::CrossedStudy rows{factorAt(inputs, "participant"), {}, factorAt(inputs, "condition"), numbersAt(inputs, value)};
    const std::size_t n = rows.values.size();
    rows.fabric =
        has(inputs, "fabric") ? factorAt(inputs, "fabric") : stats::factorOf("fabric", std::vector<std::string>(n, "all"));
    for (const stats::Factor* factor : {&rows.condition, &rows.participant, &rows.fabric})
        if (factor->of.size() != n)
            throw RequestFault(factor->name + " has " + std::to_string(factor->of.size()) + " values and " + value + " has " +
                               std::to_string(n) + "; expected one in each row");
    checkSize("conditions", static_cast<double>(rows.condition.levels.size()), mostConditions);
    // The models have a column for each condition.
    checkSize("rows x conditions", static_cast<double>(n) * static_cast<double>(rows.condition.levels.size()), mostCells);
    return rows;
}

std::optional<std::pair<double, double>> boundsOf(const json& options)
{
    if (!has(options, "bounds")) return std::nullopt;
    const auto ends = numbersOf(options.at("bounds"), "bounds");
    if (ends.size() != 2 || !(ends[0] < ends[1])) throw RequestFault("bounds must be [low, high], low < high");
    return std::pair(ends[0], ends[1]);
}

std::vector<std::pair<std::size_t, std::size_t>> contrastsOf(const json& options, const std::vector<std::string>& conditions)
{
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    if (!has(options, "contrasts")) {
        const auto count = static_cast<double>(conditions.size());
        checkSize("contrasts", count * (count - 1) / 2, mostContrasts);
        for (std::size_t a = 0; a < conditions.size(); ++a)
            for (std::size_t b = a + 1; b < conditions.size(); ++b) pairs.emplace_back(a, b);
        return pairs;
    }
    std::vector<std::string> usual;
    for (const std::string& condition : conditions) usual.push_back(usualSpelling(condition));
    const json& list = options.at("contrasts");
    if (!list.is_array() || list.empty()) throw RequestFault("contrasts must be an array of pairs [a, b] of conditions");
    checkSize("contrasts", static_cast<double>(list.size()), mostContrasts);
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (const json& pair : list) {
        if (!pair.is_array() || pair.size() != 2) throw RequestFault("contrasts must hold pairs [a, b] of conditions");
        std::array<std::size_t, 2> places{};
        for (std::size_t i = 0; i < 2; ++i) {
            const std::string name = pair[i].is_string() ? pair[i].get<std::string>() : pair[i].dump();
            auto place = placeOfName(conditions, name);
            if (!place) place = placeOfName(usual, usualSpelling(name));
            if (!place) throw RequestFault("contrasts name \"" + name + "\", which is no condition of the rows");
            places[i] = *place;
        }
        if (places[0] == places[1]) throw RequestFault("a contrast compares \"" + conditions[places[0]] + "\" with itself");
        if (!seen.insert(std::minmax(places[0], places[1])).second)
            throw RequestFault("contrasts repeat \"" + conditions[places[0]] + "\" and \"" + conditions[places[1]] +
                               "\", which would count twice in Holm's correction");
        pairs.emplace_back(places[0], places[1]);
    }
    return pairs;
}

double confidenceLevelOf(const json& options)
{
    const double confidence = numberOr(options, "conf_level", 0.95);
    if (!(confidence > 0 && confidence < 1)) throw RequestFault("conf_level must lie between 0 and 1");
    return confidence;
}

bool truthOr(const json& object, const std::string& field, bool otherwise)
{
    if (!has(object, field)) return otherwise;
    if (!object.at(field).is_boolean()) throw RequestFault(field + " is neither true nor false");
    return object.at(field).get<bool>();
}

}  // namespace study::analyse
