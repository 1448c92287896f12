#include "study/evaluation/study_comparison.h"

#include <algorithm>

#include "protocols/files/errors.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/fair_control.h"
#include "stats/kernels/threads.h"
#include "stats/tests/multiplicity.h"
#include "study/evaluation/predictions.h"
#include "study/evaluation/summary.h"

namespace study::evaluation {

namespace {

namespace models = rendering::models;

/// The model, or the control, whose signals a source predicts.
struct SourceRow {
    PredictorKind kind;
    const char* id;
    const char* name;
};

constexpr SourceRow sourceRows[] = {{PredictorKind::Generated, "generated", "generated"},
                                    {PredictorKind::GeneratedMean, "generated_mean", "generated, mean friction alone"},
                                    {PredictorKind::GlobalConstant, "global_constant", "one constant for all"},
                                    {PredictorKind::FabricMean, "fabric_mean", "the fabric's mean"},
                                    {PredictorKind::Retrieval, "retrieval", "nearest photograph"},
                                    {PredictorKind::Against, "l1_only", "L1-only network"},
                                    {PredictorKind::AnotherPlace, "another_place", "same fabric, another place"}};

bool isControl(PredictorKind kind) { return kind != PredictorKind::Generated && kind != PredictorKind::GeneratedMean; }

/// Signals that the L1-only control generates from the same photographs.
struct ControlSignals {
    std::vector<models::GeneratedSignals> signals;  ///< for each pair; empty if there is no usable control
    std::optional<int> steps;
    std::string whyNone, whyUnfair;
};

const models::GeneratedSignals& generatedFor(const StudyComparisonRequest& request, const TestPair& pair)
{
    const auto found = std::find_if(request.shown.begin(), request.shown.end(),
                                    [&](const ShownSamples& one) { return one.fabric == pair.photograph.fabric; });
    return request.generated.at(static_cast<std::size_t>(found - request.shown.begin()));
}

ControlSignals controlSignals(const rendering::fabrics::Dataset& dataset, const StudyComparisonRequest& request,
                              const TestPlan& plan, const Generate& generate)
{
    ControlSignals control;
    if (request.control.empty()) {
        control.whyNone = "no weights of an L1-only control were given (`vis2hap train --control-of MODEL` trains them)";
        return control;
    }
    try {
        const auto card = models::readModelCardFields(request.control);
        control.steps = card.steps;
        control.whyUnfair = unfairness(models::trainingDifferences(request.model, card));
        models::GenerationOptions options;
        options.model = request.control;
        const auto any = [&](const auto& has) { return std::any_of(request.generated.begin(), request.generated.end(), has); };
        options.height = any([](const auto& one) { return !one.heightMm.empty(); });
        options.friction = any([](const auto& one) { return !one.trace.empty(); });
        const rendering::fabrics::PhotographViews views(dataset);
        std::vector<models::InputPhotograph> photographs;
        for (const TestPair& pair : plan.pairs)
            photographs.push_back({rendering::fabrics::readPhotograph(dataset, pair.photograph.fabric, pair.photograph.index),
                                   views.mmPerPixel(pair.photograph.fabric, pair.photograph.index),
                                   views.lightDeg(pair.photograph.fabric, pair.photograph.index),
                                   dataset.fabric(pair.photograph.fabric).fibre});
        control.signals = generate(photographs, options);
    } catch (const protocols::Error& fault) {
        control.whyNone = std::string("the L1-only control could not be used: ") + fault.what();
    }
    return control;
}

Prediction noControl(const std::string& why)
{
    Prediction prediction;
    prediction.whyNoHeight = prediction.whyNoTrace = why;
    return prediction;
}

/// Values of one source for every pair.
std::vector<Values> valuesOf(const EvaluationContext& context, const StudyComparisonRequest& request, PredictorKind kind,
                             const std::vector<MeasuredPair>& measured, const ControlSignals& control, double rangeMm)
{
    std::vector<Values> values(context.plan.pairs.size());
    stats::onThreads(values.size(), request.threads, [&](std::size_t i) {
        const TestPair& pair = context.plan.pairs[i];
        const auto predicted = [&] {
            switch (kind) {
                case PredictorKind::Generated:
                    return predictByModel(context, pair, generatedFor(request, pair));
                case PredictorKind::GeneratedMean:
                    return predictByMean(generatedFor(request, pair), measured[i]);
                case PredictorKind::Against:
                    return control.signals.empty() ? noControl(control.whyNone)
                                                   : predictByModel(context, pair, control.signals[i]);
                case PredictorKind::GlobalConstant:
                case PredictorKind::FabricMean:
                case PredictorKind::Retrieval:
                case PredictorKind::AnotherPlace:
                case PredictorKind::Measured:
                    break;
            }
            return predictByControl(context, kind, i, measured[i]);
        };
        values[i] = compare(context, pair, measured[i], measuredMap(context, pair), predicted(), rangeMm);
    });
    return values;
}

/// Generated minus the source, over the fabrics where both have a value. A ratio whose best value is 1 has no difference.
std::vector<MeasureDifference> differencesFrom(const PredictorResult& generated, const PredictorResult& source)
{
    std::vector<MeasureDifference> differences;
    for (const Measure measure : studyMeasures) {
        if (rowOf(measure).better == Better::NearOne) continue;
        std::vector<double> ours, theirs;
        for (std::size_t i = 0; i < generated.fabrics.size(); ++i) {
            const stats::Value &a = at(generated.fabrics[i].values, measure), &b = at(source.fabrics[i].values, measure);
            if (!a.exists() || !b.exists()) continue;
            ours.push_back(*a);
            theirs.push_back(*b);
        }
        differences.push_back({measure, stats::pairedTTest(ours, theirs), {}});
    }
    return differences;
}

void correctOverControls(std::vector<ComparedSource>& sources)
{
    for (const Measure measure : studyMeasures) {
        std::vector<MeasureDifference*> family;
        for (ComparedSource& source : sources)
            for (MeasureDifference& one : source.differences)
                if (one.measure == measure) family.push_back(&one);
        std::vector<stats::Value> p;
        for (const MeasureDifference* one : family) p.push_back(one->test.p);
        const auto corrected = stats::adjusted(p, stats::Adjustment::Holm);
        for (std::size_t i = 0; i < family.size(); ++i) family[i]->pHolm = corrected[i];
    }
}

std::vector<std::string> notesOn(const rendering::fabrics::Dataset& dataset, const StudyComparisonRequest& request,
                                 const TestPlan& plan)
{
    std::vector<std::string> notes;
    if (request.model.datasetHash != request.datasetSha256)
        notes.push_back(
            "The model was not trained on this data set. The controls know other samples of its fabrics, which is an advantage.");
    const bool turnsKnown = std::all_of(plan.pairs.begin(), plan.pairs.end(), [](const TestPair& pair) {
        return pair.photograph.rotationDeg && (!pair.press || pair.press->rotationDeg);
    });
    if (!turnsKnown)
        notes.push_back("The data set does not give every rotation. A map without one is registered without rotation.");
    if (!dataset.tactileMmPerPixel)
        notes.push_back("The data set does not give the pitch of the tactile sensor. The pitch of the model is used.");
    return notes;
}

TestPlan planFor(const rendering::fabrics::Dataset& dataset, const StudyComparisonRequest& request)
{
    KnownSamplesRequest known;
    known.shown = request.shown;
    known.splitByLocation = request.model.split == "location";
    known.splitSeed = request.model.splitSeed;
    known.drawSeed = request.seed;
    if (request.model.datasetHash == request.datasetSha256)
        for (const std::string& fabric : request.model.heldOut) known.heldOut.emplace_back(fabric);
    TestPlan plan = planOfStudy(dataset, known);
    if (plan.pairs.empty())
        throw protocols::badInput({"no photograph of the study is in the data set", dataset.folder.string(),
                                   "the photographs that the study shows", "make the study from the whole data set"});
    return plan;
}

}  // namespace

StudyComparison compareStudy(const rendering::fabrics::Dataset& dataset, const StudyComparisonRequest& request,
                             const Report& report, const Generate& generate)
{
    const TestPlan plan = planFor(dataset, request);
    const auto& architecture = request.model.architecture;
    const MeasuredSignals measured(dataset, architecture.mmPerPixel, architecture.traceMmPerSample);
    PlanRequest planned;
    planned.seed = request.seed;
    planned.threads = request.threads;
    const Controls controls = fitControls(dataset, measured, plan, planned, report);
    const EvaluationContext context{dataset, measured, plan, controls};
    std::vector<MeasuredPair> pairs(plan.pairs.size());
    stats::onThreads(pairs.size(), request.threads, [&](std::size_t i) { pairs[i] = measurePair(context, plan.pairs[i]); });
    const ControlSignals control = controlSignals(dataset, request, plan, generate);

    StudyComparison comparison;
    comparison.aligned = dataset.pairing == rendering::fabrics::Pairing::Aligned;
    comparison.rangeMm = rangeOf(pairs);
    comparison.photographs = controls.photographs;
    comparison.presses = controls.presses;
    comparison.strokes = controls.strokes;
    comparison.notes = notesOn(dataset, request, plan);
    int done = 0;
    for (const SourceRow& row : sourceRows) {
        const auto values = valuesOf(context, request, row.kind, pairs, control, comparison.rangeMm.orElse(1));
        ComparedSource source{summarise({row.kind, row.id, row.name, 0}, plan, values), row.name, {}, {}, {}};
        if (row.kind == PredictorKind::Generated) source.steps = request.model.steps;
        if (row.kind == PredictorKind::Against) {
            source.steps = control.steps;
            source.whyUnfair = control.whyUnfair;
        }
        if (isControl(row.kind) && source.whyUnfair.empty())
            source.differences = differencesFrom(comparison.sources.front().result, source.result);
        comparison.sources.push_back(std::move(source));
        if (report) report("generated against measured", ++done, static_cast<int>(std::size(sourceRows)));
    }
    correctOverControls(comparison.sources);
    return comparison;
}

}  // namespace study::evaluation
