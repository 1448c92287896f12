#include "study/records/places_in_time.h"

#include <algorithm>
#include <set>

namespace study::records {

PresentationKey presentationOf(const database::CurrentAnswer& answer)
{
    return {answer.participant, answer.record.trial, answer.attempt};
}

void PlacesInTime::add(const database::CurrentAnswer& answer)
{
    const auto [entry, isNew] = m_firstEvents.emplace(presentationOf(answer), answer.event);
    if (!isNew) entry->second = std::min(entry->second, answer.event);
}

Places PlacesInTime::places() const
{
    // In a damaged study two presentations may have the same entry of the log.
    std::set<std::tuple<protocols::ParticipantId, std::int64_t, PresentationKey>> inTime;
    for (const auto& [key, event] : m_firstEvents) inTime.emplace(std::get<0>(key), event, key);
    std::map<protocols::ParticipantId, int> counts;
    Places places;
    for (const auto& [participant, event, key] : inTime) places[key] = ++counts[participant];
    return places;
}

}  // namespace study::records
