// Changes of a protocol draft that touch several places at once: phases, questions with their sentences, conditions, contrasts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "study/app/drafts/protocol_draft.h"

namespace study::app {

// ---- phases, from 0

/// What a phase asks for, as the editor offers it.
enum class PhaseKind { Choice, Numbers, Words, SameDifferent, OwnWords };

/// The kind by the keys of the phase; Numbers where it has none of them.
PhaseKind phaseKindOf(const ProtocolDraft& draft, std::size_t phase);
/// Replaces the keys of the kind. Questions and all other keys stay.
void setPhaseKind(ProtocolDraft& draft, std::size_t phase, PhaseKind kind);
/// Adds a phase with one question at the end.
void addPhase(ProtocolDraft& draft, PhaseKind kind);
/// Removes it with the sentences of questions that no other phase asks.
void removePhase(ProtocolDraft& draft, std::size_t phase);
/// Exchanges two phases.
void exchangePhases(ProtocolDraft& draft, std::size_t a, std::size_t b);

/// "phases[1]", or the place of one of its keys.
std::string phasePlace(std::size_t phase, std::string_view key = {});

// ---- questions of a phase, from 0

std::string questionIdAt(const ProtocolDraft& draft, std::size_t phase, std::size_t question);
/// Gives the question another id. Its sentence, its recording and the list of answers in own words follow.
void renameQuestion(ProtocolDraft& draft, std::size_t phase, std::size_t question, const std::string& id);
/// Adds a question with an id that is free.
void addQuestion(ProtocolDraft& draft, std::size_t phase);
void removeQuestion(ProtocolDraft& draft, std::size_t phase, std::size_t question);

/// The sentence of the file; empty where the usual one is used.
std::string sentenceOf(const ProtocolDraft& draft, const std::string& id);
void setSentence(ProtocolDraft& draft, const std::string& id, const std::string& sentence);

bool isInOwnWords(const ProtocolDraft& draft, std::size_t phase, const std::string& id);
void setInOwnWords(ProtocolDraft& draft, std::size_t phase, const std::string& id, bool inOwnWords);

/// The language of the participants: the tag of the file, or "en".
std::string languageOf(const ProtocolDraft& draft);
/// Another language for a protocol that begins. Questions that have usual sentences in it take those.
void takeLanguage(ProtocolDraft& draft, const std::string& language);

// ---- conditions and contrasts

/// A condition as the file has it.
struct DraftCondition {
    std::string id;
    std::string source;      ///< folder of the lab's own images, or what else the file says of it; empty for a rendered one
    bool byProgram = false;  ///< the lab names a program that makes the images
    bool operator==(const DraftCondition&) const = default;
};
std::vector<DraftCondition> conditionsOf(const ProtocolDraft& draft);
/// Adds a rendered condition in the usual order, or removes it.
void setCondition(ProtocolDraft& draft, const std::string& id, bool isChosen);
/// A condition of the lab's own: ready images in the folder, or, without a folder, images that a program makes.
void addOwnCondition(ProtocolDraft& draft, const std::string& id, const std::string& folder);

struct DraftContrast {
    std::string a, b;
    bool isPrimary = false;
    bool operator==(const DraftContrast&) const = default;
};
std::vector<DraftContrast> contrastsOf(const ProtocolDraft& draft);
/// Replaces all planned contrasts. The first primary one becomes "primary"; without one there is none.
void setContrasts(ProtocolDraft& draft, const std::vector<DraftContrast>& contrasts);

/// Scale points either way that count as equal where the protocol states no bounds, as protocols::usualBoundsOf().
double usualBoundOf(const ProtocolDraft& draft);

}  // namespace study::app
