// What the participant sees on a screen of their own: one value, which the window on a second screen and the page in a tablet's
// browser both show. It holds sentences, the line of the scale and the clock of a break. It has no place for a fabric, a code or
// a condition.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocols/answer_kind.h"

namespace study::participant {

/// What the participant can do on the page.
enum class Task { Read, Consent, Facts, Scale };

/// The last place on the line, after the participant has named it.
struct ScaleFeedback {
    protocols::Tenths shown, named;
    bool isRight = false;
    std::string text;
    bool operator==(const ScaleFeedback&) const = default;
};

struct ScaleTask {
    protocols::RatingScale scale;
    std::string low, high;                   ///< the ends of the line: "0 unrelated"
    std::optional<protocols::Tenths> asked;  ///< the place to find; empty when the training is complete
    std::string tap;                         ///< "Tap the place of 3.5.", where the participant can tap
    std::string say;                         ///< "Which number belongs to the mark? Say it.", where they cannot
    std::string count;                       ///< "2 of 3 right in a row"
    std::optional<ScaleFeedback> last;
    bool operator==(const ScaleTask&) const = default;
};

struct Instruction {
    Task task = Task::Read;
    std::string title;
    std::vector<std::string> lines;
    std::string statement;               ///< what the participant agrees to (Task::Consent)
    std::vector<std::string> questions;  ///< about the participant (Task::Facts)
    std::optional<ScaleTask> scale;      ///< Task::Scale
    std::optional<int> breakSeconds;     ///< how long the break has lasted, s
    std::string breakClock;              ///< "The break has lasted {time}"
    bool operator==(const Instruction&) const = default;
};

/// The same instruction at the same moment of a break: a difference of the clock alone is none.
bool isSameApartFromTheClock(Instruction a, Instruction b);

/// JSON in one line; always valid UTF-8.
std::string jsonOf(const Instruction& instruction);

/// Reads it back. Throws badInput for anything that jsonOf() does not write. `where` names the source in errors.
Instruction instructionFromJson(std::string_view json, const std::string& where);

}  // namespace study::participant
