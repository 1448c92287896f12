// What displays measured of the fingers, presentation by presentation.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "database/study_store.h"

namespace database {

/// Samples of one presentation, by one clock. A presentation that went on in another sitting may have two records.
struct FingerRecord {
    protocols::ParticipantId participant;
    protocols::TrialNumber trial;
    int attempt = 1;  ///< number of this presentation of the trial, from 1
    bool voided = false;
    std::vector<protocols::FingerSample> samples;  ///< in the order of time
    int leftOut = 0;                               ///< samples that were too many or too close to each other
    int unreadable = 0;                            ///< stored stretches that are damaged, whose samples are missing here
};

/// Calls `take` with each presentation that has samples, by participant, trial and attempt. `participant`: only theirs; empty:
/// everybody's.
void eachFingerRecord(const StudyStore& store, const protocols::ParticipantId& participant,
                      const std::function<void(const FingerRecord&)>& take);

/// Stored samples of everybody, without reading them.
std::int64_t fingerSampleCount(const StudyStore& store, const protocols::ParticipantId& participant);

}  // namespace database
