// Small study folder for tests: a real design, keys, stimuli and database, as `study new` makes them, but with constant
// images instead of a data set.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "database/disk/study_folder.h"
#include "protocols/protocol.h"

namespace tests::support {

/// Options of a test study.
struct StudyRecipe {
    int fabrics = 3;                          ///< F01, F02, …
    std::vector<std::string> fabricIds = {};  ///< ids in place of these
    std::vector<std::string> conditions{"v_grey", "h&f"};
    int participants = 2;
    int alternatives = 3;
    int breakAfter = 4;          ///< presentations between two breaks
    double deadTimeSeconds = 0;  ///< after a step of the operator; tests press keys without waiting
    bool confirmPieces = false;
    std::uint64_t designSeed = 1;
    std::uint64_t keySeed = 2;
    std::optional<std::string> passphrase = {};  ///< none: the allocation key lies open
    int imageWidthPx = 16, imageHeightPx = 10;   ///< every pixel of image n has the value 10 n
    std::string protocol = {};                   ///< JSON text used instead of the options above
    bool hasSwatchCodes = false;                 ///< false: pieces of fabric have the names of the fabrics
    int familiarisationImages = 0;
    /// Replaces conditions in the keys, by id. If it is not empty, the images have other values.
    std::map<std::string, std::string> keyNames = {};
};

/// Protocol with Q1 as a choice, then Q2–Q4 on the scale. Each phase has fabrics × conditions presentations.
std::string protocolText(const StudyRecipe& recipe);

/// Makes `folder` (its parent must exist) with protocol.json, both keys, stimuli/ and study.db.
database::StudyFolder buildStudy(const std::filesystem::path& folder, const StudyRecipe& recipe = {});

}  // namespace tests::support
