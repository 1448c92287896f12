#include "rendering/models/training.h"

#include "protocols/errors.h"
#include "rendering/models/batch_tensors.h"
#include "rendering/models/checkpoint.h"
#include "rendering/models/losses.h"
#include "rendering/models/progress_lines.h"
#include "rendering/models/validation.h"
#include "rendering/models/weights.h"

#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>

namespace rendering::models {

namespace {

using Clock = std::chrono::steady_clock;

/// The discriminator learns at half the generators' rate; at the same rate it wins at once.
constexpr double discriminatorPace = 0.5;

torch::optim::Adam adam(std::vector<torch::Tensor> parameters, double learningRate)
{
    return torch::optim::Adam(std::move(parameters), torch::optim::AdamOptions(learningRate).betas(std::make_tuple(0.5, 0.999)));
}

std::vector<torch::Tensor> parametersOf(Generators& generators)
{
    std::vector<torch::Tensor> all = generators.height->parameters();
    for (const torch::Tensor& parameter : generators.friction->parameters())
        all.push_back(parameter);
    return all;
}

void setRate(torch::optim::Adam& optimiser, double rate)
{
    for (torch::optim::OptimizerParamGroup& group : optimiser.param_groups())
        static_cast<torch::optim::AdamOptions&>(group.options()).lr(rate);
}

void requireGradients(torch::nn::Module& module, bool wanted)
{
    for (torch::Tensor& parameter : module.parameters())
        parameter.set_requires_grad(wanted);
}

/// Generators and discriminator on their way, and one step of both.
class Contest {
public:
    Contest(const TrainingData& data, const TrainingOptions& options)
        : m_data(data),
          m_options(options),
          m_weights(options.reference ? referenceWeights() : defaultWeights()),
          m_generators(makeGenerators(data.architecture)),
          m_discriminator(data.architecture),
          m_generatorSteps(adam(parametersOf(m_generators), options.learningRate)),
          m_discriminatorSteps(adam(m_discriminator->parameters(), options.learningRate * discriminatorPace))
    {
    }

    /// `fraction` of the training done, for the falling rate. Each step's batch comes from its own
    /// stream, so a resumed run draws what the unbroken one would have drawn.
    StepLosses step(int number, double fraction)
    {
        const double fall = 0.05 + 0.95 * 0.5 * (1 + std::cos(std::numbers::pi * fraction));
        setRate(m_generatorSteps, m_options.learningRate * fall);
        setRate(m_discriminatorSteps, m_options.learningRate * discriminatorPace * fall);
        protocols::Random random = protocols::Random::stream(m_options.seed, "step/" + std::to_string(number));
        const TensorBatch batch = tensorsOf(drawBatch(m_data, m_data.training, m_options.batch, true, random));
        const Touch generated{m_generators.height->forward(batch.photograph), m_generators.friction->forward(batch.photograph)};
        StepLosses losses;
        losses.discriminator = stepDiscriminator(batch, generated);
        stepGenerators(batch, generated, losses);
        return losses;
    }

    Generators& generators() { return m_generators; }

    /// A finite loss may still be followed by a step out of all bounds.
    bool finite()
    {
        for (const torch::Tensor& parameter : parametersOf(m_generators))
            if (!torch::isfinite(parameter).all().item<bool>())
                return false;
        return true;
    }

    void save(torch::serialize::OutputArchive& archive)
    {
        const auto put = [&](const std::string& name, const auto& part) {
            torch::serialize::OutputArchive inner(archive.compilation_unit());
            part.save(inner);
            archive.write(name, inner);
        };
        put("height", *m_generators.height);
        put("friction", *m_generators.friction);
        put("discriminator", *m_discriminator);
        put("generator_steps", m_generatorSteps);
        put("discriminator_steps", m_discriminatorSteps);
    }

    void load(torch::serialize::InputArchive& archive)
    {
        const auto take = [&](const std::string& name, auto& part) {
            torch::serialize::InputArchive inner;
            archive.read(name, inner);
            part.load(inner);
        };
        take("height", *m_generators.height);
        take("friction", *m_generators.friction);
        take("discriminator", *m_discriminator);
        take("generator_steps", m_generatorSteps);
        take("discriminator_steps", m_discriminatorSteps);
    }

private:
    double stepDiscriminator(const TensorBatch& batch, const Touch& generated)
    {
        m_discriminatorSteps.zero_grad();
        const torch::Tensor real = m_discriminator->forward(batch.photograph, batch.touch.friction, batch.touch.height);
        const FrictionGuess guess{generated.friction.logRatio.detach(), generated.friction.mean.detach()};
        const torch::Tensor fake = m_discriminator->forward(batch.photograph, guess, generated.height.detach());
        const torch::Tensor loss = discriminatorLoss(real, fake);
        loss.backward();
        m_discriminatorSteps.step();
        return loss.item<double>();
    }

    void stepGenerators(const TensorBatch& batch, const Touch& generated, StepLosses& losses)
    {
        m_generatorSteps.zero_grad();
        requireGradients(*m_discriminator, false);
        const torch::Tensor verdict = m_discriminator->forward(batch.photograph, generated.friction, generated.height);
        const torch::Tensor adversarial = adversarialLoss(verdict);
        const torch::Tensor apart = distance(generated, batch.touch, m_weights, m_data.architecture.meanFrictionScale);
        (m_weights.adversarial * adversarial + apart).backward();
        m_generatorSteps.step();
        requireGradients(*m_discriminator, true);
        losses.generators = adversarial.item<double>();
        losses.l1 = apart.item<double>();
    }

    const TrainingData& m_data;
    const TrainingOptions& m_options;
    LossWeights m_weights;
    Generators m_generators;
    Discriminator m_discriminator;
    torch::optim::Adam m_generatorSteps, m_discriminatorSteps;
};

void checkOptions(const TrainingOptions& options)
{
    const auto refuse = [](const std::string& what, const std::string& expected) {
        throw protocols::badInput({what, "train", expected, ""});
    };
    if (options.steps.has_value() == options.minutes.has_value())
        refuse("both or neither of --steps and --minutes", "one of them");
    if (options.steps && *options.steps < 1)
        refuse("--steps " + std::to_string(*options.steps), "at least 1");
    if (options.minutes && !(*options.minutes > 0))
        refuse("--minutes is not positive", "minutes of wall time");
    if (options.crop < 32 || options.crop % 16 != 0)
        refuse("--crop " + std::to_string(options.crop), "a multiple of 16, at least 32");
    if (options.batch < 1 || options.baseChannels < 1 || options.checkpointEvery < 1 || options.validationPairs < 1 ||
        !(options.learningRate > 0))
        refuse("a count or rate is not positive", "positive numbers");
}

/// Settings by which a checkpoint is recognised as of this run.
std::string fingerprint(const TrainingOptions& options, const TrainingData& data, const std::string& datasetHash)
{
    std::string text = datasetHash + "|" + std::to_string(options.seed) + "|" + std::to_string(options.splitSeed) + "|" +
                       std::to_string(options.batch) + "|" + std::to_string(options.crop) + "|" +
                       std::to_string(options.baseChannels) + "|" + std::to_string(options.learningRate) + "|" +
                       (options.reference ? "reference" : "default") + "|" +
                       (options.steps ? "steps " + std::to_string(*options.steps) : "minutes " + std::to_string(*options.minutes));
    for (const protocols::FabricId& id : options.heldOut)
        text += "|" + id.value;
    return text + "|" + std::to_string(data.trainingHashes.size());
}

nlohmann::ordered_json validated(const TrainingData& data, Generators& generators, const TrainingOptions& options)
{
    if (data.validation.empty())
        return nullptr;
    protocols::Random random = protocols::Random::stream(options.seed, "validation");
    return validationFigures(data, generators, options.validationPairs, random);
}

/// One whole run: the loop around Contest::step with its clock, checkpoints and model card.
class Run {
public:
    Run(const fabrics::Dataset& dataset, const TrainingOptions& options, std::ostream& log, bool terminal)
        : m_dataset(dataset), m_options(options), m_lines(log, terminal)
    {
        TrainingDataOptions reading;
        reading.splitSeed = options.splitSeed;
        reading.heldOut = options.heldOut;
        Architecture wanted;
        wanted.baseChannels = options.baseChannels;
        wanted.crop = options.crop;
        m_data = readTrainingData(dataset, wanted, reading, [&](int done, int total) { m_lines.reading(done, total); });
        for (const std::string& note : m_data.notes)
            m_lines.say(note);
        m_datasetHash = fabrics::hashOf(dataset);
        m_lines.say("training on " + std::to_string(m_data.trainingHashes.size()) + " files of " +
                    std::to_string(m_data.training.size()) + " fabrics");
    }

    void go()
    {
        torch::manual_seed(m_options.seed);
        Contest contest(m_data, m_options);
        Checkpoint state;
        state.fingerprint = fingerprint(m_options, m_data, m_datasetHash);
        const std::filesystem::path checkpoint = checkpointOf(m_options.out);
        if (m_options.resume) {
            state = readCheckpoint(checkpoint, state.fingerprint, [&](auto& archive) { contest.load(archive); });
            m_lines.say("resumed at step " + std::to_string(state.step));
        } else {
            state.validationBefore = validated(m_data, contest.generators(), m_options).dump();
        }
        const Clock::time_point started = Clock::now();
        const double before = state.elapsedS;
        const auto save = [&](torch::serialize::OutputArchive& archive) { contest.save(archive); };
        while (fractionDone(state) < 1) {
            const StepLosses losses = contest.step(state.step, fractionDone(state));
            if (!losses.finite())
                stopAt(state.step + 1);
            ++state.step;
            state.elapsedS = before + std::chrono::duration<double>(Clock::now() - started).count();
            m_lines.step(state.step, fractionDone(state), losses, remainingS(state));
            if (state.step % m_options.checkpointEvery == 0 || fractionDone(state) >= 1) {
                if (!contest.finite())
                    stopAt(state.step);
                writeCheckpoint(checkpoint, state, save);
            }
        }
        finish(contest, state);
        std::filesystem::remove(checkpoint);
    }

private:
    [[noreturn]] void stopAt(int step) const
    {
        const std::filesystem::path checkpoint = checkpointOf(m_options.out);
        const std::string kept = std::filesystem::exists(checkpoint)
                                     ? "the last checkpoint before it is kept in " + checkpoint.string() + "; "
                                     : std::string();
        throw protocols::workFailed({"the loss is no longer a number at step " + std::to_string(step), m_options.out.string(),
                                     "finite losses", kept + "train again with a smaller --learning-rate"});
    }

    double fractionDone(const Checkpoint& state) const
    {
        return m_options.steps ? static_cast<double>(state.step) / *m_options.steps : state.elapsedS / (*m_options.minutes * 60);
    }

    double remainingS(const Checkpoint& state) const
    {
        const double fraction = fractionDone(state);
        return m_options.steps ? state.elapsedS / fraction * (1 - fraction) : *m_options.minutes * 60 - state.elapsedS;
    }

    void finish(Contest& contest, const Checkpoint& state)
    {
        roundToHalf(contest.generators());
        ModelCardFields card;
        card.told.name = m_options.out.stem().string();
        card.told.trainedOnProceduralSet = m_dataset.procedural;
        card.told.trainingSampleHashes = m_data.trainingHashes;
        card.told.trainingCommand = m_options.command;
        card.architecture = m_data.architecture;
        card.seed = m_options.seed;
        card.splitSeed = m_options.splitSeed;
        card.steps = state.step;
        card.trainingMinutes = std::round(state.elapsedS / 6) / 10;
        card.reference = m_options.reference;
        for (const protocols::FabricId& id : m_options.heldOut)
            card.heldOut.push_back(id.value);
        card.datasetName = m_dataset.name;
        card.datasetHash = m_datasetHash;
        card.validation = {{"before", nlohmann::ordered_json::parse(state.validationBefore)},
                           {"after", validated(m_data, contest.generators(), m_options)}};
        writeModel(m_options.out, contest.generators(), card);
        m_lines.finished(card);
    }

    const fabrics::Dataset& m_dataset;
    const TrainingOptions& m_options;
    ProgressLines m_lines;
    TrainingData m_data;
    std::string m_datasetHash;
};

}  // namespace

void train(const fabrics::Dataset& dataset, const TrainingOptions& options, std::ostream& log, bool terminal)
{
    checkOptions(options);
    requireWritable(options.out);
    torch::set_num_threads(options.threads > 0 ? options.threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
    Run(dataset, options, log, terminal).go();
}

}  // namespace rendering::models
