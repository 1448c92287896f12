// Attacks a study as each role could and says what the role learns: an operator with a shell, who lacks both keys; an operator
// who opens the station key too; the owner, who has the passphrase. The answers of participants are no leak: no seal can hide
// them.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "protocols/orders/allocation.h"
#include "study/leaks/guessers.h"

namespace study::leaks {

/// Family-wise error of the verdict.
inline constexpr double alpha = 0.001;

/// Writes an export or a report that needs no key into an existing empty folder.
struct Exporter {
    std::string name;
    std::function<void(const std::filesystem::path& folder)> write;
};

struct LeakReport {
    std::string study;
    std::size_t trials = 0;  ///< attacked
    std::size_t slots = 0;   ///< running orders that hold them
    std::size_t trialsOfStudy = 0, slotsOfStudy = 0;
    std::size_t choices = 0;   ///< of them, with a true piece among foils
    std::size_t features = 0;  ///< readable values beside trials
    bool isUnblinded = false;
    bool hasTruth = false;              ///< false: nobody gave the passphrase, and hits cannot be counted
    std::vector<std::string> findings;  ///< differences and words that need no guess
    std::vector<std::string> modes;     ///< files and folders that other users of the computer may read
    std::vector<Guess> guesses;         ///< of the operator with a shell

    /// What the station key adds.
    struct StationKey {
        bool isReadable = false;
        std::size_t images = 0;  ///< different images that the opened codes lead to
        std::size_t named = 0;   ///< choice trials whose piece a rating trial with the same image names
        std::size_t hits = 0;    ///< of them, right
    } stationKey;

    std::vector<const Guess*> aboveChance() const;
    /// What the verdict can find: a guesser who names this share of the true pieces, of all that were guessed at by one guesser.
    /// In a study without choices the same for what is guessed at most: conditions, or same and different.
    struct Power {
        std::string target;  ///< as Guess has it
        long long trials = 0;
        double chance = 0;
        std::optional<double> share = {};  ///< none: not even a guesser who is always right
    };
    /// None where nothing is guessed at, and where hits are not counted.
    std::optional<Power> power() const;
    /// The study has so few trials that not even a guesser who is always right would stand out.
    bool isTooSmallToTell() const;
    /// The operator with a shell learns nothing: no finding, no mode, the hits of enough trials counted, and no guesser above
    /// chance.
    bool learnsNothing() const;
};

/// `key`: the truth; none: nobody gave the passphrase. Throws as StudyStore does. The test counts trials as independent. In a
/// study of a dozen presentations they are not: it has few running orders, and a wrong one can be the true one by luck.
/// `cache`: the folder of kept signals, which is attacked too; empty or missing: there is none. `unknownFiles`: paths in the
/// folder that do not belong to the study. They are findings and are not read: hits of columns that somebody made up would name
/// the truth.
LeakReport leakReport(const database::StudyStore& store, const std::optional<protocols::AllocationKey>& key,
                      const std::vector<Exporter>& exporters, const std::filesystem::path& cache = {},
                      const std::vector<std::filesystem::path>& unknownFiles = {});

}  // namespace study::leaks
