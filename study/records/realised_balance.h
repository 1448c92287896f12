// The balance that was reached by what was presented, not by what was planned.
#pragma once

#include "database/study_store.h"
#include "protocols/balance.h"

namespace study::records {

/// Over all sessions of participants who did not withdraw, in the order in which trials were presented; of a
/// voided trial the presentation that counts. Uses the masked key alone: conditions are K-labels, so the
/// certificate tells none. Empty ranges while nothing was presented.
protocols::BalanceCertificate realisedBalance(const database::StudyStore& store, const protocols::Protocol& protocol);

}  // namespace study::records
