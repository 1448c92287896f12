// Small protocol with everything that a session can have: every stage, every kind of answer, readings, facts and a
// checklist. For tests that visit all pages.
#pragma once

#include <string>
#include <vector>

#include "tests/support/study_builder.h"

namespace tests::support {

/// Options of the protocol.
struct WholeProtocol {
    std::vector<std::string> conditions{"v_grey", "h&f"};
    bool secondEntry = false;
    int breakAfter = 4;
    int sittingMinutes = 60;
    std::string language = "en";  ///< in another one, questions without usual texts and words of scales are "§1", "§2", …
};

/// Protocol with 3 fabrics and five phases: a choice with a question in words; same or different; two questions on the scale
/// with nine sections; a Likert scale of five steps; a continuous line.
std::string wholeProtocolText(const WholeProtocol& wanted = {});

/// A study with this protocol, with swatch codes and two fabrics for familiarisation.
StudyRecipe wholeStudy(const WholeProtocol& wanted = {});

/// Number of answers of one participant: 3 fabrics × conditions × seven questions.
int answersOf(const WholeProtocol& wanted);

}  // namespace tests::support
