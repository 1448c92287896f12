#include "rendering/models/fair_control.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>

#include "protocols/files/number_text.h"

namespace rendering::models {

namespace {

/// An option of `train` that only the training command of a card records.
struct CommandOption {
    const char* name;
    const char *usual, *usualDrawn;  ///< values where the command does not name the option: of `train DATASET`, of `--drawn`
    const char* difference;
    bool countsForSeeing = true;  ///< validations of networks that see choose no weights
};
constexpr CommandOption commandOptions[] = {{"--batch", "8", "8", "another batch"},
                                            {"--learning-rate", "0.001", "0.002", "another learning rate"},
                                            {"--validate-every", "250", "1000", "another interval between validations", false}};
constexpr int usualSteps = 5000;

const char* usualOf(const CommandOption& option, const ModelCardFields& card)
{
    return card.architecture.sees ? option.usualDrawn : option.usual;
}

/// The value behind the option in the training command; nullopt where it does not name the option.
std::optional<std::string> namedIn(const ModelCardFields& card, std::string_view option)
{
    std::istringstream words(card.summary.trainingCommand);
    for (std::string word; words >> word;)
        if (word == option && words >> word) return word;
    return std::nullopt;
}

std::string valueOf(const CommandOption& option, const ModelCardFields& card)
{
    return namedIn(card, option.name).value_or(usualOf(option, card));
}

/// Steps over which the learning rate falls. A training may stop before them.
int plannedSteps(const ModelCardFields& card)
{
    if (card.architecture.sees) return card.steps;
    const auto minutes = protocols::numberIn(namedIn(card, "--minutes").value_or(""));
    const auto steps = protocols::numberIn(namedIn(card, "--steps").value_or(""));
    double planned = usualSteps;
    if (steps) planned = *steps;
    if (minutes) planned = card.trainingMinutes > 0 ? card.steps * *minutes / card.trainingMinutes : card.steps;
    return std::max(card.steps, static_cast<int>(std::clamp(planned, 0.0, 1e9)));  // a card may state any number
}

/// 6000 becomes "6,000".
std::string grouped(int number)
{
    std::string text = std::to_string(number);
    for (auto place = static_cast<std::ptrdiff_t>(text.size()) - 3; place > 0; place -= 3)
        text.insert(static_cast<std::size_t>(place), ",");
    return text;
}

std::string countedSteps(int steps) { return grouped(steps) + (steps == 1 ? " step" : " steps"); }

std::string joined(std::vector<std::string> fabrics)
{
    std::sort(fabrics.begin(), fabrics.end());
    std::string text;
    for (const std::string& fabric : fabrics) text += (text.empty() ? "" : ",") + fabric;
    return text;
}

}  // namespace

std::vector<std::string> trainingDifferences(const ModelCardFields& model, const ModelCardFields& control)
{
    std::vector<std::string> differences;
    if (model.steps != control.steps)
        differences.push_back(countedSteps(control.steps) + " (the model: " + grouped(model.steps) + ")");
    const auto unlike = [&](bool different, const std::string& what) {
        if (different) differences.push_back(what);
    };
    unlike(model.architecture.sees != control.architecture.sees, "other networks");
    unlike(model.fromHash != control.fromHash, "another model to start from");
    unlike(model.datasetHash != control.datasetHash, "another data set");
    unlike(model.split != control.split || model.splitSeed != control.splitSeed, "another split");
    unlike(joined(model.heldOut) != joined(control.heldOut), "other fabrics held out");
    unlike(model.architecture.baseChannels != control.architecture.baseChannels, "another width of the networks");
    unlike(model.architecture.crop != control.architecture.crop, "another crop");
    const bool sees = model.architecture.sees || control.architecture.sees;
    for (const CommandOption& option : commandOptions)
        unlike((!sees || option.countsForSeeing) && valueOf(option, model) != valueOf(option, control), option.difference);
    unlike(model.steps == control.steps && plannedSteps(model) != plannedSteps(control),
           "a learning rate that falls over " + countedSteps(plannedSteps(control)) +
               " (the model: " + grouped(plannedSteps(model)) + ")");
    return differences;
}

std::vector<std::pair<std::string, std::string>> controlOptions(const ModelCardFields& model)
{
    std::vector<std::pair<std::string, std::string>> options{{"--l1-only", ""},
                                                             {"--steps", std::to_string(plannedSteps(model))},
                                                             {"--seed", std::to_string(model.seed)},
                                                             {"--channels", std::to_string(model.architecture.baseChannels)},
                                                             {"--crop", std::to_string(model.architecture.crop)}};
    if (!model.architecture.sees) {  // Drawn fabrics are not split, and their training does not stop early.
        options.emplace_back("--patience", std::to_string(std::max(1, model.steps)));
        if (plannedSteps(model) > model.steps) options.emplace_back("--stop-at", std::to_string(model.steps));
        options.emplace_back("--split", model.split);
        options.emplace_back("--split-seed", std::to_string(model.splitSeed));
    }
    if (!model.heldOut.empty()) options.emplace_back("--hold-out", joined(model.heldOut));
    for (const CommandOption& option : commandOptions)
        if (const std::string value = valueOf(option, model); value != usualOf(option, model))
            options.emplace_back(option.name, value);
    return options;
}

}  // namespace rendering::models
