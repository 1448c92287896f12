// A small protocol that asks for everything a session can have: every stage, every kind of answer, readings, facts and
// a checklist; for tests that walk through all pages.
#pragma once

#include <string>
#include <vector>

#include "tests/support/study_builder.h"

namespace tests::support {

struct WholeProtocol {
    std::vector<std::string> conditions{"v_grey", "h&f"};
    bool secondEntry = false;
    int breakAfter = 4;
    int sittingMinutes = 60;
};

/// 3 fabrics; in this order: a choice with a question in words, same or different, the nine-sectioned scale with two
/// questions, a Likert scale of five steps, a continuous line.
std::string wholeProtocolText(const WholeProtocol& wanted = {});

/// A study by it with swatch codes and two fabrics to get to know the display by.
StudyRecipe wholeStudy(const WholeProtocol& wanted = {});

/// Of one participant: 3 fabrics x the conditions in each of the phases' seven questions.
int answersOf(const WholeProtocol& wanted);

}  // namespace tests::support
