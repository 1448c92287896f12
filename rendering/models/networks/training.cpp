#include "rendering/models/networks/training.h"

#include <malloc.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "protocols/files/canonical_bytes.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "rendering/models/networks/adversarial_training.h"
#include "rendering/models/networks/progress_lines.h"
#include "rendering/models/networks/validation.h"
#include "rendering/models/networks/weights.h"
#include "rendering/models/seeing/checkpoint.h"
#include "rendering/models/training_limits.h"
#include "rendering/models/training_log.h"

namespace rendering::models {

namespace {

using std::chrono::steady_clock;

void checkOptions(const TrainingOptions& options)
{
    const auto refuse = [](const std::string& what, const std::string& expected) {
        throw protocols::badInput({what, "train", expected, "correct the option"});
    };
    if (options.steps.has_value() == options.minutes.has_value())
        refuse("both or neither of --steps and --minutes were given", "one of them");
    if (options.steps && *options.steps < 1) refuse("--steps is " + std::to_string(*options.steps), "at least 1");
    if (options.stopAt && (*options.stopAt < 1 || !options.steps || *options.stopAt > *options.steps))
        refuse("--stop-at is " + std::to_string(*options.stopAt), "from 1 to --steps, which must be given");
    if (options.minutes && !(*options.minutes > 0)) refuse("--minutes is not positive", "minutes of wall time");
    if (options.crop < 32 || options.crop > largestCrop || options.crop % 16 != 0)
        refuse("--crop is " + std::to_string(options.crop), "a multiple of 16 from 32 to " + std::to_string(largestCrop));
    if (options.baseChannels > mostChannels)
        refuse("--channels is " + std::to_string(options.baseChannels), "at most " + std::to_string(mostChannels));
    requireWithinLimits(options.batch, options.learningRate, options.threads);
    if (options.batch < 1 || options.baseChannels < 1 || options.checkpointEvery < 1 || options.validationPairs < 1 ||
        options.validateEvery < 1 || options.patience < 1 || !(options.learningRate > 0))
        refuse("a count or rate is not positive", "positive numbers");
}

/// Text of the settings and files that must agree for a checkpoint to be resumed. Another version may split a data set otherwise.
std::string fingerprint(const TrainingOptions& options, const TrainingData& data, const std::string& datasetHash)
{
    std::string text = datasetHash;
    for (const auto number : {options.seed, options.splitSeed}) text += "|" + std::to_string(number);
    for (const int number :
         {options.batch, options.crop, options.baseChannels, options.validateEvery, options.patience, options.validationPairs})
        text += "|" + std::to_string(number);
    text += "|" + std::to_string(options.learningRate) + "|" + nameOf(options.objective) + "|" + nameOf(options.split) + "|" +
            (options.steps ? "steps " + std::to_string(*options.steps) : "minutes " + std::to_string(*options.minutes));
    if (options.stopAt) text += "|stop at " + std::to_string(*options.stopAt);
    for (const protocols::FabricId& id : options.heldOut) text += "|" + id.value;
    protocols::CanonicalBytes files;
    for (const std::string& hash : data.trainingHashes) files << hash;
    return text + "|" + files.hash();
}

constexpr int stepsPerLogRow = 10;

/// Keeps freed memory in the process. Each step needs the same large tensors, and new pages would cause page faults.
void keepFreedMemory()
{
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
    ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

/// A whole run: the loop around AdversarialTraining::step with its time, checkpoints and model card.
class TrainingRun {
public:
    TrainingRun(const fabrics::Dataset& dataset, const TrainingOptions& options, std::ostream& log, bool terminal)
        : m_dataset(dataset), m_options(options), m_lines(log, terminal)
    {
        TrainingDataOptions reading;
        reading.splitSeed = options.splitSeed;
        reading.split = options.split;
        reading.heldOut = options.heldOut;
        Architecture wanted;
        wanted.baseChannels = options.baseChannels;
        wanted.crop = options.crop;
        wanted.imposesSpectrum = options.objective == Objective::Default && dataset.pairing == fabrics::Pairing::Weak;
        m_data = readTrainingData(dataset, wanted, reading, [&](int done, int total) { m_lines.reading(done, total); });
        for (const std::string& note : m_data.notes) m_lines.print(note);
        m_datasetHash = fabrics::hashOf(dataset);
        m_lines.print("training on " + std::to_string(m_data.trainingHashes.size()) + " files of " +
                      std::to_string(m_data.training.size()) + " fabrics");
    }

    void run()
    {
        torch::manual_seed(m_options.seed);
        AdversarialTraining training(m_data, m_options);
        Checkpoint state;
        state.fingerprint = fingerprint(m_options, m_data, m_datasetHash);
        const std::filesystem::path checkpoint = checkpointOf(m_options.out);
        if (m_options.resume) {
            StoredRun stored = readCheckpoint(checkpoint, state.fingerprint, kindsOf(training.tensors()));
            training.continueFrom(stored.tensors);
            state = std::move(stored.state);
            m_lines.print("resumed at step " + std::to_string(state.step));
        } else {
            state.validationBefore = figures(training.result()).dump();
        }
        TrainingLog log(logOf(m_options.out), m_options.resume ? std::optional(state.step) : std::nullopt);
        const steady_clock::time_point started = steady_clock::now();
        const double before = state.elapsedS;
        while (!ended(state)) {
            const StepLosses losses = training.step(state.step, fractionDone(state));
            if (!losses.finite()) stopAt(state.step + 1);
            ++state.step;
            state.elapsedS = before + std::chrono::duration<double>(steady_clock::now() - started).count();
            m_lines.step(state.step, fractionDone(state), losses, remainingS(state));
            const bool last = isAtEnd(state);
            if (state.step % stepsPerLogRow == 0)
                log.losses(state.step, std::vector<NamedValue>{{"discriminator", losses.discriminator},
                                                               {"generators", losses.generators},
                                                               {"distance", losses.distance}});
            if (last || state.step % m_options.validateEvery == 0) validate(training, state, log);
            if (last || state.step % m_options.checkpointEvery == 0 || ended(state)) {
                if (!training.finite()) stopAt(state.step);
                writeCheckpoint(checkpoint, state, training.tensors());
            }
        }
        finish(training, state);
        std::filesystem::remove(checkpoint);
    }

private:
    [[noreturn]] void stopAt(int step) const
    {
        const std::filesystem::path checkpoint = checkpointOf(m_options.out);
        const std::string kept = std::filesystem::exists(checkpoint)
                                     ? "the last checkpoint before it stays in " + checkpoint.string() + "; "
                                     : std::string();
        throw protocols::workFailed({"the loss is not finite at step " + std::to_string(step), m_options.out.string(),
                                     "finite losses", kept + "train again with a smaller --learning-rate"});
    }

    bool isAtEnd(const Checkpoint& state) const
    {
        return fractionDone(state) >= 1 || (m_options.stopAt && state.step >= *m_options.stopAt);
    }

    bool ended(const Checkpoint& state) const { return isAtEnd(state) || state.validationsWithoutBetter >= m_options.patience; }

    nlohmann::ordered_json figures(Generators& generators) const
    {
        if (m_data.validation.empty()) return nullptr;
        protocols::Random random = protocols::Random::stream(m_options.seed, "validation");
        return validationFigures(m_data, generators, weightsFor(m_options.objective), m_options.validationPairs, random);
    }

    /// Keeps the networks if they are better than at every earlier validation. Those of the reference are always kept, because
    /// adversarial losses do not decrease steadily.
    void validate(AdversarialTraining& training, Checkpoint& state, TrainingLog& log)
    {
        if (!training.finite()) stopAt(state.step);
        const nlohmann::ordered_json now = figures(training.result());
        const double distance = now.is_null() ? -state.step : now.at("distance").at("generated").get<double>();
        const bool better = m_options.objective == Objective::Reference || distance < state.bestDistance;
        state.validationsWithoutBetter = better ? 0 : state.validationsWithoutBetter + 1;
        if (better) {
            state.bestDistance = distance;
            state.bestStep = state.step;
            training.keepAsBest();
        }
        m_lines.validated(state.step, now, better);
        if (now.is_null()) return;
        std::vector<NamedValue> values;
        for (const auto& [name, value] : now.items())
            if (value.is_object()) values.push_back({name, value.at("generated").get<double>()});
        log.validation(state.step, values);
        log.pictures(state.step, sampleRows(m_data, training.result(), m_options.seed));
        m_lines.print("distance " + sparkline(log.valuesOf("distance")));
    }

    double fractionDone(const Checkpoint& state) const
    {
        return m_options.steps ? static_cast<double>(state.step) / *m_options.steps : state.elapsedS / (*m_options.minutes * 60);
    }

    double remainingS(const Checkpoint& state) const
    {
        if (!m_options.steps) return *m_options.minutes * 60 - state.elapsedS;
        return state.elapsedS / state.step * (m_options.stopAt.value_or(*m_options.steps) - state.step);
    }

    void finish(AdversarialTraining& training, const Checkpoint& state)
    {
        Generators& best = training.best();
        roundToHalf(best);
        ModelCardFields card;
        card.summary.name = m_options.out.stem().string();
        card.summary.trainedOnProceduralSet = m_dataset.procedural;
        card.summary.trainingSampleHashes = m_data.trainingHashes;
        card.summary.trainingCommand = m_options.command;
        card.architecture = m_data.architecture;
        card.seed = m_options.seed;
        card.splitSeed = m_options.splitSeed;
        card.steps = state.step;
        card.bestStep = state.bestStep;
        card.trainingMinutes = std::round(state.elapsedS / 6) / 10;
        card.objective = nameOf(m_options.objective);
        card.split = nameOf(m_options.split);
        for (const protocols::FabricId& id : m_options.heldOut) card.heldOut.push_back(id.value);
        card.datasetName = m_dataset.name;
        card.datasetHash = m_datasetHash;
        const nlohmann::ordered_json validation{{"before", nlohmann::ordered_json::parse(state.validationBefore)},
                                                {"after", figures(best)}};
        card.validationJson = validation.dump();
        writeModel(m_options.out, best, card);
        m_lines.finished(card);
    }

    const fabrics::Dataset& m_dataset;
    const TrainingOptions& m_options;
    ProgressLines m_lines;
    TrainingData m_data;
    std::string m_datasetHash;
};

}  // namespace

std::string nameOf(Objective objective)
{
    switch (objective) {
        case Objective::Default:
            return "default";
        case Objective::Reference:
            return "reference";
        case Objective::L1Only:
            return "l1-only";
    }
    return {};
}

void train(const fabrics::Dataset& dataset, const TrainingOptions& options, std::ostream& log, bool terminal)
{
    checkOptions(options);
    protocols::requireWritable(options.out);
    keepFreedMemory();
    torch::set_num_threads(options.threads > 0 ? options.threads
                                               : static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
    TrainingRun(dataset, options, log, terminal).run();
}

}  // namespace rendering::models
