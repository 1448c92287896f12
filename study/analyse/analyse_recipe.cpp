#include "study/analyse/analyse_recipe.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>

#include "study/analyse/analyse_formula.h"
#include "study/analyse/analyse_inputs.h"

namespace study::analyse {

namespace {

constexpr double mostEntries = 2e8;
constexpr std::size_t longestRecipe = 10'000;  // regular expressions and formulas are recursive

struct ArrayDefinition {
    std::string name;
    std::string formula;
};

/// Parts between commas and semicolons outside parentheses.
std::vector<std::string> partsOf(const std::string& recipe)
{
    std::vector<std::string> parts(1);
    int depth = 0;
    for (const char c : recipe) {
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (depth == 0 && (c == ',' || c == ';'))
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

/// The contents of a recipe.
struct Recipe {
    std::vector<ArrayDefinition> definitions;
    std::string index;
    std::string first = "0";
    std::string last;  ///< empty where the recipe states no range
    std::size_t rows = 0;
    std::size_t columns = 0;
    bool isFloat = false;
};

void readPart(Recipe& recipe, const std::string& part)
{
    static const std::regex range(R"(\s*([A-Za-z]+)\s*=\s*(.+?)\s*\.\.\.?\s*(.+?)\s*)");
    static const std::regex definition(R"(\s*([A-Za-z]+)(?:_([A-Za-z]+))?\s*=\s*(.+))");
    static const std::regex shape(R"(.*?(\d+)\s*rows?\s*(?:x|by|\*)\s*(\d+)\s*col.*)");
    static const std::regex indexOnly(R"(\s*([A-Za-z])\s+row-major.*)");
    std::smatch found;
    if (std::regex_match(part, found, range)) {
        recipe.index = found[1];
        recipe.first = found[2];
        recipe.last = found[3];
    } else if (std::regex_match(part, found, definition)) {
        recipe.definitions.push_back({found[1], found[3]});
        if (found[2].matched && recipe.index.empty()) recipe.index = found[2];
    } else if (std::regex_match(part, found, shape)) {
        recipe.rows = std::stoul(found[1]);
        recipe.columns = std::stoul(found[2]);
    } else if (std::regex_match(part, found, indexOnly)) {
        recipe.index = found[1];
    }
    recipe.isFloat = recipe.isFloat || part.find("float32") != std::string::npos;
}

Recipe readRecipe(const std::string& text)
{
    Recipe recipe;
    for (const std::string& part : partsOf(text)) readPart(recipe, part);
    if (recipe.definitions.empty()) throw RequestFault("the recipe \"" + text + "\" defines no array");
    return recipe;
}

/// Names and values that a formula may use: the constants, the index, and the arrays defined before it.
struct FormulaScope {
    std::vector<std::string> names;
    std::vector<FormulaNumber> values;

    std::size_t add(const std::string& name, const FormulaNumber& value)
    {
        names.push_back(name);
        values.push_back(value);
        return names.size() - 1;
    }
};

/// A whole constant takes part in exact arithmetic.
FormulaNumber constant(double x)
{
    return std::floor(x) == x && std::fabs(x) < 9e15 ? FormulaNumber::ofWhole(static_cast<WideInteger>(x))
                                                     : FormulaNumber::ofReal(x);
}

long long wholeEndOf(const std::string& formula, const FormulaScope& scope)
{
    std::string remark;
    const FormulaNumber number = Formula(formula, scope.names, &remark).evaluate(scope.values);
    if (!number.isWhole) throw RequestFault("the recipe's range \"" + formula + "\" is not a whole number");
    return static_cast<long long>(number.whole);
}

struct IndexRange {
    long long first = 0;
    long long count = 0;
};

IndexRange rangeOf(const Recipe& recipe, const FormulaScope& scope, const std::map<std::string, double>& constants)
{
    IndexRange range{wholeEndOf(recipe.first, scope), 0};
    if (!recipe.last.empty())
        range.count = wholeEndOf(recipe.last, scope) - range.first + 1;
    else if (recipe.rows > 0)
        range.count = static_cast<long long>(recipe.rows * recipe.columns);
    else if (constants.count("n") != 0)
        range.count = static_cast<long long>(constants.at("n"));
    else
        throw RequestFault("the recipe does not state how many entries there are");
    if (range.count < 0 || static_cast<double>(range.count) > mostEntries)
        throw RequestFault("the recipe asks for " + std::to_string(range.count) + " entries; expected 0 to 200000000");
    return range;
}

}  // namespace

RecipeArrays arraysOfRecipe(const std::string& text, const std::map<std::string, double>& constants)
{
    if (text.size() > longestRecipe)
        throw RequestFault("the recipe has " + std::to_string(text.size()) + " characters; expected at most " +
                           std::to_string(longestRecipe));
    const Recipe recipe = readRecipe(text);
    FormulaScope scope;
    for (const auto& [name, value] : constants) scope.add(name, constant(value));
    const IndexRange range = rangeOf(recipe, scope, constants);
    const std::size_t index = scope.add(recipe.index.empty() ? "i" : recipe.index, FormulaNumber::ofWhole(0));
    std::vector<Formula> formulas;
    std::vector<std::size_t> places;
    RecipeArrays result{{}, recipe.definitions.back().name, recipe.rows, recipe.columns};
    std::vector<std::vector<double>*> arrays;
    for (const ArrayDefinition& definition : recipe.definitions) {
        std::string remark;
        formulas.emplace_back(definition.formula, scope.names, &remark);
        places.push_back(scope.add(definition.name, FormulaNumber::ofReal(0)));
        arrays.push_back(&result.arrays[definition.name]);
        arrays.back()->reserve(static_cast<std::size_t>(range.count));
    }
    for (long long i = 0; i < range.count; ++i) {
        scope.values[index] = FormulaNumber::ofWhole(range.first + i);
        for (std::size_t d = 0; d < formulas.size(); ++d) {
            double entry = formulas[d].evaluate(scope.values).real;
            if (recipe.isFloat) entry = static_cast<float>(entry);
            scope.values[places[d]] = FormulaNumber::ofReal(entry);
            arrays[d]->push_back(entry);
        }
    }
    return result;
}

double valueOfFormula(const std::string& formula) { return Formula(formula, {}).evaluate({}).real; }

}  // namespace study::analyse
