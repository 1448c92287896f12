#include "reports/page/section_text.h"

#include <algorithm>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "protocols/usual_texts.h"
#include "reports/page/anchor_text.h"
#include "reports/page/findings.h"
#include "reports/page/html_parts.h"
#include "reports/page/methods.h"
#include "reports/page/order_text.h"
#include "reports/page/plan_section.h"
#include "reports/page/sentences.h"
#include "reports/page/signal_text.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

NumberTile countTile(std::size_t n, const std::string& singular, const std::string& more = {})
{
    return {std::to_string(n), pluralOf(n, singular) + more};
}

std::string summaryLead(const StudyAnalysis& analysis)
{
    const StudyData& data = analysis.data;
    return tiles({countTile(answeringParticipants(data), "participant"),
                  countTile(data.conditions.size() * data.fabrics.size(), "rendering"),
                  countTile(analysis.completeness.present, "answer", data.blinded ? "" : " analysed"),
                  countTile(analysis.completeness.missing(), "answer", " missing"),
                  countTile(data.voided, "presentation", " voided"), countTile(analysis.flags.size(), "quality flag")});
}

/// "3 participants, version 2 of the protocol".
std::string whoText(const SentenceWording& wording)
{
    std::vector<std::string> versions;
    for (const int version : wording.versions) versions.push_back(std::to_string(version));
    return counted(wording.participants.size(), "participant") + ", " + pluralOf(versions.size(), "version") + " " +
           listed(versions) + " of the protocol";
}

/// The sentence in quotation marks, with its wording and a remark in brackets where there are any.
std::string quotedWording(const QuestionInfo& asked, const std::string& words, const std::string& remark)
{
    const std::string wording = protocols::wordingOf(protocols::QuestionId(asked.id), asked.kind, words);
    const std::string remarks = wording + (wording.empty() || remark.empty() ? "" : "; ") + remark;
    return "\u201C" + protocols::escapedMarkup(words) + "\u201D" +
           (remarks.empty() ? "" : " (" + protocols::escapedMarkup(remarks) + ")");
}

/// The questions of one kind with the sentences that were read to the participants.
template <class Findings>
std::string questionTexts(const StudyAnalysis& analysis)
{
    std::string text;
    for (const auto& question : questionsWith<Findings>(analysis)) {
        const QuestionInfo& asked = question.analysis.question;
        if (asked.text.empty()) continue;
        text += (text.empty() ? "<b>" : "<br><b>") + protocols::escapedMarkup(question.id()) + "</b> ";
        if (asked.wordings.empty()) text += quotedWording(asked, asked.text, "");
        std::vector<std::string> wordings;
        for (const SentenceWording& one : asked.wordings) wordings.push_back(quotedWording(asked, one.text, whoText(one)));
        text += listed(wordings);
    }
    return text.empty() ? text : paragraph(text);
}

std::string claimsLead(const StudyAnalysis& analysis)
{
    const bool hasRatings = !questionsWith<RatingAnalysis>(analysis).empty();  // only their claims have bounds of equivalence
    return paragraph(
        "Each contrast has two rows. &ldquo;These fabrics&rdquo; asks what other participants would show on the same fabrics. "
        "&ldquo;Fabrics like these&rdquo; asks what other participants would show on other fabrics of this kind; it is the "
        "verdict of the summary. &ldquo;Not decided&rdquo; means that these data cannot tell." +
        (hasRatings ? " " + boundsLead(analysis.data) : ""));
}

/// Empty where no pair has mirrored bounds.
std::string mirroredSentence(const StudyData& data)
{
    std::string pairs;
    for (const ConditionPair& pair : mirroredPairs(data))
        pairs += (pairs.empty() ? "" : ", ") + protocols::escapedMarkup(pair.a) + " \u2212 " + protocols::escapedMarkup(pair.b);
    if (pairs.empty()) return {};
    const auto [low, high] = data.equivalenceBounds;
    return " The bounds belong to the planned differences. Here these stand the other way round, with the bounds " +
           typeset(protocols::shortest(0 - high)) + " and " + typeset(protocols::shortest(0 - low)) + ": " + pairs + ".";
}

/// What the numbers are, then one sentence a question on other fabrics.
std::string effectsLead(const StudyAnalysis& analysis)
{
    std::vector<std::string> sentences;
    for (const QuestionAnalysis& question : analysis.questions)
        if (const QuestionEffects* effects = effectsOf(question))
            sentences.push_back("<b>" + protocols::escapedMarkup(question.question.id) + "</b> " +
                                protocols::escapedMarkup(fabricSentence(*effects, unitOf(question))));
    if (sentences.empty()) return {};
    return paragraph(
               "These numbers describe and decide no claim. Marginal R&sup2; is the share of variance that condition explains. "
               "Conditional R&sup2; adds participants, fabrics and their interactions. ICC(2,1) is the absolute agreement of "
               "one participant with the others on the same stimuli. ICC(2,k) is that of the mean of all.") +
           bulletList(sentences);
}

/// All remarks of the study; the head of the report shows the first ones only.
std::string stampsText(const StudyData& data)
{
    std::vector<std::string> items;
    for (const std::string& stamp : data.stamps) items.push_back(protocols::escapedMarkup(stamp));
    return items.empty() ? std::string() : paragraph("Remarks on this study:") + bulletList(items);
}

std::string qualityLead(const StudyAnalysis& analysis)
{
    const Completeness& completeness = analysis.completeness;
    const std::vector<std::string> order = orderSentences(analysis);
    const std::size_t missing = completeness.missing(), empty = completeness.ofEmptyPlaces, voided = analysis.data.voided;
    const std::string counts = std::to_string(completeness.present) + " of " + counted(completeness.expected, "expected answer") +
                               (completeness.present == 1 ? " is" : " are") +
                               (analysis.data.blinded ? " stored, " : " analysed, ") + std::to_string(missing) +
                               (missing == 1 ? " is" : " are") + " missing" +
                               (empty > 0 ? ", " + std::to_string(empty) + " of them of places that nobody has. " : ". ") +
                               counted(voided, "presentation") + (voided == 1 ? " was" : " were") + " voided.";
    return paragraph(counts) + stampsText(analysis.data) +
           (analysis.flags.empty() ? paragraph("Nothing is flagged.") : std::string()) +
           (order.empty() ? std::string() : bulletList(order));
}

/// The trend of the share correct with the response time, where it has an interval.
std::string speedLead(const StudyAnalysis& analysis)
{
    std::string text;
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis)) {
        const stats::TTest& test = question.findings.accuracyBySpeed.trend.test;
        if (!test.why.empty()) continue;
        text += paragraph(
            protocols::escapedMarkup(question.id()) + ": when a response takes twice as long, the share correct changes by " +
            typeset(fixed(*test.estimate, 2)) + " (95 % interval [" + typeset(fixed(*test.ci.low, 2)) + ", " +
            typeset(fixed(*test.ci.high, 2)) + "]), at equal " + heldEqual(isInstructed(analysis.data, question.id())) +
            ". This holds for these fabrics. It is no proof that more time helps: hard choices also take longer.");
    }
    return text;
}

std::string chainLead()
{
    return paragraph(
               "One row is one rendering: a condition at one quality. Read from left to right: the time that its signals take, "
               "what this speed gives up, what a finger gets, and what participants answered.") +
           folded("What the columns are",
                  bulletList(
                      {"<b>Time</b>: median over the fabrics of the time in which the signals of one image are computed. Reading "
                       "recordings, loading the networks and drawing the image cost the same at every quality and are left out. "
                       "The interval is that of order statistics; it needs at least 6 fabrics. The program that made the study "
                       "measured it once, on one machine.",
                       "<b>Error of the signal</b>: difference from the accurate rendering. Relief: root mean square, in percent "
                       "of that relief&rsquo;s own. Friction: mean absolute difference in percent of the mean.",
                       "<b>Difference under the finger</b>: between this friction image and the accurate one, each stroked by a "
                       "simulated finger. Slipperiness and texture, in just-noticeable differences (JND), added as squares. A "
                       "model computes it; no person was asked.",
                       "<b>From measured</b>: the same against the measured signal of the fabric, where the study shows it. "
                       "Photograph and press may come from different places, so heights are compared by their spectra.",
                       "The section on generated signals describes the usual quality. Where nothing was rendered at it, it "
                       "describes the accurate one."}));
}

/// Median time and share correct under each instruction, and how many answers were late.
std::string instructionLead(const StudyAnalysis& analysis)
{
    std::string text;
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis)) {
        std::vector<std::string> parts;
        for (const InstructedSpeed& under : question.findings.instructions.instructions) {
            if (!under.speed.share.exists() || !under.speed.medianSeconds.exists()) continue;
            std::string part = protocols::escapedMarkup(under.instruction.id) + ": " + fixed(*under.speed.medianSeconds, 1) +
                               " s, share correct " + fixed(*under.speed.share, 2);
            if (under.instruction.deadlineSeconds)
                part += ", " + std::to_string(under.late) + " of " + counted(under.timed, "answer") + " late";
            parts.push_back(part);
        }
        if (!parts.empty())
            text += paragraph(protocols::escapedMarkup(question.id()) + " by instruction (median response time):") +
                    bulletList(parts);
    }
    return text;
}

std::string flagRules(const StudyAnalysis& analysis)
{
    std::vector<std::string> rules;
    for (const std::string& sentence : ruleSentences()) rules.push_back(protocols::escapedMarkup(sentence));
    if (!analysis.data.mismatchedResponses.empty()) rules.push_back(protocols::escapedMarkup(mismatchRule()));
    if (analysis.data.blinded)
        rules.push_back("blank_glass_rated_high and mismatch_rated_high need the key: they appear after the unblinding");
    return folded("Rules of the flags", bulletList(rules));
}

/// Empty where every group answered every fabric.
std::string leftOutOfGroups(const StudyAnalysis& analysis)
{
    const std::vector<std::string> fabrics = fabricsNotInEveryGroup(analysis.data, analysis.groups);
    if (fabrics.empty()) return {};
    std::vector<std::string> names;
    for (const std::string& fabric : fabrics) names.push_back(protocols::escapedMarkup(fabric));
    return paragraph("Not every group answered " + listed(names) +
                     ". A comparison of groups leaves out a fabric that some group did not answer, so that a difference of "
                     "fabrics does not look like one of groups. The tables name these fabrics.");
}

}  // namespace

std::string sectionLead(PageSection section, const StudyAnalysis& analysis)
{
    switch (section) {
        case PageSection::Summary:
            return summaryLead(analysis);
        case PageSection::Matches:
            return questionTexts<ChoiceAnalysis>(analysis) + choiceAnchorsText(analysis);
        case PageSection::Ratings:
            return questionTexts<RatingAnalysis>(analysis) + ratingAnchorsText(analysis);
        case PageSection::Words:
            return questionTexts<WordedAnalysis>(analysis);
        case PageSection::Claims:
            return claimsLead(analysis);
        case PageSection::Sentences:
            return sentencesLead(analysis);
        case PageSection::Comparisons:
            return paragraph(
                "Paired t tests on participant means, for these fabrics only. A small p shows a difference. A large p does not "
                "show that there is none.");
        case PageSection::Equivalence:
            return paragraph(
                "Two one-sided tests on participant means, for these fabrics only. Two conditions are equivalent when the 90 % "
                "interval lies inside the bounds. These p values are not corrected." +
                mirroredSentence(analysis.data));
        case PageSection::Effects:
            return effectsLead(analysis);
        case PageSection::Groups:
            return paragraph(
                       "The groups are compared on the participants' means, for these fabrics only: by Welch's t test (two "
                       "groups; F is t squared) or one-way analysis of variance (more). Nobody was assigned to a group by this "
                       "program, so a difference need not come from what the groups are named after.") +
                   leftOutOfGroups(analysis);
        case PageSection::Speed:
            return instructionLead(analysis) + speedLead(analysis);
        case PageSection::Chain:
            return chainLead();
        case PageSection::Signals:
            return signalsLead(analysis.data);
        case PageSection::Plan:
            return planLead(analysis);
        case PageSection::Quality:
            return qualityLead(analysis);
        case PageSection::Methods: {
            std::string text;
            for (const std::string& html : methodParagraphs(analysis)) text += paragraph(html);
            return text;
        }
    }
    return {};
}

std::string sectionEnd(PageSection section, const StudyAnalysis& analysis)
{
    if (section == PageSection::Summary) return bulletList(findings(analysis), "findings");
    return section == PageSection::Quality ? flagRules(analysis) : std::string();
}

bool standsAlone(PageSection section)
{
    return section == PageSection::Summary || section == PageSection::Sentences || section == PageSection::Plan ||
           section == PageSection::Quality || section == PageSection::Methods;
}

}  // namespace reports
