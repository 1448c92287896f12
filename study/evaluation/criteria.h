// What a generator must reach to be of use, as a table; which of it applies follows from split and pairing.
#pragma once

#include <string>
#include <vector>

#include "study/evaluation/evaluation.h"

namespace study::evaluation {

struct Criterion {
    std::string what;             ///< "mean friction off by"
    std::string asked;            ///< "at most 5.0 %"
    std::string found;            ///< "3.1 %"; with the value it was held against where that is a control
    std::optional<bool> reached;  ///< none: cannot be told, `found` says why
};

std::vector<Criterion> criteriaOf(const Evaluation& evaluation);

}  // namespace study::evaluation
