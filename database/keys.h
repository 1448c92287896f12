// Reads and writes the allocation key, and says who may read it ("Who may know what" in the README). The session and the app do
// not include this header; tests/layering_test.cpp checks it. The key lies in the study folder sealed with the owner's passphrase
// (allocation-key.sealed). After the unblinding, and in a study without a passphrase, it lies open (allocation-key.json).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "database/disk/station_key.h"
#include "database/study_store.h"
#include "protocols/orders/allocation.h"

namespace database {

/// Where the owner's passphrase comes from. Called only where a study has one; empty where nobody gives it.
using Passphrase = std::function<std::optional<std::string>()>;

/// Proof that the unblinding of a study is recorded. Results with condition names require it.
class Unblinded {
public:
    const UnblindingRecord& record() const { return m_record; }

private:
    explicit Unblinded(UnblindingRecord record) : m_record(std::move(record)) {}
    friend Unblinded unblind(StudyStore&, const UnblindingRecord&, const Passphrase&);
    friend std::optional<Unblinded> recordedUnblinding(const StudyStore&);
    UnblindingRecord m_record;
};

/// Opens the key, records the unblinding and then leaves the key open in the folder. Nothing is recorded where the key does not
/// open. Throws badInput without the right passphrase.
Unblinded unblind(StudyStore& store, const UnblindingRecord& record, const Passphrase& passphrase);
std::optional<Unblinded> recordedUnblinding(const StudyStore& store);

/// Writes the open key of an unblinded study where it is missing: the disk was full at the unblinding, or somebody removed it.
/// False where nothing was to do. Throws badInput without the right passphrase.
bool completeUnblinding(const StudyStore& store, const Passphrase& passphrase);

/// The key of an unblinded study. Throws workFailed where it is missing, or not the one committed in the database;
/// environmentFault where this account cannot read it.
protocols::AllocationKey readAllocationKey(const StudyStore& store, const Unblinded& permission);

/// The key for aggregates under K-labels, before the unblinding. Empty where the study has a passphrase and nobody gives it.
/// Throws badInput for a wrong one.
std::optional<protocols::AllocationKey> readKeyForAggregates(const StudyStore& store, const Passphrase& passphrase);

/// For scripted and simulated participants only, which must know what is shown. Throws workFailed for a human, badInput without
/// the right passphrase.
protocols::AllocationKey readAllocationKeyForTestDriver(const StudyStore& store, ParticipantKind kind,
                                                        const Passphrase& passphrase);

/// Writes the allocation key and the station key into a new study folder (mode 0600), which is synced as a whole. An empty
/// passphrase leaves the allocation key open. Returns the commitments. Throws environmentFault, also where a key stands already.
struct KeyHashes {
    std::string allocation, station;
};
KeyHashes writeKeys(const StudyFolder& folder, const protocols::AllocationKey& key,
                    const std::optional<std::string>& passphrase = std::nullopt);

/// SHA-256 of the sealed key in a study folder, which the log's first entry keeps; empty where there is no such file.
std::string sha256OfSealedKey(const StudyFolder& folder);

/// The field of that entry. Studies of earlier versions lack it.
inline constexpr const char* sealedKeyField = "sealed_key_sha256";

/// One line for each fault of the key files (missing, altered, not to be opened), and for what could not be checked.
struct KeyFindings {
    std::vector<std::string> faults, notes;
};
/// A sealed key is compared with the log. With a passphrase it is opened, too, and compared with its commitment.
KeyFindings findingsOfKeys(const StudyStore& store, const Passphrase& passphrase = {});

}  // namespace database
