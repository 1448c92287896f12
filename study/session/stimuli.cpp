#include "study/session/stimuli.h"

#include "database/station_key.h"

namespace study::session {

rendering::StimulusBank stimuliOf(const database::StudyStore& store)
{
    return {store.folder().stimuli(), store.stimulusHashes(), readStationKey(store)};
}

}  // namespace study::session
