#include "study/commands/parts/cache_option.h"

#include <CLI/CLI.hpp>

namespace study::commands {

void addCacheOption(CLI::App& command, const std::shared_ptr<bool>& isOff)
{
    command.add_flag("--no-cache", *isOff, "compute everything; read and keep no signals and ranges of earlier calls");
}

std::shared_ptr<rendering::cache::ResultCache> cacheUnless(bool isOff)
{
    return isOff ? nullptr : rendering::cache::usualCache();
}

}  // namespace study::commands
