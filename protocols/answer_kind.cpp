#include "protocols/answer_kind.h"

#include <algorithm>
#include <cmath>

#include "protocols/protocol_part.h"

namespace protocols {

namespace {

using Faults = std::vector<std::string>;

constexpr int mostSlots = 26;  // A to Z

Tenths tenthsIn(const ProtocolPart& scale, const std::string& key, Tenths fallback)
{
    if (!scale.raw(key).is_number()) return fallback;
    const double tenths = scale.raw(key).get<double>() * 10;
    if (std::abs(tenths) > 1e6) return fallback;  // the schema names it
    // 0.1 * 10 need not be 1 in binary; a number further off is not a tenth.
    if (std::abs(tenths - std::round(tenths)) > 1e-6)
        scale.faults().add(scale.placeOf(key) + ": " + scale.raw(key).dump() + ", expected a whole number of tenths");
    return Tenths{static_cast<int>(std::lround(tenths))};
}

RatingScale scaleIn(const ProtocolPart& phase)
{
    const ProtocolPart part = phase.part("scale");
    RatingScale scale;
    scale.min = tenthsIn(part, "min", scale.min);
    scale.max = tenthsIn(part, "max", scale.max);
    scale.step = tenthsIn(part, "step", scale.step);
    scale.sections = part.whole("sections", scale.sections);
    scale.labels = part.texts("labels");
    // Half of a scale says nothing about the other half: the usual one breaks no rule.
    return phase.faults().isRefusedWithin(phase.placeOf("scale")) ? RatingScale{} : scale;
}

/// A key of a phase that declares the kind of its questions.
struct DeclaringKey {
    const char* name;
    AnswerKind (*read)(const ProtocolPart& phase);
};

constexpr DeclaringKey declaringKeys[] = {
    {"alternatives",
     [](const ProtocolPart& phase) -> AnswerKind {
         return ForcedChoice{phase.whole("alternatives", ForcedChoice{}.alternatives)};
     }},
    {"scale", [](const ProtocolPart& phase) -> AnswerKind { return Rating{scaleIn(phase)}; }},
    {"same_different", [](const ProtocolPart&) -> AnswerKind { return SameDifferent{}; }},
};
static_assert(std::size(declaringKeys) == std::variant_size_v<AnswerKind> - 1, "a key for each kind but free text");

Faults faultsOfChoice(const ForcedChoice& choice, int fabrics, const std::string& place)
{
    const std::string has = place + ".alternatives: " + std::to_string(choice.alternatives);
    if (choice.alternatives < 2) return {has + ", expected at least 2"};
    Faults faults;
    if (choice.alternatives > mostSlots) faults.push_back(has + ", expected at most 26, for the slots A to Z");
    if (choice.alternatives > fabrics)
        faults.push_back(has + " of " + std::to_string(fabrics) + " fabrics, expected no more alternatives than fabrics");
    return faults;
}

Faults faultsOfScale(const RatingScale& scale, const std::string& place)
{
    Faults faults;
    if (scale.max <= scale.min) faults.push_back(place + ": max is not above min, expected min < max");
    if (scale.step.value < 1)
        faults.push_back(place + ".step: is not positive, expected at least 0.1");
    else if ((scale.max.value - scale.min.value) % scale.step.value != 0)
        faults.push_back(place + ".step: does not lead from min to max, expected a whole number of steps");
    if (scale.sections < 1) faults.push_back(place + ".sections: expected at least 1");
    const int steps = scale.step.value < 1 ? 0 : (scale.max.value - scale.min.value) / scale.step.value;
    if (!scale.labels.empty() && static_cast<int>(scale.labels.size()) != steps + 1)
        faults.push_back(place + ".labels: " + std::to_string(scale.labels.size()) + " words, expected " +
                         std::to_string(steps + 1) + ", one a step");
    return faults;
}

}  // namespace

std::string nameOf(const AnswerKind& kind)
{
    return std::visit(
        Overloaded{[](const ForcedChoice&) { return "choice"; }, [](const Rating&) { return "rating"; },
                   [](const SameDifferent&) { return "same_different"; }, [](const FreeText&) { return "free_text"; }},
        kind);
}

int alternativesOf(const AnswerKind& kind)
{
    return std::visit(Overloaded{[](const ForcedChoice& choice) { return choice.alternatives; }, [](const Rating&) { return 0; },
                                 [](const SameDifferent&) { return 2; }, [](const FreeText&) { return 0; }},
                      kind);
}

TrayRule trayRuleOf(const AnswerKind& task)
{
    return std::visit(Overloaded{[](const ForcedChoice& choice) -> TrayRule { return TrueAmongFoils{choice.alternatives}; },
                                 [](const Rating&) -> TrayRule { return TrueAlone{}; },
                                 [](const SameDifferent&) -> TrayRule { return TrueOrOther{}; },
                                 [](const FreeText&) -> TrayRule { return TrueAlone{}; }},
                      task);
}

int piecesOnTray(const AnswerKind& task)
{
    return std::visit(Overloaded{[](const TrueAmongFoils& rule) { return rule.pieces; }, [](const TrueAlone&) { return 1; },
                                 [](const TrueOrOther&) { return 1; }},
                      trayRuleOf(task));
}

std::optional<bool> isRight(const AnswerKind& kind, const std::vector<FabricId>& tray, const FabricId& truth,
                            const std::string& answer)
{
    using Right = std::optional<bool>;
    return std::visit(Overloaded{[&](const ForcedChoice&) -> Right { return answer == truth.value; },
                                 [](const Rating&) -> Right { return std::nullopt; },
                                 [&](const SameDifferent&) -> Right { return (tray.front() == truth) == (answer == "same"); },
                                 [](const FreeText&) -> Right { return std::nullopt; }},
                      kind);
}

std::optional<int> placeAmongAlternatives(const AnswerKind& kind, const std::vector<FabricId>& tray, const std::string& answer)
{
    using Place = std::optional<int>;
    return std::visit(Overloaded{[&](const ForcedChoice&) -> Place {
                                     const auto slot = std::ranges::find(tray, answer, &FabricId::value);
                                     return slot == tray.end() ? Place() : static_cast<int>(slot - tray.begin());
                                 },
                                 [](const Rating&) -> Place { return std::nullopt; },
                                 [&](const SameDifferent&) -> Place { return answer == "same" ? 0 : 1; },
                                 [](const FreeText&) -> Place { return std::nullopt; }},
                      kind);
}

std::vector<AnswerKind> kindsDeclaredIn(const ProtocolPart& phase)
{
    std::vector<AnswerKind> kinds;
    for (const DeclaringKey& key : declaringKeys)
        if (phase.has(key.name) && phase.raw(key.name) != false) kinds.push_back(key.read(phase));
    return kinds;
}

std::string keysOfKinds()
{
    std::string names;
    const std::size_t count = std::size(declaringKeys);
    for (std::size_t i = 0; i < count; ++i)
        names += (i == 0 ? "" : i + 1 == count ? " and " : ", ") + std::string(declaringKeys[i].name);
    return names;
}

std::vector<std::string> faultsOf(const AnswerKind& task, int fabrics, const std::string& place)
{
    return std::visit(
        Overloaded{[&](const ForcedChoice& choice) { return faultsOfChoice(choice, fabrics, place); },
                   [&](const Rating& rating) { return faultsOfScale(rating.scale, place + ".scale"); },
                   [&](const SameDifferent&) {
                       return fabrics >= 2
                                  ? Faults()
                                  : Faults{place + ".same_different: one fabric, expected at least 2, so that some can differ"};
                   },
                   [](const FreeText&) { return Faults(); }},
        task);
}

}  // namespace protocols
