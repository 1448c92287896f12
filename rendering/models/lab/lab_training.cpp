#include "rendering/models/lab/lab_training.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "protocols/files/canonical_bytes.h"
#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/drawn/drawn_dataset.h"
#include "rendering/models/drawn_memory.h"
#include "rendering/models/lab/lab_steps.h"
#include "rendering/models/lab/lab_table.h"
#include "rendering/models/seeing/checkpoint.h"
#include "rendering/models/training_log.h"

namespace rendering::models {

namespace {

using std::chrono::steady_clock;

constexpr int stepsPerLabRow = 10;
/// Weights are looked at this often during a training.
constexpr int looks = 4;
constexpr int photographsForFigures = 40;
constexpr std::size_t photographsForInterval = 10;
/// Drawn fabrics for the last word, against those that choose the weights.
constexpr int patchesForLastWord = 2;
constexpr std::uint64_t lastWordFamily = 0x6a09e667f3bcc908;  // Neither of training nor of the choice.

/// Half, a quarter and an eighth of the way keep part of the gain where the whole way costs too much.
constexpr double sharesOfTheWay[] = {1, 0.5, 0.25, 0.125};

std::string listOf(const std::vector<std::string>& names)
{
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return text;
}

std::string countOf(std::size_t number, const std::string& noun)
{
    return std::to_string(number) + " " + noun + (number == 1 ? "" : noun.back() == 's' ? "es" : "s");
}

/// Figures of both held-out parts.
struct HeldOutFigures {
    LabFigures places, fabrics;
    std::vector<LabFigures> both() const { return {places, fabrics}; }
};

/// Weights on the way from the given ones to those of a step.
struct Candidate {
    int step = 0;
    double share = 1, score = 1;
};

class LabRun {
public:
    LabRun(const fabrics::Dataset& dataset, const fabrics::Dataset* scans, const ClothTrainingOptions& options, std::ostream& log,
           bool terminal)
        : m_dataset(dataset),
          m_options(options),
          m_out(log),
          m_terminal(terminal),
          m_start(cardOfSeeingModel(options.from)),
          m_given(readSeeingModel(options.from, m_start)),
          m_best(makeSeeingNetworks(m_start.architecture)),
          m_architecture(m_start.architecture),
          m_lab(readLabCloth(dataset, m_start.architecture, {.splitSeed = options.splitSeed, .heldOut = options.heldOut}))
    {
        if (fabrics::drawnSeedOf(dataset) == options.seed)
            throw protocols::badInput({"this training would draw the very fabrics that it holds out",
                                       "--seed " + std::to_string(options.seed), "another seed than that of the data set",
                                       "give another --seed"});
        m_options.side = m_start.architecture.crop;
        if (scans != nullptr) takeScans(*scans);
        m_datasetHash = fabrics::hashOf(dataset);
        moveTowards(m_best, m_given, 1);
    }

    void run()
    {
        torch::manual_seed(m_options.seed);
        describe();
        m_before = heldOutFigures(m_given, m_start.architecture);
        m_drawn = drawnBatches(m_start.architecture, m_options.validationPatches, ~m_options.seed);
        m_drawnBefore = seenPatches(m_given, m_drawn);
        takeFactors();
        LabSteps training(m_lab, m_scans, m_architecture, m_options);
        training.networks().startFrom(m_given);
        train(training);
        finish();
        std::filesystem::remove(checkpointOf(m_options.out));
    }

private:
    /// What the lab holds out must not come in as a scan: the gain on it would be memory.
    void takeScans(const fabrics::Dataset& scans)
    {
        const PictureSet leftOut = scansOfHeldOut(scans, m_lab);
        m_scans = readScannedCloth(scans, {}, leftOut);
        m_scansHash = fabrics::hashOf(scans);
        if (leftOut.empty()) return;
        const std::string pictures = countOf(leftOut.size(), "picture");
        m_scansHash += " without " + pictures;  // A checkpoint of all scans cannot be continued.
        m_lab.notes.push_back(pictures + " of --scans " + (leftOut.size() == 1 ? "is" : "are") +
                              " left out: the lab holds out the same places or fabrics");
    }

    void describe() const
    {
        std::size_t presses = 0, strokes = 0, fabrics = 0, registered = 0;
        for (const LabFabric& fabric : m_lab.fabrics) {
            presses += fabric.presses.size();
            strokes += fabric.strokes.size();
            fabrics += fabric.heldOut ? 0 : 1;
        }
        for (const LabPhotograph& photograph : m_lab.photographs) registered += photograph.reliefMm.empty() ? 0 : 1;
        for (const std::string& note : m_lab.notes) m_out << note << "\n";
        m_out << memoryOf(heldOutAmong(m_lab, m_start.summary.trainingSampleHashes), m_start.summary.name);
        if (const std::string note = noteOnDrawnFabrics(m_dataset, m_start.summary); !note.empty())
            m_out << "MEMORY: " << note << ".\n";
        m_out << "adapting " << m_start.summary.name << " to \"" << m_dataset.name
              << "\": " << countOf(m_lab.photographsOf(LabPart::Training).size(), "photograph") << " of "
              << countOf(fabrics, "fabric")
              << "; held out: " << countOf(m_lab.photographsOf(LabPart::HeldOutPlace).size(), "photograph") << " of other places";
        if (const std::string ids = heldOutIds(); !ids.empty())
            m_out << ", and " << ids << " with " << countOf(m_lab.photographsOf(LabPart::HeldOutFabric).size(), "photograph");
        m_out << "\nmeasured: " << countOf(strokes, "stroke") << ", " << countOf(presses, "press") << ", "
              << countOf(registered, "photograph") << " with heights of their own pixels" << std::endl;
    }

    std::string heldOutIds() const
    {
        std::vector<std::string> ids;
        for (const LabFabric& fabric : m_lab.fabrics)
            if (fabric.heldOut) ids.push_back(fabric.id.value);
        return listOf(ids);
    }

    HeldOutFigures heldOutFigures(SeeingNetworks& networks, const Architecture& architecture) const
    {
        return {labFigures(seenLab(networks, architecture, m_lab, LabPart::HeldOutPlace, photographsForFigures)),
                labFigures(seenLab(networks, architecture, m_lab, LabPart::HeldOutFabric, photographsForFigures))};
    }

    double scoreOf(const HeldOutFigures& figures) const { return labScore(m_before.both(), figures.both()); }

    /// Takes each factor that brings held-out photographs closer.
    void takeFactors()
    {
        const LabFactors found =
            labFactors(seenLab(m_given, m_start.architecture, m_lab, LabPart::Training, 2 * photographsForFigures));
        m_architecture.frictionFactor *= found.friction;
        m_architecture.reliefFactor *= found.relief;
        const HeldOutFigures with = heldOutFigures(m_given, m_architecture);
        const auto closer = [&](std::optional<double> LabFigures::*error) {
            double change = 0;
            for (const auto& [before, after] : {std::pair{&m_before.places, &with.places}, {&m_before.fabrics, &with.fabrics}})
                if (before->*error && after->*error) change += *(after->*error) - *(before->*error);
            return change < 0;
        };
        if (closer(&LabFigures::frictionError)) m_factors.friction = found.friction;
        if (closer(&LabFigures::sqError)) m_factors.relief = found.relief;
        m_architecture.frictionFactor = m_start.architecture.frictionFactor * m_factors.friction;
        m_architecture.reliefFactor = m_start.architecture.reliefFactor * m_factors.relief;
        m_kept = {0, 0, scoreOf(heldOutFigures(m_given, m_architecture))};
    }

    std::string fingerprint() const
    {
        std::string text =
            "lab|" + m_datasetHash + "|" + m_scansHash + "|" + m_start.summary.sha256 + "|" + std::to_string(m_options.seed) +
            "|" + std::to_string(m_options.splitSeed) + "|" + std::to_string(m_options.scanShare) + "|" +
            std::to_string(m_options.learningRate) + "|" + std::to_string(m_options.batch) + "|" +
            std::to_string(m_options.validationPatches) + "|" +
            (m_options.steps ? "steps " + std::to_string(*m_options.steps) : "minutes " + std::to_string(*m_options.minutes));
        for (const protocols::FabricId& id : m_options.heldOut) text += "|" + id.value;
        protocols::CanonicalBytes files;  // Another version may split the same lab otherwise.
        for (const std::string& hash : m_lab.trainingHashes) files << hash;
        return text + "|" + files.hash();
    }

    double fractionDone(const Checkpoint& state) const
    {
        return m_options.steps ? static_cast<double>(state.step) / *m_options.steps : state.elapsedS / (*m_options.minutes * 60);
    }

    std::vector<StoredTensor> stored(LabSteps& training)
    {
        std::vector<StoredTensor> tensors = training.networks().tensors();
        for (const NamedTensor& one : tensorsOf("best.", m_best)) tensors.push_back(storedTensor(one.name, one.tensor));
        return tensors;
    }

    void resume(LabSteps& training, Checkpoint& state)
    {
        StoredRun run = readCheckpoint(checkpointOf(m_options.out), state.fingerprint, kindsOf(stored(training)));
        std::size_t next = 0;
        training.networks().continueFrom(run.tensors, next);
        const torch::NoGradGuard noGradient;
        for (NamedTensor& one : tensorsOf({}, m_best)) copyInto(one.tensor, run.tensors.at(next++));
        state = std::move(run.state);
        // null until the first look
        if (const auto choice = nlohmann::json::parse(state.validationBefore); choice.is_object()) {
            m_candidates = choice.value("candidates", m_candidates);
            if (state.bestStep > 0) m_kept = {state.bestStep, choice.value("share", 1.0), state.bestDistance};
        }
        m_out << "resumed at step " << state.step << std::endl;
    }

    void train(LabSteps& training)
    {
        Checkpoint state;
        state.fingerprint = fingerprint();
        if (m_options.resume) resume(training, state);
        TrainingLog log(logOf(m_options.out), m_options.resume ? std::optional(state.step) : std::nullopt);
        const steady_clock::time_point started = steady_clock::now();
        const double before = state.elapsedS;
        while (fractionDone(state) < 1) {
            const int looked = static_cast<int>(looks * fractionDone(state));
            const LabLosses losses = training.step(state.step, fractionDone(state));
            if (!std::isfinite(losses.relief + losses.friction + losses.drawn)) stopAt(state.step + 1);
            ++state.step;
            state.elapsedS = before + std::chrono::duration<double>(steady_clock::now() - started).count();
            const bool last = fractionDone(state) >= 1;
            if (state.step % stepsPerLabRow == 0 || last) report(state, losses, log);
            if (last || static_cast<int>(looks * fractionDone(state)) > looked) look(training, state, log);
            state.elapsedS = before + std::chrono::duration<double>(steady_clock::now() - started).count();
            if (last || state.step % m_options.checkpointEvery == 0) {
                if (!training.networks().finite()) stopAt(state.step);
                writeCheckpoint(checkpointOf(m_options.out), state, stored(training));
            }
            if (last) break;
        }
        m_steps = state.step;
        m_minutes = std::round(state.elapsedS / 6) / 10;
    }

    [[noreturn]] void stopAt(int step) const
    {
        throw protocols::workFailed({"the loss is not finite at step " + std::to_string(step), m_options.out.string(),
                                     "finite losses", "train again with a smaller --learning-rate"});
    }

    void report(const Checkpoint& state, const LabLosses& losses, TrainingLog& log) const
    {
        log.losses(state.step, std::vector<NamedValue>{
                                   {"lab_relief", losses.relief}, {"lab_friction", losses.friction}, {"drawn", losses.drawn}});
        const double fraction = fractionDone(state);
        const int minutesLeft = static_cast<int>(std::ceil(state.elapsedS / fraction * std::max(0.0, 1 - fraction) / 60));
        const auto rounded = [](double value) { return std::round(1000 * value) / 1000; };
        m_out << (m_terminal ? "\r" : "") << "step " << state.step << ", the lab's relief " << rounded(losses.relief)
              << ", its friction " << rounded(losses.friction) << ", drawn cloth " << rounded(losses.drawn) << ", about "
              << minutesLeft << " min left" << (m_terminal ? "   " : "\n") << std::flush;
    }

    /// Keeps the present weights, or those on the way to them, where they are the best so far and cost little.
    void look(LabSteps& training, Checkpoint& state, TrainingLog& log)
    {
        SeeingNetworks mixed = makeSeeingNetworks(m_start.architecture);
        for (const double share : sharesOfTheWay) {
            moveTowards(mixed, m_given, 1);
            moveTowards(mixed, training.networks().average(), share);
            const double score = scoreOf(heldOutFigures(mixed, m_architecture));
            const ShippedAbilities shipped = shippedAbilities(m_drawnBefore, seenPatches(mixed, m_drawn));
            if (share == 1)
                log.validation(state.step, std::vector<NamedValue>{{"lab_score", score}, {"shipped_worse", shipped.worst()}});
            m_out << (m_terminal ? "\n" : "") << "step " << state.step
                  << (share < 1 ? ", " + protocols::fixed(share, 3) + " of the way" : std::string()) << ": held-out errors are "
                  << protocols::fixed(score, 3) << " of those before, shipped abilities "
                  << (shipped.worst() > 0 ? "worse by " : "better by ") << protocols::fixed(std::abs(shipped.worst()), 1) << " %"
                  << std::endl;
            ++m_candidates;
            if (shipped.worst() > mostWorsePercent) continue;
            if (score < m_kept.score) {
                m_kept = {state.step, share, score};
                moveTowards(m_best, mixed, 1);
                state.bestStep = state.step;
                state.bestDistance = score;
            }
            break;
        }
        state.validationBefore = nlohmann::json{{"share", m_kept.share}, {"candidates", m_candidates}}.dump();
    }

    /// Goes back towards the given weights until drawn fabrics that chose nothing agree.
    ShippedAbilities lastWord()
    {
        const std::vector<ClothBatch> drawn =
            drawnBatches(m_start.architecture, patchesForLastWord * m_options.validationPatches, m_options.seed ^ lastWordFamily);
        m_lastBefore = seenPatches(m_given, drawn);
        while (true) {
            m_lastAfter = seenPatches(m_best, drawn);
            const ShippedAbilities shipped = shippedAbilities(m_lastBefore, m_lastAfter);
            if (shipped.worst() <= mostWorsePercent || m_kept.step == 0) return shipped;
            const bool stop = m_kept.share <= sharesOfTheWay[3];
            moveTowards(m_best, m_given, stop ? 1 : 0.5);
            m_kept.share /= 2;
            if (stop) m_kept = {};
        }
    }

    void refuseWithoutGain(double score) const
    {
        if (score <= 1 - leastGain) return;
        std::filesystem::remove(checkpointOf(m_options.out));
        std::filesystem::remove_all(logOf(m_options.out));
        throw protocols::workFailed({"nothing was gained on the held-out photographs, so no model is written and " +
                                         m_options.from.string() + " stays the better one",
                                     m_dataset.folder.string(),
                                     "errors that are at least " + protocols::fixed(100 * leastGain, 0) + " % smaller",
                                     "add photographs or measurements, or train longer"});
    }

    /// The deviations that the networks state, against the errors on drawn fabrics: as wide as before.
    double intervalFactorOfDrawn() const
    {
        const auto tail = [](const std::vector<SeenPatch>& patches) {
            std::vector<double> errors;
            for (const SeenPatch& patch : patches) errors.push_back(patch.standardError());
            std::ranges::sort(errors);
            return errors[static_cast<std::size_t>(0.9 * static_cast<double>(errors.size() - 1))];
        };
        return std::clamp(m_start.architecture.intervalFactor * tail(m_lastAfter) / std::max(1e-6, tail(m_lastBefore)), 0.2, 5.0);
    }

    /// Widens the interval until it holds 90 % of the held-out photographs, where there are enough of them.
    void widenInterval(std::vector<SeenLabPhotograph>& places, std::vector<SeenLabPhotograph>& fabrics)
    {
        std::vector<double> shares;
        for (const auto* part : {&places, &fabrics})
            for (const SeenLabPhotograph& one : *part)
                if (one.logFrictionError) shares.push_back(one.intervalShare);
        if (shares.size() < photographsForInterval) return;
        std::ranges::sort(shares);
        const double wanted = shares[static_cast<std::size_t>(std::ceil(0.9 * static_cast<double>(shares.size()))) - 1];
        const double factor = std::clamp(m_architecture.intervalFactor * std::max(1.0, wanted), 0.2, 10.0);
        for (auto* part : {&places, &fabrics})
            for (SeenLabPhotograph& one : *part) one.intervalShare *= m_architecture.intervalFactor / factor;
        m_architecture.intervalFactor = factor;
    }

    double errorAsStated() const
    {
        double sum = 0;
        for (const SeenPatch& patch : m_lastAfter)
            sum += std::abs(std::expm1(patch.logError + std::log(m_architecture.frictionFactor)));
        return sum / static_cast<double>(m_lastAfter.size());
    }

    void finish()
    {
        LabOutcome outcome;
        outcome.shipped = lastWord();
        m_architecture.intervalFactor = intervalFactorOfDrawn();
        auto places = seenLab(m_best, m_architecture, m_lab, LabPart::HeldOutPlace, photographsForFigures);
        auto fabrics = seenLab(m_best, m_architecture, m_lab, LabPart::HeldOutFabric, photographsForFigures);
        widenInterval(places, fabrics);
        outcome.placesBefore = m_before.places;
        outcome.fabricsBefore = m_before.fabrics;
        outcome.placesAfter = labFigures(places);
        outcome.fabricsAfter = labFigures(fabrics);
        refuseWithoutGain(scoreOf({outcome.placesAfter, outcome.fabricsAfter}));
        outcome.heldOutFabrics = heldOutIds();
        outcome.heldOutSeen = heldOutAmong(m_lab, m_start.summary.trainingSampleHashes);
        outcome.statedFrictionError = errorAsStated();
        outcome.factors = m_factors;
        outcome.step = m_kept.step;
        outcome.share = m_kept.share;
        outcome.candidates = m_candidates;
        writeSeeingModel(m_options.out, m_best, cardFor(outcome));
        m_out << labTable(outcome, m_start.summary.name, m_options.out.stem().string()) << "wrote " << m_options.out.string()
              << " after " << m_steps << " steps, " << m_minutes << " min" << std::endl;
    }

    ModelCardFields cardFor(const LabOutcome& outcome) const
    {
        ModelCardFields card;
        card.summary.name = m_options.out.stem().string();
        card.summary.trainedOnProceduralSet = m_dataset.procedural && m_scans.empty() && m_start.summary.trainedOnProceduralSet;
        card.summary.trainingCommand = m_options.command;
        addTrainingHashes(card, m_start.summary.trainingSampleHashes);
        addTrainingHashes(card, hashesOf(m_scans));
        addTrainingHashes(card, m_lab.trainingHashes);
        card.summary.drawnSeeds = m_start.summary.drawnSeeds;
        card.summary.drawnSeeds.insert(m_options.seed);
        card.architecture = m_architecture;
        card.seed = m_options.seed;
        card.splitSeed = m_options.splitSeed;
        card.steps = m_steps;
        card.bestStep = outcome.step;
        card.trainingMinutes = m_minutes;
        for (const LabFabric& fabric : m_lab.fabrics)
            if (fabric.heldOut) card.heldOut.push_back(fabric.id.value);
        card.datasetName = m_dataset.name;
        card.datasetHash = m_datasetHash;
        card.fromName = m_start.summary.name;
        card.fromHash = m_start.summary.sha256;
        nlohmann::ordered_json validation = asJson(outcome);
        validation["photographs"] = m_lab.photographsOf(LabPart::Training).size();
        card.validationJson = validation.dump();
        return card;
    }

    const fabrics::Dataset& m_dataset;
    ClothTrainingOptions m_options;
    std::ostream& m_out;
    bool m_terminal;
    ModelCardFields m_start;
    SeeingNetworks m_given, m_best;
    Architecture m_architecture;
    LabCloth m_lab;
    std::vector<ScannedCloth> m_scans;
    std::string m_datasetHash, m_scansHash;
    HeldOutFigures m_before;
    std::vector<ClothBatch> m_drawn;
    std::vector<SeenPatch> m_drawnBefore, m_lastBefore, m_lastAfter;
    LabFactors m_factors;
    Candidate m_kept;
    int m_candidates = 1;  ///< the given weights with the factors are the first
    int m_steps = 0;
    double m_minutes = 0;
};

}  // namespace

void adaptToLab(const fabrics::Dataset& lab, const fabrics::Dataset* scans, const ClothTrainingOptions& options,
                std::ostream& log, bool terminal)
{
    requireUsable(options);
    std::error_code none;
    if (std::filesystem::equivalent(options.out, options.from, none))
        throw protocols::badInput({"--out names the model of --from", options.out.string(),
                                   "a new file, so that both can be compared", "name another file with --out"});
    protocols::requireWritable(options.out);
    setTrainingThreads(options);
    log << "reading " << lab.folder.string() << std::endl;
    LabRun(lab, scans, options, log, terminal).run();
}

}  // namespace rendering::models
