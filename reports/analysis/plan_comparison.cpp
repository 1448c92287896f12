#include "reports/analysis/plan_comparison.h"

#include <algorithm>
#include <map>
#include <set>

#include "protocols/files/number_text.h"
#include "reports/analysis/study_analysis.h"
#include "reports/data/design_limits.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

/// What the answers cover.
struct Answered {
    std::set<std::string> participants, fabrics, conditions, questions;

    explicit Answered(const StudyData& data)
    {
        for (const StudyResponse& response : data.responses) {
            participants.insert(response.participant);
            fabrics.insert(response.fabric);
            conditions.insert(response.condition);
            questions.insert(response.question);
        }
    }
};

Accord accordOf(bool isAsPlanned) { return isAsPlanned ? Accord::AsPlanned : Accord::Deviates; }

std::string boundsText(const std::pair<double, double>& bounds)
{
    return protocols::shortest(bounds.first) + " and " + protocols::shortest(bounds.second);
}

/// Names in `wanted` that are not in `found`, in their order.
std::vector<std::string> absentFrom(const std::set<std::string>& found, const std::vector<std::string>& wanted)
{
    std::vector<std::string> absent;
    for (const std::string& name : wanted)
        if (!found.contains(name)) absent.push_back(name);
    return absent;
}

std::vector<std::string> unplannedIn(const std::set<std::string>& found, const std::vector<std::string>& planned)
{
    std::vector<std::string> unplanned;
    for (const std::string& name : found)
        if (std::ranges::find(planned, name) == planned.end()) unplanned.push_back(name);
    return unplanned;
}

/// "5", or "5; without answers: h; not planned: k".
std::string coverText(std::size_t count, const std::vector<std::string>& absent, const std::vector<std::string>& unplanned)
{
    std::string text = std::to_string(count);
    if (!absent.empty()) text += "; without answers: " + listed(absent);
    if (!unplanned.empty()) text += "; not planned: " + listed(unplanned);
    return text;
}

/// A row that compares counts, and names where they are known. `ids` may be empty.
PlanRow coverRow(const StudyData& data, const std::string& item, std::size_t planned, const std::vector<std::string>& ids,
                 const std::set<std::string>& answered)
{
    if (data.blinded && answered.empty()) return {item, std::to_string(planned), "nobody has finished yet", Accord::Unknown};
    const std::vector<std::string> absent = absentFrom(answered, ids), unplanned = ids.empty() ? ids : unplannedIn(answered, ids);
    return {item, std::to_string(planned), coverText(answered.size(), absent, unplanned),
            accordOf(absent.empty() && unplanned.empty() && answered.size() == planned)};
}

const Registration* followedOf(const StudyData& data)
{
    for (const Registration& registration : data.registrations)
        if (registration.isFollowed) return &registration;
    return nullptr;
}

std::string whenText(const Registration& registration)
{
    return "registered on " + registration.time + ", " + timingText(registration.answersBefore, registration.afterUnblinding);
}

PlanRow registrationRow(const StudyData& data)
{
    const std::string wanted = "before the first answer";
    if (const Registration* followed = followedOf(data))
        return {"registration", wanted, whenText(*followed), accordOf(isInTime(*followed))};
    const std::string ofVersion =
        data.planVersion > 0 ? "; the plan is that of version " + std::to_string(data.planVersion) + " of the protocol" : "";
    if (!data.registrations.empty())
        return {"registration", wanted, whenText(data.registrations.front()) + ofVersion, Accord::Deviates};
    return {"registration", "-", data.hasLog ? "not preregistered" + ofVersion : "no registration is known", Accord::Unknown};
}

std::string amendmentText(const Registration& amendment)
{
    return "registration " + std::to_string(amendment.number) + " on " + amendment.time + ", " +
           timingText(amendment.answersBefore, amendment.afterUnblinding) + " (" + listed(amendment.changes) +
           (amendment.isFollowed ? "; followed here)" : "; not followed here)");
}

/// Amendments before the first answer belong to the plan; later ones deviate from it.
void addAmendments(std::vector<PlanRow>& rows, const StudyData& data)
{
    if (data.registrations.size() < 2) return;
    std::vector<std::string> amendments;
    bool inTime = true;
    for (std::size_t i = 1; i < data.registrations.size(); ++i) {
        amendments.push_back(amendmentText(data.registrations[i]));
        inTime = inTime && isInTime(data.registrations[i]);
    }
    rows.push_back({"amendments", "none after the first answer", listed(amendments), accordOf(inTime)});
}

std::string shortHash(const std::string& sha256) { return sha256.substr(0, 12); }

PlanRow protocolRow(const StudyData& data)
{
    const PlannedDesign& design = *data.plannedDesign;
    std::string done = shortHash(data.protocolInUse);
    if (!data.protocolChanges.empty()) done += "; changed: " + listed(data.protocolChanges) + "; the plan is followed here";
    if (!data.changedTexts.empty())
        done += (data.protocolChanges.empty() ? "; changed: " : "; also changed: ") + listed(data.changedTexts);
    return {"protocol (SHA-256)", shortHash(design.protocolSha256), done, accordOf(design.protocolSha256 == data.protocolInUse)};
}

PlanRow participantsRow(const StudyData& data, const Answered& answered)
{
    const std::size_t planned = data.plannedDesign->participants, count = answered.participants.size();
    PlanRow row{"participants", std::to_string(planned), std::to_string(count) + (data.blinded ? " finished" : ""),
                accordOf(count == planned)};
    if (!data.withdrawn.empty()) row.done += "; withdrew: " + std::to_string(data.withdrawn.size());
    if (!data.erased.empty()) row.done += "; answers erased: " + std::to_string(data.erased.size());
    return row;
}

/// Whether an answered question was asked in other words than planned. Only an amendment can change them.
bool isReworded(const StudyData& data, const QuestionInfo& question, const Answered& answered)
{
    const auto& texts = data.plannedDesign->texts;
    const auto planned = std::ranges::find(texts, wordingNameOf(question.id), &PlannedText::name);
    if (data.protocolVersions.empty() || planned == texts.end() || !answered.questions.contains(question.id)) return false;
    if (question.wordings.empty()) return question.text != planned->text;
    return std::ranges::any_of(question.wordings, [&](const SentenceWording& one) { return one.text != planned->text; });
}

PlanRow questionsRow(const StudyData& data, const Answered& answered)
{
    const PlannedDesign& design = *data.plannedDesign;
    PlanRow row = coverRow(data, "questions", design.questions.size(), design.questions, answered.questions);
    std::vector<std::string> reworded;
    for (const QuestionInfo& question : data.questions)
        if (isReworded(data, question, answered)) reworded.push_back(question.id);
    if (reworded.empty()) return row;
    row.done += "; reworded: " + listed(reworded);
    row.accord = Accord::Deviates;
    return row;
}

/// The questions in which each planned contrast was tested, with the reason where it was not.
class ContrastSearch {
public:
    explicit ContrastSearch(const StudyAnalysis& analysis)
        : m_answered(analysis.data), m_areOthersAsked(analysis.data.plannedFrom == PlanOrigin::Option)
    {
        for (const QuestionAnalysis& question : analysis.questions) {
            const QuestionClaims* claims = claimsOf(question);
            if (claims == nullptr) continue;
            m_questions.push_back(question.question.id);
            for (const ContrastFinding& finding : claims->contrasts) {
                // One of the two generalisations is enough.
                auto& why = m_why.try_emplace({question.question.id, finding.a, finding.b}, finding.claim.mean.why).first->second;
                if (finding.claim.mean.why.empty()) why.clear();
            }
        }
    }

    ContrastDone find(const std::string& a, const std::string& b, bool isPrimary) const
    {
        ContrastDone done{a, b, isPrimary, {}, {}, absentFrom(m_answered.conditions, {a, b}), {}};
        for (const std::string& question : m_questions) {
            const auto found = m_why.find({question, a, b});
            const bool isTested = found != m_why.end() && found->second.empty();
            (isTested ? done.testedIn : done.untested).push_back(question);
            if (!isTested && done.why.empty()) done.why = whyNot(done, found == m_why.end() ? whyNotAsked() : found->second);
        }
        return done;
    }

private:
    static std::string whyNot(const ContrastDone& done, const std::string& why)
    {
        return done.unanswered.empty() ? why : "no answers under " + listed(done.unanswered);
    }

    std::string whyNotAsked() const { return m_areOthersAsked ? "the option --planned names other contrasts" : ""; }

    Answered m_answered;
    bool m_areOthersAsked;
    std::vector<std::string> m_questions;
    std::map<std::tuple<std::string, std::string, std::string>, std::string> m_why;
};

PlanRow primaryRow(const StudyData& data, const std::vector<ContrastDone>& contrasts)
{
    if (data.blinded) return {"primary contrast", "left out while blinded", "-", Accord::Unknown};
    if (contrasts.empty()) return {"primary contrast", "none", "-", Accord::Unknown};
    const ContrastDone& primary = contrasts.front();
    const std::string done = primary.testedIn.empty() ? "not tested: " + primary.why : "tested in " + listed(primary.testedIn);
    return {"primary contrast", contrastName(primary),
            done + (primary.untested.empty() || primary.testedIn.empty()
                        ? ""
                        : "; not in " + listed(primary.untested) + ": " + primary.why),
            accordOf(primary.untested.empty() && !primary.testedIn.empty())};
}

/// What was done where the plan has no contrast.
PlanRow allPairsRow(const StudyData& data)
{
    const std::string planned = "none: all pairs";
    if (!data.planned.empty())
        return {"planned contrasts", planned, counted(data.planned.size(), "contrast") + " of the option --planned",
                Accord::Deviates};
    if (!comparesAllPairs(data)) return {"planned contrasts", planned, "none tested (needs --pairs)", Accord::Deviates};
    return {"planned contrasts", planned, "all pairs", Accord::AsPlanned};
}

PlanRow contrastsRow(const StudyData& data, const std::vector<ContrastDone>& contrasts)
{
    const std::size_t planned = data.plannedDesign->contrasts;
    if (data.blinded)
        return {"planned contrasts", planned == 0 ? "none: all pairs" : std::to_string(planned), "left out while blinded",
                Accord::Unknown};
    if (planned == 0) return allPairsRow(data);
    const auto whole = static_cast<std::size_t>(
        std::ranges::count_if(contrasts, [](const ContrastDone& one) { return one.untested.empty() && !one.testedIn.empty(); }));
    const auto none =
        static_cast<std::size_t>(std::ranges::count_if(contrasts, [](const ContrastDone& one) { return one.testedIn.empty(); }));
    std::string done = std::to_string(whole) + " tested";
    if (const std::size_t part = planned - whole - none; part > 0)
        done += ", " + std::to_string(part) + " in part of the questions";
    if (none > 0) done += ", " + std::to_string(none) + " not tested";
    return {"planned contrasts", std::to_string(planned), done, accordOf(whole == planned)};
}

PlanRow exclusionRow(const StudyData& data, const Screening& screening)
{
    const std::string flagged =
        screening.excluded.empty() ? "nobody is flagged" : counted(screening.excluded.size(), "participant") + " flagged";
    PlanRow row{"excluded participants", "nobody; flagged ones are left out beside the main analysis", "nobody; " + flagged,
                Accord::AsPlanned};
    if (!data.blinded) return row;
    row.done = "no analysis while blinded; " + flagged + " by the rules that need no key";
    row.accord = Accord::Unknown;
    return row;
}

PlanRow answersRow(const StudyData& data, const Completeness& completeness)
{
    // Completeness counts catch trials and anchors of a blinded study, too; `data` holds its finished participants.
    const std::size_t present = data.blinded ? data.responses.size() : completeness.present;
    std::string done = std::to_string(present);
    if (data.voided > 0) done += "; " + counted(data.voided, "presentation") + " voided and presented again";
    return {"answers", std::to_string(data.plannedDesign->answers()), done, accordOf(present == data.plannedDesign->answers())};
}

}  // namespace

std::string contrastName(const ContrastDone& contrast) { return contrast.a + " - " + contrast.b; }

PlanComparison comparePlan(const StudyAnalysis& analysis)
{
    PlanComparison plan;
    const StudyData& data = analysis.data;
    if (!data.plannedDesign) return plan;
    const PlannedDesign& design = *data.plannedDesign;
    const Answered answered(data);
    const ContrastSearch search(analysis);
    for (const auto& [a, b] : design.contrastPairs) plan.contrasts.push_back(search.find(a, b, plan.contrasts.empty()));
    plan.rows = {registrationRow(data)};
    addAmendments(plan.rows, data);
    plan.rows.push_back(protocolRow(data));
    plan.rows.push_back(participantsRow(data, answered));
    plan.rows.push_back(coverRow(data, "fabrics", design.fabrics, design.fabricIds, answered.fabrics));
    plan.rows.push_back(coverRow(data, "conditions", design.conditions, design.conditionIds, answered.conditions));
    plan.rows.push_back(questionsRow(data, answered));
    plan.rows.push_back(primaryRow(data, plan.contrasts));
    plan.rows.push_back(contrastsRow(data, plan.contrasts));
    plan.rows.push_back({"bounds of equivalence", boundsText(design.equivalenceBounds), boundsText(data.equivalenceBounds),
                         accordOf(design.equivalenceBounds == data.equivalenceBounds)});
    plan.rows.push_back(exclusionRow(data, analysis.screening));
    plan.rows.push_back(answersRow(data, analysis.completeness));
    return plan;
}

std::vector<PlanRow> deviationsOf(const PlanComparison& plan)
{
    std::vector<PlanRow> deviations;
    for (const PlanRow& row : plan.rows)
        if (row.accord == Accord::Deviates) deviations.push_back(row);
    return deviations;
}

std::string nameOf(Accord accord)
{
    switch (accord) {
        case Accord::AsPlanned:
            return "yes";
        case Accord::Deviates:
            return "no";
        case Accord::Unknown:
            break;
    }
    return "-";
}

}  // namespace reports
