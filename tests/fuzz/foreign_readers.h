// What other labs, scanners, cameras and programs bring: tables, pictures, maps, replies of a server.
#pragma once

#include "tests/fuzz/readers.h"

namespace fuzz {

std::vector<Reader> foreignReaders(const std::filesystem::path& folder);

}  // namespace fuzz
