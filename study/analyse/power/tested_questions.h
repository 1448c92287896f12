// The questions of a planned study whose answers `vis2hap power` simulates: ratings on one scale, and choices among one number of
// alternatives. Questions of another kind are named as left out.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "protocols/protocol.h"

namespace study::analyse {

/// The simulated ratings have the scale of this question.
struct TestedRatings {
    std::string question;
    protocols::RatingScale scale;
    int runs = 1;                          ///< answers to a cell, one under each instruction; the tests take their mean
    std::vector<std::string> others = {};  ///< questions with another scale
};

/// The simulated choices have the alternatives of this question. Same or different is a choice between two.
struct TestedChoices {
    std::string question;
    protocols::AnswerKind kind;
    int alternatives = 2;
    int runs = 1;                          ///< answers to a cell, one under each instruction; the simulated choices have one
    std::vector<std::string> others = {};  ///< questions with another number of alternatives
};

struct TestedQuestions {
    std::optional<TestedRatings> ratings;  ///< none where no question is rated
    std::optional<TestedChoices> choices;  ///< none where no answer is right or wrong
    std::vector<std::string> inWords;      ///< questions without a test
};

/// The first rated question and the first choice; `question`, if it is not empty, takes the place of the one of its kind. Throws
/// badInput for a name that no question with a test has.
TestedQuestions testedQuestions(const protocols::Protocol& protocol, const std::string& question = {});

/// Adds "rated", "chosen" and "left_out".
void putTested(nlohmann::ordered_json& json, const TestedQuestions& tested);

/// The same as lines for people; a question that is left out stands beside the option that shows it.
std::string textOf(const TestedQuestions& tested);

}  // namespace study::analyse
