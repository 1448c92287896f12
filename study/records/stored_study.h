// A stored study as reports, status and export read it: with K-labels while it is blinded, with the names of the conditions after
// its unblinding is recorded.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "database/keys.h"
#include "database/study_store.h"
#include "reports/data/study_data.h"

namespace study::records {

/// Opens the study for reading. Throws badInput where the folder is no study.
database::StudyStore openStudy(const std::filesystem::path& study);

/// The fabric and the condition of each file code. The condition is a K-label, or with the permission its id.
struct Naming {
    struct Entry {
        protocols::FabricId fabric;
        std::string condition;
    };
    bool blinded = true;
    std::map<protocols::FileCode, Entry> entries;
    std::vector<std::string> conditions;  ///< K-labels sorted, or ids in the order of the protocol
};
Naming namingOf(const database::StudyStore& store, const protocols::Protocol& protocol,
                const std::optional<database::Unblinded>& permission);

protocols::Protocol protocolOf(const database::StudyFacts& facts);

/// The data of the report. Throws badInput or workFailed if the stored study cannot be read.
reports::StudyData studyData(const database::StudyStore& store);

}  // namespace study::records
