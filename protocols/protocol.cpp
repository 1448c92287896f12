#include "protocols/protocol.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "protocols/condition.h"
#include "protocols/usual_texts.h"

namespace protocols {

namespace {

using Faults = std::vector<std::string>;

std::string element(const std::string& list, std::size_t index) { return list + "[" + std::to_string(index) + "]"; }

std::string knownConditions()
{
    std::string text;
    for (const Condition& condition : allConditions()) text += (text.empty() ? "" : ", ") + std::string(condition.id);
    return text;
}

void checkCounts(const Protocol& p, Faults& faults)
{
    if (p.name.empty()) faults.push_back("name: is empty, expected a name for the study");
    if (p.participants < 1) faults.push_back("participants: " + std::to_string(p.participants) + ", expected at least 1");
    if (p.fabricCount < 1) faults.push_back("fabrics: " + std::to_string(p.fabricCount) + ", expected at least 1");
    if (!p.fabrics.empty() && static_cast<int>(p.fabrics.size()) != p.fabricCount)
        faults.push_back("fabrics: " + std::to_string(p.fabrics.size()) + " are named, expected " +
                         std::to_string(p.fabricCount));
    std::set<FabricId> seen;
    for (std::size_t i = 0; i < p.fabrics.size(); ++i) {
        if (p.fabrics[i].empty()) faults.push_back(element("fabrics", i) + ": is empty, expected the id of a fabric");
        if (!seen.insert(p.fabrics[i]).second)
            faults.push_back(element("fabrics", i) + ": '" + p.fabrics[i].value + "' is named twice, expected each fabric once");
    }
}

void checkConditions(const Protocol& p, Faults& faults)
{
    if (p.conditions.empty()) faults.push_back("conditions: is empty, expected at least one of " + knownConditions());
    std::set<ConditionId> seen;
    for (std::size_t i = 0; i < p.conditions.size(); ++i) {
        const ConditionId& id = p.conditions[i];
        if (isOwnCondition(p, id)) {
            if (const std::string fault = faultOfOwnId(id.value); !fault.empty())
                faults.push_back(element("conditions", i) + ".id: " + fault);
            const auto images = p.ownImages.find(id);
            if (images != p.ownImages.end() && images->second.empty())
                faults.push_back(element("conditions", i) + ".images: is empty, expected the folder of the images");
        } else if (const auto fault = faultOf(id.value))
            faults.push_back(element("conditions", i) + ": " + fault->what + ", expected " + fault->expected);
        if (!seen.insert(id).second)
            faults.push_back(element("conditions", i) + ": '" + id.value + "' is named twice, expected each condition once");
    }
}

/// A task with a right answer takes one question; ratings take several.
void checkTask(const Protocol& p, const Phase& phase, const std::string& place, Faults& faults)
{
    for (const std::string& fault : faultsOf(phase.task, p.fabricCount, place)) faults.push_back(fault);
    if (phase.catchTrials < 0 || phase.catchTrials > p.presentationsPerPhase())
        faults.push_back(place + ".catch_trials: " + std::to_string(phase.catchTrials) +
                         ", expected at most the number of presentations in the phase");
    const auto scored = std::ranges::count_if(phase.questions, [](const Question& q) { return alternativesOf(q.kind) > 0; });
    if (alternativesOf(phase.task) > 0 && scored != 1)
        faults.push_back(place + ".questions: " + std::to_string(scored) +
                         " questions with a right answer, expected one (and any number in free_text)");
}

/// The faults that make anchors impossible.
void checkAnchors(const Protocol& p, const Phase& phase, const std::string& place, Faults& faults)
{
    const Anchors& anchors = phase.anchors;
    const std::string mismatched = place + ".mismatched: " + std::to_string(anchors.mismatched);
    const std::string repeated = place + ".repeated: " + std::to_string(anchors.repeated);
    const auto isPossible = [&](int count) { return count >= 0 && count <= p.presentationsPerPhase(); };
    const std::string possible =
        ", expected 0 to " + std::to_string(p.presentationsPerPhase()) + ", the presentations of the phase";
    if (!isPossible(anchors.mismatched)) faults.push_back(mismatched + possible);
    if (!isPossible(anchors.repeated)) faults.push_back(repeated + possible);
    if (anchors.repeated > 0 && p.presentationsPerPhase() == 1)
        faults.push_back(repeated + ", expected 0: the phase has one presentation, so that none can lie between the two");
    if (!anchors.condition.empty() && std::ranges::find(p.conditions, anchors.condition) == p.conditions.end())
        faults.push_back(place + ".condition: '" + anchors.condition.value +
                         "' is not among the conditions, expected one of the protocol's conditions");
    if (anchors.mismatched < 1) return;
    if (!std::holds_alternative<TrueAlone>(trayRuleOf(phase.task)))
        faults.push_back(mismatched + ", expected 0: only a phase with a scale can have mismatched presentations");
    if (p.fabricCount == 1)
        faults.push_back(mismatched + ", expected 0: the study has one fabric, so that no other can lie on the tray");
    if (!p.conditions.empty() && anchorConditionOf(p, anchors).empty())
        faults.push_back(place +
                         ".condition: is missing, expected one of the protocol's conditions, because none of them is measured");
}

void checkQuestions(const Phase& phase, const std::string& place, std::set<QuestionId>& seen, Faults& faults)
{
    if (phase.questions.empty()) faults.push_back(place + ".questions: is empty, expected at least one question");
    for (std::size_t i = 0; i < phase.questions.size(); ++i) {
        const Question& question = phase.questions[i];
        const std::string its = element(place + ".questions", i) + ": '" + question.id.value + "'";
        if (!seen.insert(question.id).second) faults.push_back(its + " is asked twice, expected each question once");
        if (question.text.empty()) faults.push_back(its + " has no text, expected one in question_texts");
    }
}

constexpr int mostInstructions = 6;  // as the schema has it
constexpr double shortestDeadlineSeconds = 0.1, longestDeadlineSeconds = 3600;

std::string withoutCase(std::string text)
{
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

void checkInstructions(const std::vector<BlockInstruction>& instructions, const std::string& place, Faults& faults)
{
    std::set<std::string> seen;
    if (static_cast<int>(instructions.size()) > mostInstructions)
        faults.push_back(place + ": names " + std::to_string(instructions.size()) + ", expected at most " +
                         std::to_string(mostInstructions));
    for (std::size_t i = 0; i < instructions.size(); ++i) {
        const BlockInstruction& one = instructions[i];
        const std::string its = place + "[" + std::to_string(i) + "]";
        if (one.id.empty()) faults.push_back(its + ".id: is empty, expected a name such as \"speed\"");
        if (!seen.insert(withoutCase(one.id.value)).second)
            faults.push_back(its + ".id: '" + one.id.value +
                             "' is named twice, expected ids that differ also when their case is ignored");
        if (one.deadlineSeconds &&
            !(*one.deadlineSeconds >= shortestDeadlineSeconds && *one.deadlineSeconds <= longestDeadlineSeconds))
            faults.push_back(its + ".deadline_seconds: expected 0.1 to 3600 seconds");
        if (one.text.empty()) faults.push_back(its + ".text: is empty, expected the sentence that the operator says");
    }
}

void checkPhases(const Protocol& p, Faults& faults)
{
    if (p.phases.empty()) faults.push_back("phases: is empty, expected at least one phase");
    std::set<QuestionId> seen;
    for (std::size_t i = 0; i < p.phases.size(); ++i) {
        const std::string place = element("phases", i);
        checkQuestions(p.phases[i], place, seen, faults);
        checkTask(p, p.phases[i], place, faults);
        checkInstructions(p.phases[i].instructions, place + ".instructions", faults);
        checkAnchors(p, p.phases[i], place + ".anchors", faults);
    }
}

void checkPrimary(const Protocol& p, Faults& faults)
{
    if (!p.primary || std::ranges::find(p.planned, *p.primary) != p.planned.end()) return;
    faults.push_back("primary: '" + p.primary->a.value + "' and '" + p.primary->b.value +
                     "' are not a planned contrast in this order, expected a pair of planned");
}

void checkPlanned(const Protocol& p, Faults& faults)
{
    std::set<std::pair<ConditionId, ConditionId>> seen;
    for (std::size_t i = 0; i < p.planned.size(); ++i) {
        const auto& [a, b] = p.planned[i];
        for (const ConditionId* id : {&a, &b}) {
            if (id->empty())
                faults.push_back(element(element("planned", i), id == &a ? 0 : 1) + ": is empty, expected the id of a condition");
            else if (std::ranges::find(p.conditions, *id) == p.conditions.end())
                faults.push_back(element("planned", i) + ": '" + id->value +
                                 "' is not among the conditions, expected a pair of the protocol's conditions");
        }
        if (a.empty() || b.empty()) continue;
        if (a == b) faults.push_back(element("planned", i) + ": compares '" + a.value + "' with itself, expected two conditions");
        if (!seen.insert(std::minmax(a, b)).second)
            faults.push_back(element("planned", i) + ": repeats an earlier contrast, expected each pair once");
    }
}

void checkNumbers(const Protocol& p, Faults& faults)
{
    const auto [lower, upper] = p.equivalenceBounds;
    if (!std::isfinite(lower) || !std::isfinite(upper) || lower >= upper)
        faults.push_back("equivalence_bounds: the lower is not below the upper, expected [lower, upper]");
    if (!std::isfinite(p.secondsPerPresentation) || p.secondsPerPresentation <= 0)
        faults.push_back("seconds_per_presentation: expected more than 0");
    if (p.breakAfterPresentations < 1) faults.push_back("break_after: expected at least 1 presentation");
    if (p.sittingMinutes < 1) faults.push_back("sitting_minutes: expected at least 1 minute");
    if (p.breakAfterMinutes.value_or(1) < 1) faults.push_back("break_after_minutes: expected at least 1 minute");
    if (!(p.deadTimeSeconds >= 0 && p.deadTimeSeconds <= 5)) faults.push_back("dead_time_seconds: expected 0 to 5 seconds");
    if (p.familiarisationFabrics < 0) faults.push_back("familiarisation_fabrics: expected 0 or more");
}

/// The phases without the sentences of their questions and instructions: what running orders and stored answers depend on.
std::vector<Phase> fixedPhasesOf(const Protocol& p)
{
    std::vector<Phase> fixed = p.phases;
    for (Phase& phase : fixed) {
        for (Question& question : phase.questions) question.text.clear();
        for (BlockInstruction& instruction : phase.instructions) instruction.text.clear();
    }
    return fixed;
}

/// In tenths.
int lengthOf(const RatingScale& scale) { return scale.max.value - scale.min.value; }

std::string inBraces(const std::set<std::string>& names)
{
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "{" : ", {") + name + "}";
    return list.empty() ? "no braces" : list;
}

void checkParticipantTexts(const Protocol& p, Faults& faults)
{
    for (const auto& [key, text] : p.participantTexts) {
        const auto usual = usualParticipantTexts().find(key);
        if (usual == usualParticipantTexts().end())
            faults.push_back("participant_texts: '" + key + "' is no text of the participant's page, expected a key such as '" +
                             usualParticipantTexts().begin()->first + "' (see the README)");
        else if (const auto names = placeholdersIn(usual->second); placeholdersIn(text) != names)
            faults.push_back("participant_texts." + key + ": has " + inBraces(placeholdersIn(text)) + ", expected " +
                             inBraces(names));
    }
}

}  // namespace

int Protocol::presentations() const
{
    int count = 0;
    for (const Phase& phase : phases) count += (presentationsPerPhase() + phase.extraPresentations()) * phase.runs();
    return count;
}

int Protocol::breaks() const
{
    const int mostInBlock = std::max(1, breakAfterPresentations);
    int blocks = 0;
    for (const Phase& phase : phases) {
        const int inList = presentationsPerPhase() + phase.extraPresentations();
        blocks += (inList + mostInBlock - 1) / mostInBlock * phase.runs();
    }
    return std::max(0, blocks - 1);
}

int Protocol::answersPerParticipant() const
{
    int count = 0;
    for (const Phase& phase : phases)
        count += (presentationsPerPhase() + phase.extraPresentations()) * phase.runs() * static_cast<int>(phase.questions.size());
    return count;
}

int Protocol::answersPerRendering() const
{
    int count = 0;
    for (const Phase& phase : phases) count += static_cast<int>(phase.questions.size()) * phase.runs();
    return count;
}

int Protocol::sittingsPerParticipant() const
{
    return std::max(1, static_cast<int>(std::ceil(minutesPerParticipant() / sittingMinutes)));
}

std::vector<PlannedContrast> contrastsInOrder(const Protocol& protocol)
{
    std::vector<PlannedContrast> contrasts = protocol.planned;
    if (const auto primary = std::ranges::find(contrasts, protocol.primary.value_or(PlannedContrast()));
        primary != contrasts.end())
        std::rotate(contrasts.begin(), primary, primary + 1);
    return contrasts;
}

bool isOwnCondition(const Protocol& protocol, const ConditionId& id)
{
    return protocol.ownImages.contains(id) || protocol.ownPrograms.contains(id);
}

const Question* questionWith(const Protocol& protocol, const QuestionId& id)
{
    for (const Phase& phase : protocol.phases)
        for (const Question& question : phase.questions)
            if (question.id == id) return &question;
    return nullptr;
}

const BlockInstruction* instructionWith(const std::vector<BlockInstruction>& instructions, const InstructionId& id)
{
    const auto found = std::ranges::find(instructions, id, &BlockInstruction::id);
    return found == instructions.end() ? nullptr : &*found;
}

std::string nameOf(SpeedAim aim)
{
    switch (aim) {
        case SpeedAim::Speed:
            return "speed";
        case SpeedAim::Accuracy:
            return "accuracy";
        case SpeedAim::None:
            break;
    }
    return "";
}

SpeedAim speedAimNamed(std::string_view name)
{
    if (name == "speed") return SpeedAim::Speed;
    return name == "accuracy" ? SpeedAim::Accuracy : SpeedAim::None;
}

bool hasInstructions(const Protocol& protocol)
{
    return std::ranges::any_of(protocol.phases, [](const Phase& phase) { return !phase.instructions.empty(); });
}

std::string nameOf(AnchorKind kind)
{
    switch (kind) {
        case AnchorKind::Mismatched:
            return "mismatched";
        case AnchorKind::Repeated:
            return "repeated";
        case AnchorKind::None:
            break;
    }
    return "";
}

std::optional<AnchorKind> anchorKindNamed(std::string_view name)
{
    for (const AnchorKind kind : {AnchorKind::Mismatched, AnchorKind::Repeated})
        if (nameOf(kind) == name) return kind;
    return std::nullopt;
}

bool hasAnchors(const Protocol& protocol)
{
    return std::ranges::any_of(protocol.phases, [](const Phase& phase) { return phase.anchors.presentations() > 0; });
}

ConditionId anchorConditionOf(const Protocol& protocol, const Anchors& anchors)
{
    if (!anchors.condition.empty()) return anchors.condition;
    for (const std::string_view row : {"h&f", "h", "f", "t_grey", "gradient"})
        for (const std::string_view quality : {"@accurate", "@balanced", "", "@fast"}) {
            const ConditionId id(std::string(row) + std::string(quality));
            if (std::ranges::find(protocol.conditions, id) != protocol.conditions.end()) return id;
        }
    return {};
}

std::pair<double, double> usualBoundsOn(const RatingScale& scale)
{
    const double bound = (scale.max.inScaleUnits() - scale.min.inScaleUnits()) / 20;
    return {-bound, bound};
}

std::pair<double, double> usualBoundsOf(const std::vector<Phase>& phases)
{
    std::optional<RatingScale> shortest;
    for (const Phase& phase : phases)
        for (const Question& question : phase.questions) {
            const auto* rating = std::get_if<Rating>(&question.kind);
            if (rating == nullptr || lengthOf(rating->scale) <= 0) continue;  // a scale without length is a fault of its own
            if (!shortest || lengthOf(rating->scale) < lengthOf(*shortest)) shortest = rating->scale;
        }
    return usualBoundsOn(shortest.value_or(RatingScale()));
}

const RatingScale* memorisedScaleOf(const Protocol& protocol)
{
    for (const Phase& phase : protocol.phases)
        if (const auto* rating = std::get_if<Rating>(&phase.task)) return &rating->scale;
    return nullptr;
}

std::string participantText(const Protocol& protocol, std::string_view key)
{
    const auto own = protocol.participantTexts.find(std::string(key));
    if (own != protocol.participantTexts.end()) return own->second;
    const std::string ofOwnEnds = textFromOwnEnds(protocol, key);
    return ofOwnEnds.empty() ? usualParticipantTexts(protocol.language).find(key)->second : ofOwnEnds;
}

bool isPromptKey(const Protocol& protocol, std::string_view key)
{
    static const std::set<std::string_view> plain{"wait", "feel", "break", "end", "same", "different", "point"};
    if (plain.contains(key)) return true;
    const std::size_t line = key.find('_');
    if (line == std::string_view::npos) return false;
    const std::string_view kind = key.substr(0, line), rest = key.substr(line + 1);
    if (kind == "question") return questionWith(protocol, QuestionId(std::string(rest))) != nullptr;
    if (kind == "answer") return rest.size() == 1 && rest[0] >= 'A' && rest[0] <= 'Z';
    const bool isPlainNumber =
        !rest.empty() && rest.size() <= 3 && rest.find_first_not_of("0123456789") == std::string_view::npos;
    return kind == "number" && isPlainNumber && (rest.size() == 1 || rest[0] != '0');
}

std::vector<std::string> fixedPartsChanged(const Protocol& kept, const Protocol& changed)
{
    std::vector<std::string> parts;
    if (kept.participants != changed.participants) parts.emplace_back("participants");
    if (kept.fabricCount != changed.fabricCount || kept.fabrics != changed.fabrics) parts.emplace_back("fabrics");
    if (kept.conditions != changed.conditions || kept.ownImages != changed.ownImages || kept.ownPrograms != changed.ownPrograms)
        parts.emplace_back("conditions");
    if (fixedPhasesOf(kept) != fixedPhasesOf(changed)) parts.emplace_back("phases");
    // Repetitions lie a block after their originals.
    const bool hasRepetitions = std::ranges::any_of(kept.phases, [](const Phase& phase) { return phase.anchors.repeated > 0; });
    if (hasRepetitions && kept.breakAfterPresentations != changed.breakAfterPresentations) parts.emplace_back("break_after");
    if (kept.swatchCodes != changed.swatchCodes) parts.emplace_back("swatches");
    if (kept.prompts != changed.prompts) parts.emplace_back("prompts");  // the study holds the recordings of its first protocol
    if (kept.familiarisationFabrics != changed.familiarisationFabrics) parts.emplace_back("familiarisation_fabrics");
    return parts;
}

std::vector<std::string> faultsOf(const Protocol& protocol)
{
    Faults faults;
    checkCounts(protocol, faults);
    checkConditions(protocol, faults);
    checkPhases(protocol, faults);
    checkPlanned(protocol, faults);
    checkPrimary(protocol, faults);
    checkNumbers(protocol, faults);
    checkParticipantTexts(protocol, faults);
    for (const auto& [key, file] : protocol.prompts)
        if (!isPromptKey(protocol, key))
            faults.push_back("prompts: '" + key +
                             "' is no prompt, expected wait, feel, break, end, same, different, point, "
                             "question_ID, answer_A or number_5");
    return faults;
}

}  // namespace protocols
