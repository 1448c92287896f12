// The sentences that a study uses where its protocol gives none: the questions of the paper, consent, how to stroke. The
// operator reads them to the participant.
#pragma once

#include <string>

#include "protocols/answer_kind.h"
#include "protocols/ids.h"

namespace protocols {

/// The sentence of the paper's questions Q1 to Q4, in a phase with this task; empty for other questions.
std::string usualTextOf(const QuestionId& question, const AnswerKind& task);

/// What the operator confirms before the session begins.
std::string usualConsent();

/// How the participant strokes glass and cloth.
std::string usualStrokeWords();

}  // namespace protocols
