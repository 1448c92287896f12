#include "study/participant/participant_act.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocols/files/safe_text.h"
#include "protocols/files/strict_json.h"

namespace study::participant {

namespace {

using nlohmann::json;

protocols::Error refusedAct(const std::string& what, const std::string& where)
{
    return protocols::badInput({what, where, R"({"number": N} with "agrees", "facts" or "tapped")", ""});
}

int numberOf(const json& value, const std::string& name, const std::string& where)
{
    constexpr std::int64_t largest = 1'000'000'000;
    // An unsigned number beyond 64 bits with sign would wrap around.
    const bool isWhole = value.is_number_integer() && !(value.is_number_unsigned() && value.get<std::uint64_t>() > largest);
    if (!isWhole || value.get<std::int64_t>() > largest || value.get<std::int64_t>() < -largest)
        throw refusedAct("'" + name + "' is no whole number", where);
    return static_cast<int>(value.get<std::int64_t>());
}

FactsTold factsOf(const json& list, const std::string& where)
{
    if (!list.is_array() || list.size() > mostFacts) throw refusedAct("'facts' is no list of at most 200 texts", where);
    FactsTold told;
    for (const json& fact : list) {
        if (!fact.is_string() || fact.get_ref<const std::string&>().size() > longestFact)
            throw refusedAct("a fact is no text of at most 1000 bytes", where);
        std::string text = protocols::withoutTurns(fact.get_ref<const std::string&>());
        if (protocols::printable(text) != text) throw refusedAct("a fact has control characters", where);
        told.answers.push_back(std::move(text));
    }
    return told;
}

}  // namespace

std::string jsonOf(const ParticipantAct& act)
{
    nlohmann::ordered_json text{{"number", act.number}};
    std::visit(protocols::Overloaded{[&](const Agreement& agreement) { text["agrees"] = agreement.agrees; },
                                     [&](const FactsTold& facts) { text["facts"] = facts.answers; },
                                     [&](const PlaceTapped& tapped) { text["tapped"] = tapped.place.value; }},
               act.what);
    return text.dump(-1, ' ', false, json::error_handler_t::replace);
}

ParticipantAct actFromJson(std::string_view text, const std::string& where)
{
    const json act = protocols::parseStrictJson(text, where);
    if (!act.is_object() || act.size() != 2 || !act.contains("number")) throw refusedAct("this is no act", where);
    const int number = numberOf(act.at("number"), "number", where);
    if (act.contains("agrees") && act.at("agrees").is_boolean()) return {number, Agreement{act.at("agrees").get<bool>()}};
    if (act.contains("facts")) return {number, factsOf(act.at("facts"), where)};
    if (act.contains("tapped")) return {number, PlaceTapped{{numberOf(act.at("tapped"), "tapped", where)}}};
    throw refusedAct("this is no act", where);
}

bool isAskedFor(const ParticipantAct& act, const Instruction& instruction)
{
    if (std::holds_alternative<Agreement>(act.what)) return instruction.task == Task::Consent;
    if (const auto* facts = std::get_if<FactsTold>(&act.what))
        return instruction.task == Task::Facts && facts->answers.size() == instruction.questions.size();
    const auto& scale = instruction.scale;
    return scale && scale->asked && scale->scale.holds(std::get<PlaceTapped>(act.what).place);
}

}  // namespace study::participant
