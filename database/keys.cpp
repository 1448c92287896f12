#include "database/keys.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/key_json.h"

namespace database {

namespace {

constexpr mode_t ownerOnly = 0600;
constexpr mode_t everyoneReads = 0644;

protocols::Error cannotWrite(const std::filesystem::path& file)
{
    return protocols::environmentFault({std::string("the key cannot be written: ") + std::strerror(errno), file.string(),
                                        "a new file", "check the folder and the disk"});
}

bool writeAll(int descriptor, const std::string& text)
{
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
        if (written < 0 && errno != EINTR) return false;
        done += written > 0 ? static_cast<std::size_t>(written) : 0;
    }
    return ::fsync(descriptor) == 0;
}

/// The mode is given to open, so that no moment exists in which others could read the key.
void writeKeyFile(const std::filesystem::path& file, const std::string& text, mode_t mode)
{
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor < 0) throw cannotWrite(file);
    const bool written = ::fchmod(descriptor, mode) == 0 && writeAll(descriptor, text);
    const int reason = errno;
    ::close(descriptor);
    if (written) return;
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    errno = reason;
    throw cannotWrite(file);
}

/// The bytes of a key file that is the committed one. Throws workFailed else.
std::string committedText(const std::filesystem::path& file, const std::string& commitment)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw protocols::workFailed(
            {"the key cannot be read", file.string(), "the file that was made with the study", "bring it back from a backup"});
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (protocols::sha256(text) != commitment)
        throw protocols::workFailed({"the key is not the one committed in the database", file.string(), "SHA-256 " + commitment,
                                     "bring it back from a backup"});
    return text;
}

protocols::AllocationKey readKey(const StudyStore& store)
{
    const std::filesystem::path file = store.folder().allocationKey();
    return protocols::allocationKeyFromJson(committedText(file, store.facts().keySha256), file.string());
}

}  // namespace

Unblinded unblind(StudyStore& store, const std::string& who, const std::string& why, const std::string& wallTime)
{
    store.recordUnblinding({who, why, wallTime});
    return Unblinded({who, why, wallTime});
}

std::optional<Unblinded> recordedUnblinding(const StudyStore& store)
{
    if (std::optional<UnblindingRecord> record = store.unblinding()) return Unblinded(std::move(*record));
    return std::nullopt;
}

protocols::AllocationKey readAllocationKey(const StudyStore& store, const Unblinded&) { return readKey(store); }

protocols::MaskedKey readMaskedKey(const StudyStore& store)
{
    const std::filesystem::path file = store.folder().maskedKey();
    return protocols::maskedKeyFromJson(committedText(file, store.facts().maskedKeySha256), file.string());
}

protocols::AllocationKey readAllocationKeyForTestDriver(const StudyStore& store, ParticipantKind kind)
{
    if (kind == ParticipantKind::Human)
        throw protocols::workFailed({"the allocation key stays closed while a human takes part",
                                     store.folder().allocationKey().string(), "a scripted or simulated participant",
                                     "unblind the study when it is over"});
    return readKey(store);
}

KeyHashes writeKeys(const StudyFolder& folder, const protocols::AllocationKey& key)
{
    const std::string full = protocols::toJson(key);
    const std::string half = protocols::toJson(protocols::masked(key));
    writeKeyFile(folder.allocationKey(), full, ownerOnly);
    writeKeyFile(folder.maskedKey(), half, everyoneReads);
    return {protocols::sha256(full), protocols::sha256(half)};
}

std::vector<std::string> faultsOfKeys(const StudyStore& store)
{
    std::vector<std::string> faults;
    const StudyFacts facts = store.facts();
    for (const auto& [file, commitment] : {std::pair{store.folder().allocationKey(), facts.keySha256},
                                           std::pair{store.folder().maskedKey(), facts.maskedKeySha256}}) {
        try {
            committedText(file, commitment);
        } catch (const protocols::Error& fault) {
            faults.push_back(fault.what());
        }
    }
    struct stat status {};
    if (::stat(store.folder().allocationKey().c_str(), &status) == 0 && (status.st_mode & 0077) != 0)
        faults.push_back(store.folder().allocationKey().string() + ": others may read the allocation key; expected mode 0600");
    return faults;
}

}  // namespace database
