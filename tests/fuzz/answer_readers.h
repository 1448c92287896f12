// Tables of answers from other experiments, as `report --from` reads them.
#pragma once

#include "tests/fuzz/readers.h"

namespace fuzz {

std::vector<Reader> answerReaders(const std::filesystem::path& folder);

}  // namespace fuzz
