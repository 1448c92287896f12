// The kinds of answer that a question can ask for, as one variant, and what this folder knows about each kind. Code that
// treats the kinds differently visits the variant without a default, so that the compiler names it when a kind is added.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "protocols/ids.h"

namespace protocols {

class ProtocolPart;

/// The scale of a rating. The paper's is the Haptic Analog Scale: 0 unrelated, 10 totally the same.
struct RatingScale {
    Tenths min{0};
    Tenths max{100};
    Tenths step{1};                   ///< the smallest spoken difference
    int sections = 9;                 ///< equal sections of the line that the participant memorises; 1: a plain line
    std::vector<std::string> labels;  ///< the words of a Likert scale, one a step from min to max; empty: numbers only

    bool holds(Tenths rating) const { return rating >= min && rating <= max && (rating.value - min.value) % step.value == 0; }
    bool operator==(const RatingScale&) const = default;
};

/// Which of `alternatives` fabric pieces on the tray the rendering shows; one is right.
struct ForcedChoice {
    int alternatives = 3;
    bool operator==(const ForcedChoice&) const = default;
};

/// A number on a scale for the one fabric on the tray.
struct Rating {
    RatingScale scale;
    bool operator==(const Rating&) const = default;
};

/// Whether the one fabric on the tray is the fabric of the rendering; one of two answers is right.
struct SameDifferent {
    bool operator==(const SameDifferent&) const = default;
};

/// The participant's own words; nothing is right or wrong.
struct FreeText {
    bool operator==(const FreeText&) const = default;
};

using AnswerKind = std::variant<ForcedChoice, Rating, SameDifferent, FreeText>;

/// The true fabric lies among foils.
struct TrueAmongFoils {
    int pieces = 3;  ///< foils and the true one
    bool operator==(const TrueAmongFoils&) const = default;
};
/// The true fabric lies alone.
struct TrueAlone {
    bool operator==(const TrueAlone&) const = default;
};
/// One fabric lies there: in half of the presentations the true one, else another.
struct TrueOrOther {
    bool operator==(const TrueOrOther&) const = default;
};
/// Which fabric pieces lie on the tray during a presentation.
using TrayRule = std::variant<TrueAmongFoils, TrueAlone, TrueOrOther>;

/// What the trays of a choice phase are drawn for, beside hiding the true slot.
enum class TrayAim {
    EvenSlots,  ///< true fabrics and foils are equally often in each slot
    FewSwaps,   ///< as many pieces as possible stay where they lie from one tray to the next
};

/// One function object out of several lambdas, for std::visit.
template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

/// "choice", "rating", "same_different" or "free_text": the kind's name in result files.
std::string nameOf(const AnswerKind& kind);

/// Number of answers of which one is right: m of a forced choice, 2 of same/different; 0 where nothing is right or wrong.
int alternativesOf(const AnswerKind& kind);

/// What a phase with this task lays on the tray.
TrayRule trayRuleOf(const AnswerKind& task);

/// Number of fabric pieces that lie on the tray at a time.
int piecesOnTray(const AnswerKind& task);

/// Whether a stored answer is right; empty where nothing is right or wrong. `tray`: the fabrics in slot order; `truth`: the
/// fabric of the rendering; `answer`: a fabric id, "same" or "different", or words.
std::optional<bool> isRight(const AnswerKind& kind, const std::vector<FabricId>& tray, const FabricId& truth,
                            const std::string& answer);

/// Place of a stored answer among the alternatives, from 0: the slot of the chosen fabric; 0 "same", 1 "different". Empty where
/// there are no alternatives, and for a fabric that was not on the tray.
std::optional<int> placeAmongAlternatives(const AnswerKind& kind, const std::vector<FabricId>& tray, const std::string& answer);

/// The kinds that a phase of a protocol file declares, by its keys `alternatives`, `scale` and `same_different`; a sound phase
/// declares one. Free text is declared for single questions, by `free_text`.
std::vector<AnswerKind> kindsDeclaredIn(const ProtocolPart& phase);

/// "alternatives, scale and same_different": the keys that declare a kind, for messages.
std::string keysOfKinds();

/// Faults of the task of the phase at `place` ("phases[0]"), each "place: what is wrong, what was expected".
std::vector<std::string> faultsOf(const AnswerKind& task, int fabrics, const std::string& place);

}  // namespace protocols
