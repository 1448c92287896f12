// Registers the plan of a study: the log takes it first, then the files are written. After a crash between the two, the same
// call writes the missing files from the log.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "database/preregistrations.h"

namespace study::making {

struct PreregistrationCall {
    std::filesystem::path out;  ///< folder for copies of the two files; empty: none
    std::string who;            ///< may be empty
    std::string program;        ///< "vis2hap 0.6.0"
    std::string wallTime;       ///< ISO 8601
};

struct Preregistered {
    database::PreregistrationRecord record;
    bool isNew = false;                        ///< false: the same plan was registered before
    std::vector<std::string> changes;          ///< parts of the plan that an amendment changes
    std::vector<std::filesystem::path> files;  ///< of this registration: text and JSON, in the study folder
    std::vector<std::filesystem::path> written;
};

/// Registers the plan unless the last registration has the same one, and writes every registered file that is missing. Throws
/// badInput: an edited protocol.json, a file of that name with other content, a name that is not UTF-8. Throws
/// environmentFault: faults of the disk.
Preregistered preregister(database::StudyStore& store, const PreregistrationCall& call);

}  // namespace study::making
