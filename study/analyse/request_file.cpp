#include "study/analyse/request_file.h"

#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "study/analyse/analyse.h"

namespace study::analyse {

namespace {

using nlohmann::json;

protocols::Error malformedRequests(const std::string& what, const std::string& where)
{
    return protocols::badInput({what, where, "{\"cases\":[{\"id\":...,\"analysis\":...,\"inputs\":{...},\"options\":{...}}]}",
                                "correct the request file"});
}

/// The ids of all cases. Each id must be unique, because the answers are stored by id.
std::vector<std::string> idsOf(const json& cases, const std::string& file)
{
    std::vector<std::string> ids;
    std::set<std::string> seen;
    for (const json& one : cases) {
        const std::string where = file + ", case " + std::to_string(ids.size() + 1);
        if (!one.is_object() || !one.contains("id") || !one["id"].is_string())
            throw malformedRequests("the case has no id", where);
        ids.push_back(one["id"].get<std::string>());
        if (!seen.insert(ids.back()).second) throw malformedRequests("the id " + ids.back() + " is used twice", where);
    }
    return ids;
}

}  // namespace

nlohmann::ordered_json answersTo(std::string_view text, const std::string& where, const std::filesystem::path& folder)
{
    const json document = protocols::parseStrictJson(text, where);
    if (!document.is_object() || !document.contains("cases") || !document["cases"].is_array())
        throw malformedRequests("the file has no array of cases", where);
    const json& cases = document["cases"];
    const auto ids = idsOf(cases, where);
    auto all = nlohmann::ordered_json::object();
    // The ids are unique, so no key is looked for: a look through all before it would take the square of their number.
    auto& answers = all.get_ref<nlohmann::ordered_json::object_t&>();
    answers.reserve(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) answers.emplace_back(ids[i], answerOf(cases[i], folder));
    return all;
}

}  // namespace study::analyse
