#include "protocols/files/folder_draft.h"

#include <fcntl.h>
#include <stdio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "protocols/files/disk_sync.h"
#include "protocols/files/errors.h"
#include "protocols/files/unfinished.h"
#include "protocols/process/owner_only.h"

namespace protocols {

namespace {

namespace fs = std::filesystem;

Error cannotMake(const fs::path& folder, const std::error_code& reason)
{
    return environmentFault({"the folder cannot be made (" + reason.message() + ")", folder.string(),
                             "a writable folder with free space", "free space or choose another folder"});
}

Error cannotPutInPlace(const fs::path& place, const std::error_code& reason)
{
    return environmentFault({"cannot be put in place (" + reason.message() + ")", place.string(),
                             "a writable folder that no other program changes", "choose another folder"});
}

/// The folder and its parents that do not exist yet, innermost first.
std::vector<fs::path> missingOnes(const fs::path& folder)
{
    std::error_code unknown;
    std::vector<fs::path> missing;
    for (fs::path at = folder; !fs::exists(at, unknown) && at.has_relative_path(); at = at.parent_path()) missing.push_back(at);
    return missing;
}

bool stands(const fs::path& place) { return fs::exists(fs::symlink_status(place)); }

/// Both names exist before and after. Throws filesystem_error.
void exchange(const fs::path& a, const fs::path& b)
{
    if (::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return;
    if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP)
        throw fs::filesystem_error("exchange", a, b, std::error_code(errno, std::generic_category()));
    // A file system without exchanges, such as a network share.
    const fs::path aside = a.string() + ".earlier";
    fs::rename(b, aside);
    std::error_code failure;
    fs::rename(a, b, failure);
    if (failure) {
        std::error_code ignored;
        fs::rename(aside, b, ignored);
        throw fs::filesystem_error("rename", a, b, failure);
    }
    fs::rename(aside, a);
}

struct Move {
    fs::path from, to;
    bool isExchange;

    void make() const { isExchange ? exchange(from, to) : fs::rename(from, to); }
    void undo() const { isExchange ? exchange(from, to) : fs::rename(to, from); }
};

/// A folder in the place of a file, or the other way round, is somebody's work.
Move moveTo(const fs::path& from, const fs::path& to)
{
    const bool isTaken = stands(to);
    if (isTaken && fs::is_directory(from) != fs::is_directory(to))
        throw fs::filesystem_error(
            "rename", from, to,
            std::make_error_code(fs::is_directory(to) ? std::errc::is_a_directory : std::errc::not_a_directory));
    return {from, to, isTaken};
}

void addMoves(std::vector<Move>& moves, const fs::path& from, const fs::path& to, bool joinsFolders)
{
    for (const fs::directory_entry& entry : fs::directory_iterator(from)) {
        const fs::path target = to / entry.path().filename();
        if (joinsFolders && entry.is_directory() && fs::is_directory(target))
            addMoves(moves, entry.path(), target, joinsFolders);
        else
            moves.push_back(moveTo(entry.path(), target));
    }
}

void makeAllOrNone(const std::vector<Move>& moves)
{
    std::size_t done = 0;
    try {
        for (; done < moves.size(); ++done) moves[done].make();
    } catch (const fs::filesystem_error&) {
        while (done-- > 0) moves[done].undo();
        throw;
    }
}

}  // namespace

FolderDraft::FolderDraft(const fs::path& place, Earlier earlier)
    : m_place(folderPath(place)),
      m_earlier(earlier),
      m_joins((earlier == Earlier::EntriesReplaced || earlier == Earlier::FilesJoined) && stands(m_place))
{
    // Inside the place, renames stay within one file system even where the place is a mount point.
    const fs::path named = m_joins ? m_place / "vis2hap" : m_place;
    removeAbandoned(named);
    m_draft = unfinishedName(named);
    std::error_code problem;
    fs::remove_all(m_draft, problem);
    m_madeParents = missingOnes(m_draft.parent_path());
    makeFolders(m_draft.parent_path());
    makeFolders(m_draft, Sync::Later);
}

FolderDraft::~FolderDraft()
{
    std::error_code ignored;
    fs::remove_all(m_draft, ignored);
    if (m_isInPlace) return;
    for (const fs::path& parent : m_madeParents) fs::remove(parent, ignored);  // only where it is empty
}

fs::path FolderDraft::file(const fs::path& relative) const
{
    const fs::path whole = m_draft / relative;
    makeFolders(whole.parent_path(), Sync::Later);
    return whole;
}

void FolderDraft::outdates(const std::vector<fs::path>& entries)
{
    m_outdated.insert(m_outdated.end(), entries.begin(), entries.end());
}

void FolderDraft::putInPlace(const std::vector<fs::path>& last)
{
    try {
        syncTree(m_draft);
        if (m_joins)
            joinPlace(last);
        else
            becomePlace();
        m_isInPlace = true;
    } catch (const fs::filesystem_error& fault) {
        throw cannotPutInPlace(m_place, fault.code());
    }
}

void FolderDraft::becomePlace()
{
    moveTo(m_draft, m_place);  // refuses a file
    if (m_earlier == Earlier::Replaced && stands(m_place))
        exchange(m_draft, m_place);
    else
        fs::rename(m_draft, m_place);  // an empty folder gives way
    syncFolder(m_place.parent_path());
}

/// An empty folder, but for the draft, gets the mode that the program gives to its folders. One with files is somebody's, and
/// one that others may write into is shared on purpose.
void FolderDraft::closeEmptyPlace() const
{
    const auto entries = std::distance(fs::directory_iterator(m_place), fs::directory_iterator());
    std::error_code ignored;  // who may write into a folder need not own it
    constexpr fs::perms shared = fs::perms::group_write | fs::perms::others_write | fs::perms::set_gid;
    if (entries > 1 || (fs::status(m_place).permissions() & shared) != fs::perms::none) return;
    if (filesAreKeptToOwner())
        closeFolderToOthers(m_place);
    else
        fs::permissions(m_place, fs::status(m_draft).permissions(), ignored);
}

void FolderDraft::joinPlace(const std::vector<fs::path>& last)
{
    closeEmptyPlace();
    std::vector<Move> moves;
    addMoves(moves, m_draft, m_place, m_earlier == Earlier::FilesJoined);
    std::set<fs::path> changed;
    for (const fs::path& entry : m_outdated) {
        if (!stands(m_place / entry) || stands(m_draft / entry)) continue;
        moves.push_back({m_place / entry, m_draft / (".outdated-" + std::to_string(moves.size())), false});
        changed.insert((m_place / entry).parent_path());
    }
    const auto rank = [&](const Move& move) {
        const auto found = std::find(last.begin(), last.end(), move.to.lexically_relative(m_place));
        return found == last.end() ? 0 : 1 + (found - last.begin());
    };
    std::sort(moves.begin(), moves.end(),
              [&](const Move& a, const Move& b) { return std::pair(rank(a), a.to) < std::pair(rank(b), b.to); });
    makeAllOrNone(moves);
    for (const Move& move : moves) changed.insert(move.to.parent_path());
    for (const fs::path& folder : changed) syncFolder(folder);
}

fs::path folderPath(const fs::path& folder)
{
    const fs::path whole = fs::absolute(folder.empty() ? fs::path(".") : folder).lexically_normal();
    return whole.has_filename() ? whole : whole.parent_path();
}

void makeFolders(const fs::path& folder, Sync sync)
{
    const fs::path whole = folderPath(folder);
    const std::vector<fs::path> missing = missingOnes(whole);
    std::error_code problem;
    fs::create_directories(whole, problem);
    if (problem) throw cannotMake(folder, problem);
    if (filesAreKeptToOwner())
        for (const fs::path& made : missing) closeFolderToOthers(made);
    if (sync == Sync::Now)
        for (const fs::path& made : missing) syncFolder(made.parent_path());
}

}  // namespace protocols
