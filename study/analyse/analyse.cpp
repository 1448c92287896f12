#include "study/analyse/analyse.h"

#include <algorithm>

#include "study/analyse/analyse_answer.h"
#include "study/analyse/analyse_inputs.h"

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

const Analysis& analysisOf(const json& request)
{
    const std::string name = textOr(request, "analysis", "");
    const auto& all = analyses();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Analysis& one) { return one.name == name; });
    if (found != all.end()) return *found;
    std::string known;
    for (const Analysis& one : all) known += (known.empty() ? "" : ", ") + std::string(one.name);
    throw RequestFault(name.empty() ? "no analysis is named; there are: " + known
                                    : "unknown analysis \"" + name + "\"; there are: " + known);
}

}  // namespace

const std::vector<Analysis>& analyses()
{
    static const std::vector<Analysis> all = [] {
        std::vector<Analysis> together;
        for (const auto& group :
             {analysesOfMeans(), analysesOfCounts(), analysesOfTables(), analysesOfSignals(), analysesOfSamples()})
            together.insert(together.end(), group.begin(), group.end());
        return together;
    }();
    return all;
}

ordered_json answerOf(const json& request, const std::filesystem::path& folder)
{
    try {
        if (!request.is_object()) throw RequestFault("the request is not an object");
        const Analysis& analysis = analysisOf(request);
        return analysis.answer({objectOrEmpty(request, "inputs"), objectOrEmpty(request, "options"), folder});
    } catch (const RequestFault& fault) {
        return {{"error", fault.what()}};
    }
}

}  // namespace study::analyse
