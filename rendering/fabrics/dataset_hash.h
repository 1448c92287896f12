// SHA-256 over a data set with hashes of its files that the caller may remember: hashOf() of dataset.h reads every file.
#pragma once

#include <functional>

#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

/// Equals hashOf(dataset) where `hashOfFile` gives the SHA-256 of each file.
std::string hashOf(const Dataset& dataset, const std::function<std::string(const std::filesystem::path&)>& hashOfFile);

}  // namespace rendering::fabrics
