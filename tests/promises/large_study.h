// `vis2hap study status` and `vis2hap verify` on a study with many answers.
#pragma once

#include <filesystem>
#include <vector>

#include "tests/promises/promise.h"

namespace tests::promises {

/// Makes a study of the paper with small images and plays sessions of 252 answers through the engine.
void makeLargeStudy(const std::filesystem::path& folder, int answers);

/// One row for each of the two programs. Studies that Effort::studies lacks are made there.
std::vector<Promise> ofLargeStudies(const Effort& effort);

}  // namespace tests::promises
