// The place of each presentation in the order of time, which differs from its number in the list where a void moved it.
#pragma once

#include <map>
#include <tuple>

#include "database/study_store.h"

namespace study::records {

/// One presentation of a trial: participant, number in the list, attempt.
using PresentationKey = std::tuple<protocols::ParticipantId, protocols::TrialNumber, int>;

PresentationKey presentationOf(const database::CurrentAnswer& answer);

/// Place among the presentations that the participant answered, from 1.
using Places = std::map<PresentationKey, int>;

/// Collects answers, in any order, and orders their presentations. A presentation that was voided after an answer counts, because
/// it took its time.
class PlacesInTime {
public:
    void add(const database::CurrentAnswer& answer);
    Places places() const;

private:
    std::map<PresentationKey, std::int64_t> m_firstEvents;  ///< first entries of the log
};

}  // namespace study::records
