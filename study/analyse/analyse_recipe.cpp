#include "study/analyse/analyse_recipe.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "protocols/files/number_text.h"
#include "study/analyse/analyse_formula.h"
#include "study/analyse/analyse_inputs.h"

namespace study::analyse {

namespace {

constexpr double largestIndex = 9e15;          // whole in double
constexpr std::size_t longestRecipe = 10'000;  // formulas are recursive

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

/// Reads the text of a part from left to right. A step that does not fit takes nothing and returns nothing.
class PartReader {
public:
    explicit PartReader(std::string_view text) : m_text(text) {}

    /// Returns false where there is none.
    bool skipBlanks()
    {
        const std::size_t before = m_text.size();
        while (!m_text.empty() && isBlank(m_text.front())) m_text.remove_prefix(1);
        return m_text.size() < before;
    }

    bool take(std::string_view word)
    {
        if (!m_text.starts_with(word)) return false;
        m_text.remove_prefix(word.size());
        return true;
    }

    std::string_view takeLetters()
    {
        return takeWhile([](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); });
    }
    std::string_view takeDigits()
    {
        return takeWhile([](char c) { return c >= '0' && c <= '9'; });
    }

    std::string_view rest() const { return m_text; }

    static bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

private:
    template <class Fits>
    std::string_view takeWhile(Fits fits)
    {
        const auto end = std::find_if_not(m_text.begin(), m_text.end(), fits);
        const std::string_view taken = m_text.substr(0, static_cast<std::size_t>(end - m_text.begin()));
        m_text.remove_prefix(taken.size());
        return taken;
    }

    std::string_view m_text;
};

std::string withoutBlanksAround(std::string_view text)
{
    while (!text.empty() && PartReader::isBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && PartReader::isBlank(text.back())) text.remove_suffix(1);
    return std::string(text);
}

/// "i = 0..n-1", also with three dots.
bool readRange(Recipe& recipe, std::string_view part)
{
    PartReader reader(part);
    reader.skipBlanks();
    const std::string_view index = reader.takeLetters();
    reader.skipBlanks();
    if (index.empty() || !reader.take("=")) return false;
    reader.skipBlanks();
    const std::string_view ends = reader.rest();
    const std::size_t dots = ends.find("..", 1);
    if (dots == std::string_view::npos) return false;
    const std::size_t after = dots + (ends.substr(dots).starts_with("...") ? 3 : 2);
    const std::string first = withoutBlanksAround(ends.substr(0, dots)), last = withoutBlanksAround(ends.substr(after));
    if (first.empty() || last.empty()) return false;
    recipe.index = index;
    recipe.first = first;
    recipe.last = last;
    return true;
}

/// "x_i = i/2" or "b = 0.8*a".
bool readDefinition(Recipe& recipe, std::string_view part)
{
    PartReader reader(part);
    reader.skipBlanks();
    const std::string_view name = reader.takeLetters();
    const bool hasIndex = reader.take("_");
    const std::string_view index = hasIndex ? reader.takeLetters() : std::string_view();
    reader.skipBlanks();
    if (name.empty() || (hasIndex && index.empty()) || !reader.take("=")) return false;
    reader.skipBlanks();
    if (reader.rest().empty()) return false;
    recipe.definitions.push_back({std::string(name), std::string(reader.rest())});
    if (hasIndex && recipe.index.empty()) recipe.index = index;
    return true;
}

std::size_t sideOf(std::string_view digits)
{
    std::size_t side = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), side);
    if (read.ec != std::errc{} || static_cast<double>(side) > mostRecipeEntries)
        throw RequestFault("the recipe's shape has a side of " + std::string(digits) + "; expected at most " +
                           protocols::fixed(mostRecipeEntries, 0));
    return side;
}

/// "800 rows x 1280 cols" somewhere in the part.
bool readShape(Recipe& recipe, std::string_view part)
{
    for (std::size_t word = part.find("row"); word != std::string_view::npos; word = part.find("row", word + 1)) {
        std::size_t end = word;
        while (end > 0 && PartReader::isBlank(part[end - 1])) --end;
        std::size_t begin = end;
        while (begin > 0 && part[begin - 1] >= '0' && part[begin - 1] <= '9') --begin;
        PartReader reader(part.substr(word + 3));
        reader.take("s");
        reader.skipBlanks();
        if (begin == end || !(reader.take("x") || reader.take("by") || reader.take("*"))) continue;
        reader.skipBlanks();
        const std::string_view columns = reader.takeDigits();
        reader.skipBlanks();
        if (columns.empty() || !reader.take("col")) continue;
        recipe.rows = sideOf(part.substr(begin, end - begin));
        recipe.columns = sideOf(columns);
        return true;
    }
    return false;
}

/// "k row-major".
bool readIndexAlone(Recipe& recipe, std::string_view part)
{
    PartReader reader(part);
    reader.skipBlanks();
    const std::string_view index = reader.takeLetters();
    if (index.size() != 1 || !reader.skipBlanks() || !reader.take("row-major")) return false;
    recipe.index = index;
    return true;
}

void readPart(Recipe& recipe, const std::string& part)
{
    const bool isRead = readRange(recipe, part) || readDefinition(recipe, part) || readShape(recipe, part);
    if (!isRead) readIndexAlone(recipe, part);  // anything else is a remark
    recipe.isFloat = recipe.isFloat || part.find("float32") != std::string::npos;
}

Recipe readRecipe(const std::string& text)
{
    Recipe recipe;
    for (const std::string& part : partsOf(text)) readPart(recipe, part);
    if (recipe.definitions.empty()) throw RequestFault("the recipe \"" + text + "\" defines no array");
    std::set<std::string> names;
    for (const ArrayDefinition& definition : recipe.definitions)
        if (!names.insert(definition.name).second) throw RequestFault("the recipe defines " + definition.name + " twice");
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
    if (!number.isWhole || !(std::fabs(number.real) < largestIndex))
        throw RequestFault("the recipe's range \"" + formula + "\" is not a whole number below 9e15");
    return static_cast<long long>(number.whole);
}

struct IndexRange {
    long long first = 0;
    long long count = 0;
};

/// The number of entries, which is a constant.
long long entriesIn(double n)
{
    if (!(n >= 0 && n <= mostRecipeEntries))
        throw RequestFault("the recipe's n is outside 0 to " + protocols::fixed(mostRecipeEntries, 0));
    return static_cast<long long>(n);
}

IndexRange rangeOf(const Recipe& recipe, const FormulaScope& scope, const std::map<std::string, double>& constants)
{
    IndexRange range{wholeEndOf(recipe.first, scope), 0};
    // Both sides are at most mostRecipeEntries, so that their product fits.
    const auto ofShape = static_cast<long long>(recipe.rows * recipe.columns);
    if (!recipe.last.empty())
        range.count = wholeEndOf(recipe.last, scope) - range.first + 1;
    else if (recipe.rows > 0)
        range.count = ofShape;
    else if (constants.count("n") != 0)
        range.count = entriesIn(constants.at("n"));
    else
        throw RequestFault("the recipe does not state how many entries there are");
    const auto entries = static_cast<double>(range.count);
    if (range.count < 0 || entries * static_cast<double>(recipe.definitions.size()) > mostRecipeEntries)
        throw RequestFault("the recipe asks for " + std::to_string(range.count) + " entries of " +
                           std::to_string(recipe.definitions.size()) + (recipe.definitions.size() == 1 ? " array" : " arrays") +
                           "; expected 0 to " + protocols::fixed(mostRecipeEntries, 0) + " in all");
    if (recipe.rows > 0 && range.count != ofShape)
        throw RequestFault("the recipe's range has " + std::to_string(range.count) + " entries, but its shape " +
                           std::to_string(ofShape));
    return range;
}

/// A recipe that can be carried out within the limits.
struct PreparedRecipe {
    Recipe recipe;
    FormulaScope scope;
    IndexRange range;
};

PreparedRecipe preparedRecipe(const std::string& text, const std::map<std::string, double>& constants)
{
    if (text.size() > longestRecipe)
        throw RequestFault("the recipe has " + std::to_string(text.size()) + " characters; expected at most " +
                           std::to_string(longestRecipe));
    PreparedRecipe prepared{readRecipe(text), {}, {}};
    for (const auto& [name, value] : constants) prepared.scope.add(name, constant(value));
    prepared.range = rangeOf(prepared.recipe, prepared.scope, constants);
    if (static_cast<double>(prepared.range.count) * static_cast<double>(text.size()) > mostRecipeWork)
        throw RequestFault("the recipe of " + std::to_string(text.size()) + " characters is too long for " +
                           std::to_string(prepared.range.count) + " entries; expected a product of at most " +
                           protocols::fixed(mostRecipeWork, 0));
    return prepared;
}

}  // namespace

RecipeCost costOfRecipe(const std::string& text, const std::map<std::string, double>& constants)
{
    const PreparedRecipe prepared = preparedRecipe(text, constants);
    const auto count = static_cast<double>(prepared.range.count);
    return {count * static_cast<double>(prepared.recipe.definitions.size()), count * static_cast<double>(text.size())};
}

RecipeArrays arraysOfRecipe(const std::string& text, const std::map<std::string, double>& constants)
{
    auto [recipe, scope, range] = preparedRecipe(text, constants);
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
