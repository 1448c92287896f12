#include "study/evaluation/evaluation.h"

#include <algorithm>

#include "protocols/files/errors.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/drawn_memory.h"
#include "rendering/models/fair_control.h"
#include "stats/kernels/threads.h"
#include "study/evaluation/predictions.h"
#include "study/evaluation/summary.h"

namespace study::evaluation {

namespace {

namespace fabrics = rendering::fabrics;
namespace models = rendering::models;

/// Number of photographs sent to the generator program at once: enough to outweigh its start-up, few enough to show progress.
constexpr std::size_t photographsAtOnce = 30;

constexpr PredictorKind controlKinds[] = {PredictorKind::GlobalConstant, PredictorKind::FabricMean, PredictorKind::Retrieval,
                                          PredictorKind::AnotherPlace};

Predictor controlPredictor(PredictorKind kind)
{
    switch (kind) {
        case PredictorKind::GlobalConstant:
            return {kind, "global_constant", "one constant for all", 0};
        case PredictorKind::FabricMean:
            return {kind, "fabric_mean", "the fabric's mean", 0};
        case PredictorKind::Retrieval:
            return {kind, "retrieval", "nearest photograph", 0};
        case PredictorKind::AnotherPlace:
            return {kind, "another_place", "fabric, another place", 0};
        case PredictorKind::Measured:
            return {kind, "measured", "measured itself", 0};
        case PredictorKind::GeneratedMean:
            return {kind, "generated_mean", "generated, mean alone", 0};
        case PredictorKind::Generated:
        case PredictorKind::Against:
            break;
    }
    return {kind, "generated", "generated", 0};
}

struct OpenModel {
    std::filesystem::path file;
    models::ModelCardFields card;
};

std::vector<OpenModel> openModels(const EvaluationRequest& request)
{
    std::vector<OpenModel> opened;
    const auto open = [&](const std::filesystem::path& file) { opened.push_back({file, models::readModelCardFields(file)}); };
    open(request.model.empty() ? models::shippedModel() : request.model);
    for (const auto& file : request.against) open(file);
    return opened;
}

/// Fabrics that the model was not trained on; the split by fabric tests these.
std::vector<protocols::FabricId> heldOutFabrics(const fabrics::Dataset& dataset, const OpenModel& model)
{
    std::vector<protocols::FabricId> found;
    for (const auto& fabric : dataset.fabrics)
        if (std::find(model.card.heldOut.begin(), model.card.heldOut.end(), fabric.id.value) != model.card.heldOut.end())
            found.push_back(fabric.id);
    if (found.empty())
        throw protocols::badInput({model.card.heldOut.empty()
                                       ? "the model was trained on every fabric, so it cannot be tested by fabric"
                                       : "the data set has none of the fabrics that the model held out",
                                   models::cardOf(model.file).string(), "held_out with fabrics of " + dataset.folder.string(),
                                   "train a model with `vis2hap train … --hold-out F02,F09,F13`, or use --split location"});
    return found;
}

/// Whether the model was trained on, or adapted to, this very data set.
bool isOfDataset(const models::ModelCardFields& card, const std::string& datasetHash)
{
    return !card.datasetHash.empty() && card.datasetHash == datasetHash;
}

/// The split of the model's training where that was on this data set: any other would test photographs that chose its weights.
SplitKind usualSplit(const models::ModelCardFields& card, const std::string& datasetHash)
{
    const bool isByLocation = !card.architecture.sees && card.split == nameOf(SplitKind::Location);
    return isByLocation && isOfDataset(card, datasetHash) ? SplitKind::Location : SplitKind::Sample;
}

/// A note where the test may hold samples that chose the weights of this model: the validation part of a training, or what an
/// adaptation held out. Else empty.
std::string noteOnValidation(const PlanRequest& plan, const models::ModelCardFields& card, const std::string& datasetHash)
{
    if (!isOfDataset(card, datasetHash)) return {};
    const std::string& name = card.summary.name;
    if (card.architecture.sees)
        return "samples that the adaptation of " + name + " held out chose its weights, and may be tested here";
    if (plan.split == SplitKind::Fabric || (nameOf(plan.split) == card.split && plan.seed == card.splitSeed)) return {};
    return name + " was trained with --split " + card.split + " and --split-seed " + std::to_string(card.splitSeed) +
           ": under another split, test samples may have chosen its weights";
}

PlanRequest planRequest(const fabrics::Dataset& dataset, const EvaluationRequest& request, const std::vector<OpenModel>& opened,
                        const std::string& datasetHash)
{
    PlanRequest plan;
    plan.split = request.split.value_or(usualSplit(opened.front().card, datasetHash));
    plan.seed = request.splitSeed.value_or(opened.front().card.splitSeed);
    plan.samplesPerFabric = request.samplesPerFabric;
    plan.threads = request.threads;
    for (const OpenModel& model : opened)
        plan.trainedOn.insert(model.card.summary.trainingSampleHashes.begin(), model.card.summary.trainingSampleHashes.end());
    if (plan.split == SplitKind::Fabric) plan.heldOut = heldOutFabrics(dataset, opened.front());
    return plan;
}

/// Mean within fabrics first, then over fabrics, as for every measure.
stats::Value noiseFloorOf(const TestPlan& plan, const std::vector<MeasuredPair>& pairs)
{
    std::vector<Values> ofPairs(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i)
        at(ofPairs[i], Measure::FrictionMaeOverMean) =
            pairs[i].trace ? ownMeanError(*pairs[i].trace) : stats::Value::undefined("there is no measured friction");
    return at(summarise({}, plan, ofPairs).mean, Measure::FrictionMaeOverMean);
}

/// Generates the signals of `count` pairs, starting at pair `first`. Index: [model][pair].
std::vector<std::vector<models::GeneratedSignals>> generatedFor(const EvaluationContext& context,
                                                                const EvaluationRequest& request,
                                                                const std::vector<OpenModel>& opened, std::size_t first,
                                                                std::size_t count, const Generate& generate)
{
    const fabrics::PhotographViews views(context.dataset);
    std::vector<models::InputPhotograph> photographs;
    for (std::size_t i = first; i < first + count; ++i) {
        const PlannedSample& photograph = context.plan.pairs[i].photograph;
        photographs.push_back({fabrics::readPhotograph(context.dataset, photograph.fabric, photograph.index),
                               views.mmPerPixel(photograph.fabric, photograph.index),
                               views.lightDeg(photograph.fabric, photograph.index),
                               context.dataset.fabric(photograph.fabric).fibre});
    }
    std::vector<std::vector<models::GeneratedSignals>> answers;
    for (const OpenModel& model : opened) {
        models::GenerationOptions options;
        options.model = model.file;
        options.quality = request.quality;
        answers.push_back(generate(photographs, options));
    }
    return answers;
}

std::vector<Predictor> predictorsOf(const std::vector<OpenModel>& opened)
{
    std::vector<Predictor> predictors;
    for (std::size_t i = 0; i < opened.size(); ++i) {
        const std::string name = opened[i].file.stem().string();
        predictors.push_back(i == 0 ? Predictor{PredictorKind::Generated, "generated", "generated", 0}
                                    : Predictor{PredictorKind::Against, "against:" + name, "against: " + name, i});
    }
    predictors.push_back(controlPredictor(PredictorKind::GeneratedMean));
    for (const PredictorKind kind : controlKinds) predictors.push_back(controlPredictor(kind));
    predictors.push_back(controlPredictor(PredictorKind::Measured));
    return predictors;
}

/// Values of all pairs. Index: [predictor][pair], with the predictors in the order of predictorsOf().
std::vector<std::vector<Values>> evaluatePairs(const EvaluationContext& context, const EvaluationRequest& request,
                                               const std::vector<OpenModel>& opened, const std::vector<MeasuredPair>& measured,
                                               double rangeMm, const Generate& generate, const Report& report)
{
    const std::vector<Predictor> predictors = predictorsOf(opened);
    const std::size_t total = context.plan.pairs.size();
    std::vector<std::vector<Values>> values(predictors.size(), std::vector<Values>(total));
    for (std::size_t first = 0; first < total; first += photographsAtOnce) {
        const std::size_t count = std::min(photographsAtOnce, total - first);
        const auto answers = generatedFor(context, request, opened, first, count, generate);
        stats::onThreads(
            count, request.threads,
            [&](std::size_t k) {
                const std::size_t i = first + k;
                const TestPair& pair = context.plan.pairs[i];
                const HeightMap partner = measuredMap(context, pair);
                const auto prediction = [&](std::size_t s) {
                    if (s < opened.size()) return predictByModel(context, pair, answers[s][k]);
                    if (predictors[s].kind == PredictorKind::GeneratedMean) return predictByMean(answers.front()[k], measured[i]);
                    return predictByControl(context, predictors[s].kind, i, measured[i]);
                };
                for (std::size_t s = 0; s < predictors.size(); ++s)
                    values[s][i] = predictors[s].kind == PredictorKind::Measured
                                       ? valuesOfMeasured(context, pair, measured[i])
                                       : compare(context, pair, measured[i], partner, prediction(s), rangeMm);
            },
            [&](std::size_t done) {
                if (report) report("generated against measured", static_cast<int>(first + done), static_cast<int>(total));
            });
    }
    return values;
}

void addFacts(const fabrics::Dataset& dataset, const std::vector<OpenModel>& opened, const EvaluationContext& context,
              Evaluation& evaluation)
{
    evaluation.dataset = dataset.name;
    evaluation.notes = context.plan.notes;
    const auto told = std::ranges::count_if(context.dataset.fabrics, [](const auto& fabric) { return fabric.fibre.has_value(); });
    if (told > 0)
        evaluation.notes.push_back("the generators are told the fibre of " + std::to_string(told) + " of " +
                                   std::to_string(context.dataset.fabrics.size()) +
                                   " fabrics (dataset.json; --fibre-untold leaves it out)");
    evaluation.aligned = dataset.pairing == fabrics::Pairing::Aligned;
    for (const OpenModel& model : opened) {
        evaluation.models.push_back({model.card.summary.name, model.file.string(), model.card.summary.sha256,
                                     model.card.objective, model.card.heldOut, model.card.steps,
                                     models::trainingDifferences(opened.front().card, model.card)});
        if (const auto& used = evaluation.models.back(); !used.differences.empty())
            evaluation.notes.push_back(used.name + " is not a fair control: it was " + unfairness(used.differences));
    }
    evaluation.leaks = context.plan.leaks;
    evaluation.pairs = static_cast<int>(context.plan.pairs.size());
    evaluation.trainingPhotographs = context.controls.photographs;
    evaluation.trainingPresses = context.controls.presses;
    evaluation.trainingStrokes = context.controls.strokes;
    const bool turnsKnown = std::all_of(context.plan.pairs.begin(), context.plan.pairs.end(), [](const TestPair& pair) {
        return pair.photograph.rotationDeg && (!pair.press || pair.press->rotationDeg);
    });
    if (!turnsKnown)
        evaluation.notes.push_back("samples.csv does not give every rotation; maps without one are registered unrotated");
    if (!dataset.tactileMmPerPixel)
        evaluation.notes.push_back(
            "the data set does not give the pixel pitch of the tactile sensor; the pitch of the model is used");
}

}  // namespace

const PredictorResult* Evaluation::predictor(PredictorKind kind) const
{
    const auto found = std::find_if(predictors.begin(), predictors.end(),
                                    [&](const PredictorResult& one) { return one.predictor.kind == kind; });
    return found == predictors.end() ? nullptr : &*found;
}

std::string Evaluation::whyUnfair(const PredictorResult& predictor) const
{
    return predictor.predictor.model < models.size() ? unfairness(models[predictor.predictor.model].differences) : std::string();
}

std::string unfairness(const std::vector<std::string>& differences)
{
    std::string text;
    for (const std::string& difference : differences) text += (text.empty() ? "trained with " : ", ") + difference;
    return text;
}

Evaluation evaluate(const fabrics::Dataset& dataset, const EvaluationRequest& request, const Report& report,
                    const Generate& generate)
{
    const auto opened = openModels(request);
    const bool anyHasSet = std::ranges::any_of(opened, [](const OpenModel& model) { return !model.card.datasetHash.empty(); });
    const std::string datasetHash = anyHasSet ? fabrics::hashOf(dataset) : std::string();  // reads every file
    const PlanRequest planned = planRequest(dataset, request, opened, datasetHash);
    TestPlan plan = testPlan(dataset, planned, report);
    for (const OpenModel& model : opened)
        if (std::string note = noteOnValidation(planned, model.card, datasetHash); !note.empty())
            plan.notes.push_back(std::move(note));
    for (const OpenModel& model : opened)
        if (std::string note = models::noteOnDrawnFabrics(dataset, model.card.summary); !note.empty())
            plan.notes.push_back(std::move(note));
    const auto& architecture = opened.front().card.architecture;
    const MeasuredSignals measured(dataset, architecture.mmPerPixel, architecture.traceMmPerSample);
    const Controls controls = fitControls(dataset, measured, plan, planned, report);
    const EvaluationContext context{dataset, measured, plan, controls};
    std::vector<MeasuredPair> pairs(plan.pairs.size());
    stats::onThreads(plan.pairs.size(), request.threads, [&](std::size_t i) { pairs[i] = measurePair(context, plan.pairs[i]); });

    Evaluation evaluation;
    addFacts(dataset, opened, context, evaluation);
    evaluation.split = planned.split;
    evaluation.splitSeed = planned.seed;
    evaluation.boundsFraction = request.boundsFraction;
    evaluation.rangeMm = rangeOf(pairs);
    evaluation.noiseFloor = noiseFloorOf(plan, pairs);
    const auto values = evaluatePairs(context, request, opened, pairs, evaluation.rangeMm.orElse(1), generate, report);
    const auto predictors = predictorsOf(opened);
    for (std::size_t s = 0; s < predictors.size(); ++s)
        evaluation.predictors.push_back(summarise(predictors[s], plan, values[s]));
    const PredictorResult truth = evaluation.predictors.back();
    for (PredictorResult& predictor : evaluation.predictors) {
        predictor.friction = compareMeans(predictor, truth, Measure::MeanFriction, request.boundsFraction);
        predictor.sq = compareMeans(predictor, truth, Measure::SqMm, request.boundsFraction);
    }
    evaluation.fabrics = static_cast<int>(truth.fabrics.size());
    return evaluation;
}

}  // namespace study::evaluation
