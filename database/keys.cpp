#include "database/keys.h"

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "protocols/records/key_json.h"
#include "protocols/secrets/sealing.h"

namespace database {

namespace {

namespace fs = std::filesystem;

protocols::Error notUsable(const std::string& what, const fs::path& file)
{
    return protocols::workFailed({what, file.string(), "the file that was made with the study", "restore it from a backup"});
}

/// The text, if its hash is the committed one.
protocols::AllocationKey committed(const StudyStore& store, const std::string& text, const fs::path& file)
{
    if (protocols::sha256(text) != store.facts().keySha256)
        throw notUsable("the allocation key is not the one committed in the database", file);
    return protocols::allocationKeyFromJson(text, file.string());
}

/// What the passphrase opens; empty where nobody gives one.
std::optional<protocols::AllocationKey> unsealed(const StudyStore& store, const Passphrase& passphrase)
{
    const fs::path file = store.folder().sealedAllocationKey();
    const auto sealed = protocols::readIfPossible(file);
    if (!sealed) throw notUsable("the sealed allocation key cannot be read", file);
    const auto given = passphrase ? passphrase() : std::nullopt;
    if (!given) return std::nullopt;
    const auto text = protocols::openWithPassphrase(*given, *sealed, file.string());
    if (!text)
        throw protocols::badInput({"the passphrase does not open the allocation key", file.string(),
                                   "the passphrase that was given when the study was made", "try again"});
    return committed(store, *text, file);
}

std::optional<protocols::AllocationKey> readKey(const StudyStore& store, const Passphrase& passphrase)
{
    const fs::path file = store.folder().allocationKey();
    if (const auto text = protocols::readIfPossible(file)) return committed(store, *text, file);
    if (!store.facts().hasPassphrase) throw notUsable("the allocation key cannot be read", file);
    return unsealed(store, passphrase);
}

protocols::AllocationKey neededKey(const StudyStore& store, const Passphrase& passphrase)
{
    if (auto key = readKey(store, passphrase)) return std::move(*key);
    throw protocols::badInput({"this needs the owner's passphrase", store.folder().folder.string(),
                               "a terminal to ask on, --passphrase-file FILE or VIS2HAP_PASSPHRASE", "give the passphrase"});
}

}  // namespace

Unblinded unblind(StudyStore& store, const UnblindingRecord& record, const Passphrase& passphrase)
{
    const auto key = neededKey(store, passphrase);
    store.recordUnblinding(record);
    if (!fs::exists(store.folder().allocationKey()))
        protocols::writeWholeFile(store.folder().allocationKey(), protocols::toJson(key), protocols::Sync::Now,
                                  protocols::Readers::OwnerOnly);
    return Unblinded(record);
}

std::optional<Unblinded> recordedUnblinding(const StudyStore& store)
{
    if (std::optional<UnblindingRecord> record = store.unblinding()) return Unblinded(std::move(*record));
    return std::nullopt;
}

protocols::AllocationKey readAllocationKey(const StudyStore& store, const Unblinded&) { return neededKey(store, {}); }

std::optional<protocols::AllocationKey> readKeyForAggregates(const StudyStore& store, const Passphrase& passphrase)
{
    return readKey(store, passphrase);
}

protocols::AllocationKey readAllocationKeyForTestDriver(const StudyStore& store, ParticipantKind kind,
                                                        const Passphrase& passphrase)
{
    if (kind == ParticipantKind::Human)
        throw protocols::workFailed({"the allocation key must not be read for a human participant",
                                     store.folder().folder.string(), "a scripted or simulated participant",
                                     "unblind the study after its last session"});
    return neededKey(store, passphrase);
}

KeyHashes writeKeys(const StudyFolder& folder, const protocols::AllocationKey& key, const std::optional<std::string>& passphrase)
{
    for (const fs::path& file : {folder.allocationKey(), folder.sealedAllocationKey(), folder.stationKey()})
        if (fs::exists(file))
            throw protocols::environmentFault(
                {"the key exists already", file.string(), "a new study folder", "choose another folder; no key was replaced"});
    const std::string text = protocols::toJson(key);
    if (passphrase)
        protocols::writeWholeFile(folder.sealedAllocationKey(), protocols::sealWithPassphrase(*passphrase, text),
                                  protocols::Sync::Later, protocols::Readers::OwnerOnly);
    else
        protocols::writeWholeFile(folder.allocationKey(), text, protocols::Sync::Later, protocols::Readers::OwnerOnly);
    return {protocols::sha256(text), writeStationKey(folder, protocols::stationKeyOf(key.secret))};
}

std::vector<std::string> faultsOfKeys(const StudyStore& store)
{
    std::vector<std::string> faults;
    const StudyFolder& folder = store.folder();
    try {
        (void)readStationKey(store);
    } catch (const protocols::Error& fault) {
        faults.push_back(fault.what());
    }
    try {
        (void)readKey(store, {});
    } catch (const protocols::Error& fault) {
        faults.push_back(fault.what());
    }
    if (store.facts().hasPassphrase && !store.unblinding() && fs::exists(folder.allocationKey()))
        faults.push_back(folder.allocationKey().string() + ": the allocation key lies open, and the study is not unblinded");
    return faults;
}

}  // namespace database
