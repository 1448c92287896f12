// Criteria that a useful generator must meet, as a table. Split and pairing decide which of them apply.
#pragma once

#include <string>
#include <vector>

#include "study/evaluation/evaluation.h"

namespace study::evaluation {

struct Criterion {
    std::string what;             ///< measure, such as "friction: mean off by"
    std::string required;         ///< requirement, such as "at most 5.0 %"
    std::string found;            ///< result, such as "3.1 %", with the value of the control it is compared with
    std::optional<bool> reached;  ///< none: undecided, with the reason in `found`
};

std::vector<Criterion> criteriaOf(const Evaluation& evaluation);

}  // namespace study::evaluation
