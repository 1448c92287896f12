// The work of `vis2hap export`, for commands that look at what an export holds.
#pragma once

#include <filesystem>
#include <string>

#include "database/keys.h"

namespace study::commands {

/// `format`: "csv", "json" or "script". `out`: a folder that need not exist.
void writeExport(const database::StudyStore& store, const std::filesystem::path& out, const std::string& format,
                 const database::Passphrase& passphrase);

}  // namespace study::commands
