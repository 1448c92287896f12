// Studies of earlier versions (schemas 1 and 2), whose stimuli, keys and file codes lay open. Opening one for writing upgrades
// it:
//   1. .upgrade/ is filled with the new database, the new keys and the sealed stimuli, and synced.
//   2. before-upgrade/ becomes a whole copy of the study as it is (a second one before-upgrade-2/).
//   3. The new database is renamed over study.db. Until here the older study is untouched.
//   4. Stimuli and keys are moved to their places, the open ones are removed, and .upgrade/ vanishes.
// A program that is killed before step 3 leaves the older study, and the next opening begins anew. One that is killed after it
// leaves step 4 to the next opening. A study that cannot be upgraded keeps its files, and no copy of it is left: that would lie
// open, too.
// The store calls these functions; database/upgrade, which reads and writes by the store's own rules, has them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "database/disk/study_folder.h"
#include "protocols/files/temporary_folder.h"

namespace database {

/// Whether the study has an older schema. Throws as checkedVersion().
bool isOlder(const StudyFolder& folder);

/// Whether an upgrade waits to be finished.
bool hasUnfinishedUpgrade(const StudyFolder& folder);

/// Called after each step that a killed program may have reached last.
using UpgradeStep = std::function<void(const std::string& step)>;

/// Upgrades the study or finishes its upgrade; the caller holds the write lock. Returns what the operator must know. Throws
/// workFailed where the allocation key is missing or altered or rows are damaged, environmentFault where another program reads
/// the study or the disk fails.
std::string upgrade(const StudyFolder& folder, const UpgradeStep& reached = {});

/// An upgraded copy of the study for a program that only reads, with certificates and recordings. The folder of the study stays
/// as it is.
std::unique_ptr<protocols::TemporaryFolder> upgradedCopy(const StudyFolder& folder);

/// "before-upgrade/study.db" and the like: the copies that upgrades left in the folder and that know the participant.
std::vector<std::string> copiesBeforeUpgradeOf(const std::string& participant, const StudyFolder& folder);

}  // namespace database
