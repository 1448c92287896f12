// The certificate of an erasure: a text for the participant and the ethics board.
#pragma once

#include <filesystem>

#include "database/study_store.h"

namespace study::records {

/// Writes STUDY/erasures/erasure-N.txt, where N is the entry of the log, records its hash in the log and returns its path. Throws
/// environmentFault.
std::filesystem::path writeErasureCertificate(const database::StudyStore& store, const database::Erasure& erasure,
                                              const database::ErasureRecord& record);

}  // namespace study::records
