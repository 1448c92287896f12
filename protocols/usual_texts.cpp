#include "protocols/usual_texts.h"

#include <array>

namespace protocols {

namespace {

std::string inWords(int number)
{
    constexpr std::array<const char*, 13> words{"no",    "one",   "two",  "three", "four",   "five",  "six",
                                                "seven", "eight", "nine", "ten",   "eleven", "twelve"};
    const auto place = static_cast<std::size_t>(number);
    return place < words.size() ? words[place] : std::to_string(number);
}

std::string slotLetter(int slot) { return {static_cast<char>('A' + slot)}; }

/// "A, B or C"; a longer list than can be kept in mind becomes "A to K".
std::string lettersOf(int pieces)
{
    constexpr int mostToName = 6;
    if (pieces > mostToName) return "A to " + slotLetter(pieces - 1);
    std::string letters = "A";
    for (int slot = 1; slot < pieces; ++slot) letters += (slot + 1 == pieces ? " or " : ", ") + slotLetter(slot);
    return letters;
}

std::string choiceText(const AnswerKind& task)
{
    const int pieces = piecesOnTray(task);
    if (pieces < 2) return "Which piece of fabric feels like the screen?";
    return "Which of the " + inWords(pieces) + " pieces of fabric feels like the screen: " + lettersOf(pieces) + "?";
}

/// A sentence of each edition.
struct UsualText {
    const char* before06;
    const char* current;

    std::string of(ProtocolEdition edition) const { return edition == ProtocolEdition::Before06 ? before06 : current; }
};

constexpr const char* choiceBefore06 = "Which of the showed fabric pieces does the haptic rendering match with?";
constexpr UsualText slipperiness{"Does the haptic rendering have the same slipperiness as the physical fabric?",
                                 "How closely does the screen match the fabric in slipperiness?"};
constexpr UsualText texture{"Does the haptic rendering have the same texture as the physical fabric?",
                            "How closely does the screen match the fabric in texture?"};
constexpr UsualText realism{"How much realism of haptic rendering do you feel compared with physical fabric?",
                            "How real does the screen feel, compared with the fabric?"};
constexpr UsualText consent{
    "The participant has read the information sheet, was told that they may stop at any time without giving a reason, "
    "and has agreed to take part",
    "The participant has read the information sheet. They know that they may stop at any time without giving a reason. They have "
    "agreed to take part."};
constexpr UsualText strokeWords{
    "Stroke from left to right with one finger, lightly, at about the width of the hand in two seconds; lift the finger on the "
    "way back. Stroke the glass and the cloth the same way, as often as you like.",
    "Stroke from left to right with one finger. Press lightly. Take two seconds for the width of your hand. Lift the finger on "
    "the way back. Stroke the glass and the fabric in the same way, as often as you like."};

}  // namespace

std::string usualTextOf(const QuestionId& question, const AnswerKind& task, ProtocolEdition edition)
{
    if (question.value == "Q1") return edition == ProtocolEdition::Before06 ? choiceBefore06 : choiceText(task);
    if (question.value == "Q2") return slipperiness.of(edition);
    if (question.value == "Q3") return texture.of(edition);
    if (question.value == "Q4") return realism.of(edition);
    return "";
}

std::string usualConsent(ProtocolEdition edition) { return consent.of(edition); }

std::string usualStrokeWords(ProtocolEdition edition) { return strokeWords.of(edition); }

}  // namespace protocols
