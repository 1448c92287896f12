// Checks a whole study for `vis2hap verify`: files, database and hash chains, keys, stimuli and protocol.
#pragma once

#include <string>
#include <vector>

#include "database/keys.h"
#include "database/study_store.h"

namespace study::records {

struct Findings {
    std::vector<std::string> faults;  ///< one line each; empty for a sound study
    std::vector<std::string> notes;   ///< what the owner should know, although the study is sound
};

/// With a passphrase, a sealed key is opened and compared, too.
Findings findingsOf(const database::StudyStore& store, const database::Passphrase& passphrase = {});

}  // namespace study::records
