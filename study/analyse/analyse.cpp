#include "study/analyse/analyse.h"

#include <algorithm>

#include "study/analyse/analyse_counts.h"
#include "study/analyse/analyse_inputs.h"
#include "study/analyse/analyse_means.h"
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
        const NamedAnalysis& analysis = analysisOf(request);
        return analysis.answer({objectOrEmpty(request, "inputs"), objectOrEmpty(request, "options"), folder});
    } catch (const RequestFault& fault) {
        return {{"error", fault.what()}};
    }
}

}  // namespace study::analyse
