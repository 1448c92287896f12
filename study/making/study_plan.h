// The plan of a study before its answers: what is asked of whom, which claims are tested how, and with which power. plan_text.h
// and plan_json.h write it.
#pragma once

#include <string>
#include <vector>

#include "database/study_store.h"
#include "protocols/protocol.h"
#include "study/analyse/power/question_power.h"

namespace study::making {

/// When a plan is registered, and what was there before it.
struct RegistrationStamp {
    int number = 1;                 ///< from 1; the later ones are amendments
    std::string time;               ///< ISO 8601
    std::string who;                ///< may be empty
    std::size_t answersBefore = 0;  ///< given before; those that were erased since count, too
    bool afterUnblinding = false;
    std::vector<std::string> earlierHashes;  ///< SHA-256 of the JSON of each earlier registration
    std::vector<std::string> changes;        ///< parts of the plan that differ from the registration before
    std::size_t erasedBefore = 0;            ///< of the answers before
};

/// "before the first answer", "after 12 answers", "after 12 answers and after the unblinding".
std::string timingOf(const RegistrationStamp& stamp);

struct StudyPlan {
    database::StudyFacts facts;
    database::ProtocolVersion version;  ///< the protocol that is planned: the latest of the study
    protocols::Protocol protocol;
    std::vector<protocols::PlannedContrast> contrasts;  ///< the primary one first; empty: all pairs
    std::vector<analyse::QuestionPower> power;
    std::string program;  ///< that writes the plan
};

/// Throws badInput where protocol.json differs from the protocol that the study stores.
StudyPlan planOf(const database::StudyStore& store, const std::string& program);

/// The rules by which the report of this protocol flags data, each a sentence, and the names of the flags that set a participant
/// apart.
struct ExclusionRules {
    std::vector<std::string> sentences;
    std::vector<std::string> flags;
};
ExclusionRules exclusionRules(const protocols::Protocol& protocol);

}  // namespace study::making
