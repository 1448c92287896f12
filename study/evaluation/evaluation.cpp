#include "study/evaluation/evaluation.h"

#include <algorithm>

#include "protocols/files/errors.h"
#include "rendering/models/model_card.h"
#include "stats/kernels/threads.h"
#include "study/evaluation/speaking.h"
#include "study/evaluation/summary.h"

namespace study::evaluation {

namespace {

namespace fabrics = rendering::fabrics;
namespace models = rendering::models;

/// So many photographs go to the second program at once: enough to outweigh its start, few enough to show progress.
constexpr std::size_t photographsAtOnce = 30;

constexpr SpeakerKind controlKinds[] = {SpeakerKind::GlobalConstant, SpeakerKind::FabricMean, SpeakerKind::Retrieval,
                                        SpeakerKind::AnotherPlace};

Speaker speakerOf(SpeakerKind kind)
{
    switch (kind) {
        case SpeakerKind::GlobalConstant:
            return {kind, "global_constant", "one constant for all"};
        case SpeakerKind::FabricMean:
            return {kind, "fabric_mean", "the fabric's mean"};
        case SpeakerKind::Retrieval:
            return {kind, "retrieval", "nearest photograph"};
        case SpeakerKind::AnotherPlace:
            return {kind, "another_place", "fabric, another place"};
        case SpeakerKind::Measured:
            return {kind, "measured", "measured itself"};
        case SpeakerKind::GeneratedMean:
            return {kind, "generated_mean", "generated, mean alone"};
        case SpeakerKind::Generated:
        case SpeakerKind::Against:
            break;
    }
    return {kind, "generated", "generated"};
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

/// By fabric, those are tested that the model never saw.
std::vector<protocols::FabricId> heldOutFabrics(const fabrics::Dataset& dataset, const OpenModel& model)
{
    std::vector<protocols::FabricId> found;
    for (const auto& fabric : dataset.fabrics)
        if (std::find(model.card.heldOut.begin(), model.card.heldOut.end(), fabric.id.value) != model.card.heldOut.end())
            found.push_back(fabric.id);
    if (found.empty())
        throw protocols::badInput({model.card.heldOut.empty()
                                       ? "the model was trained without holding a fabric out, so it cannot be tested by fabric"
                                       : "none of the fabrics that the model held out is in the data set",
                                   models::cardOf(model.file).string(), "held_out naming fabrics of " + dataset.folder.string(),
                                   "train one with `vis2hap train ... --hold-out F02,F09,F13`, or use --split location"});
    return found;
}

PlanRequest planRequest(const fabrics::Dataset& dataset, const EvaluationRequest& request, const std::vector<OpenModel>& opened)
{
    PlanRequest plan;
    plan.split = request.split;
    plan.seed = request.splitSeed.value_or(opened.front().card.splitSeed);
    plan.samplesPerFabric = request.samplesPerFabric;
    plan.threads = request.threads;
    for (const OpenModel& model : opened)
        plan.trainedOn.insert(model.card.told.trainingSampleHashes.begin(), model.card.told.trainingSampleHashes.end());
    if (request.split == SplitKind::Fabric) plan.heldOut = heldOutFabrics(dataset, opened.front());
    return plan;
}

stats::Value rangeOf(const std::vector<MeasuredPair>& pairs)
{
    double lowest = 0, highest = 0;
    bool any = false;
    for (const MeasuredPair& pair : pairs) {
        if (!pair.heightFeatures) continue;
        lowest = any ? std::min(lowest, pair.lowestMm) : pair.lowestMm;
        highest = any ? std::max(highest, pair.highestMm) : pair.highestMm;
        any = true;
    }
    if (!any) return stats::Value::undefined("there is no measured height");
    if (!(highest > lowest)) return stats::Value::undefined("the measured heights are flat");
    return highest - lowest;
}

/// Within fabrics first, as everything else.
stats::Value noiseFloorOf(const TestPlan& plan, const std::vector<MeasuredPair>& pairs)
{
    std::vector<Values> ofPairs(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i)
        at(ofPairs[i], Measure::FrictionMaeOverMean) =
            pairs[i].trace ? ownMeanError(*pairs[i].trace) : stats::Value::undefined("there is no measured friction");
    return at(summarise({}, plan, ofPairs).mean, Measure::FrictionMaeOverMean);
}

/// Asks every model for the photographs of the pairs from `first` on. [model][pair]
std::vector<std::vector<models::GeneratedSignals>> generatedFor(const Setting& setting, const EvaluationRequest& request,
                                                                const std::vector<OpenModel>& opened, std::size_t first,
                                                                std::size_t count, const Generate& generate)
{
    std::vector<models::PhotographToTouch> photographs;
    for (std::size_t i = first; i < first + count; ++i) {
        const Sample& photograph = setting.plan.pairs[i].photograph;
        photographs.push_back(
            {fabrics::readPhotograph(setting.dataset, photograph.fabric, photograph.index), setting.dataset.cameraMmPerPixel});
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

std::vector<Speaker> speakersOf(const std::vector<OpenModel>& opened)
{
    std::vector<Speaker> speakers;
    for (std::size_t i = 0; i < opened.size(); ++i) {
        const std::string name = opened[i].file.stem().string();
        speakers.push_back(i == 0 ? Speaker{SpeakerKind::Generated, "generated", "generated"}
                                  : Speaker{SpeakerKind::Against, "against:" + name, "against: " + name});
    }
    speakers.push_back(speakerOf(SpeakerKind::GeneratedMean));
    for (const SpeakerKind kind : controlKinds) speakers.push_back(speakerOf(kind));
    speakers.push_back(speakerOf(SpeakerKind::Measured));
    return speakers;
}

/// [speaker][pair], in the order of speakersOf().
std::vector<std::vector<Values>> hearAll(const Setting& setting, const EvaluationRequest& request,
                                         const std::vector<OpenModel>& opened, const std::vector<MeasuredPair>& measured,
                                         double rangeMm, const Generate& generate, const Report& report)
{
    const std::vector<Speaker> speakers = speakersOf(opened);
    const std::size_t total = setting.plan.pairs.size();
    std::vector<std::vector<Values>> heard(speakers.size(), std::vector<Values>(total));
    for (std::size_t first = 0; first < total; first += photographsAtOnce) {
        const std::size_t count = std::min(photographsAtOnce, total - first);
        const auto answers = generatedFor(setting, request, opened, first, count, generate);
        stats::onThreads(
            count, request.threads,
            [&](std::size_t k) {
                const std::size_t i = first + k;
                const TestPair& pair = setting.plan.pairs[i];
                const HeightMap partner = partnerMap(setting, pair);
                const auto said = [&](std::size_t s) {
                    if (s < opened.size()) return saidByModel(setting, pair, answers[s][k]);
                    if (speakers[s].kind == SpeakerKind::GeneratedMean) return saidByMean(answers.front()[k], measured[i]);
                    return saidByControl(setting, speakers[s].kind, i, measured[i]);
                };
                for (std::size_t s = 0; s < speakers.size(); ++s)
                    heard[s][i] = speakers[s].kind == SpeakerKind::Measured
                                      ? measuredItself(setting, pair, measured[i])
                                      : compare(setting, pair, measured[i], partner, said(s), rangeMm);
            },
            [&](std::size_t done) {
                if (report) report("generated against measured", static_cast<int>(first + done), static_cast<int>(total));
            });
    }
    return heard;
}

void addFacts(const fabrics::Dataset& dataset, const std::vector<OpenModel>& opened, const Setting& setting,
              Evaluation& evaluation)
{
    evaluation.dataset = dataset.name;
    evaluation.aligned = dataset.pairing == fabrics::Pairing::Aligned;
    for (const OpenModel& model : opened)
        evaluation.models.push_back(
            {model.card.told.name, model.file.string(), model.card.told.sha256, model.card.objective, model.card.heldOut});
    evaluation.leaks = setting.plan.leaks;
    evaluation.notes = setting.plan.notes;
    evaluation.pairs = static_cast<int>(setting.plan.pairs.size());
    evaluation.trainingPhotographs = setting.controls.photographs;
    evaluation.trainingPresses = setting.controls.presses;
    evaluation.trainingStrokes = setting.controls.strokes;
    const bool turnsKnown = std::all_of(setting.plan.pairs.begin(), setting.plan.pairs.end(), [](const TestPair& pair) {
        return pair.photograph.rotationDeg && (!pair.press || pair.press->rotationDeg);
    });
    if (!turnsKnown) evaluation.notes.push_back("samples.csv does not tell every rotation: such maps are registered as they lie");
    if (!dataset.tactileMmPerPixel)
        evaluation.notes.push_back("the data set does not state the sensor's pitch: that of the model is taken");
}

}  // namespace

const SpeakerResult* Evaluation::speaker(SpeakerKind kind) const
{
    const auto found =
        std::find_if(speakers.begin(), speakers.end(), [&](const SpeakerResult& one) { return one.speaker.kind == kind; });
    return found == speakers.end() ? nullptr : &*found;
}

Evaluation evaluate(const fabrics::Dataset& dataset, const EvaluationRequest& request, const Report& report,
                    const Generate& generate)
{
    const auto opened = openModels(request);
    const PlanRequest asked = planRequest(dataset, request, opened);
    const TestPlan plan = testPlan(dataset, asked, report);
    const MeasuredSignals measured(dataset, opened.front().card.architecture.mmPerPixel);
    const Controls controls = learnControls(dataset, measured, plan, asked, report);
    const Setting setting{dataset, measured, plan, controls};
    std::vector<MeasuredPair> pairs(plan.pairs.size());
    stats::onThreads(plan.pairs.size(), request.threads, [&](std::size_t i) { pairs[i] = measurePair(setting, plan.pairs[i]); });

    Evaluation evaluation;
    addFacts(dataset, opened, setting, evaluation);
    evaluation.split = request.split;
    evaluation.splitSeed = asked.seed;
    evaluation.boundsFraction = request.boundsFraction;
    evaluation.rangeMm = rangeOf(pairs);
    evaluation.noiseFloor = noiseFloorOf(plan, pairs);
    const auto heard = hearAll(setting, request, opened, pairs, evaluation.rangeMm.orElse(1), generate, report);
    const auto speakers = speakersOf(opened);
    for (std::size_t s = 0; s < speakers.size(); ++s) evaluation.speakers.push_back(summarise(speakers[s], plan, heard[s]));
    const SpeakerResult truth = evaluation.speakers.back();
    for (SpeakerResult& speaker : evaluation.speakers) {
        speaker.friction = compareMeans(speaker, truth, Measure::MeanFriction, request.boundsFraction);
        speaker.sq = compareMeans(speaker, truth, Measure::SqMm, request.boundsFraction);
    }
    evaluation.fabrics = static_cast<int>(truth.fabrics.size());
    return evaluation;
}

}  // namespace study::evaluation
