// The sentences for the participant and the recordings for the headphones, as the editor offers them: by key, with what stands
// there without an own one.
#pragma once

#include <string>
#include <vector>

#include "study/app/drafts/protocol_draft.h"

namespace study::app {

/// One text of the objects "participant_texts" and "prompts".
struct KeyedText {
    std::string key;
    std::string usual;  ///< the usual sentence, or what a voice says; empty if there is none
    std::string own;    ///< of the file: a sentence, or the name of a recording; empty where the usual one is used
    bool operator==(const KeyedText&) const = default;
};

/// Every sentence of the participant's page, by key, in the language of the draft. Keys of the file that no page has stand at the
/// end.
std::vector<KeyedText> participantTextsOf(const ProtocolDraft& draft);

/// Every prompt that sessions of this draft can need: moments, questions, letters of pieces, numbers of scales. Other keys of the
/// file stand at the end.
std::vector<KeyedText> promptsOf(const ProtocolDraft& draft);

/// Sets the own text of a key; an empty one removes it. `object`: "participant_texts" or "prompts".
void setOwnText(ProtocolDraft& draft, const std::string& object, const std::string& key, const std::string& text);

}  // namespace study::app
