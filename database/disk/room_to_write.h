// Whether the disk has room for another copy of a database.
#pragma once

#include <filesystem>

namespace database {

/// Throws environmentFault where a database could not be written anew. SQLite needs room for a copy beside it, and for another
/// one in its own folder for temporary files. The message says that nothing was erased.
void requireRoomToWriteAnew(const std::filesystem::path& database);

}  // namespace database
