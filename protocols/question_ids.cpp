#include "protocols/question_ids.h"

#include <algorithm>
#include <array>
#include <map>

namespace protocols {

namespace {

constexpr std::size_t longestQuestionId = 40;

constexpr std::array<std::string_view, 24> columnsOfAnswers{
    "participant", "trial",          "question",        "fabric",          "condition", "alternatives",
    "answer",      "correct",        "rating",          "seconds",         "ready_at",  "touched_at",
    "touched_by",  "answered_at",    "stored_at",       "corrections",     "voided",    "wall_time",
    "note",        "touch_ended_at", "answer_begun_at", "answer_begun_by", "entries",   "response_seconds"};

// Not the functions of <cctype>: those follow the user's locale.
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

std::string inLowerCase(std::string text)
{
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

/// A question and where it stands.
struct AskedAt {
    QuestionId id;
    std::string place;
};

std::vector<AskedAt> questionsIn(const Protocol& protocol)
{
    std::vector<AskedAt> questions;
    for (std::size_t i = 0; i < protocol.phases.size(); ++i)
        for (std::size_t j = 0; j < protocol.phases[i].questions.size(); ++j)
            questions.push_back(
                {protocol.phases[i].questions[j].id, "phases[" + std::to_string(i) + "].questions[" + std::to_string(j) + "]"});
    return questions;
}

/// Who took a column first: a question, or nobody (empty) for a fixed one.
using Columns = std::map<std::string, QuestionId>;

/// The fault of the first column of this question that is taken; empty where none is.
std::string faultOfColumns(const AskedAt& asked, const Columns& taken)
{
    for (const std::string& column : columnsOf(asked.id)) {
        const auto known = taken.find(inLowerCase(column));
        if (known == taken.end()) continue;
        if (known->second.empty())
            return asked.place + ": '" + asked.id.value + "' is a column of exported answers, expected another id";
        if (inLowerCase(known->second.value) == inLowerCase(asked.id.value))
            return asked.place + ": '" + asked.id.value + "' differs from '" + known->second.value +
                   "' in case only, expected different ids";
        return asked.place + ": '" + asked.id.value + "' and '" + known->second.value + "' would both have a column '" + column +
               "' in exported answers, expected another id";
    }
    return "";
}

}  // namespace

bool isQuestionId(std::string_view id)
{
    if (id.empty() || id.size() > longestQuestionId || !isLetter(id.front())) return false;
    return std::ranges::all_of(id, [](char c) { return isLetter(c) || isDigit(c) || c == '_'; });
}

std::vector<std::string> columnsOf(const QuestionId& question)
{
    const std::string& id = question.value;
    return {id, id + "_correct", id + "_answer", id + "_seconds"};
}

std::span<const std::string_view> answerColumns() { return columnsOfAnswers; }

std::vector<std::string> faultsOfQuestionIds(const Protocol& protocol)
{
    std::vector<std::string> faults;
    Columns taken;
    for (const std::string_view column : columnsOfAnswers) taken[std::string(column)];
    for (const AskedAt& asked : questionsIn(protocol)) {
        if (!isQuestionId(asked.id.value))
            faults.push_back(asked.place + ": '" + asked.id.value +
                             "', expected a letter, then letters, digits and underscores, at most 40 characters");
        const std::string fault = faultOfColumns(asked, taken);
        // The same id twice is named where every question is asked once.
        const auto first = taken.find(inLowerCase(asked.id.value));
        const bool isSame = first != taken.end() && first->second == asked.id;
        if (!fault.empty() && !isSame) faults.push_back(fault);
        for (const std::string& column : columnsOf(asked.id)) taken.emplace(inLowerCase(column), asked.id);
    }
    return faults;
}

}  // namespace protocols
