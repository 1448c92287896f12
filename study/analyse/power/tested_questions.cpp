#include "study/analyse/power/tested_questions.h"

#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

bool isSameScale(const protocols::RatingScale& a, const protocols::RatingScale& b)
{
    return a.min == b.min && a.max == b.max && a.step == b.step;
}

bool hasTest(const protocols::AnswerKind& kind)
{
    return std::holds_alternative<protocols::Rating>(kind) || protocols::alternativesOf(kind) > 1;
}

std::vector<protocols::Question> questionsOf(const protocols::Protocol& protocol)
{
    std::vector<protocols::Question> all;
    for (const protocols::Phase& phase : protocol.phases) all.insert(all.end(), phase.questions.begin(), phase.questions.end());
    return all;
}

int runsOf(const protocols::Protocol& protocol, const protocols::Question& question)
{
    for (const protocols::Phase& phase : protocol.phases)
        for (const protocols::Question& one : phase.questions)
            if (one.id == question.id) return phase.runs();
    return 1;
}

void requireQuestion(const std::vector<protocols::Question>& all, const std::string& name)
{
    std::string names;
    for (const protocols::Question& question : all) {
        if (!hasTest(question.kind)) continue;
        if (question.id.value == name) return;
        names += (names.empty() ? "" : ", ") + question.id.value;
    }
    throw protocols::badInput({"the protocol has no rated question and no choice \"" + name + "\"", "--question",
                               names.empty() ? "no such option, because no answer has a test" : "one of " + names, ""});
}

void take(const protocols::Question& question, int runs, TestedQuestions& tested)
{
    if (const auto* rating = std::get_if<protocols::Rating>(&question.kind))
        tested.ratings = TestedRatings{question.id.value, rating->scale, runs};
    else
        tested.choices = TestedChoices{question.id.value, question.kind, protocols::alternativesOf(question.kind), runs};
}

bool isTaken(const protocols::AnswerKind& kind, const TestedQuestions& tested)
{
    return std::holds_alternative<protocols::Rating>(kind) ? tested.ratings.has_value() : tested.choices.has_value();
}

void addOther(const protocols::Question& question, TestedQuestions& tested)
{
    const auto* rating = std::get_if<protocols::Rating>(&question.kind);
    if (!hasTest(question.kind))
        tested.inWords.push_back(question.id.value);
    else if (rating != nullptr && !isSameScale(rating->scale, tested.ratings->scale))
        tested.ratings->others.push_back(question.id.value);
    else if (rating == nullptr && protocols::alternativesOf(question.kind) != tested.choices->alternatives)
        tested.choices->others.push_back(question.id.value);
}

/// " Another scale: Q2; see it by --question Q2."; empty where there is none.
std::string othersText(const std::string& what, const std::vector<std::string>& others)
{
    if (others.empty()) return "";
    std::string text = " " + what + ":";
    for (const std::string& id : others) text += " " + id;
    return text + "; see it by --question " + others.front() + ".";
}

void addLeftOut(ordered_json& rows, const std::vector<std::string>& questions, const char* why)
{
    for (const std::string& id : questions) rows.push_back({{"question", id}, {"why", why}});
}

}  // namespace

TestedQuestions testedQuestions(const protocols::Protocol& protocol, const std::string& question)
{
    const auto all = questionsOf(protocol);
    if (!question.empty()) requireQuestion(all, question);
    TestedQuestions tested;
    for (const protocols::Question& one : all)
        if (one.id.value == question) take(one, runsOf(protocol, one), tested);
    for (const protocols::Question& one : all)
        if (hasTest(one.kind) && !isTaken(one.kind, tested)) take(one, runsOf(protocol, one), tested);
    for (const protocols::Question& one : all) addOther(one, tested);
    return tested;
}

void putTested(ordered_json& json, const TestedQuestions& tested)
{
    ordered_json leftOut = ordered_json::array();
    if (const auto& rated = tested.ratings) {
        json["rated"] = {{"question", rated->question},
                         {"scale", {rated->scale.min.inScaleUnits(), rated->scale.max.inScaleUnits()}},
                         {"step", rated->scale.step.inScaleUnits()},
                         {"answers_averaged", rated->runs},
                         {"questions_with_other_scales", rated->others}};
        addLeftOut(leftOut, rated->others, "another scale; see it by --question");
    }
    if (const auto& chosen = tested.choices) {
        json["chosen"] = {{"question", chosen->question},
                          {"kind", nameOf(chosen->kind)},
                          {"alternatives", chosen->alternatives},
                          {"answers_in_cell", chosen->runs},
                          {"answers_counted", 1},
                          {"questions_with_other_alternatives", chosen->others}};
        addLeftOut(leftOut, chosen->others, "another number of alternatives; see it by --question");
    }
    addLeftOut(leftOut, tested.inWords, "answers in words have no test");
    json["left_out"] = std::move(leftOut);
}

std::string textOf(const TestedQuestions& tested)
{
    const auto number = [](protocols::Tenths tenths) { return protocols::shortest(tenths.inScaleUnits()); };
    std::string text;
    if (const auto& rated = tested.ratings)
        text += "The ratings are those of " + rated->question + ", from " + number(rated->scale.min) + " to " +
                number(rated->scale.max) + " in steps of " + number(rated->scale.step) + "." +
                othersText("Another scale", rated->others) + "\n";
    if (tested.ratings && tested.ratings->runs > 1)
        text += "The residual variance is that of a mean of " + std::to_string(tested.ratings->runs) +
                " ratings, one under each instruction.\n";
    if (const auto& chosen = tested.choices)
        text += "The choices are those of " + chosen->question + ", among " + std::to_string(chosen->alternatives) + " answers." +
                othersText("Another number of alternatives", chosen->others) + "\n";
    if (tested.choices && tested.choices->runs > 1)
        text += "One choice in a cell is counted. The protocol asks for " + std::to_string(tested.choices->runs) +
                ", one under each instruction, so the power is higher (see vis2hap protocol show).\n";
    if (!tested.inWords.empty()) {
        text += "Left out, because answers in words have no test:";
        for (const std::string& id : tested.inWords) text += " " + id;
        text += ".\n";
    }
    return text;
}

}  // namespace study::analyse
