// A folder written as a whole: it is filled under a hidden name, synced once at its end and then renamed. A full
// disk, a fault or a killed process leaves what stood there before.
#pragma once

#include <filesystem>
#include <vector>

#include "protocols/files/whole_file.h"

namespace protocols {

/// What becomes of the folder that stands at the place already.
enum class Earlier {
    Refused,          ///< it must be empty
    Replaced,         ///< it vanishes with all it holds
    EntriesReplaced,  ///< files and folders of the draft take the place of those with the same name
    FilesJoined,      ///< files of the draft join those in the folders with the same name
};

/// Vanishes with all it holds unless it was put in place.
class FolderDraft {
public:
    /// Makes an empty folder beside `place`, or in it where its entries stay. Removes drafts of killed processes.
    /// Throws environmentFault.
    FolderDraft(const std::filesystem::path& place, Earlier earlier);
    ~FolderDraft();
    FolderDraft(const FolderDraft&) = delete;
    FolderDraft& operator=(const FolderDraft&) = delete;

    const std::filesystem::path& path() const { return m_draft; }

    /// Where to write a file of the draft, with Sync::Later; makes the folders on the way.
    std::filesystem::path file(const std::filesystem::path& relative) const;

    /// Entries of the place that vanish with the moves where the draft holds none of their name; relative paths. For places
    /// whose other entries stay.
    void outdates(const std::vector<std::filesystem::path>& entries);

    /// Syncs the draft, then gives it its place; `last` names the files that make the others valid. Undoes its moves and
    /// throws environmentFault where one fails.
    void putInPlace(const std::vector<std::filesystem::path>& last = {});

private:
    void becomePlace();
    void closeEmptyPlace() const;
    void joinPlace(const std::vector<std::filesystem::path>& last);

    std::filesystem::path m_place, m_draft;
    std::vector<std::filesystem::path> m_outdated;     ///< relative to the place
    std::vector<std::filesystem::path> m_madeParents;  ///< innermost first; removed with an abandoned draft
    Earlier m_earlier;
    bool m_isInPlace = false;
    bool m_joins;  ///< the draft lies inside its place and moves there entry by entry
};

/// Absolute and without a slash at its end: "report/" and "report" name the same folder.
std::filesystem::path folderPath(const std::filesystem::path& folder);

/// Makes a folder and its missing parents. Throws environmentFault.
void makeFolders(const std::filesystem::path& folder, Sync sync = Sync::Now);

}  // namespace protocols
