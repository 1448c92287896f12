#include "rendering/models/lab/lab_table.h"

#include <cmath>

#include "protocols/files/number_text.h"

namespace rendering::models {

namespace {

using protocols::fixed;

constexpr std::size_t measureWidth = 46, valueWidth = 11;

/// Width in characters, of which UTF-8 takes several bytes each.
std::string paddedTo(std::string text, std::size_t width)
{
    std::size_t length = 0;
    for (const char byte : text) length += (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U ? 1 : 0;
    text.append(length < width ? width - length : 1, ' ');
    return text;
}

std::string row(const std::string& measure, const std::string& before, const std::string& after, const std::string& remark = {})
{
    std::string line = paddedTo("  " + measure, measureWidth) + paddedTo(before, valueWidth);
    line += remark.empty() ? after : paddedTo(after, valueWidth) + remark;
    return line + "\n";
}

std::string percent(double share) { return fixed(100 * share, 1) + " %"; }

std::string ofAll(int some, int all) { return std::to_string(some) + " of " + std::to_string(all); }

std::string counted(int number, const std::string& noun)
{
    return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

std::string labRows(const LabFigures& before, const LabFigures& after)
{
    std::string text;
    if (before.frictionError && after.frictionError) {
        text += row("mean friction, error", percent(*before.frictionError), percent(*after.frictionError));
        text += row("mean friction inside the 90 % interval", ofAll(before.insideInterval, before.frictionPhotographs),
                    ofAll(after.insideInterval, after.frictionPhotographs));
    }
    if (before.sqRatio && after.sqRatio) {
        text += row("Sq, generated over measured", fixed(*before.sqRatio, 2), fixed(*after.sqRatio, 2));
        text += row("Sq, distance of the two", percent(std::expm1(*before.sqError)), percent(std::expm1(*after.sqError)));
    }
    if (before.correlation && after.correlation)
        text += row("correlation with the measured relief", fixed(*before.correlation, 3), fixed(*after.correlation, 3));
    return text;
}

std::string change(const ShippedAbility& ability)
{
    return (ability.worsePercent > 0 ? "worse by " : "better by ") + fixed(std::abs(ability.worsePercent), 1) +
           " % (95 %: worse by at most " + fixed(std::max(0.0, ability.atMostPercent), 1) + " %)";
}

std::string factorLines(const LabOutcome& outcome, const std::string& given, const std::string& adapted)
{
    std::string factors;
    if (outcome.factors.friction != 1) factors += fixed(outcome.factors.friction, 2) + " times the friction";
    if (outcome.factors.relief != 1)
        factors += (factors.empty() ? "" : " and ") + fixed(outcome.factors.relief, 2) + " times the relief";
    if (factors.empty()) return {};
    std::string text = "This lab measures " + factors + " that " + given + " generates; " + adapted + " multiplies by it.\n";
    if (outcome.factors.friction != 1)
        text += "So " + adapted + " is for this lab: its friction is " + percent(outcome.statedFrictionError) +
                " off the law of drawn fabrics (" + given + ": " + percent(outcome.shipped.friction.before) + ").\n";
    return text;
}

std::string choiceLine(const LabOutcome& outcome)
{
    std::string kept = "the given weights with the lab's factors";
    if (outcome.step > 0) {
        kept = "the weights of step " + std::to_string(outcome.step);
        if (outcome.share < 1)
            kept = percent(outcome.share) + " of the way from the given weights to those of step " + std::to_string(outcome.step);
    }
    return "Kept: " + kept + ", the best of " + std::to_string(outcome.candidates) +
           " on the held-out photographs. Expect a little less on others.\n";
}

}  // namespace

std::string memoryOf(std::size_t heldOutSeen, const std::string& given)
{
    if (heldOutSeen == 0) return {};
    return "MEMORY: " + given + " was trained on " + counted(static_cast<int>(heldOutSeen), "photograph") +
           " that this call holds out, so the figures of held-out places and fabrics also measure memory. Take its --split-seed "
           "and --hold-out, or start from the model before it.\n";
}

std::string labTable(const LabOutcome& outcome, const std::string& given, const std::string& adapted)
{
    std::string text = paddedTo("", measureWidth) + paddedTo("before", valueWidth) + "after\n";
    if (outcome.placesBefore.photographs > 0)
        text += "held-out places: " + counted(outcome.placesBefore.photographs, "photograph") + " of " +
                counted(outcome.placesBefore.fabrics, "fabric") + "\n" + labRows(outcome.placesBefore, outcome.placesAfter);
    if (outcome.fabricsBefore.photographs > 0)
        text += "held-out fabrics " + outcome.heldOutFabrics + ": " + counted(outcome.fabricsBefore.photographs, "photograph") +
                "\n" + labRows(outcome.fabricsBefore, outcome.fabricsAfter);
    text += "shipped abilities, on " + counted(outcome.shipped.fabrics, "drawn fabric") + " without the lab's factors\n" +
            row("relief, correlation", fixed(outcome.shipped.relief.before, 3), fixed(outcome.shipped.relief.after, 3),
                change(outcome.shipped.relief)) +
            row("mean friction, error", percent(outcome.shipped.friction.before), percent(outcome.shipped.friction.after),
                change(outcome.shipped.friction));
    text += memoryOf(outcome.heldOutSeen, given);
    return text + factorLines(outcome, given, adapted) + choiceLine(outcome);
}

nlohmann::ordered_json asJson(const LabOutcome& outcome)
{
    return {{"held_out_places", {{"before", asJson(outcome.placesBefore)}, {"after", asJson(outcome.placesAfter)}}},
            {"held_out_fabrics", {{"before", asJson(outcome.fabricsBefore)}, {"after", asJson(outcome.fabricsAfter)}}},
            {"shipped_abilities", asJson(outcome.shipped)},
            {"stated_friction_error", outcome.statedFrictionError},
            {"factors", {{"friction", outcome.factors.friction}, {"relief", outcome.factors.relief}}},
            {"share_of_the_step", outcome.share},
            {"candidates", outcome.candidates},
            {"held_out_trained_on", outcome.heldOutSeen}};
}

}  // namespace rendering::models
