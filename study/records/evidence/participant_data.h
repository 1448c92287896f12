// Everything that a study stores about one participant, for that person: `vis2hap export STUDY --participant ID`. While the study
// is blinded, the data hold no fabric, no condition and nothing about right or wrong.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "database/study_store.h"

namespace study::records {

/// The data as JSON (schema vis2hap.participant/1): consent, facts, sittings, answers with corrections and voided presentations,
/// notes, events, erasures, copies on record. A choice is the letter of its place on the tray; after the unblinding each answer
/// also has fabric, condition and, where there is a right answer, correctness. Throws badInput for an unknown participant.
nlohmann::ordered_json participantData(const database::StudyStore& store, const protocols::ParticipantId& participant);

/// Writes your-data.html, your-data.json, your-answers.csv and a copy of each certificate of an erasure of this participant into
/// an existing folder. Throws environmentFault.
void writeParticipantData(const database::StudyStore& store, const nlohmann::ordered_json& data,
                          const std::filesystem::path& folder);

/// The data of all participants as leak-check attacks them: without what people said, wrote or answered, which no seal can hide.
/// Writes the page of each, and all rows joined in joined.json, as an attacker would join them.
void writeEveryParticipant(const database::StudyStore& store, const std::filesystem::path& folder);

}  // namespace study::records
