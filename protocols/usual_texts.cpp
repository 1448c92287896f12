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

}  // namespace

std::string usualTextOf(const QuestionId& question, const AnswerKind& task)
{
    if (question.value == "Q1") return choiceText(task);
    if (question.value == "Q2") return "How closely does the screen match the fabric in slipperiness?";
    if (question.value == "Q3") return "How closely does the screen match the fabric in texture?";
    if (question.value == "Q4") return "How real does the screen feel, compared with the fabric?";
    return "";
}

std::string usualConsent()
{
    return "The participant has read the information sheet. They know that they may stop at any time without giving a reason. "
           "They have agreed to take part";
}

std::string usualStrokeWords()
{
    return "Stroke from left to right with one finger. Press lightly. Take two seconds for the width of your hand. Lift the "
           "finger on the way back. Stroke the glass and the fabric in the same way, as often as you like.";
}

}  // namespace protocols
