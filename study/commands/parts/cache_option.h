// The option --no-cache of commands that keep signals and ranges.
#pragma once

#include <memory>

#include "rendering/cache/result_cache.h"

namespace CLI {
class App;
}

namespace study::commands {

/// Adds the option to a command; `isOff` must live as long as the command line.
void addCacheOption(CLI::App& command, const std::shared_ptr<bool>& isOff);

/// The cache of this user; null where --no-cache was given or no folder is there.
std::shared_ptr<rendering::cache::ResultCache> cacheUnless(bool isOff);

}  // namespace study::commands
