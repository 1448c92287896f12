// A small study folder for tests: a real design, keys, stimuli and database, made as `study new`
// makes them, but from constant images instead of a data set.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "database/study_folder.h"
#include "protocols/protocol.h"

namespace tests::support {

struct StudyRecipe {
    int fabrics = 3;  ///< F01 ...
    std::vector<std::string> conditions{"v_grey", "h&f"};
    int participants = 2;
    int alternatives = 3;
    int breakAfter = 4;  ///< presentations
    std::uint64_t designSeed = 1;
    std::uint64_t keySeed = 2;
    int imageWidthPx = 16, imageHeightPx = 10;  ///< image n is constant, of value 10 n
    std::string protocol = {};                  ///< JSON text, instead of the one that follows from the above
    bool hasSwatchCodes = false;                ///< else fabric pieces go by their names
    int familiarisationImages = 0;
    /// What each condition is called in the keys: itself where nothing stands here. The images are others then.
    std::map<std::string, std::string> keyNames = {};
};

/// Q1 by choice, then Q2 to Q4 on the scale: fabrics x conditions presentations in each phase.
std::string protocolText(const StudyRecipe& recipe);

/// Makes `folder` (its parent must exist) with protocol.json, both keys, stimuli/ and study.db.
database::StudyFolder buildStudy(const std::filesystem::path& folder, const StudyRecipe& recipe = {});

}  // namespace tests::support
