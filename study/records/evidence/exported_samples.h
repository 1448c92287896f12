// Samples of the finger as a CSV table, for exports of an unblinded study: before that the speed and the force of a
// presentation could give its condition away.
#pragma once

#include <optional>
#include <string>

#include "study/records/stored_study.h"

namespace study::records {

/// One row a sample: participant, trial, attempt, voided, at_ns, x_mm, y_mm, force_n; with `naming` also fabric and condition.
/// A stored stretch that is damaged has one row without time and values. `participant`: only theirs; empty: everybody's.
std::string fingerSamplesCsv(const database::StudyStore& store, const protocols::ParticipantId& participant,
                             const std::optional<Naming>& naming);

}  // namespace study::records
