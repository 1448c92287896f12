// Makes a study from protocol, data set and seed: a folder with blinded running orders, stimuli and keys. The folder is made
// under a temporary name beside its place and renamed at the end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "protocols/records/balance.h"
#include "rendering/cache/result_cache.h"
#include "study/making/own/own_program.h"

namespace study::making {

struct NewStudy {
    std::filesystem::path study;
    std::filesystem::path dataset;
    std::filesystem::path protocol;    ///< empty: the protocol of the paper
    std::string language = "en";       ///< of the participants, for the protocol of the paper; one that has usual texts
    std::filesystem::path model;       ///< empty: the shipped weights
    std::filesystem::path control;     ///< L1-only control of the model; empty: the shipped one of the shipped weights
    std::vector<OwnProgram> programs;  ///< of the conditions that the protocol leaves to the lab
    ProgramLimits programLimits;
    std::optional<int> participants;        ///< replaces the number of the protocol
    std::uint64_t seed = 1;                 ///< for fabrics, samples and running orders
    std::optional<std::uint64_t> keySeed;   ///< for tests; otherwise a secret of the system
    std::optional<std::string> passphrase;  ///< seals the allocation key; empty: the key lies open, and the report says so
    bool allowTrainingSamples = false;
    bool evenStrange = false;        ///< generates from photographs that do not look like cloth; every report states it
    std::string programVersion;      ///< stored with the study, e.g. "vis2hap 0.5.0"
    std::string programCommit;       ///< of the sources; empty where the build does not know it
    std::filesystem::path response;  ///< of the display; empty: levels are linear in the maps
    std::filesystem::path images;    ///< folder for the friction images under their names; reused if their inputs are the same
    bool replaceSimulated = false;   ///< replaces a study in which no human took part
    /// Keeps signals, ranges and their comparison for other studies; null: everything is computed.
    std::shared_ptr<rendering::cache::ResultCache> cache = nullptr;
};

struct MadeStudy {
    database::StudyFacts facts;
    protocols::BalanceCertificate balance;
    /// Of the same orders with even slots, where a phase has few swaps; shows what these cost.
    std::optional<protocols::BalanceCertificate> balanceWithEvenSlots;
    std::vector<std::string> warnings;
    bool imagesReused = false;
};

using StepProgress = std::function<void(int done, int total, const std::string& what)>;

/// Progress of the friction images by step, and of the comparison of signals by stage.
struct StudyProgress {
    StepProgress images = {};
    std::function<void(const std::string& stage, int done, int total)> comparison = {};
    /// Of the images that programs of the lab make.
    std::function<void(const std::string& stage, int done, int total)> programs = {};
    /// For `--explain`: the plan of the whole study as counts (planned_work.h), and the name of each stage before it begins.
    std::function<void(const std::string& text)> planned = {};
    std::function<void(const std::string& name)> stage = {};
};

/// Throws badInput where makeStudy() would refuse the place, the protocol or the list of fabrics. Computes nothing.
void requireInputs(const NewStudy& request);

/// Throws badInput: the folder exists, the protocol does not fit the data set, a signal is missing, the model was trained on
/// all samples. Throws environmentFault: faults of the disk.
MadeStudy makeStudy(const NewStudy& request, const StudyProgress& progress = {});

}  // namespace study::making
