#include "study/session/given_answer.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "database/study_store.h"
#include "protocols/json_count.h"

namespace study::session {

namespace {

using Json = nlohmann::ordered_json;
using protocols::FabricId;
using protocols::Overloaded;
using protocols::RatingScale;
using protocols::Tenths;

/// "5.4", or "5" for a whole number.
std::string inTenths(int tenths)
{
    const std::string sign = tenths < 0 ? "-" : "";
    const int size = std::abs(tenths);
    return sign + std::to_string(size / 10) + (size % 10 == 0 ? std::string() : "." + std::to_string(size % 10));
}

const char* whatIsGiven(const GivenAnswer& answer)
{
    return std::visit(Overloaded{[](const FabricId&) { return "one of the fabrics on the tray"; },
                                 [](const Tenths&) { return "a number on the scale"; },
                                 [](const Sameness&) { return "same or different"; }, [](const Words&) { return "words"; }},
                      answer);
}

/// Checks one answer against questions of each kind.
struct Check {
    const GivenAnswer& answer;
    const protocols::Question& question;
    const std::vector<FabricId>& tray;
    const PieceNames& names;

    using Fault = std::optional<std::string>;

    Fault operator()(const protocols::ForcedChoice&) const
    {
        const auto* fabric = std::get_if<FabricId>(&answer);
        if (!fabric) return asksFor(whatIsGiven(FabricId()));
        if (std::ranges::find(tray, *fabric) != tray.end()) return std::nullopt;
        std::string there;
        for (const FabricId& one : tray) there += (there.empty() ? "" : ", ") + nameIn(names, one);
        return nameIn(names, *fabric) + " is not on the tray (" + there + ").";
    }
    Fault operator()(const protocols::Rating& rating) const
    {
        const auto* tenths = std::get_if<Tenths>(&answer);
        if (!tenths) return asksFor(whatIsGiven(Tenths()));
        const RatingScale& scale = rating.scale;
        if (scale.holds(*tenths)) return std::nullopt;
        return inTenths(tenths->value) + " is not on the scale: from " + inTenths(scale.min.value) + " to " +
               inTenths(scale.max.value) + " in steps of " + inTenths(scale.step.value) + ".";
    }
    Fault operator()(const protocols::SameDifferent&) const { return require<Sameness>(); }
    Fault operator()(const protocols::FreeText&) const { return require<Words>(); }

    template <class Wanted>
    Fault require() const
    {
        return std::holds_alternative<Wanted>(answer) ? Fault() : asksFor(whatIsGiven(Wanted{}));
    }
    Fault asksFor(const std::string& wanted) const
    {
        return question.id.value + " asks for " + wanted + ", not for " + whatIsGiven(answer) + ".";
    }
};

}  // namespace

std::string nameIn(const PieceNames& names, const FabricId& fabric)
{
    const auto name = names.find(fabric);
    return name == names.end() ? fabric.value : name->second;
}

std::string textOf(const GivenAnswer& answer)
{
    return std::visit(Overloaded{[](const FabricId& fabric) { return fabric.value; },
                                 [](const Tenths& rating) {
                                     const int size = std::abs(rating.value);
                                     return (rating.value < 0 ? "-" : "") + std::to_string(size / 10) + "." +
                                            std::to_string(size % 10);
                                 },
                                 [](const Sameness& given) { return std::string(given.same ? "same" : "different"); },
                                 [](const Words& given) { return given.text; }},
                      answer);
}

std::optional<std::string> faultOf(const GivenAnswer& answer, const protocols::Question& question,
                                   const std::vector<FabricId>& tray, const PieceNames& names)
{
    return std::visit(Check{answer, question, tray, names}, question.kind);
}

Json payloadOf(const GivenAnswer& answer)
{
    return std::visit(Overloaded{[](const FabricId& fabric) {
                                     return Json{{"fabric", fabric.value}};
                                 },
                                 [](const Tenths& rating) {
                                     return Json{{"tenths", rating.value}};
                                 },
                                 [](const Sameness& given) {
                                     return Json{{"same", given.same}};
                                 },
                                 [](const Words& given) {
                                     return Json{{"words", given.text}};
                                 }},
                      answer);
}

GivenAnswer givenAnswerIn(const Json& payload)
{
    if (payload.contains("fabric")) return FabricId(payload.at("fabric").get<std::string>());
    if (payload.contains("same")) return Sameness{payload.at("same").get<bool>()};
    if (payload.contains("words")) return Words{payload.at("words").get<std::string>()};
    return Tenths{protocols::wholeOf<int>(payload.at("tenths"))};
}

void putInto(database::AnswerRecord& record, const GivenAnswer& answer)
{
    std::visit(Overloaded{[&](const FabricId&) { record.answer = textOf(answer); },
                          [&](const Tenths& rating) { record.rating = rating; },
                          [&](const Sameness&) { record.answer = textOf(answer); },
                          [&](const Words&) { record.answer = textOf(answer); }},
               answer);
}

}  // namespace study::session
