// The work of `vis2hap export`, for commands that look at what an export holds.
#pragma once

#include <filesystem>
#include <string>

#include "database/keys.h"

namespace study::commands {

struct ExportForm {
    std::string format;        ///< "csv", "json" or "script"
    bool withLog = false;      ///< the log, too: log.csv, acts.csv and log.txt
    bool withSamples = false;  ///< samples of the finger, too: finger_samples.csv; unblinded studies only
};

/// `out`: a folder that need not exist.
void writeExport(const database::StudyStore& store, const std::filesystem::path& out, const ExportForm& form,
                 const database::Passphrase& passphrase);

}  // namespace study::commands
