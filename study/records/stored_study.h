// A stored study as a report, a status or an export sees it: under K-labels while it is blinded, under
// condition names once its unblinding is recorded.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "database/keys.h"
#include "database/study_store.h"
#include "reports/data/study_data.h"

namespace study::records {

/// Opens for reading. Throws badInput where it is no study.
database::StudyStore openStudy(const std::filesystem::path& study);

/// File code -> fabric and what the condition is called: K-label, or id with the permission.
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

reports::StudyData studyData(const database::StudyStore& store);

}  // namespace study::records
