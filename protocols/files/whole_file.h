// Files read and written in one piece. A reader gets all bytes or a named fault. A writer leaves the
// whole new file or what stood there before, also when the process is killed or the power fails.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace protocols {

/// Largest file that is read in one piece, bytes. Records of 10^7 rows have 0.3 GB.
inline constexpr std::uint64_t largestFile = std::uint64_t{1} << 31;

/// How long a reader waits for the first bytes of a pipe, s.
inline constexpr int longestWaitForPipeS = 10;

/// All bytes of a regular file, a pipe or a terminal. Throws badInput where the file is missing, is a folder or another device,
/// has more than `mostBytes` bytes, or cannot be read, and for a pipe into which nobody writes. Of a regular file that is too
/// large nothing is read, of a pipe little more than `mostBytes`. Throws environmentFault where this process has too many open
/// files.
std::string readWholeFile(const std::filesystem::path& file, std::uint64_t mostBytes = largestFile);

/// All bytes, or nothing where readWholeFile() throws badInput: for callers with a message of their own.
std::optional<std::string> readIfPossible(const std::filesystem::path& file);

/// All bytes of a regular file of at most `mostBytes`. Throws badInput for a folder, pipe, socket or device, which is not even
/// opened, and for a larger file, of which nothing is read.
std::string readRegularFile(const std::filesystem::path& file, std::uint64_t mostBytes);

/// The first `count` bytes of a regular file, or all bytes of a shorter one. Throws as readRegularFile() does.
std::string beginningOf(const std::filesystem::path& file, std::size_t count);

/// All bytes, one block after the other, for files of any size. Throws as readWholeFile() does.
void readInBlocks(const std::filesystem::path& file, const std::function<void(std::string_view)>& take);

/// When the bytes of a new file must have reached the disk.
enum class Sync {
    Now,    ///< before the call returns
    Later,  ///< with the folder that is written as a whole (FolderDraft), or never, where the file is for this run only
};

/// Who may read a new file.
enum class Readers {
    AsUsual,    ///< as the user's umask says
    OwnerOnly,  ///< mode 0600 from the first byte on
};

/// Writes a hidden temporary file beside `file`, syncs it, renames it and syncs the folder. Devices, pipes and open files of this
/// process, as /dev/stdout is one, are written directly. Any other link to a file or to nothing is replaced, so that it leads to
/// no file of somebody else. Throws environmentFault and leaves nothing behind.
void writeWholeFile(const std::filesystem::path& file, std::string_view bytes, Sync sync = Sync::Now,
                    Readers readers = Readers::AsUsual);

/// Takes the next bytes of a file.
using TakeBytes = std::function<void(std::string_view)>;

/// Writes as writeWholeFile() does, but piece by piece: `make` gives the bytes in their order. So a large file is never held in
/// memory. What `make` throws leaves nothing behind.
void writeInPieces(const std::filesystem::path& file, const std::function<void(const TakeBytes&)>& make, Sync sync = Sync::Now,
                   Readers readers = Readers::AsUsual);

/// Copies a file into a folder that is still being made. Only the owner can read the copy; it has neither mode nor times of the
/// file, which some network shares refuse. Throws as readInBlocks() does, and environmentFault.
void copyBytes(const std::filesystem::path& from, const std::filesystem::path& to);

/// Gives a finished file, written under another name in the same file system, its final name: syncs, renames, syncs the
/// folder. Throws environmentFault.
void putFileInPlace(const std::filesystem::path& finished, const std::filesystem::path& file);

/// Throws badInput where something has this name.
void requireNewFile(const std::filesystem::path& file);

/// As putFileInPlace, for a name that must be new. Throws badInput where somebody took the name in the meantime; what has it
/// stays.
void putNewFileInPlace(const std::filesystem::path& finished, const std::filesystem::path& file);

/// Proves before long work that `file` can be written afterwards. Throws environmentFault, or badInput where a folder stands.
void requireWritable(const std::filesystem::path& file);

}  // namespace protocols
