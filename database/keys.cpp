#include "database/keys.h"

#include "database/disk/payload_fields.h"
#include "database/sqlite_connection.h"
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

/// The hash of the sealed key in the log; empty in studies of earlier versions.
std::string recordedSealHash(const StudyStore& store)
{
    const SqliteConnection sqlite(store.folder().database(), SqliteConnection::Mode::Read);
    const auto first = sqlite.value(QStringLiteral("SELECT payload FROM events WHERE sequence = 1"));
    return textIn(payloadIn(fromQt(first)), sealedKeyField);
}

/// A missing file is reported with the open key, because either of them is enough.
void checkSealedKey(const StudyStore& store, const Passphrase& passphrase, KeyFindings& findings)
{
    const fs::path file = store.folder().sealedAllocationKey();
    const auto sealed = protocols::readIfPossible(file);
    if (!sealed) return;
    const std::string recorded = recordedSealHash(store), name = file.filename().string();
    if (recorded.empty())
        protocols::requireSealedForm(*sealed, file.string());
    else if (protocols::sha256(*sealed) != recorded)
        throw notUsable("the sealed allocation key is not the file that the log names", file);
    const auto given = passphrase ? passphrase() : std::nullopt;
    if (!given) {
        if (recorded.empty())
            findings.notes.push_back(name +
                                     ": its hash is not recorded, because an earlier version made the study; "
                                     "the passphrase would show whether it opens");
        return;
    }
    if (const auto text = protocols::openWithPassphrase(*given, *sealed, file.string()))
        (void)committed(store, *text, file);
    else if (recorded.empty())
        throw notUsable("the passphrase does not open the allocation key: it is another one, or the file was altered", file);
    else
        findings.notes.push_back(name +
                                 ": not opened, because the study was made with another passphrase; the file is unchanged");
}

protocols::AllocationKey neededKey(const StudyStore& store, const Passphrase& passphrase)
{
    if (auto key = readKey(store, passphrase)) return std::move(*key);
    throw protocols::badInput({"this needs the owner's passphrase", store.folder().folder.string(),
                               "a terminal to ask on, --passphrase-file FILE or VIS2HAP_PASSPHRASE", "give the passphrase"});
}

void layOpen(const StudyFolder& folder, const protocols::AllocationKey& key)
{
    if (!fs::exists(folder.allocationKey()))
        protocols::writeWholeFile(folder.allocationKey(), protocols::toJson(key), protocols::Sync::Now,
                                  protocols::Readers::OwnerOnly);
}

/// The disk may have been full at the unblinding, or another account unblinded the study.
protocols::Error notLaidOpen(const StudyStore& store)
{
    const fs::path file = store.folder().allocationKey();
    if (fs::exists(file))
        return protocols::environmentFault({"the study is unblinded, and this account cannot read the allocation key",
                                            file.string(), "a file of the account that reads the study",
                                            "give the file to this account (chown)"});
    return protocols::workFailed({"the study is unblinded, but its open allocation key is missing", file.string(),
                                  "the file that the unblinding writes",
                                  "run vis2hap unblind again with the passphrase, which writes it"});
}

}  // namespace

Unblinded unblind(StudyStore& store, const UnblindingRecord& record, const Passphrase& passphrase)
{
    const auto key = neededKey(store, passphrase);
    store.recordUnblinding(record);
    layOpen(store.folder(), key);
    return Unblinded(record);
}

bool completeUnblinding(const StudyStore& store, const Passphrase& passphrase)
{
    if (!store.unblinding() || fs::exists(store.folder().allocationKey())) return false;
    layOpen(store.folder(), neededKey(store, passphrase));
    return true;
}

std::optional<Unblinded> recordedUnblinding(const StudyStore& store)
{
    if (std::optional<UnblindingRecord> record = store.unblinding()) return Unblinded(std::move(*record));
    return std::nullopt;
}

protocols::AllocationKey readAllocationKey(const StudyStore& store, const Unblinded&)
{
    if (auto key = readKey(store, {})) return std::move(*key);
    throw notLaidOpen(store);
}

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

std::string sha256OfSealedKey(const StudyFolder& folder)
{
    const auto sealed = protocols::readIfPossible(folder.sealedAllocationKey());
    return sealed ? protocols::sha256(*sealed) : std::string();
}

KeyFindings findingsOfKeys(const StudyStore& store, const Passphrase& passphrase)
{
    KeyFindings findings;
    const auto check = [&findings](const auto& step) {
        try {
            step();
        } catch (const protocols::Error& fault) {
            findings.faults.push_back(fault.what());
        }
    };
    check([&] { (void)readStationKey(store.folder(), store.facts().stationKeySha256); });
    check([&] {
        if (!readKey(store, {}) && store.unblinding()) throw notLaidOpen(store);
    });
    if (!store.facts().hasPassphrase) return findings;
    check([&] { checkSealedKey(store, passphrase, findings); });
    const fs::path open = store.folder().allocationKey();
    if (!store.unblinding() && fs::exists(open))
        findings.faults.push_back(open.string() + ": the allocation key lies open, and the study is not unblinded");
    return findings;
}

}  // namespace database
