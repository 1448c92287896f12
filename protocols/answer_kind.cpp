#include "protocols/answer_kind.h"

namespace protocols {

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

}  // namespace protocols
