#include "database/keys.h"

#include <sys/stat.h>

#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "protocols/records/key_json.h"

namespace database {

namespace {

/// The bytes of a key file. Throws workFailed if their hash is not the committed one.
std::string committedText(const std::filesystem::path& file, const std::string& commitment)
{
    const std::optional<std::string> text = protocols::readIfPossible(file);
    if (!text)
        throw protocols::workFailed(
            {"the key cannot be read", file.string(), "the file that was made with the study", "restore it from a backup"});
    if (protocols::sha256(*text) != commitment)
        throw protocols::workFailed({"the key is not the one committed in the database", file.string(), "SHA-256 " + commitment,
                                     "restore it from a backup"});
    return *text;
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
        throw protocols::workFailed({"the allocation key must not be read for a human participant",
                                     store.folder().allocationKey().string(), "a scripted or simulated participant",
                                     "unblind the study after its last session"});
    return readKey(store);
}

KeyHashes writeKeys(const StudyFolder& folder, const protocols::AllocationKey& key)
{
    for (const std::filesystem::path& file : {folder.allocationKey(), folder.maskedKey()})
        if (std::filesystem::exists(file))
            throw protocols::environmentFault(
                {"the key exists already", file.string(), "a new study folder", "choose another folder; no key was replaced"});
    const std::string full = protocols::toJson(key);
    const std::string half = protocols::toJson(protocols::masked(key));
    protocols::writeWholeFile(folder.allocationKey(), full, protocols::Sync::Later, protocols::Readers::OwnerOnly);
    protocols::writeWholeFile(folder.maskedKey(), half, protocols::Sync::Later, protocols::Readers::Everyone);
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
        faults.push_back(store.folder().allocationKey().string() +
                         ": other users may read the allocation key (expected mode 0600): run chmod 600 on it");
    return faults;
}

}  // namespace database
