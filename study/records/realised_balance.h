// The balance of the presentations that took place, beside the planned balance.
#pragma once

#include "database/study_store.h"
#include "protocols/records/balance.h"

namespace study::records {

/// `answers`: those of the store. Covers all sessions of participants who did not withdraw, in the order of presentation. For a
/// voided trial, the presentation that is analysed counts. The certificate names no condition. Contains no ranges before the
/// first presentation.
protocols::BalanceCertificate realisedBalance(const database::StudyStore& store,
                                              const std::vector<database::CurrentAnswer>& answers,
                                              const protocols::Protocol& protocol, const protocols::AllocationKey& key);

}  // namespace study::records
