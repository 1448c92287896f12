// The protocol of a study as a value: participants, fabrics, conditions, phases with their questions, breaks, equivalence bounds,
// planned contrasts. protocol_json.h reads it from a file; counterbalancing.h draws the running orders.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocols/answer_kind.h"
#include "protocols/ids.h"

namespace protocols {

/// One question with the sentence that is said to the participant.
struct Question {
    QuestionId id;
    std::string text;
    AnswerKind kind;
    bool operator==(const Question&) const = default;
};

/// What a block of presentations asks of the participant's speed.
enum class SpeedAim { None, Speed, Accuracy };

/// One level of the factor "instruction" of a phase: to be fast, to be accurate, or to answer before a deadline.
struct BlockInstruction {
    InstructionId id;
    SpeedAim aim = SpeedAim::None;
    std::optional<double> deadlineSeconds;  ///< for each answer, from the first touch to the beginning of the answer
    std::string text;                       ///< the operator says it at the beginning of a block
    bool operator==(const BlockInstruction&) const = default;
};

/// What a presentation is beside those of the list.
enum class AnchorKind {
    None,        ///< one of the list, or a catch trial
    Mismatched,  ///< the image of one fabric, with another fabric on the tray
    Repeated,    ///< a presentation of the list for the second time
};

/// Presentations beside those of a phase's list. Mismatched ones show the least that ratings can be (the floor). Repeated ones
/// show how well answers agree with themselves, and so the most that they can reach (the ceiling). No analysis of a condition
/// uses their answers.
struct Anchors {
    int mismatched = 0;     ///< of a phase of ratings
    int repeated = 0;       ///< of any phase
    ConditionId condition;  ///< whose images are mismatched; empty: none is named (see anchorConditionOf)

    int presentations() const { return mismatched + repeated; }
    bool operator==(const Anchors&) const = default;
};

/// A run of presentations, each condition x fabric once. Its questions are asked one after another in every presentation.
/// `catchTrials` more presentations leave the glass blank. With instructions the whole run is repeated under each of them, so
/// that every condition x fabric is answered under every instruction; the participants' orders of the instructions differ.
struct Phase {
    std::vector<Question> questions;
    AnswerKind task;  ///< what a question asks for unless it is answered in free text; decides what lies on the tray
    int catchTrials = 0;
    TrayAim trayAim = TrayAim::EvenSlots;  ///< of a choice phase
    std::vector<BlockInstruction> instructions = {};
    Anchors anchors = {};

    /// Presentations of one run beside each condition x fabric.
    int extraPresentations() const { return catchTrials + anchors.presentations(); }
    /// How often the run is repeated: the number of instructions, or once.
    int runs() const { return instructions.empty() ? 1 : static_cast<int>(instructions.size()); }
    bool operator==(const Phase&) const = default;
};

struct PlannedContrast {
    ConditionId a;
    ConditionId b;
    bool operator==(const PlannedContrast&) const = default;
};

/// The neutral codes on the fabric pieces. They keep names from suggesting an answer.
enum class SwatchCodes {
    Once,            ///< the same labels for the whole study
    PerParticipant,  ///< new labels for each participant, by the preparation sheet
};

struct Protocol {
    std::string name;
    int participants = 10;
    int fabricCount = 7;
    std::vector<FabricId> fabrics;  ///< by name; empty: fabricCount of them are drawn by seed
    std::vector<ConditionId> conditions;
    /// Conditions of the lab's own: the folder with a ready friction image for each fabric. A relative one lies beside the
    /// protocol. Every id stands in `conditions`, too.
    std::map<ConditionId, std::string> ownImages;
    /// Conditions of the lab's own whose images a program makes. The lab names the program when it makes the study.
    std::set<ConditionId> ownPrograms;
    std::vector<Phase> phases;
    std::pair<double, double> equivalenceBounds{-0.5, 0.5};  ///< scale points
    bool hasUsualBounds = false;  ///< the file states no bounds: they are usualBoundsOf() its phases, the default of this program
    std::vector<PlannedContrast> planned;
    std::optional<PlannedContrast> primary;  ///< one of the planned contrasts; missing: the first
    double secondsPerPresentation = 25;
    int breakAfterPresentations = 21;      ///< a block: the presentations between two breaks
    std::optional<int> breakAfterMinutes;  ///< a break is also due after this time without one
    int sittingMinutes = 60;
    std::vector<std::string> checklist;  ///< the operator reads and ticks these lines before a sitting
    std::vector<std::string> readings;   ///< measured with the checklist: "temperature in °C", ...
    std::vector<std::string> facts;      ///< about the participant, each optional: age, gender, ...
    std::string consent;                 ///< the operator confirms it when the participant has agreed
    std::string strokeWords;             ///< the operator says how to stroke glass and fabric
    SwatchCodes swatchCodes = SwatchCodes::Once;
    int familiarisationFabrics = 0;  ///< at most; not among those of the study; fewer if the data set has fewer
    bool secondEntry = false;        ///< the operator enters every answer twice; both must agree
    double deadTimeSeconds = 0.7;    ///< a new tray cannot be confirmed within it, so that a key that bounces arms nothing
    bool confirmPieces = false;      ///< the operator scans or types the code of every piece on the tray
    std::string language = "en";     ///< BCP 47 tag of what the participant reads and hears
    /// Sentences for the participant by key (usualParticipantTexts()); a missing one is the usual text.
    std::map<std::string, std::string> participantTexts;
    /// Recordings for the headphones by key (isPromptKey()): names of WAV files beside the protocol.
    std::map<std::string, std::string> prompts;

    /// Conditions x fabrics, without catch trials and anchors, under one instruction.
    int presentationsPerPhase() const { return fabricCount * static_cast<int>(conditions.size()); }
    /// Presentations for one participant, with catch trials and anchors.
    int presentations() const;
    /// Breaks by count for one participant: one between two lists (phases and instructions), and one in a list after every
    /// `breakAfterPresentations`. A session may have more by time.
    int breaks() const;
    int answersPerParticipant() const;
    /// Answers of one participant to one fabric under one condition: every question, under each instruction of its phase.
    int answersPerRendering() const;
    /// Planned time without breaks.
    double minutesPerParticipant() const { return presentations() * secondsPerPresentation / 60; }
    /// At least one.
    int sittingsPerParticipant() const;
    bool operator==(const Protocol&) const = default;
};

/// The planned contrasts in their order, but the primary one first.
std::vector<PlannedContrast> contrastsInOrder(const Protocol& protocol);

/// Whether the condition is one of the lab's own, by ready images or by a program.
bool isOwnCondition(const Protocol& protocol, const ConditionId& id);

/// The question with this id; null where the protocol asks no such question.
const Question* questionWith(const Protocol& protocol, const QuestionId& id);

/// The instruction with this id; null where there is none.
const BlockInstruction* instructionWith(const std::vector<BlockInstruction>& instructions, const InstructionId& id);

/// "speed", "accuracy"; empty for none.
std::string nameOf(SpeedAim aim);
/// None for any other name.
SpeedAim speedAimNamed(std::string_view name);

/// Whether any phase instructs the participant.
bool hasInstructions(const Protocol& protocol);

/// "mismatched", "repeated"; empty for none.
std::string nameOf(AnchorKind kind);
/// Empty for any other name.
std::optional<AnchorKind> anchorKindNamed(std::string_view name);

/// Whether any phase has anchors.
bool hasAnchors(const Protocol& protocol);

/// The condition of mismatched images: the one that the anchors name, else the best measured one of the protocol. That is the
/// first of h&f, h, f, t_grey and gradient that it has, at its best quality. Empty where the protocol has none of them.
ConditionId anchorConditionOf(const Protocol& protocol, const Anchors& anchors);

/// Bounds of equivalence where nobody states any: a twentieth of the scale either way, ±0.5 on the paper's scale from 0 to 10.
std::pair<double, double> usualBoundsOn(const RatingScale& scale);

/// The same for all ratings of these phases. Of several lengths of scale the shortest counts: bounds of a longer one would call
/// clear differences equivalent. ±0.5 where nothing is rated.
std::pair<double, double> usualBoundsOf(const std::vector<Phase>& phases);

/// The scale that the participants memorise: that of the first phase with ratings; null where nothing is rated.
const RatingScale* memorisedScaleOf(const Protocol& protocol);

/// The sentence for the participant with this key: the protocol's, one from its own texts for the ends of the scale
/// (textFromOwnEnds()), or the usual one. `key` is one of usualParticipantTexts().
std::string participantText(const Protocol& protocol, std::string_view key);

/// Whether a recording can have this key: "wait", "feel", "break", "end", "same", "different", "point"; "question_ID" for a
/// question of the protocol; "answer_A" to "answer_Z"; "number_0" to "number_999".
bool isPromptKey(const Protocol& protocol, std::string_view key);

/// The parts that `changed` changes although participants have trials that follow `kept`: "phases", "conditions", ... Empty if
/// only texts, times, bounds, contrasts, checklist and facts differ.
std::vector<std::string> fixedPartsChanged(const Protocol& kept, const Protocol& changed);

/// All faults, each "place: what is wrong, what was expected"; empty if a study can follow the protocol.
std::vector<std::string> faultsOf(const Protocol& protocol);

}  // namespace protocols
