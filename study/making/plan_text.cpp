#include "study/making/plan_text.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "protocols/files/number_text.h"
#include "protocols/files/safe_text.h"
#include "reports/data/registration.h"
#include "reports/data/study_data.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"
#include "stats/claims/claims.h"

namespace study::making {

namespace {

using protocols::shortest;
using reports::counted;
using stats::Generalisation;

std::string item(const std::string& sentence) { return "- " + sentence + "\n"; }

std::string section(int number, const std::string& title, const std::string& body)
{
    return "\n" + std::to_string(number) + ". " + title + "\n" + body;
}

std::string nameOf(const protocols::PlannedContrast& contrast) { return contrast.a.value + " - " + contrast.b.value; }

std::string boundsOf(const StudyPlan& plan)
{
    return shortest(plan.protocol.equivalenceBounds.first) + " and " + shortest(plan.protocol.equivalenceBounds.second);
}

/// Empty where the protocol states its bounds.
std::string usualBoundsText(const StudyPlan& plan)
{
    const auto& protocol = plan.protocol;
    if (!protocol.hasUsualBounds) return "";
    std::vector<protocols::AnswerKind> kinds;
    for (const auto& phase : protocol.phases)
        for (const auto& question : phase.questions) kinds.push_back(question.kind);
    // Bounds that an earlier version of this program registered stay, and it had another default.
    const bool isOfNow = protocol.equivalenceBounds == usualBoundsOf(protocol.phases);
    return " The protocol states none: they are the default of this program" +
           (isOfNow ? ", " + reports::usualBoundsRule(kinds) : std::string()) + ".";
}

std::string words(Generalisation generalisation)
{
    return generalisation == Generalisation::TheseFabrics ? "these fabrics" : "fabrics like these";
}

std::vector<protocols::Question> questionsOf(const protocols::Protocol& protocol)
{
    std::vector<protocols::Question> questions;
    for (const auto& phase : protocol.phases) questions.insert(questions.end(), phase.questions.begin(), phase.questions.end());
    return questions;
}

bool asksForNumbers(const protocols::Protocol& protocol)
{
    for (const auto& question : questionsOf(protocol))
        if (std::holds_alternative<protocols::Rating>(question.kind)) return true;
    return false;
}

bool asksForChoices(const protocols::Protocol& protocol)
{
    for (const auto& question : questionsOf(protocol))
        if (alternativesOf(question.kind) > 1) return true;
    return false;
}

/// A text of the protocol as one line. Tabs and line ends become blanks. Marks of direction stay where each ends in the text
/// itself, as Hebrew and Arabic texts have them; others would turn around what stands behind the text.
std::string inOneLine(std::string text)
{
    constexpr std::string_view isolates[] = {"\xE2\x81\xA6", "\xE2\x81\xA7", "\xE2\x81\xA8"}, end = "\xE2\x81\xA9";
    std::ranges::replace(text, '\t', ' ');
    int open = 0;
    std::string line, piece;
    const auto addPiece = [&] { line += protocols::printable(std::exchange(piece, "")); };
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view mark = std::string_view(text).substr(at, end.size());
        const bool begins = std::ranges::find(isolates, mark) != std::end(isolates), ends = mark == end;
        if (ends && open == 0) return protocols::printable(text);
        if (!begins && !ends) {
            piece += text[at++];
            continue;
        }
        open += begins ? 1 : -1;
        addPiece();
        line += mark;
        at += mark.size();
    }
    addPiece();
    return open == 0 ? line : protocols::printable(text);
}

std::string headOf(const StudyPlan& plan, const RegistrationStamp& stamp)
{
    std::string text = "STUDY PLAN: " + inOneLine(plan.facts.name) + "\n";
    text += "Registered: " + stamp.time + (stamp.who.empty() ? "" : " by " + stamp.who) + ", " + timingOf(stamp) + ".\n";
    if (stamp.number == 1) return text + "This is the first registration of this study.\n";
    text += "This is registration " + std::to_string(stamp.number) + ", an amendment.\n";
    for (std::size_t i = 0; i < stamp.earlierHashes.size(); ++i)
        text += "Registration " + std::to_string(i + 1) + " has the SHA-256 " + stamp.earlierHashes[i] + ".\n";
    return text + "Parts of the plan that changed since registration " + std::to_string(stamp.number - 1) + ": " +
           reports::listed(stamp.changes) + ".\n";
}

/// Empty where all answers before the plan are still there.
std::string erasedText(const RegistrationStamp& stamp)
{
    if (stamp.erasedBefore == 0) return "";
    return "; " + std::to_string(stamp.erasedBefore) + " of them had already been erased";
}

std::string dataSoFar(const RegistrationStamp& stamp)
{
    std::string text = stamp.answersBefore == 0
                           ? "No answer had been stored when this plan was registered.\n"
                           : counted(stamp.answersBefore, "answer") + (stamp.answersBefore == 1 ? " was" : " were") +
                                 " stored before this plan was registered" + erasedText(stamp) + ".\n";
    text += stamp.afterUnblinding ? "The study was unblinded before: the conditions of the answers could be known.\n"
                                  : "The study was blinded: nobody could know the condition of an answer from the program.\n";
    return text;
}

/// The hypotheses of one question.
std::string hypothesesOf(const StudyPlan& plan, const protocols::Question& question)
{
    const reports::Scoring scoring = reports::scoringOf(question.kind);
    if (std::holds_alternative<reports::OpenWords>(scoring))
        return item(question.id.value + ": no hypothesis. The answers in words are listed.");
    const auto* choice = std::get_if<reports::RightOrWrong>(&scoring);
    const std::string what = choice != nullptr ? "the share of right answers" : "the mean rating";
    std::string text;
    if (choice != nullptr)
        text += item(question.id.value + ": under each condition, " + what + " is above chance, 1/" +
                     std::to_string(choice->alternatives) + " (one-sided).");
    const std::string pairs = plan.contrasts.empty() ? "each pair of conditions" : "each planned contrast";
    if (!plan.contrasts.empty())
        text += item(question.id.value + ", primary: " + what + " differs between " + plan.contrasts.front().a.value + " and " +
                     plan.contrasts.front().b.value + " (two-sided).");
    if (plan.protocol.conditions.size() > 1)
        text += item(question.id.value + ": for " + pairs + ", " + what + " differs between the two conditions (two-sided).");
    if (choice == nullptr && plan.protocol.conditions.size() > 1)
        text += item(question.id.value + ": for " + pairs + ", the difference of the mean ratings lies within " + boundsOf(plan) +
                     " (equivalence).");
    return text;
}

std::string hypotheses(const StudyPlan& plan)
{
    std::string text;
    for (const auto& question : questionsOf(plan.protocol)) text += hypothesesOf(plan, question);
    text +=
        "The null hypothesis of a difference is a mean difference of 0. That of an equivalence is a mean difference at or "
        "beyond a bound.\n";
    return text;
}

std::string scoringText(const protocols::AnswerKind& kind)
{
    return std::visit(protocols::Overloaded{
                          [](const reports::RightOrWrong& choice) {
                              return "one of " + std::to_string(choice.alternatives) +
                                     " answers is right; scored 1 or 0; chance is 1/" + std::to_string(choice.alternatives);
                          },
                          [](const reports::NumberOnScale& scale) {
                              return "a number from " + shortest(scale.min) + " to " + shortest(scale.max) + "; scored as it is";
                          },
                          [](const reports::OpenWords&) { return std::string("free words; not scored"); },
                      },
                      reports::scoringOf(kind));
}

std::string measures(const StudyPlan& plan)
{
    std::string text;
    for (const auto& question : questionsOf(plan.protocol))
        text += item(question.id.value + ": \"" + inOneLine(question.text) + "\" Answer: " + scoringText(question.kind) + ".");
    return text + "The response time runs from the first touch to the answer. It is described, without a hypothesis.\n";
}

/// Empty where the phase gives no instruction.
std::string instructionsText(const protocols::Phase& phase)
{
    if (phase.instructions.empty()) return "";
    std::string text = " Instructions (" + std::to_string(phase.instructions.size()) + "):";
    for (const auto& instruction : phase.instructions)
        text += (&instruction == &phase.instructions.front() ? " " : "; ") + instruction.id.value + ", \"" +
                inOneLine(instruction.text) + "\"";
    return text +
           " All presentations are repeated under each instruction. The order of the instructions is balanced over "
           "participants. Answers after a deadline are marked and analysed.";
}

/// Empty where the phase has no anchors.
std::string plannedAnchors(const protocols::Protocol& protocol, const protocols::Anchors& anchors)
{
    std::string text;
    if (anchors.mismatched > 0)
        text += " " + counted(anchors.mismatched, "mismatched presentation") + ": the image is " +
                anchorConditionOf(protocol, anchors).value +
                " of one fabric, and another fabric lies on the tray. Their mean rating is the floor.";
    if (anchors.repeated > 0)
        text += " " + counted(anchors.repeated, "presentation") + (anchors.repeated == 1 ? " comes" : " come") +
                " a second time. The agreement with the first answer shows the noise of the answers, and so the ceiling.";
    return text.empty() ? text : text + " Answers to these anchors belong to no condition.";
}

std::string design(const StudyPlan& plan)
{
    const auto& protocol = plan.protocol;
    std::string text =
        std::string("Within participants: every participant meets every fabric under every condition once in each phase") +
        (hasInstructions(protocol) ? " and under each of its instructions" : "") + ".\n";
    std::string names;
    for (const auto& condition : protocol.conditions) names += (names.empty() ? "" : ", ") + condition.value;
    text += "Conditions (" + std::to_string(protocol.conditions.size()) + "): " + names + ".\n";
    std::string fabrics;
    for (const auto& fabric : plan.facts.fabrics)
        fabrics += (fabrics.empty() ? "" : ", ") + fabric.value + " (" + inOneLine(plan.facts.fabricNames.at(fabric)) + ")";
    text += "Fabrics (" + std::to_string(plan.facts.fabrics.size()) + "): " + fabrics + ".\n";
    for (std::size_t i = 0; i < protocol.phases.size(); ++i) {
        std::vector<std::string> ids;
        for (const auto& question : protocol.phases[i].questions) ids.push_back(question.id.value);
        text += "Phase " + std::to_string(i + 1) + ": " + counted(protocol.presentationsPerPhase(), "presentation") +
                (protocol.phases[i].catchTrials == 0 ? ""
                                                     : " and " + counted(protocol.phases[i].catchTrials, "catch trial") +
                                                           " with blank glass, which no analysis of conditions uses") +
                "; questions " + reports::listed(ids) + "." + instructionsText(protocol.phases[i]) +
                plannedAnchors(protocol, protocol.phases[i].anchors) + "\n";
    }
    return text + counted(protocol.answersPerParticipant(), "answer") +
           " per participant. The order of presentations is balanced and drawn by seed. The experimenter and the participant "
           "see codes, not conditions.\n";
}

std::string contrasts(const StudyPlan& plan)
{
    if (plan.contrasts.empty())
        return "No contrast is planned: all pairs of conditions of a question are one family. No contrast is primary.\n";
    std::string text = "Primary contrast: " + nameOf(plan.contrasts.front()) +
                       ". It belongs to the family of planned contrasts and has no level of its own.\n";
    text += "Planned contrasts, in this order and with this sign (first minus second):\n";
    for (const auto& contrast : plan.contrasts) text += item(nameOf(contrast));
    return text;
}

std::string analyses(const StudyPlan& plan)
{
    const bool numbers = asksForNumbers(plan.protocol), choices = asksForChoices(plan.protocol);
    std::string text = contrasts(plan);
    text +=
        "Every claim is made for two populations. \"These fabrics\": other participants, the same fabrics. \"Fabrics like "
        "these\": other participants and other fabrics of this kind.\n";
    text += "The claim for fabrics like these decides. The claim for these fabrics stands beside it.\n";
    text += item(
        "These fabrics: Student's t test on the participants' means over fabrics (of the difference of the two "
        "conditions, or of the shares under one condition).");
    text += item(
        "Fabrics like these, ratings: linear mixed model of the ratings under the two conditions alone, with random intercepts "
        "of participant, fabric, participant x condition and fabric x condition (REML). The t test has Satterthwaite's degrees "
        "of freedom.");
    text += item(
        "Fabrics like these, choices, and ratings of which some are missing: linear mixed model of the differences of the two "
        "conditions, one for each participant and fabric, with crossed random intercepts of participant and fabric (REML).");
    text += item(
        "The degrees of freedom have a limit where the differences vary neither with participants nor with fabrics by these "
        "estimates. It applies if all conditions together show such an interaction (F tests, p < .05), or if answers are "
        "missing. It is 1.2 / (rp^6 / (participants - 1) + rf^6 / (fabrics - 1)). rp and rf are the mean squares of the "
        "participants' and fabrics' differences over that of their residual.");
    if (choices)
        text += item(
            "Choices enter these tests as 1 and 0. Above chance: the same tests of the share under one condition, "
            "one-sided against 1/m. Choices have no bounds of equivalence.");
    if (numbers)
        text +=
            item("Equivalence: two one-sided tests at the bounds " + boundsOf(plan) + " scale points." + usualBoundsText(plan));
    text += "Level: alpha = " + shortest(stats::claimAlpha) + ".\n";
    text += std::string("Correction: Holm's, within the family of one question and one population: once for the differences") +
            (numbers ? ", once for the equivalences" : "") + (choices ? ", once over the conditions for \"above chance\"" : "") +
            ". There is no correction across questions.\n";
    text += std::string("Verdicts: \"different\" if the corrected p of the difference is below alpha") +
            (numbers ? ", \"equivalent\" if that of the equivalence is, \"different, within the bounds\" if both are" : "") +
            ", otherwise \"not decided\".\n";
    text +=
        "All conditions at once: repeated-measures analysis of variance on the participants' means, with the "
        "Greenhouse-Geisser correction (these fabrics), and the F test of a linear mixed model with random effects of "
        "participant, fabric and their interactions with condition (fabrics like these).\n";
    return text + "Every other analysis of the report is exploratory.\n";
}

std::string exclusions(const StudyPlan& plan)
{
    const ExclusionRules rules = exclusionRules(plan.protocol);
    std::string text = "The main analysis excludes no participant and no valid answer. No outlier is removed or changed.\n";
    text += "The program flags data by these rules:\n";
    for (const auto& sentence : rules.sentences) text += item(sentence);
    text += "A second analysis leaves out participants with one of these flags: " + reports::listed(rules.flags) +
            ". It stands beside the main analysis and decides nothing.\n";
    text += "Participants who withdraw are not analysed; another participant may take the place.\n";
    text +=
        "Voided presentations are kept, not analysed, and presented again. A corrected answer replaces the first one; both "
        "are kept.\n";
    return text +
           "Missing answers are not imputed. A test uses the participants and fabrics that have the answers which it "
           "needs, and reports its n.\n";
}

std::string size(const StudyPlan& plan)
{
    return counted(static_cast<std::size_t>(plan.protocol.participants), "participant") +
           ". Data collection stops when this number have finished. No result is tested before that to decide whether to stop.\n";
}

std::string percentOf(const stats::Value& power)
{
    if (!power.exists()) return "unknown (" + power.why() + ")";
    if (*power > 0.995) return "over 99 %";
    if (*power < 0.005) return "below 1 %";
    return protocols::fixed(100 * *power, 0) + " %";
}

std::string effectText(const analyse::PowerOfClaim& claim, const analyse::QuestionPower& power, const StudyPlan& plan)
{
    const std::string effect = protocols::fixed(claim.effect, 2);
    switch (claim.kind) {
        case analyse::ClaimKind::Difference:
            return "Difference, truly " + effect + (power.ratings ? " scale points" : " between two shares about .5");
        case analyse::ClaimKind::Equivalence:
            return "Equivalence within " + boundsOf(plan) + ", true difference " + effect;
        case analyse::ClaimKind::AboveChance:
            break;
    }
    return "Above chance, true share " + effect;
}

std::string familyText(const analyse::PowerOfClaim& claim, const analyse::QuestionPower& power)
{
    return claim.kind == analyse::ClaimKind::AboveChance ? counted(power.conditions, "condition")
                                                         : counted(power.contrasts, "contrast");
}

std::string powerOf(const analyse::PowerOfClaim& claim, const analyse::QuestionPower& power, const StudyPlan& plan)
{
    const std::string text =
        effectText(claim, power, plan) + ", for " + words(claim.generalisation) + ": power " + percentOf(claim.power.alone);
    if (!claim.power.alone.exists()) return item(text + ".");
    return item(text + "; at the first step of Holm's correction over " + familyText(claim, power) + " " +
                percentOf(claim.power.firstStep) + ".");
}

std::string boundText(const stats::Value& bound)
{
    return bound.exists() ? "+-" + protocols::fixed(*bound, 2) + " scale points" : "no bounds of the scale";
}

std::string narrowestText(const analyse::NarrowestBounds& narrowest)
{
    return item("Smallest bounds with a power of 80 %, if there is no difference, for " + words(narrowest.generalisation) + ": " +
                boundText(narrowest.bounds.alone) + "; at the first step of Holm's correction " +
                boundText(narrowest.bounds.firstStep) + ".");
}

std::string assumptionsOf(const analyse::QuestionPower& power)
{
    if (power.ratings)
        return "Assumed variances, in squared scale points: participant x condition " +
               protocols::fixed(power.ratings->participantCondition, 3) + ", fabric x condition " +
               protocols::fixed(power.ratings->fabricCondition, 3) + ", residual " +
               protocols::fixed(power.ratings->residual, 3) + ".\n";
    return "Assumed SDs of the log odds of a right answer: participants " + shortest(power.choices->participantSd) +
           ", fabrics " + shortest(power.choices->fabricSd) + ", no interaction with condition.\n";
}

/// Questions with the same design have the same power; it is written once.
bool isAlike(const analyse::QuestionPower& a, const analyse::QuestionPower& b)
{
    if (a.ratings.has_value() != b.ratings.has_value() || a.claims.size() != b.claims.size()) return false;
    for (std::size_t i = 0; i < a.claims.size(); ++i)
        if (a.claims[i].effect != b.claims[i].effect || a.claims[i].power.alone != b.claims[i].power.alone) return false;
    return true;
}

std::string power(const StudyPlan& plan)
{
    if (plan.power.empty()) return "No question is tested.\n";
    std::string text =
        "By formula, for complete data that follow the assumptions below. They come from no data of this study. Real "
        "interactions "
        "may be larger; the power is then lower. The power alone is that of one test at alpha. The first step of Holm's "
        "correction "
        "is the least favourable one.\n";
    std::vector<bool> done(plan.power.size());
    for (std::size_t i = 0; i < plan.power.size(); ++i) {
        if (done[i]) continue;
        std::vector<std::string> ids;
        for (std::size_t k = i; k < plan.power.size(); ++k)
            if (isAlike(plan.power[i], plan.power[k])) {
                done[k] = true;
                ids.push_back(plan.power[k].question);
            }
        text += reports::listed(ids) + ":\n" + assumptionsOf(plan.power[i]);
        for (const auto& claim : plan.power[i].claims) text += powerOf(claim, plan.power[i], plan);
        for (const auto& narrowest : plan.power[i].narrowest) text += narrowestText(narrowest);
    }
    return text;
}

std::string identity(const StudyPlan& plan)
{
    const auto& facts = plan.facts;
    std::string text = "Protocol, version " + std::to_string(plan.version.version) + ": SHA-256 " + plan.version.sha256 + "\n";
    text += "Data set: SHA-256 " + facts.datasetSha256 + (facts.datasetProcedural ? " (procedural)" : "") + "\n";
    text += "Generators: " + (facts.modelSha256.empty() ? "none" : "SHA-256 " + facts.modelSha256) + "\n";
    text += "Allocation of the conditions, closed until the unblinding: SHA-256 " + facts.keySha256 + "\n";
    text += "Study made on " + facts.createdAt + " with " + facts.programVersion + "; plan written with " + plan.program + "\n";
    for (const auto& stamp : facts.stamps) text += "Note: " + stamp + "\n";
    return text +
           "The file preregistration.json beside this one holds the same plan and the SHA-256 of this text. Its own SHA-256 "
           "stands in the log of the study.\n";
}

}  // namespace

std::string planText(const StudyPlan& plan, const RegistrationStamp& stamp)
{
    return headOf(plan, stamp) + section(1, "Data so far", dataSoFar(stamp)) + section(2, "Hypotheses", hypotheses(plan)) +
           section(3, "Measures", measures(plan)) + section(4, "Design", design(plan)) + section(5, "Analyses", analyses(plan)) +
           section(6, "Exclusions, missing and voided answers", exclusions(plan)) +
           section(7, "Number of participants", size(plan)) + section(8, "Power", power(plan)) +
           section(9, "Identity", identity(plan));
}

}  // namespace study::making
