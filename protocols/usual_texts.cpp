#include "protocols/usual_texts.h"

#include <array>

#include "protocols/files/number_text.h"

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

std::string usualInstructionText(const BlockInstruction& instruction)
{
    std::string text;
    switch (instruction.aim) {
        case SpeedAim::Speed:
            text = "Answer as fast as you can. Mistakes are all right now.";
            break;
        case SpeedAim::Accuracy:
            text = "Answer as accurately as you can. Take all the time that you need.";
            break;
        case SpeedAim::None:
            if (!instruction.deadlineSeconds) text = "Answer as accurately and as fast as you can.";
            break;
    }
    if (!instruction.deadlineSeconds) return text;
    const std::string limit = shortest(*instruction.deadlineSeconds);
    return text + (text.empty() ? "" : " ") + "Answer within " + limit + (limit == "1" ? " second" : " seconds") +
           " after your finger touches the screen.";
}

const std::map<std::string, std::string, std::less<>>& usualParticipantTexts()
{
    static const std::map<std::string, std::string, std::less<>> texts{
        {"welcome_title", "Welcome"},
        {"welcome_text",
         "Read the information sheet. The experimenter explains what happens and answers your questions. You may stop at any "
         "time. You do not have to give a reason."},
        {"consent_title", "Consent"},
        {"consent_text", "Read this statement. Then say whether you agree."},
        {"agree", "I agree"},
        {"decline", "I do not agree"},
        {"declined_title", "Thank you"},
        {"declined_text", "You do not have to take part. Tell the experimenter. You can also go back to the statement."},
        {"back", "Back"},
        {"facts_title", "About you"},
        {"facts_text",
         "You do not have to answer these questions. You may leave any line empty. Your answers are stored apart from your "
         "other answers. You can ask us to erase them later."},
        {"send", "Send"},
        {"familiarise_title", "Get to know the display"},
        {"familiarise_text", "The experimenter shows you how to feel the display."},
        {"scale_title", "Learn the scale"},
        {"scale_text", "The line has equal parts. Only its ends have numbers."},
        {"scale_low", "unrelated"},
        {"scale_high", "totally the same"},
        {"scale_tap", "Tap the place of {number}."},
        {"scale_say", "Which number belongs to the mark? Say it."},
        {"scale_right", "Right. Your answer was {named}, and the place is {shown}."},
        {"scale_wrong", "Your answer was {named}. The place is {shown}."},
        {"scale_count", "{count} of {needed} right in a row"},
        {"scale_done", "You know the scale now. The experimenter continues."},
        {"mask_title", "Put on the blindfold and the headphones"},
        {"mask_text", "The experimenter helps you."},
        {"wait_title", "Please wait for the experimenter"},
        {"feel_title", "Feel the display"},
        {"break_title", "Break"},
        {"break_text", "You may lift the blindfold, drink and move your hand. The experimenter tells you when we continue."},
        {"break_clock", "The break has lasted {time}"},
        {"pause_title", "Pause"},
        {"pause_text", "Please wait for the experimenter."},
        {"last_title", "Almost done"},
        {"last_text", "Tell the experimenter what you noticed."},
        {"end_title", "Thank you"},
        {"end_text", "The session is over."},
        {"spoken_same", "the same"},
        {"spoken_different", "different"},
        {"spoken_point", "point"},
        {"code_title", "Enter the code"},
        {"code_text", "The experimenter has a code of six digits for you."},
        {"code_field", "Code"},
        {"code_enter", "Continue"},
        {"code_wrong", "This code is wrong. Try again."},
        {"code_wait", "There were too many wrong codes. Wait {seconds} seconds."},
        {"code_spent", "This code is not valid any more. Ask the experimenter for a new code."},
        {"code_taken", "Another device shows this page. Ask the experimenter for a new code."},
        {"no_connection", "There is no connection. This page continues by itself."},
    };
    return texts;
}

std::set<std::string> placeholdersIn(std::string_view text)
{
    std::set<std::string> names;
    for (std::size_t from = text.find('{'); from != std::string_view::npos; from = text.find('{', from + 1)) {
        const std::size_t to = text.find('}', from);
        if (to == std::string_view::npos) break;
        names.emplace(text.substr(from + 1, to - from - 1));
    }
    return names;
}

}  // namespace protocols
