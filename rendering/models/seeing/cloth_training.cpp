#include "rendering/models/seeing/cloth_training.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "rendering/models/seeing/checkpoint.h"
#include "rendering/models/seeing/cloth_steps.h"
#include "rendering/models/seeing/friction_target.h"
#include "rendering/models/training_limits.h"
#include "rendering/models/training_log.h"

namespace rendering::models {

namespace {

using std::chrono::steady_clock;

constexpr int stepsPerLogRow = 50;
/// Patches that calibrate friction, against those of a validation: a tail needs more of them than a mean, and the rarest fibre is
/// one in 25. A training that saw fewer gets the lower number.
constexpr int patchesPerShortCalibration = 5, patchesPerCalibration = 30;

Architecture architectureFor(const ClothTrainingOptions& options, const std::optional<ModelCardFields>& start)
{
    if (start) return start->architecture;
    Architecture architecture;
    architecture.sees = true;
    architecture.baseChannels = options.baseChannels;
    architecture.crop = options.side;
    architecture.imposesSpectrum = false;
    setSpectrogramShape(architecture);
    return architecture;
}

/// The settings that must agree for a checkpoint to be resumed.
std::string fingerprint(const ClothTrainingOptions& options, const std::string& scansHash, const std::string& startHash,
                        const std::string& objective)
{
    std::string text =
        "cloth|" + scansHash + "|" + startHash + "|" + std::to_string(options.seed) + "|" + std::to_string(options.scanShare) +
        "|" + std::to_string(options.learningRate) + "|" +
        (options.steps ? "steps " + std::to_string(*options.steps) : "minutes " + std::to_string(*options.minutes));
    for (const int number : {options.batch, options.side, options.baseChannels}) text += "|" + std::to_string(number);
    for (const protocols::FabricId& id : options.heldOut) text += "|" + id.value;
    return objective == "default" ? text : text + "|" + objective;
}

/// The loop around ClothTraining::step with its time, checkpoints and model card.
class ClothRun {
public:
    ClothRun(const fabrics::Dataset* scans, const ClothTrainingOptions& options, std::ostream& log, bool terminal)
        : m_dataset(scans),
          m_options(options),
          m_out(log),
          m_terminal(terminal),
          m_start(options.from.empty() ? std::nullopt : std::optional(cardOfSeeingModel(options.from))),
          m_architecture(architectureFor(options, m_start))
    {
        if (scans == nullptr) return;
        m_scans = readScannedCloth(*scans, options.heldOut);
        m_scansHash = fabrics::hashOf(*scans);
    }

    void run()
    {
        if (!m_options.towards.empty()) return mix();
        torch::manual_seed(m_options.seed);
        ClothTraining training(m_architecture, m_scans, m_options);
        Checkpoint state;
        state.fingerprint = fingerprint(m_options, m_scansHash, m_start ? m_start->summary.sha256 : "", training.objective());
        const std::filesystem::path checkpoint = checkpointOf(m_options.out);
        if (writes() && m_options.resume) {
            StoredRun stored = readCheckpoint(checkpoint, state.fingerprint, kindsOf(training.tensors()));
            training.continueFrom(stored.tensors);
            state = std::move(stored.state);
            m_out << "resumed at step " << state.step << std::endl;
        }
        if (m_start && !m_options.resume) {
            SeeingNetworks start = readSeeingModel(m_options.from, *m_start);
            training.startFrom(start);
        }
        if (!m_options.place.isAlone()) join(training, state);
        std::optional<TrainingLog> log;
        if (writes()) log.emplace(logOf(m_options.out), m_options.resume ? std::optional(state.step) : std::nullopt);
        m_out << "training on drawn fabrics of family " << m_options.seed << " and " << m_scans.size() << " pictures of scans"
              << std::endl;
        if (m_start && m_start->summary.drawnSeeds.contains(m_options.seed))
            m_out << "note: " << m_start->summary.name << " was trained on the fabrics of family " << m_options.seed
                  << " already, so they are shown again; another --seed draws new ones" << std::endl;
        if (log && m_start && !m_options.resume) validate(training, state.step, *log);
        const steady_clock::time_point started = steady_clock::now();
        const double before = state.elapsedS;
        while (fractionDone(state) < 1) {
            const ClothLosses losses = training.step(state.step, fractionDone(state));
            if (!std::isfinite(losses.relief + losses.friction + losses.spectrogram)) stopAt(state.step + 1);
            ++state.step;
            state.elapsedS = agreed(before + std::chrono::duration<double>(steady_clock::now() - started).count());
            const bool last = fractionDone(state) >= 1;
            if (log && (state.step % stepsPerLogRow == 0 || last)) report(state, losses, *log);
            if (log && state.step % m_options.validateEvery == 0 && !last) validate(training, state.step, *log);
            if (last || state.step % m_options.checkpointEvery == 0) {
                if (!training.finite()) stopAt(state.step);
                if (writes()) writeCheckpoint(checkpoint, state, training.tensors());
            }
        }
        if (writes()) finish(training, state);
        agreed(0);  // The others end when the model is written.
        if (writes())
            std::filesystem::remove(checkpoint);
        else
            m_out << "rank 0 has written the model" << std::endl;
    }

private:
    bool writes() const { return m_options.place.isFirst(); }

    /// Meets the other processes, which take networks, step and time of rank 0.
    void join(ClothTraining& training, Checkpoint& state)
    {
        const TrainingPlace& place = m_options.place;
        m_out << "rank " << place.rank << " of " << place.processes << " waits for the others at " << place.master << std::endl;
        m_peers.emplace(place, agreedSettings());
        training.shareWith(*m_peers);
        state.step = static_cast<int>(agreed(state.step));
        state.elapsedS = agreed(state.elapsedS);
    }

    /// What all processes must have alike.
    AgreedSettings agreedSettings() const
    {
        const auto number = [](double value) { return nlohmann::json(value).dump(); };
        std::string heldOut;
        for (const protocols::FabricId& id : m_options.heldOut) heldOut += (heldOut.empty() ? "" : ",") + id.value;
        return {{"--steps", m_options.steps ? std::to_string(*m_options.steps) : ""},
                {"--minutes", m_options.minutes ? number(*m_options.minutes) : ""},
                {"--seed", std::to_string(m_options.seed)},
                {"--batch", std::to_string(m_options.batch)},
                {"--crop", std::to_string(m_options.side)},
                {"--channels", std::to_string(m_options.baseChannels)},
                {"--learning-rate", number(m_options.learningRate)},
                {"--scan-share", number(m_options.scanShare)},
                {"--checkpoint-every", std::to_string(m_options.checkpointEvery)},
                {"--resume", m_options.resume ? "given" : ""},
                {"--hold-out", heldOut},
                {"the hash of the data set of --scans", m_scansHash},
                {"the hash of the model of --from", m_start ? m_start->summary.sha256 : ""}};
    }

    /// The number of rank 0.
    double agreed(double number) const
    {
        if (!m_peers) return number;
        torch::Tensor shared = torch::full({1}, number, torch::kDouble);
        m_peers->takeFromFirst(shared);
        return shared.item<double>();
    }

    /// Weights on the way to a model that was trained further. Its training is the one that the card tells, but for the files,
    /// which are those of both.
    void mix()
    {
        ModelCardFields card = cardOfSeeingModel(m_options.towards);
        Architecture same = card.architecture;
        same.intervalFactor = m_architecture.intervalFactor;
        same.fibres = m_architecture.fibres;
        if (same != m_architecture)
            throw protocols::badInput({"the two models have other networks, or one belongs to a lab", m_options.towards.string(),
                                       "a model that was trained from " + m_options.from.string(), "name such a model"});
        SeeingNetworks start = readSeeingModel(m_options.from, *m_start), end = readSeeingModel(m_options.towards, card);
        moveTowards(start, end, m_options.way);
        ClothTraining training(m_architecture, m_scans, m_options);
        training.startFrom(start);
        write(training, std::move(card), 0);
    }

    [[noreturn]] void stopAt(int step) const
    {
        throw protocols::workFailed({"the loss is not finite at step " + std::to_string(step), m_options.out.string(),
                                     "finite losses",
                                     "continue from the last checkpoint with --resume, or train again with a "
                                     "smaller --learning-rate"});
    }

    double fractionDone(const Checkpoint& state) const
    {
        return m_options.steps ? static_cast<double>(state.step) / *m_options.steps : state.elapsedS / (*m_options.minutes * 60);
    }

    void report(const Checkpoint& state, const ClothLosses& losses, TrainingLog& log) const
    {
        log.losses(state.step,
                   std::vector<NamedValue>{
                       {"relief", losses.relief}, {"friction", losses.friction}, {"spectrogram", losses.spectrogram}});
        const double fraction = fractionDone(state);
        const int minutesLeft = static_cast<int>(std::ceil(state.elapsedS / fraction * (1 - fraction) / 60));
        m_out << (m_terminal ? "\r" : "") << "step " << state.step << ", relief " << std::round(1000 * losses.relief) / 1000
              << ", friction " << std::round(1000 * losses.friction) / 1000 << ", spectrogram "
              << std::round(1000 * losses.spectrogram) / 1000 << ", about " << minutesLeft << " min left"
              << (m_terminal ? "   " : "\n") << std::flush;
    }

    nlohmann::ordered_json validate(ClothTraining& training, int step, TrainingLog& log) const
    {
        const nlohmann::ordered_json figures =
            clothFigures(training.result(), m_architecture, m_options.validationPatches, m_options.seed);
        std::vector<NamedValue> values;
        for (const auto& [name, value] : figures.items()) values.push_back({name, value.get<double>()});
        log.validation(step, values);
        m_out << (m_terminal ? "\n" : "") << "validation " << figures.dump() << std::endl;
        return figures;
    }

    void finish(ClothTraining& training, const Checkpoint& state)
    {
        ModelCardFields card;
        card.summary.trainedOnProceduralSet = m_dataset == nullptr;
        card.objective = training.objective();
        card.seed = m_options.seed;
        card.steps = card.bestStep = state.step;
        card.trainingMinutes = std::round(state.elapsedS / 6) / 10;
        for (const protocols::FabricId& id : m_options.heldOut) card.heldOut.push_back(id.value);
        card.datasetName = m_dataset != nullptr ? m_dataset->name : "drawn fabrics";
        card.datasetHash = m_scansHash;
        card.summary.drawnSeeds.insert(m_options.seed);
        addTrainingHashes(card, hashesOf(m_scans));
        write(training, std::move(card), state.step);
    }

    /// Calibrates friction, validates, and writes weights and card.
    void write(ClothTraining& training, ModelCardFields card, int step)
    {
        const int most = patchesPerCalibration * m_options.validationPatches;
        const bool isShort = step > 0 && step * m_options.batch < most;
        calibrateFriction(training.result(), m_architecture,
                          isShort ? patchesPerShortCalibration * m_options.validationPatches : most, m_options.seed);
        card.summary.name = m_options.out.stem().string();
        card.summary.trainingCommand = m_options.command;
        card.architecture = m_architecture;
        if (m_start) {
            card.fromName = m_start->summary.name;
            card.fromHash = m_start->summary.sha256;
            card.summary.trainedOnProceduralSet = card.summary.trainedOnProceduralSet && m_start->summary.trainedOnProceduralSet;
            addTrainingHashes(card, m_start->summary.trainingSampleHashes);
            card.summary.drawnSeeds.insert(m_start->summary.drawnSeeds.begin(), m_start->summary.drawnSeeds.end());
        }
        TrainingLog log(logOf(m_options.out), step > 0 ? std::optional(step) : std::nullopt);
        card.validationJson = validate(training, step, log).dump();
        writeSeeingModel(m_options.out, training.result(), card);
        m_out << "wrote " << m_options.out.string();
        if (step > 0) m_out << " after " << step << " steps, " << card.trainingMinutes << " min";
        m_out << std::endl;
    }

    const fabrics::Dataset* m_dataset;
    const ClothTrainingOptions& m_options;
    std::ostream& m_out;
    bool m_terminal;
    std::optional<ModelCardFields> m_start;
    Architecture m_architecture;
    std::vector<ScannedCloth> m_scans;
    std::string m_scansHash;
    std::optional<TrainingPeers> m_peers;
};

void requireUsablePlace(const ClothTrainingOptions& options)
{
    const auto refuse = [](const std::string& what, const std::string& expected) {
        throw protocols::badInput({what, "train", expected, "correct the option"});
    };
    const TrainingPlace& place = options.place;
    if (place.processes < 1 || place.processes > mostProcesses)
        refuse("--processes is " + std::to_string(place.processes), "1 to " + std::to_string(mostProcesses));
    if (place.rank < 0 || place.rank >= place.processes)
        refuse("--rank is " + std::to_string(place.rank), "0 to " + std::to_string(place.processes - 1));
    if (place.waitS < 1 || place.waitS > 86400) refuse("--wait is " + std::to_string(place.waitS), "1 to 86400 s");
    if (place.isAlone()) return;
    if (!options.towards.empty()) refuse("--processes was given together with --towards", "a training");
    if (options.batch < place.processes)
        refuse(
            "a batch of " + std::to_string(options.batch) + " is too small for " + std::to_string(place.processes) + " processes",
            "a patch for each process");
    const std::size_t colon = place.master.rfind(':');
    int port = 0;
    const char* end = place.master.data() + place.master.size();
    if (colon == std::string::npos || colon == 0 || std::from_chars(place.master.data() + colon + 1, end, port).ptr != end ||
        port < 1 || port > 65535)
        refuse("--master is \"" + place.master + "\"", "HOST:PORT of rank 0, such as 192.168.1.10:29500");
}

}  // namespace

void requireUsable(const ClothTrainingOptions& options)
{
    const auto refuse = [](const std::string& what, const std::string& expected) {
        throw protocols::badInput({what, "train", expected, "correct the option"});
    };
    if (options.steps.has_value() == options.minutes.has_value())
        refuse("both or neither of --steps and --minutes were given", "one of them");
    if (options.steps && *options.steps < 1) refuse("--steps is " + std::to_string(*options.steps), "at least 1");
    if (options.minutes && !(*options.minutes > 0)) refuse("--minutes is not positive", "minutes of wall time");
    if (!options.towards.empty() && options.from.empty())
        refuse("--towards was given without --from", "two models: --from MODEL --towards MODEL2");
    if (!(options.way >= 0 && options.way <= 1)) refuse("--way is out of range", "a share of the way, 0 to 1");
    if (options.side < 48 || options.side > largestCrop || options.side % 16 != 0)
        refuse("--crop is " + std::to_string(options.side), "a multiple of 16 from 48 to " + std::to_string(largestCrop));
    if (options.baseChannels < 1 || options.baseChannels > mostChannels)
        refuse("--channels is " + std::to_string(options.baseChannels), "1 to " + std::to_string(mostChannels));
    requireWithinLimits(options.batch, options.learningRate, options.threads);
    if (options.batch < 2 || options.checkpointEvery < 1 || options.validateEvery < 1 || options.validationPatches < 1 ||
        !(options.learningRate > 0))
        refuse("a count or rate is too small", "positive numbers, and a batch of at least 2");
    if (!(options.scanShare >= 0 && options.scanShare <= 1)) refuse("--scan-share is out of range", "0 to 1");
    requireUsablePlace(options);
}

void setTrainingThreads(const ClothTrainingOptions& options)
{
    // Drawing the next batch takes about as long as a step, so one thread is left to it.
    const int threads =
        options.threads > 0 ? options.threads : static_cast<int>(std::max(2U, std::thread::hardware_concurrency()));
    torch::set_num_threads(std::max(1, threads - 1));
}

void addTrainingHashes(ModelCardFields& card, const std::vector<std::string>& hashes)
{
    std::vector<std::string>& all = card.summary.trainingSampleHashes;
    all.insert(all.end(), hashes.begin(), hashes.end());
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
}

ModelCardFields cardOfSeeingModel(const std::filesystem::path& model)
{
    ModelCardFields card = readModelCardFields(model);
    if (!card.architecture.sees)
        throw protocols::badInput({"is no model of `vis2hap train --drawn`", model.string(), "networks for any cloth",
                                   "name such a model, or leave --from out"});
    return card;
}

void trainOnCloth(const fabrics::Dataset* scans, const ClothTrainingOptions& options, std::ostream& log, bool terminal)
{
    requireUsable(options);
    if (options.makeObjective && (scans != nullptr || !options.from.empty() || !options.place.isAlone()))
        throw protocols::badInput({"the losses of the paper were given together with --scans, --from or --processes", "train",
                                   "a control: new networks, drawn fabrics and one process", "leave the other option out"});
    if (options.place.isFirst()) protocols::requireWritable(options.out);
    setTrainingThreads(options);
    ClothRun(scans, options, log, terminal).run();
}

}  // namespace rendering::models
