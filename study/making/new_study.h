// Making a study: protocol + data set + seed -> study folder with blinded lists, stimuli and keys.
// Everything is made in a temporary folder beside the study and renamed at the end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "protocols/balance.h"

namespace study::making {

struct NewStudy {
    std::filesystem::path study;
    std::filesystem::path dataset;
    std::filesystem::path protocol;        ///< empty: the paper's
    std::filesystem::path model;           ///< empty: the shipped weights
    std::optional<int> participants;       ///< instead of the protocol's
    std::uint64_t seed = 1;                ///< fabrics, samples, running orders
    std::optional<std::uint64_t> keySeed;  ///< tests only; else a secret of the system
    bool allowTrainingSamples = false;
    std::string programVersion;     ///< kept with the study, e.g. "vis2hap 0.5.0"
    std::filesystem::path images;   ///< keep the friction images here by name, and reuse them if they fit
    bool replaceSimulated = false;  ///< remake a study in which no human took part
};

struct MadeStudy {
    database::StudyFacts facts;
    protocols::BalanceCertificate balance;
    std::vector<std::string> warnings;
    bool imagesReused = false;
};

using StepProgress = std::function<void(int done, int total, const std::string& what)>;

/// Throws badInput (a folder that exists, a protocol that does not fit the data set, a signal that is
/// missing, only samples that the model was trained on), environmentFault (disk).
MadeStudy makeStudy(const NewStudy& request, const StepProgress& progress = {});

}  // namespace study::making
