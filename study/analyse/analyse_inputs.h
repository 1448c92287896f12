// Reads the numbers of a request: JSON numbers, "nan", "inf", decimals beyond the range of double, fractions and roots
// ("1/3", "sqrt(2)/2"), arrays, tables, and recipes of long arrays.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stats/models/crossed_study.h"

namespace study::analyse {

/// A fault of a request; the text names the field and states what was expected.
struct RequestFault : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The number in a JSON value; NaN for null. `where` names the value in the fault.
double numberOf(const nlohmann::json& value, const std::string& where);

/// A required field, and a field with a default.
double numberAt(const nlohmann::json& object, const std::string& field);
double numberOr(const nlohmann::json& object, const std::string& field, double otherwise);

/// A whole number; 27.0 counts as one.
long long wholeAt(const nlohmann::json& object, const std::string& field);
long long wholeOr(const nlohmann::json& object, const std::string& field, long long otherwise);

std::string textOr(const nlohmann::json& object, const std::string& field, const std::string& otherwise);

/// The numbers of an object, which its recipe may name.
std::map<std::string, double> constantsIn(const nlohmann::json& object);

/// The array of a field: written out, made by its own recipe, or made by the common recipe of all inputs.
std::vector<double> numbersAt(const nlohmann::json& inputs, const std::string& field);
/// Empty where the field is absent.
std::vector<double> numbersOrNone(const nlohmann::json& inputs, const std::string& field);

std::vector<std::vector<double>> rowsAt(const nlohmann::json& inputs, const std::string& field);

/// The labels of the rows, such as participants: texts, numbers or truth values; levels in the order of first appearance.
stats::Factor factorAt(const nlohmann::json& inputs, const std::string& field);

/// Throws RequestFault where `size`, the number of `what`, is above `most`: before memory or time is spent on it.
void checkSize(const std::string& what, double size, double most);

/// The most cells of participants x fabrics x conditions: 160 MB of numbers.
inline constexpr double mostCells = 2e7;

/// The most conditions of a request, with 4,950 pairs; and the most pairs that it compares. A pair takes up to a millisecond.
inline constexpr double mostConditions = 100;
inline constexpr double mostContrasts = 5000;

/// Long rows: the number `value` of each row with its "condition", "participant" and "fabric", all of one length. Without
/// fabrics all rows have one. Throws RequestFault for more than mostConditions,
/// and for too many rows x conditions.
stats::CrossedStudy crossedRowsAt(const nlohmann::json& inputs, const std::string& value);

/// [low, high] of the option "bounds", low < high; none where it is absent.
std::optional<std::pair<double, double>> boundsOf(const nlohmann::json& options);

/// The pairs of the option "contrasts", [["a", "b"], ...], as places in `conditions`; all pairs where it is absent. At most
/// mostContrasts. "h_g+f_g" names the condition "h_g&f_g", and the other way round.
std::vector<std::pair<std::size_t, std::size_t>> contrastsOf(const nlohmann::json& options,
                                                             const std::vector<std::string>& conditions);

/// The option "conf_level", between 0 and 1; otherwise 0.95.
double confidenceLevelOf(const nlohmann::json& options);

bool truthOr(const nlohmann::json& object, const std::string& field, bool otherwise);

/// One row of a table that gives names to the values of an enum.
template <typename Choice>
struct NamedChoice {
    std::string_view name;
    Choice choice;
};

/// The value that `field` names. Throws RequestFault for a name that is not in the table.
template <typename Choice, std::size_t N>
Choice choiceOr(const nlohmann::json& object, const std::string& field, const NamedChoice<Choice> (&choices)[N],
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
