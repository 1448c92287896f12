// The kinds of answer that a question can ask for, as one variant. Every place that treats kinds differently visits it, so
// that the compiler names each such place when a kind is added.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "protocols/ids.h"

namespace protocols {

/// The scale of a rating. The paper's is the Haptic Analog Scale: 0 unrelated, 10 totally the same.
struct RatingScale {
    Tenths min{0};
    Tenths max{100};
    Tenths step{1};                   ///< the smallest spoken difference
    int sections = 9;                 ///< equal sections of the line that the participant memorises; 1: a plain line
    std::vector<std::string> labels;  ///< a Likert scale's words, one a step from min to max; empty: numbers only

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

/// One function object out of several lambdas, for std::visit.
template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

/// "choice", "rating", "same_different" or "free_text": the kind's name in files.
std::string nameOf(const AnswerKind& kind);

/// Number of answers of which one is right: m of a forced choice, 2 of same/different; 0 where nothing is right or wrong.
int alternativesOf(const AnswerKind& kind);

}  // namespace protocols
