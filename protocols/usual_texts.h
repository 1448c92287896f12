// The sentences that a study uses where its protocol gives none: the questions of the paper, consent, how to stroke. The
// operator reads them to the participant. Also what the participant reads on a screen of their own.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "protocols/answer_kind.h"
#include "protocols/ids.h"
#include "protocols/protocol.h"
#include "protocols/protocol_edition.h"

namespace protocols {

/// The sentence of the paper's questions Q1 to Q4, in a phase with this task; empty for other questions.
std::string usualTextOf(const QuestionId& question, const AnswerKind& task, ProtocolEdition edition);

/// What the operator confirms before the session begins.
std::string usualConsent(ProtocolEdition edition);

/// How the participant strokes glass and cloth.
std::string usualStrokeWords(ProtocolEdition edition);

/// "Answer as fast as you can. ...": what the operator says at the beginning of a block with this instruction.
std::string usualInstructionText(const BlockInstruction& instruction);

/// What the participant reads on their own screen, by key, in English: {name} stands for a value. A protocol may replace each
/// by "participant_texts".
const std::map<std::string, std::string, std::less<>>& usualParticipantTexts();

/// The names in braces in a text: "{count} of {needed}" gives "count" and "needed".
std::set<std::string> placeholdersIn(std::string_view text);

}  // namespace protocols
