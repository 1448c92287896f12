// The fault of a process that may not open more files (`ulimit -n`). Without it, every file looks missing or damaged.
#pragma once

#include <string>

#include "protocols/files/errors.h"

namespace protocols {

/// True for the values of errno that say that this process, or the computer, has too many open files.
bool isTooManyOpenFiles(int reason);

/// True where the next file could not be opened for that reason: for libraries that do not report it.
bool canOpenNoMoreFiles();

/// The environment fault of such a value; `where` names the file that could not be opened.
Error tooManyOpenFiles(const std::string& where);

}  // namespace protocols
