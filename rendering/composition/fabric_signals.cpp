#include "rendering/composition/fabric_signals.h"

#include <algorithm>
#include <chrono>
#include <opencv2/core.hpp>
#include <utility>

#include "rendering/fabrics/sample_places.h"
#include "rendering/signals/friction_trace.h"
#include "rendering/signals/grey.h"
#include "rendering/signals/height_gradient.h"
#include "rendering/signals/shape_from_shading.h"

namespace rendering {

namespace {

using fabrics::Modality;

/// A kind of recording and its sample index in a choice.
struct RecordingKind {
    Signal signal;
    Modality modality;
    int SampleChoice::*index;
    const char* plural;
};

constexpr RecordingKind recordingKinds[] = {
    {Signal::Photograph, Modality::Visual, &SampleChoice::visual, "photographs"},
    {Signal::TactileFrame, Modality::Tactile, &SampleChoice::tactile, "tactile frames"},
    {Signal::FrictionRecord, Modality::Friction, &SampleChoice::friction, "friction records"},
};

/// A photograph with fewer times the pixels of the screen is turned into a relief as a whole, in about a second.
constexpr std::size_t leastPhotographs = 8;

std::string ofFabric(const protocols::FabricId& fabric, const protocols::Condition& condition)
{
    return " of fabric " + fabric.value + ", which condition " + std::string(condition.id) + " needs";
}

std::optional<protocols::Fault> missingSample(const fabrics::Dataset& dataset, const protocols::FabricId& fabric,
                                              const SampleChoice& samples, const protocols::Condition& condition,
                                              const RecordingKind& kind)
{
    const auto indices = fabrics::sampleIndices(dataset, fabric, kind.modality);
    const int wanted = samples.*(kind.index);
    const auto folder = dataset.folder / fabric.value / fabrics::nameOf(kind.modality);
    if (indices.empty())
        return protocols::Fault{std::string("the data set has no ") + kind.plural + ofFabric(fabric, condition), folder.string(),
                                "at least one sample", "import some, or leave the condition out"};
    if (!std::binary_search(indices.begin(), indices.end(), wanted))
        return protocols::Fault{
            "sample " + std::to_string(wanted) + " is not among the " + kind.plural + ofFabric(fabric, condition),
            folder.string(), "an index from " + std::to_string(indices.front()) + " to " + std::to_string(indices.back()),
            "choose another --sample"};
    return {};
}

std::optional<protocols::Fault> missingHeight(const fabrics::Dataset& dataset, const protocols::FabricId& fabric,
                                              const SampleChoice& samples, const protocols::Condition& condition)
{
    const auto heights = "the height" + ofFabric(fabric, condition) + ", cannot be computed: ";
    const auto where = (dataset.folder / "dataset.json").string();
    if (dataset.tactileCalibration.empty())
        return protocols::Fault{heights + "the tactile frames have no calibration", where, "tactile.calibration",
                                "calibrate with vis2hap calibrate and name the file in dataset.json"};
    if (dataset.tactileCalibration != "known") return {};
    if (std::filesystem::exists(knownHeightPath(dataset, fabric, samples.tactile))) return {};
    return protocols::Fault{heights + "the data set states known heights but has none for this sample", where,
                            fabric.value + "/height/*.tiff", "add the height, or name a calibration"};
}

/// Pitch of a signal's recording, as the data set states it.
std::optional<double> statedPitch(const fabrics::Dataset& dataset, const protocols::FabricId& fabric, const SampleChoice& samples,
                                  Signal signal)
{
    return recordingOf(signal) == Signal::Photograph ? fabrics::PhotographViews(dataset).mmPerPixel(fabric, samples.visual)
                                                     : dataset.tactileMmPerPixel;
}

protocols::Fault missingPitch(const fabrics::Dataset& dataset, const std::string& what)
{
    return {what + ", is unknown", (dataset.folder / "dataset.json").string(), "mm_per_pixel",
            "state it in dataset.json, or use --scale pixels"};
}

/// Runs one computation, counts it and adds its time.
template <class Work>
void computed(RenderedFabrics& counts, FabricSignals& signals, Signal signal, Work work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    const double taken = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    counts.milliseconds[signal] += taken;
    signals.milliseconds[signal] = taken;
    ++counts.computed[signal];
}

const cv::Mat& imageOf(const FabricSignals& signals, Signal signal) { return signals.images.at(signal); }

}  // namespace

SampleChoice firstSamples(const fabrics::Dataset& dataset, const protocols::FabricId& fabric)
{
    SampleChoice choice;
    for (const auto& kind : recordingKinds)
        if (const auto indices = fabrics::sampleIndices(dataset, fabric, kind.modality); !indices.empty())
            choice.*(kind.index) = indices.front();
    return choice;
}

std::optional<protocols::Fault> missingInput(const fabrics::Dataset& dataset, const protocols::FabricId& fabric,
                                             const SampleChoice& samples, const protocols::Condition& condition,
                                             DisplayScale scale)
{
    const auto needed = signalsFor(condition);
    const auto needs = [&](Signal signal) { return std::find(needed.begin(), needed.end(), signal) != needed.end(); };
    for (const auto& kind : recordingKinds)
        if (needs(kind.signal))
            if (auto fault = missingSample(dataset, fabric, samples, condition, kind)) return fault;
    if (needs(Signal::PhotometricHeight))
        if (auto fault = missingHeight(dataset, fabric, samples, condition)) return fault;
    const auto relief = reliefSignal(condition);
    if (scale == DisplayScale::Physical && relief && !statedPitch(dataset, fabric, samples, *relief))
        return missingPitch(dataset, "the physical scale of the images" + ofFabric(fabric, condition));
    if (needs(Signal::HeightGradient) && !dataset.tactileMmPerPixel) {
        auto fault = missingPitch(dataset, "the pitch of the tactile frames" + ofFabric(fabric, condition));
        fault.nextStep = "state it in dataset.json, or leave the condition out";
        return fault;
    }
    return {};
}

cv::Mat SignalComputation::tactileHeight(const protocols::FabricId& fabric, int index, const cv::Mat& frame)
{
    if (m_dataset.tactileCalibration == "known") return fabrics::readKnownHeight(m_dataset, fabric, index).value();
    if (!m_calibration) {
        m_reference = fabrics::readTactileReference(m_dataset);
        m_calibration = signals::calibrationOf(m_dataset, m_reference);
    }
    return signals::heightFromFrame(frame, m_reference, *m_calibration, models::presetOf(m_quality).integration);
}

cv::Mat SignalComputation::reliefOf(const cv::Mat& photograph, FabricSignals& result) const
{
    const cv::Size kept(std::min(photograph.cols, m_shown.width), std::min(photograph.rows, m_shown.height));
    const bool small = m_shown.empty() || photograph.total() < leastPhotographs * static_cast<std::size_t>(m_shown.area());
    if (small || m_shading.method != signals::ShadingMethod::Linear || m_shading.quality != signals::ShadingQuality::Accurate)
        return signals::shapeFromShading(photograph, m_shading);
    const cv::Point first((photograph.cols - kept.width) / 2, (photograph.rows - kept.height) / 2);
    auto part = signals::reliefOfPart(photograph, {first, kept}, *result.light, m_shading);
    result.shapeLeftOut = part.varianceLeftOut;
    return part.height;
}

void SignalComputation::addMeasuredTrace(const protocols::FabricId& fabric, int sample, const std::set<Signal>& needed,
                                         RenderedFabrics& counts, const FabricSignals& known, FabricSignals& result) const
{
    if (known.traces.contains(Signal::MeasuredTrace) && needed.contains(Signal::MeasuredTrace)) {
        result.traces.insert(*known.traces.find(Signal::MeasuredTrace));
        result.milliseconds[Signal::MeasuredTrace] = known.milliseconds.at(Signal::MeasuredTrace);
        result.measuredMeanFriction = known.measuredMeanFriction;
        result.measuredQuantity = known.measuredQuantity;
        result.traceMmPerSample = known.traceMmPerSample;
        return;
    }
    fabrics::FrictionRecord record;
    if (needed.contains(Signal::FrictionRecord))
        computed(counts, result, Signal::FrictionRecord, [&] { record = fabrics::readFriction(m_dataset, fabric, sample); });
    if (needed.contains(Signal::MeasuredTrace))
        computed(counts, result, Signal::MeasuredTrace, [&] {
            const auto where = fabrics::samplePath(m_dataset, fabric, Modality::Friction, sample).string();
            auto trace = signals::frictionTrace(record, where);
            result.traces[Signal::MeasuredTrace] = std::move(trace.values);
            result.measuredMeanFriction = trace.mean;
            result.measuredQuantity = trace.quantity;
            result.traceMmPerSample = trace.mmPerSample;
        });
}

FabricSignals SignalComputation::measured(const protocols::FabricId& fabric, const SampleChoice& samples,
                                          const std::set<Signal>& needed, RenderedFabrics& counts, const FabricSignals& known)
{
    FabricSignals result;
    result.photographMmPerPixel = m_views.mmPerPixel(fabric, samples.visual);
    result.fibre = m_dataset.fabric(fabric).fibre;
    result.photographLightDeg = m_views.lightDeg(fabric, samples.visual);
    result.tactileMmPerPixel = m_dataset.tactileMmPerPixel;
    const auto compute = [&](Signal signal, const auto& work) {
        if (!needed.contains(signal)) return;
        if (const auto same = known.images.find(signal); same != known.images.end() && !dependsOnQuality(signal)) {
            result.images.insert(*same);
            if (const auto taken = known.milliseconds.find(signal); taken != known.milliseconds.end())
                result.milliseconds.insert(*taken);
        } else {
            computed(counts, result, signal, [&] { result.images[signal] = work(); });
        }
    };
    const auto readPhotograph = [&]() -> const cv::Mat& {
        if (!result.images.contains(Signal::Photograph))
            compute(Signal::Photograph, [&] { return fabrics::readPhotograph(m_dataset, fabric, samples.visual); });
        return imageOf(result, Signal::Photograph);
    };
    const auto readFrame = [&]() -> const cv::Mat& {
        if (!result.images.contains(Signal::TactileFrame))
            compute(Signal::TactileFrame, [&] { return fabrics::readTactileFrame(m_dataset, fabric, samples.tactile); });
        return imageOf(result, Signal::TactileFrame);
    };
    // A cache may make recordings needless. The generators always see the photograph.
    const bool isSeen = std::any_of(needed.begin(), needed.end(), [](Signal signal) { return isGenerated(signal); });
    if (needed.contains(Signal::Photograph) && (isSeen || !m_kept.isOn())) readPhotograph();
    if (needed.contains(Signal::TactileFrame) && !m_kept.isOn()) readFrame();
    // A signal that the cache gives is not counted as computed.
    const auto keep = [&](Signal signal, const auto& keptOrComputed) {
        if (needed.contains(signal))
            result.images[signal] = keptOrComputed([&](const auto& work) {
                cv::Mat image;
                computed(counts, result, signal, [&] { image = work(); });
                return image;
            });
    };
    compute(Signal::GreyPhotograph, [&] { return signals::grey(readPhotograph()); });
    keep(Signal::ShapeFromShading, [&](const auto& counted) {
        return m_kept.relief(fabric, samples.visual, m_shading, m_shown, result, [&] {
            const cv::Mat& photograph = readPhotograph();
            return counted([&] {
                result.light = signals::estimateLight(photograph, m_shading.highPassPx);
                result.colourVariation = signals::colourVariation(photograph, m_shading.highPassPx);
                return reliefOf(photograph, result);
            });
        });
    });
    compute(Signal::GreyTactile, [&] { return signals::grey(readFrame()); });
    keep(Signal::PhotometricHeight, [&](const auto& counted) {
        const auto height = [&] {
            const cv::Mat& frame = readFrame();
            return counted([&] { return tactileHeight(fabric, samples.tactile, frame); });
        };
        // A known height is a file that is read as fast as an entry of the cache.
        return m_dataset.tactileCalibration == "known" ? height()
                                                       : m_kept.height(fabric, samples.tactile, m_quality, result, height);
    });

    compute(Signal::HeightGradient,
            [&] { return signals::heightGradient(imageOf(result, Signal::PhotometricHeight), *m_dataset.tactileMmPerPixel); });
    addMeasuredTrace(fabric, samples.friction, needed, counts, known, result);
    return result;
}

void addGenerated(FabricSignals& signals, models::GeneratedSignals generated, const std::set<Signal>& needed)
{
    signals.photograph = generated.photograph;
    if (needed.contains(Signal::GeneratedHeight)) {
        signals.images[Signal::GeneratedHeight] = generated.heightMm;
        signals.milliseconds[Signal::GeneratedHeight] = generated.heightMilliseconds;
        signals.generatedMmPerPixel = generated.heightMmPerPixel;
    }
    if (needed.contains(Signal::GeneratedSpectrogram)) {
        signals.images[Signal::GeneratedSpectrogram] = generated.spectrogram;
        signals.milliseconds[Signal::GeneratedSpectrogram] = generated.frictionMilliseconds;
        signals.traces[Signal::GeneratedTrace] = std::move(generated.trace);
        signals.generatedMeanFriction = generated.meanFriction;
        signals.generatedTraceMmPerSample = generated.traceMmPerSample;
    }
}

void addMissing(FabricSignals& signals, const FabricSignals& other)
{
    signals.images.insert(other.images.begin(), other.images.end());
    if (other.traces.contains(Signal::MeasuredTrace) && !signals.traces.contains(Signal::MeasuredTrace))
        signals.measuredQuantity = other.measuredQuantity;
    signals.traces.insert(other.traces.begin(), other.traces.end());
    signals.milliseconds.insert(other.milliseconds.begin(), other.milliseconds.end());
    const auto fill = [&](auto... fields) { ((signals.*fields = signals.*fields ? signals.*fields : other.*fields), ...); };
    fill(&FabricSignals::measuredMeanFriction, &FabricSignals::generatedMeanFriction, &FabricSignals::light,
         &FabricSignals::shapeLeftOut, &FabricSignals::colourVariation, &FabricSignals::photograph,
         &FabricSignals::photographMmPerPixel, &FabricSignals::tactileMmPerPixel, &FabricSignals::generatedMmPerPixel,
         &FabricSignals::traceMmPerSample, &FabricSignals::generatedTraceMmPerSample, &FabricSignals::likeness,
         &FabricSignals::photographLightDeg, &FabricSignals::fibre);
}

Sources sourcesOf(const protocols::Condition& condition, const FabricSignals& signals)
{
    Sources sources;
    if (const auto relief = reliefSignal(condition)) {
        sources.relief = imageOf(signals, *relief);
        if (*relief == Signal::ShapeFromShading) sources.reliefLeftOut = signals.shapeLeftOut;
        sources.reliefMmPerPixel = isGenerated(*relief)                         ? signals.generatedMmPerPixel
                                   : recordingOf(*relief) == Signal::Photograph ? signals.photographMmPerPixel
                                                                                : signals.tactileMmPerPixel;
    }
    if (const auto friction = frictionSignal(condition)) {
        const bool generated = *friction == Signal::GeneratedTrace;
        sources.trace = signals.traces.at(*friction);
        sources.traceMmPerSample = (generated ? signals.generatedTraceMmPerSample : signals.traceMmPerSample).value_or(0);
        sources.meanFriction = generated ? signals.generatedMeanFriction : signals.measuredMeanFriction;
    }
    return sources;
}

}  // namespace rendering
