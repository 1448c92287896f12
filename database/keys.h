// Reads and writes the keys, and says who may read which one ("Who may know what" in the README). The session and the app do not
// include this header; tests/layering_test.cpp checks it.
#pragma once

#include <string>

#include "database/study_store.h"
#include "protocols/allocation.h"

namespace database {

/// Proof that the unblinding of a study is recorded. Results with condition names require it.
class Unblinded {
public:
    const UnblindingRecord& record() const { return m_record; }

private:
    explicit Unblinded(UnblindingRecord record) : m_record(std::move(record)) {}
    friend Unblinded unblind(StudyStore&, const std::string&, const std::string&, const std::string&);
    friend std::optional<Unblinded> recordedUnblinding(const StudyStore&);
    UnblindingRecord m_record;
};

/// Records the unblinding (who, why, when) and permits reading condition names. `wallTime`: ISO 8601.
Unblinded unblind(StudyStore& store, const std::string& who, const std::string& why, const std::string& wallTime);
std::optional<Unblinded> recordedUnblinding(const StudyStore& store);

/// Both check the key against its hash in the database. They throw workFailed if it differs.
protocols::AllocationKey readAllocationKey(const StudyStore& store, const Unblinded& permission);
protocols::MaskedKey readMaskedKey(const StudyStore& store);

/// For scripted and simulated participants only, which must know what is shown. Throws workFailed for a human.
protocols::AllocationKey readAllocationKeyForTestDriver(const StudyStore& store, ParticipantKind kind);

/// Writes allocation-key.json (mode 0600) and masked-key.json into a new study folder, which is synced as a whole. Returns
/// their SHA-256. Throws environmentFault, also where a key stands already.
struct KeyHashes {
    std::string allocation, masked;
};
KeyHashes writeKeys(const StudyFolder& folder, const protocols::AllocationKey& key);

/// One line for each fault of the two key files: unreadable, altered, readable by others.
std::vector<std::string> faultsOfKeys(const StudyStore& store);

}  // namespace database
