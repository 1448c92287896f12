// The stimuli of a study as its sessions use them.
#pragma once

#include "database/study_store.h"
#include "rendering/display/stimulus_bank.h"

namespace study::session {

/// Opens the sealed images with the station key. Throws workFailed where a file or the key is missing or altered.
rendering::StimulusBank stimuliOf(const database::StudyStore& store);

}  // namespace study::session
