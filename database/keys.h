// Who may read which key (see "Who may know what" in the README). Session and app include neither
// this nor the key types' readers; tests/layering_test guards it.
#pragma once

#include <string>

#include "database/study_store.h"
#include "protocols/allocation.h"

namespace database {

/// Proof that a study's unblinding is recorded; results with condition names ask for one.
class Unblinded {
public:
    const UnblindingRecord& record() const { return m_record; }

private:
    explicit Unblinded(UnblindingRecord record) : m_record(std::move(record)) {}
    friend Unblinded unblind(StudyStore&, const std::string&, const std::string&, const std::string&);
    friend std::optional<Unblinded> recordedUnblinding(const StudyStore&);
    UnblindingRecord m_record;
};

/// Records the act (who, why, when), then lets names be read. `wallTime` ISO 8601.
Unblinded unblind(StudyStore& store, const std::string& who, const std::string& why, const std::string& wallTime);
std::optional<Unblinded> recordedUnblinding(const StudyStore& store);

/// Both keys are checked against the commitment in the database; workFailed where they differ.
protocols::AllocationKey readAllocationKey(const StudyStore& store, const Unblinded& permission);
protocols::MaskedKey readMaskedKey(const StudyStore& store);

/// For scripted and simulated participants alone: drivers of tests, which must know what is shown.
protocols::AllocationKey readAllocationKeyForTestDriver(const StudyStore& store, ParticipantKind kind);

/// Writes allocation-key.json (mode 0600) and masked-key.json into a new study folder, which is synced as a whole. Returns
/// their SHA-256. Throws environmentFault, also where a key stands already.
struct KeyHashes {
    std::string allocation, masked;
};
KeyHashes writeKeys(const StudyFolder& folder, const protocols::AllocationKey& key);

/// verify: fault lines of both key files against the commitment.
std::vector<std::string> faultsOfKeys(const StudyStore& store);

}  // namespace database
