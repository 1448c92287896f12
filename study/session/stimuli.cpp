#include "study/session/stimuli.h"

#include "database/disk/station_key.h"

namespace study::session {

rendering::StimulusBank stimuliOf(const database::StudyStore& store)
{
    return {store.folder().stimuli(), store.stimulusHashes(), readStationKey(store.folder(), store.facts().stationKeySha256)};
}

}  // namespace study::session
