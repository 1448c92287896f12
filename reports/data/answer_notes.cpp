#include "reports/data/answer_notes.h"

#include "reports/data/answers_csv.h"
#include "reports/text/plain_words.h"

namespace reports {

std::vector<std::string> answerNotes(const AnswerRows& rows, const AnswerColumns& columns, const StudyData& data,
                                     const FoundInCells& found, const std::string& where)
{
    std::vector<std::string> notes;
    const auto note = [&](const std::string& text) { notes.push_back(where + ": " + text); };
    if (!rows.taken.empty()) note("read with " + rows.taken);
    std::vector<std::string> unused = columns.unused;
    unused.insert(unused.end(), rows.unused.begin(), rows.unused.end());
    if (!unused.empty()) note("not analysed: " + listed(unused));
    std::vector<std::string> assumed;
    for (const QuestionInfo& question : data.questions)
        if (question.alternativesAssumed) assumed.push_back(question.id);
    if (!assumed.empty())
        note("the choices of " + listed(assumed) + " are tested against 1/" + std::to_string(usualAlternatives) +
             ", the default of this program; name the number of alternatives by --alternatives or --protocol");
    std::vector<std::string> onUsualScale;
    for (const QuestionInfo& question : data.questions)
        if (question.scaleAssumed) onUsualScale.push_back(question.id);
    if (!onUsualScale.empty() && !found.hasOtherScale)
        note("the ratings of " + listed(onUsualScale) +
             " are read on a scale of 0 to 10, the default of this program; name another by --scale LOW,HIGH or --protocol");
    if (found.hasOtherScale) note("some ratings are outside 0 to 10; name their scale by --scale LOW,HIGH or by --protocol");
    for (const auto& [question, scores] : found.scores)
        if (const std::string contradictions = scores.note(); !contradictions.empty()) note(contradictions);
    if (rows.wordsAlone > 0)
        note(counted(rows.wordsAlone, "answer") + " without correct or rating left out, beside others of the same question");
    if (rows.voided > 0)
        note(rows.namesPresentations ? counted(rows.voided, "voided presentation") +
                                           " left out; a table of answers has no row of those that were voided without an answer"
                                     : counted(rows.voided, "voided answer") + " left out");
    if (rows.ofWithdrawn > 0)
        note(counted(rows.ofWithdrawn, rows.kinds.empty() ? "row" : "answer") + " of participants who withdrew left out");
    return notes;
}

}  // namespace reports
