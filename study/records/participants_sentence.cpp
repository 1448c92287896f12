#include "study/records/participants_sentence.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "protocols/files/number_text.h"
#include "stats/kernels/descriptive.h"
#include "study/session/driver.h"

namespace study::records {

namespace {

constexpr std::size_t fewPeople = 5;
constexpr double largestFact = 1e15;  // a larger one is no measure of a person, and its decimals are lost: it counts as a word

std::optional<double> numberOf(const std::string& text)
{
    double number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool isWhole = fault == std::errc() && end == text.data() + text.size() && std::abs(number) <= largestFact;
    return isWhole ? std::optional(number) : std::nullopt;
}

std::string oneDecimal(double number) { return protocols::fixed(number, 1); }

std::string inLowerCase(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return c < 128 ? std::tolower(c) : c; });
    return text;
}

std::string described(const std::string& fact, const std::vector<double>& numbers, std::size_t people)
{
    const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
    const stats::Description all = stats::describe(numbers);
    std::string text = fact + " mean " + oneDecimal(*all.mean);
    if (all.sd.exists()) text += ", SD " + oneDecimal(*all.sd) + ", " + oneDecimal(*low) + " to " + oneDecimal(*high);
    return numbers.size() < people ? text + " (" + std::to_string(people - numbers.size()) + " not stated)" : text;
}

std::string counted(const std::string& fact, const std::vector<std::string>& values, std::size_t people)
{
    std::map<std::string, std::size_t> counts;
    for (const auto& value : values) ++counts[inLowerCase(value)];
    std::size_t others = 0;
    std::string text;
    for (const auto& [value, count] : counts) {
        if (people >= fewPeople && count < 2)
            others += count;
        else
            text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + value;
    }
    if (others > 0) text += (text.empty() ? "" : ", ") + std::to_string(others) + " other";
    if (values.size() < people) text += (text.empty() ? "" : ", ") + std::to_string(people - values.size()) + " not stated";
    return fact + ": " + text;
}

std::string clauseOf(const std::string& fact, const std::vector<std::string>& values, std::size_t people)
{
    std::vector<double> numbers;
    for (const auto& value : values)
        if (const auto number = numberOf(value)) numbers.push_back(*number);
    return numbers.size() == values.size() ? described(fact, numbers, people) : counted(fact, values, people);
}

}  // namespace

std::string participantsSentence(const database::StudyStore& store)
{
    const auto facts = store.personalFacts();
    std::size_t people = 0;
    std::map<std::string, std::vector<std::string>> valuesOf;  // by fact, of participants whose answers are analysed
    for (const auto& enrolment : store.enrolments()) {
        if (enrolment.state == database::SlotState::Withdrawn) continue;
        ++people;
        const auto known = facts.find(enrolment.participant);
        if (known == facts.end()) continue;
        for (const auto& [fact, value] : known->second)
            if (fact != session::debriefingFact) valuesOf[fact].push_back(value);
    }
    std::string clauses;
    for (const auto& [fact, values] : valuesOf) clauses += (clauses.empty() ? "" : "; ") + clauseOf(fact, values, people);
    if (clauses.empty()) return {};
    return std::to_string(people) + (people == 1 ? " participant (" : " participants (") + clauses + ").";
}

}  // namespace study::records
