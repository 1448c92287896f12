// The registered plans of a study: entries of the log, which keep both texts of a plan, and the names of their files. The
// functions open a connection of their own; whoever records keeps the store open for writing, and with it the lock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "database/study_store.h"

namespace database {

struct PreregistrationRecord {
    int number = 1;                 ///< from 1; the later ones are amendments
    std::size_t answersBefore = 0;  ///< given before it; those that were erased since count, too
    bool afterUnblinding = false;
    std::string who;         ///< may be empty
    std::string text, json;  ///< bytes of the two files
    std::string wallTime;    ///< ISO 8601
    std::int64_t event = 0;  ///< its entry of the log; 0 before it is recorded

    std::string textSha256() const;
    std::string jsonSha256() const;  ///< the hash of the registration: the JSON carries the hash of the text
};

/// Appends the plan to the log; returns after the sync. Throws workFailed unless its number is the next one, environmentFault
/// (disk full, read-only).
void recordPreregistration(const StudyStore& store, const PreregistrationRecord& record);

/// In their order. Throws workFailed where an entry cannot be read.
std::vector<PreregistrationRecord> preregistrationsOf(const StudyStore& store);

/// preregistration.txt and preregistration-2.txt in the study folder; `kind`: "txt" or "json".
std::filesystem::path preregistrationFile(const StudyFolder& folder, int number, const std::string& kind);

nlohmann::ordered_json payloadOf(const PreregistrationRecord& record);

/// Whether the payload has all fields with their types.
bool isPreregistration(const nlohmann::json& payload);

/// What is wrong with a payload that should have this number; empty where nothing is.
std::string faultOfPreregistration(const nlohmann::json& payload, int number);

}  // namespace database
