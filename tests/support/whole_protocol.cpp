#include "tests/support/whole_protocol.h"

#include <nlohmann/json.hpp>

#include "protocols/usual_texts.h"

namespace tests::support {

using Json = nlohmann::ordered_json;

std::string wholeProtocolText(const WholeProtocol& wanted)
{
    const Json phases = {{{"questions", {"Q1", "W1"}}, {"alternatives", 3}, {"free_text", {"W1"}}},
                         {{"questions", {"S1"}}, {"same_different", true}},
                         {{"questions", {"Q2", "Q3"}}, {"scale", {{"min", 0}, {"max", 10}, {"step", 0.1}, {"sections", 9}}}},
                         {{"questions", {"L1"}},
                          {"scale",
                           {{"min", 1},
                            {"max", 5},
                            {"step", 1},
                            {"sections", 4},
                            {"labels", {"not at all", "hardly", "partly", "mostly", "fully"}}}}},
                         {{"questions", {"C1"}}, {"scale", {{"min", 0}, {"max", 10}, {"step", 0.1}, {"sections", 1}}}}};
    const Json texts = {{"Q1", "Which of the three pieces does the rendering match?"},
                        {"W1", "How does the rendering feel, in your own words?"},
                        {"S1", "Are the rendering and the piece the same fabric?"},
                        {"L1", "The rendering feels like cloth: how far do you agree?"},
                        {"C1", "How pleasant is the rendering?"},
                        {"Q2", "Does the rendering have the same slipperiness as the piece?"},
                        {"Q3", "Does the rendering have the same texture as the piece?"}};
    const Json paper = Json::parse(protocols::paperProtocolIn(wanted.language));
    Json protocol = {{"schema", "vis2hap.protocol/1"},
                     {"name", "Whole study"},
                     {"participants", 3},
                     {"fabrics", {"F01", "F02", "F03"}},
                     {"conditions", wanted.conditions},
                     {"phases", phases},
                     {"question_texts", texts},
                     {"seconds_per_presentation", 30},
                     {"break_after", wanted.breakAfter},
                     {"sitting_minutes", wanted.sittingMinutes},
                     {"familiarisation_fabrics", 2},
                     {"second_entry", wanted.secondEntry},
                     {"dead_time_seconds", 0},
                     {"checklist", paper.at("checklist")},
                     {"readings", paper.at("readings")},
                     {"facts", paper.at("facts")}};
    if (wanted.language != "en") {
        protocol["name"] = "§";
        protocol["language"] = wanted.language;
        protocol["question_texts"] = {{"W1", "§1"}, {"S1", "§2"}, {"L1", "§3"}, {"C1", "§4"}};
        protocol["phases"][3]["scale"]["labels"] = {"§5", "§6", "§7", "§8", "§9"};
    }
    return protocol.dump(2);
}

StudyRecipe wholeStudy(const WholeProtocol& wanted)
{
    StudyRecipe recipe;
    recipe.conditions = wanted.conditions;
    recipe.protocol = wholeProtocolText(wanted);
    recipe.hasSwatchCodes = true;
    recipe.familiarisationImages = 2;
    return recipe;
}

int answersOf(const WholeProtocol& wanted)
{
    constexpr int fabrics = 3, questions = 7;
    return fabrics * static_cast<int>(wanted.conditions.size()) * questions;
}

}  // namespace tests::support
