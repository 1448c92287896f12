// The sentences that a study uses where its protocol gives none: the questions of the paper, consent, how to stroke. The
// operator reads them to the participant. Also what the participant reads on a screen of their own and on the sheet with their
// data. Each language has a file: protocols/texts/usual_texts.LANGUAGE.json.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/answer_kind.h"
#include "protocols/ids.h"
#include "protocols/protocol.h"
#include "protocols/texts/protocol_edition.h"

namespace protocols {

using TextsByKey = std::map<std::string, std::string, std::less<>>;

/// What one file of usual texts holds. In a text, {name} stands for a value.
struct UsualTexts {
    std::string language;   ///< main part of a BCP 47 tag: "en", "de"
    std::string name;       ///< of the language in English, for the report: "German"
    std::string reviewer;   ///< who speaks the language natively and checked the texts; empty: nobody yet
    std::string studyName;  ///< of the paper's study
    TextsByKey questions;   ///< "Q2", "Q3", "Q4"; "choice" ({count}, {letters}) and "choice_of_one" are Q1
    TextsByKey instructions;
    std::vector<std::string> counts;  ///< "no", "one", ... in words
    TextsByKey letters;               ///< "between", "last" and "range" ({first}, {last}) of "A, B or C"
    std::string consent;
    std::string strokeWords;
    std::vector<std::string> checklist, readings, facts;  ///< of the paper's study
    TextsByKey participant;
    TextsByKey ownData;  ///< of the sheet on which a person reads what a study stores about them
};

/// The languages that have usual texts, English first.
std::vector<std::string> languagesOfUsualTexts();

/// Whether the main part of the tag has usual texts: "de-CH" has those of "de". "zh-Hant" and "zh-TW" have none, because those of
/// "zh" are in simplified characters.
bool hasUsualTexts(std::string_view language);

/// The usual texts for this BCP 47 tag, by its main part; English where there are none.
const UsualTexts& usualTexts(std::string_view language);

/// The file with usual texts in one language. Throws badInput that names the part which is missing or wrong.
UsualTexts usualTextsFromJson(std::string_view json, const std::string& where);

/// The paper's study with the sentences, checklist, readings and facts of a language that has usual texts: JSON of a protocol.
std::string paperProtocolIn(std::string_view language);

/// The sentence of the paper's questions Q1 to Q4, in a phase with this task; empty for other questions.
std::string usualTextOf(const QuestionId& question, const AnswerKind& task, ProtocolEdition edition,
                        std::string_view language = "en");

/// The wording that the paper prints for Q1 to Q4, kept as a record; empty for other questions.
std::string paperWordingOf(const QuestionId& question);

/// "the paper's wording", "the corrected wording", "the corrected wording in German, translation not reviewed" or "the study's
/// own wording": which of them the sentence of a question is. Empty for questions that the paper does not ask.
std::string wordingOf(const QuestionId& question, const AnswerKind& task, const std::string& text);

/// What the operator confirms before the session begins.
std::string usualConsent(ProtocolEdition edition, std::string_view language = "en");

/// How the participant strokes glass and cloth.
std::string usualStrokeWords(ProtocolEdition edition, std::string_view language = "en");

/// "Answer as fast as you can. ...": what the operator says at the beginning of a block with this instruction.
std::string usualInstructionText(const BlockInstruction& instruction, std::string_view language = "en");

/// What the participant reads on their own screen and hears from the operator, by key: {name} stands for a value. A protocol
/// may replace each by "participant_texts".
const TextsByKey& usualParticipantTexts(std::string_view language = "en");

/// What stands for a sentence about an end of the scale where the protocol has no such sentence but texts of its own for the
/// ends: "{number} rough as bark" for "say_unrelated". Empty for other keys, and where the end is the usual one.
std::string textFromOwnEnds(const Protocol& protocol, std::string_view key);

/// Which texts are missing beside the protocol's own texts for the ends of a scale of numbers. Empty if there are none.
std::string noteOnOwnEnds(const Protocol& protocol);

/// The names in braces in a text: "{count} of {needed}" gives "count" and "needed".
std::set<std::string> placeholdersIn(std::string_view text);

/// The text with values for its names in braces.
std::string filledText(std::string text, const TextsByKey& values);

}  // namespace protocols
