#include "reports/data/study_data.h"

namespace reports {

Scoring scoringOf(const protocols::AnswerKind& kind)
{
    return std::visit(protocols::Overloaded{
                          [](const protocols::ForcedChoice& choice) -> Scoring {
                              return RightOrWrong{choice.alternatives, false};
                          },
                          [](const protocols::SameDifferent&) -> Scoring {
                              return RightOrWrong{2, true};
                          },
                          [](const protocols::Rating& rating) -> Scoring {
                              return NumberOnScale{rating.scale.min.inScaleUnits(), rating.scale.max.inScaleUnits()};
                          },
                          [](const protocols::FreeText&) -> Scoring { return OpenWords{}; },
                      },
                      kind);
}

std::size_t answeringParticipants(const StudyData& data)
{
    std::set<std::string> answering;
    for (const StudyResponse& response : data.responses) answering.insert(response.participant);
    return answering.empty() ? data.participants.size() : answering.size();
}

bool hasNumbers(const QuestionInfo& question) { return !std::holds_alternative<OpenWords>(scoringOf(question.kind)); }

std::size_t answersPerCellOf(const StudyData& data, const QuestionInfo& question)
{
    return question.answersPerCell != 0 ? question.answersPerCell : data.answersPerCell;
}

int firstAlternatives(const StudyData& data)
{
    for (const QuestionInfo& question : data.questions)
        if (const Scoring scoring = scoringOf(question.kind); const auto* choice = std::get_if<RightOrWrong>(&scoring))
            return choice->alternatives;
    return RightOrWrong().alternatives;
}

}  // namespace reports
