// Reading the numbers of a request: JSON numbers, "nan", "inf", decimals beyond the doubles, fractions
// and roots ("1/3", "sqrt(2)/2"), arrays, tables, and recipes of long arrays.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace study::analyse {

/// A request that cannot be understood; the text names the field and what was expected.
struct RequestFault : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The number of a JSON value; NaN for null. `where` names it in the fault.
double numberOf(const nlohmann::json& value, const std::string& where);

/// A required field of `inputs`, and one of `options` with a default.
double numberAt(const nlohmann::json& object, const std::string& field);
double numberOr(const nlohmann::json& object, const std::string& field, double otherwise);

/// A whole number, also written 27.0.
long long wholeAt(const nlohmann::json& object, const std::string& field);
long long wholeOr(const nlohmann::json& object, const std::string& field, long long otherwise);

std::string textOr(const nlohmann::json& object, const std::string& field, const std::string& otherwise);

/// The array of a field: written out, a recipe of its own, or made by the recipe of all inputs.
std::vector<double> numbersAt(const nlohmann::json& inputs, const std::string& field);
/// Empty where the field is absent.
std::vector<double> numbersOrNone(const nlohmann::json& inputs, const std::string& field);

std::vector<std::vector<double>> rowsAt(const nlohmann::json& inputs, const std::string& field);

/// The choice that `field` names, of a table of names.
template <typename Choice>
struct Named {
    std::string_view name;
    Choice choice;
};

template <typename Choice, std::size_t N>
Choice choiceOr(const nlohmann::json& object, const std::string& field, const Named<Choice> (&choices)[N],
                const std::string& otherwise)
{
    const std::string wanted = textOr(object, field, otherwise);
    std::string known;
    for (const auto& one : choices) {
        if (one.name == wanted) return one.choice;
        known += (known.empty() ? "" : ", ") + std::string(one.name);
    }
    throw RequestFault("unknown " + field + " \"" + wanted + "\"; expected one of: " + known);
}

}  // namespace study::analyse
