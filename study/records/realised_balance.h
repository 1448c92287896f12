// The balance of the presentations that took place, beside the planned balance.
#pragma once

#include "database/study_store.h"
#include "protocols/records/balance.h"

namespace study::records {

/// Covers all sessions of participants who did not withdraw, in the order of presentation. For a voided trial, the
/// presentation that is analysed counts. Conditions are K-labels of the masked key, so the certificate names no condition.
/// Contains no ranges before the first presentation.
protocols::BalanceCertificate realisedBalance(const database::StudyStore& store, const protocols::Protocol& protocol);

}  // namespace study::records
