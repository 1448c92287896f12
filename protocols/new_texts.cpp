#include "protocols/new_texts.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/id_rule.h"

namespace protocols {

namespace {

using nlohmann::json;

/// Calls found(place, text) for each text.
template <class Found>
void eachText(const json& value, const std::string& place, const Found& found)
{
    if (value.is_string()) return found(place, value.get_ref<const std::string&>());
    std::size_t number = 0;
    for (const auto& [key, part] : value.items()) {
        if (place.empty() && (key == "name" || key == "fabrics" || key == "comment" || key == "$schema")) continue;
        if (value.is_object())
            eachText(part, place.empty() ? key : place + "." + key, found);
        else if (value.is_array())
            eachText(part, place + "[" + std::to_string(number++) + "]", found);
    }
}

/// Empty for a good text.
std::string faultOfText(const std::string& place, const std::string& text)
{
    const std::string why = faultOfWords(text);
    if (why.empty()) return {};
    return place + ": the text " + why + ", expected characters that a reader sees, line ends and tabs";
}

/// Empty where no fact has the name of the comment at the end, or a name that no server takes.
std::string faultOfFacts(const json& protocol)
{
    constexpr std::size_t longestName = 2000;  // bytes; in database/server/sql/functions.sql, too
    const auto facts = protocol.find("facts");
    if (facts == protocol.end() || !facts->is_array()) return {};
    if (std::ranges::find(*facts, json(debriefingFact)) != facts->end())
        return std::string("facts: the comment at the end is stored under the name \"") + debriefingFact +
               "\", expected another name";
    for (const json& fact : *facts)
        if (fact.is_string() && fact.get_ref<const std::string&>().size() > longestName)
            return "facts: a name has " + std::to_string(fact.get_ref<const std::string&>().size()) +
                   " bytes, expected at most " + std::to_string(longestName);
    return {};
}

}  // namespace

std::vector<std::string> faultsOfTexts(const json& protocol)
{
    std::vector<std::string> faults;
    eachText(protocol, "", [&](const std::string& place, const std::string& text) {
        if (std::string fault = faultOfText(place, text); !fault.empty()) faults.push_back(std::move(fault));
    });
    if (std::string fault = faultOfFacts(protocol); !fault.empty()) faults.push_back(std::move(fault));
    return faults;
}

void requireGoodNewTexts(std::string_view amended, std::string_view before, const std::string& where)
{
    std::set<std::string> known;
    const json earlier = json::parse(before);
    if (const std::string fault = faultOfFacts(json::parse(amended)); !fault.empty() && faultOfFacts(earlier).empty())
        throw badInput({fault, where, "", "choose another name"});
    eachText(earlier, "", [&](const std::string&, const std::string& text) { known.insert(text); });
    eachText(json::parse(amended), "", [&](const std::string& place, const std::string& text) {
        const std::string fault = known.contains(text) ? "" : faultOfText(place, text);
        if (!fault.empty()) throw badInput({fault, where, "", "correct the text"});
    });
}

}  // namespace protocols
