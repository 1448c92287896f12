#include "study/analyse/analyse.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "protocols/files/errors.h"
#include "study/analyse/analyse_claims.h"
#include "study/analyse/analyse_counts.h"
#include "study/analyse/analyse_designs.h"
#include "study/analyse/analyse_inputs.h"
#include "study/analyse/analyse_means.h"
#include "study/analyse/analyse_models.h"
#include "study/analyse/analyse_recipe.h"
#include "study/analyse/analyse_samples.h"
#include "study/analyse/analyse_signals.h"
#include "study/analyse/analyse_tables.h"

namespace study::analyse {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const json& objectOrEmpty(const json& request, const std::string& field)
{
    static const json empty = json::object();
    if (!request.contains(field) || request.at(field).is_null()) return empty;
    if (!request.at(field).is_object()) throw RequestFault(field + " is not an object");
    return request.at(field);
}

/// One name of a list of fields: "x", or "[x]" where it may be absent.
struct KnownField {
    std::string name;
    bool required;
};

std::vector<KnownField> fieldsOf(std::string_view list)
{
    std::vector<KnownField> fields;
    std::istringstream words{std::string(list)};
    for (std::string word; words >> word;) {
        const bool required = word.front() != '[';
        fields.push_back({required ? word : word.substr(1, word.size() - 2), required});
    }
    return fields;
}

/// "kind, x, [y]", or "none".
std::string withCommas(std::string_view list)
{
    std::string text;
    for (const KnownField& field : fieldsOf(list))
        text += (text.empty() ? "" : ", ") + (field.required ? field.name : "[" + field.name + "]");
    return text.empty() ? "none" : text;
}

/// The first field of the object that the list does not name; empty where there is none.
std::string unknownFieldOf(const json& object, const std::vector<KnownField>& known)
{
    for (const auto& [name, value] : object.items())
        if (std::none_of(known.begin(), known.end(), [&](const KnownField& field) { return field.name == name; })) return name;
    return {};
}

enum class Remarks { Refused, BesideAllKnown };

/// Throws RequestFault where a required field is absent or a field is unknown.
void checkFields(const json& object, const std::string& kind, std::string_view list, Remarks remarks)
{
    const auto known = fieldsOf(list);
    const std::string unknown = unknownFieldOf(object, known);
    const std::string found = unknown.empty() ? "" : ", but \"" + unknown + "\"";
    bool complete = true;
    for (const KnownField& field : known) {
        const bool isThere = object.contains(field.name);
        if (!isThere && field.required)
            throw RequestFault("the " + kind + " have no " + field.name + found + "; expected: " + withCommas(list));
        complete = complete && isThere;
    }
    if (!unknown.empty() && !(complete && remarks == Remarks::BesideAllKnown))
        throw RequestFault("unknown name \"" + unknown + "\" in the " + kind + "; expected: " + withCommas(list));
}

/// Adds the cost of the object's recipe, if it has one. A recipe with a fault adds nothing; reading it names the fault.
void addRecipe(RecipeCost& sum, const json& object)
{
    if (!object.is_object() || !object.contains("recipe") || !object.at("recipe").is_string()) return;
    try {
        const RecipeCost cost = costOfRecipe(object.at("recipe").get<std::string>(), constantsIn(object));
        sum.entries += cost.entries;
        sum.work += cost.work;
    } catch (const RequestFault&) {
    }
}

/// Throws RequestFault where the recipes of the inputs together, also those of single rows, cost too much.
void checkRecipes(const json& inputs)
{
    RecipeCost sum;
    addRecipe(sum, inputs);
    for (const json& field : inputs) {
        addRecipe(sum, field);
        if (field.is_array())
            for (const json& row : field) addRecipe(sum, row);
    }
    checkSize("entries of all recipes", sum.entries, mostRecipeEntries);
    checkSize("entries x characters of all recipes", sum.work, mostRecipeWork);
}

void checkRequest(const NamedAnalysis& analysis, const AnalysisRequest& request)
{
    if (!request.inputs.contains("recipe")) checkFields(request.inputs, "inputs", analysis.inputs, Remarks::BesideAllKnown);
    checkFields(request.options, "options", analysis.options, Remarks::Refused);
    checkRecipes(request.inputs);
}

const NamedAnalysis& analysisOf(const json& request)
{
    const std::string name = textOr(request, "analysis", "");
    const auto& all = analyses();
    const auto found = std::find_if(all.begin(), all.end(), [&](const NamedAnalysis& one) { return one.name == name; });
    if (found != all.end()) return *found;
    std::string known;
    for (const NamedAnalysis& one : all) known += (known.empty() ? "" : ", ") + std::string(one.name);
    throw RequestFault(name.empty() ? "no analysis is named; expected one of: " + known
                                    : "unknown analysis \"" + name + "\"; expected one of: " + known);
}

}  // namespace

const std::vector<NamedAnalysis>& analyses()
{
    static const std::vector<NamedAnalysis> all = [] {
        std::vector<NamedAnalysis> together;
        for (const auto& group : {analysesOfMeans(), analysesOfCounts(), analysesOfTables(), analysesOfDesigns(),
                                  analysesOfClaims(), analysesOfModels(), analysesOfSignals(), analysesOfSamples()})
            together.insert(together.end(), group.begin(), group.end());
        return together;
    }();
    return all;
}

std::string listOfAnalyses()
{
    std::string text;
    for (const NamedAnalysis& one : analyses())
        text += std::string(one.name) + ": " + std::string(one.purpose) + "\n    inputs: " + withCommas(one.inputs) +
                "\n    options: " + withCommas(one.options) + "\n";
    return text;
}

ordered_json answerOf(const json& request, const std::filesystem::path& folder)
{
    try {
        if (!request.is_object()) throw RequestFault("the request is not an object");
        const NamedAnalysis& analysis = analysisOf(request);
        const AnalysisRequest whole{objectOrEmpty(request, "inputs"), objectOrEmpty(request, "options"), folder};
        checkRequest(analysis, whole);
        return analysis.answer(whole);
    } catch (const RequestFault& fault) {
        return {{"error", fault.what()}};
    } catch (const protocols::Error& fault) {
        return {{"error", fault.what()}};
    } catch (const std::exception& fault) {
        // Whatever it is, the other requests of the file are answered.
        return {{"error", std::string("the analysis failed (") + fault.what() + "); expected smaller or other inputs"}};
    }
}

}  // namespace study::analyse
