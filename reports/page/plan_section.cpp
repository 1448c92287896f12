#include "reports/page/plan_section.h"

#include <algorithm>
#include <cctype>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "reports/page/html_parts.h"
#include "reports/text/condition_label.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

using protocols::escapedMarkup;

std::string registrationSentence(const StudyData& data)
{
    if (!data.hasLog)
        return data.plannedDesign ? "A protocol came with the answers. No registration of it is known."
                                  : "Neither a registration nor a protocol came with the answers: no plan is known.";
    if (data.registrations.empty() && data.planVersion == 0)
        return "The study was not preregistered. The plan is that of its first protocol.";
    const std::string ofVersion = "The plan is that of version " + std::to_string(data.planVersion) +
                                  " of its protocol, the last one before the first answer.";
    if (data.registrations.empty()) return "The study was not preregistered. " + ofVersion;
    const Registration& first = data.registrations.front();
    const std::string registered = "Preregistered on " + escapedMarkup(first.time) + ", " +
                                   timingText(first.answersBefore, first.afterUnblinding) + ", SHA-256 <code>" +
                                   escapedMarkup(first.sha256) + "</code>.";
    if (data.planVersion == 0) return registered;
    return registered + " This plan is not followed, because it changes what the protocol stated before the first answer. " +
           ofVersion;
}

std::string amendmentSentences(const StudyData& data)
{
    std::string text;
    for (const Registration& registration : data.registrations)
        if (registration.number > 1) {
            std::vector<std::string> changes;
            for (const std::string& change : registration.changes)
                changes.push_back("<code>" + escapedMarkup(change) + "</code>");
            text += " Registration " + std::to_string(registration.number) + " on " + escapedMarkup(registration.time) + ", " +
                    timingText(registration.answersBefore, registration.afterUnblinding) + ", changed " + listed(changes) +
                    "; SHA-256 <code>" + escapedMarkup(registration.sha256) + "</code>.";
        }
    for (const Registration& registration : data.registrations)
        if (registration.isFollowed && data.registrations.size() > 1)
            text += " This report follows registration " + std::to_string(registration.number) + ".";
    return text;
}

/// Names the planned contrasts that the answers cannot test.
std::string untestedSentence(const PlanComparison& plan)
{
    std::vector<std::string> names;
    for (const ContrastDone& contrast : plan.contrasts)
        if (contrast.testedIn.empty()) names.push_back(htmlLabel(contrast.a) + " \u2212 " + htmlLabel(contrast.b));
    if (names.empty()) return {};
    return std::to_string(names.size()) + " of " + counted(plan.contrasts.size(), "planned contrast") +
           (names.size() == 1 ? " was" : " were") + " not tested: " + listed(names) + ".";
}

std::string deviationSentence(const PlanComparison& plan)
{
    std::vector<std::string> items;
    for (const PlanRow& row : deviationsOf(plan)) items.push_back(row.item);
    if (items.empty()) return "Nothing differs from the plan.";
    return "The study differs from its plan in: " + listed(items) + ".";
}

std::string withCapital(std::string sentence)
{
    sentence.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence.front())));
    return sentence;
}

/// Of bounds or contrasts that something states, within a sentence.
std::string statedBy(PlanOrigin origin, const StudyData& data, const std::string& option)
{
    switch (origin) {
        case PlanOrigin::Program:
            return "this program";
        case PlanOrigin::Option:
            return "the option <code>" + option + "</code>";
        case PlanOrigin::RegisteredPlan:
            return "the registered plan";
        case PlanOrigin::Protocol:
            break;
    }
    return data.planVersion > 0 ? "version " + std::to_string(data.planVersion) + " of the protocol" : "the protocol";
}

std::string usualRuleOf(const StudyData& data)
{
    std::vector<protocols::AnswerKind> kinds;
    for (const QuestionInfo& question : data.questions) kinds.push_back(question.kind);
    return usualBoundsRule(kinds);
}

/// Why the bounds are the default of this program.
std::string whyUsualBounds(const StudyData& data)
{
    const bool isAssumed = std::ranges::any_of(data.questions, [](const QuestionInfo& one) { return one.scaleAssumed; });
    if (!data.plannedDesign)
        return isAssumed ? "No protocol and no option stated any, nor the scale: 0 to 10 is assumed."
                         : "No protocol and no option stated any.";
    return withCapital(statedBy(PlanOrigin::Protocol, data, "")) + " states none.";
}

std::string boundsSource(const StudyData& data) { return withCapital(statedBy(data.boundsFrom, data, "--bounds")); }

std::string typesetBounds(const std::pair<double, double>& bounds)
{
    return typeset(protocols::shortest(bounds.first)) + " and " + typeset(protocols::shortest(bounds.second));
}

/// Empty where the latest protocol has the bounds of the plan.
std::string laterBoundsSentence(const StudyData& data)
{
    if (std::ranges::find(data.protocolChanges, equivalenceBoundsChanged) == data.protocolChanges.end()) return "";
    return " The latest version of the protocol has other bounds. They are not used, because they came after the plan.";
}

/// Empty where the bounds of the call are those of the protocol, or no protocol states any.
std::string replacedBoundsSentence(const StudyData& data)
{
    if (data.boundsFrom != PlanOrigin::Option || !data.plannedDesign || data.plannedDesign->hasUsualBounds) return "";
    const auto& planned = data.plannedDesign->equivalenceBounds;
    return planned == data.equivalenceBounds ? "" : " They replace those of the protocol, " + typesetBounds(planned) + ".";
}

}  // namespace

std::string planLead(const StudyAnalysis& analysis)
{
    std::string html = paragraph(registrationSentence(analysis.data) + amendmentSentences(analysis.data));
    if (analysis.plan.rows.empty()) return html;
    html += paragraph(deviationSentence(analysis.plan));
    if (const std::string untested = untestedSentence(analysis.plan); !untested.empty()) html += paragraph(untested);
    return html;
}

std::string boundsSentence(const StudyData& data)
{
    const std::string bounds = typesetBounds(data.equivalenceBounds) + " scale points";
    const std::string stated =
        data.boundsFrom == PlanOrigin::Program
            ? "Their bounds are the default of this program: " + bounds + ", " + usualRuleOf(data) + ". " + whyUsualBounds(data)
            : boundsSource(data) + " states their bounds: " + bounds + ".";
    return stated + replacedBoundsSentence(data) + laterBoundsSentence(data);
}

std::string boundsLead(const StudyData& data)
{
    if (data.boundsFrom != PlanOrigin::Program) return boundsSource(data) + " states the bounds of equivalence.";
    return "The bounds of equivalence are the default of this program, " + usualRuleOf(data) + ". " + whyUsualBounds(data);
}

std::string contrastsSource(const StudyData& data) { return statedBy(data.plannedFrom, data, "--planned"); }

std::vector<std::string> planFindings(const StudyAnalysis& analysis)
{
    if (analysis.plan.rows.empty()) return {};
    std::vector<std::string> sentences{registrationSentence(analysis.data) + " " + deviationSentence(analysis.plan)};
    if (std::string untested = untestedSentence(analysis.plan); !untested.empty()) sentences.push_back(std::move(untested));
    return sentences;
}

}  // namespace reports
