#include "study/evaluation/measured_signals.h"

#include <utility>

#include "protocols/files/errors.h"
#include "study/evaluation/friction_comparison.h"

namespace study::evaluation {

namespace fabrics = rendering::fabrics;
namespace signals = rendering::signals;

namespace {

/// Reason why the data set gives no coefficient of friction, as seen in its first record; empty if it does.
std::string whyNoFrictionIn(const fabrics::Dataset& dataset)
{
    for (const auto& fabric : dataset.fabrics)
        if (const auto indices = fabrics::sampleIndices(dataset, fabric.id, fabrics::Modality::Friction); !indices.empty()) {
            const auto record = fabrics::readFriction(dataset, fabric.id, indices.front());
            return record.isCoefficient() ? ""
                                          : "the friction records contain " + record.quantity + ", not a coefficient of friction";
        }
    return "the data set has no friction records";
}

bool hasPresses(const fabrics::Dataset& dataset)
{
    for (const auto& fabric : dataset.fabrics)
        if (!fabrics::sampleIndices(dataset, fabric.id, fabrics::Modality::Tactile).empty()) return true;
    return false;
}

}  // namespace

MeasuredSignals::MeasuredSignals(const fabrics::Dataset& dataset, double pitchIfUnknownMm, double traceMmPerSample)
    : m_dataset(dataset),
      m_pitchMm(dataset.tactileMmPerPixel.value_or(pitchIfUnknownMm)),
      m_traceMmPerSample(traceMmPerSample),
      m_whyNoFriction(whyNoFrictionIn(dataset))
{
    if (!hasPresses(dataset)) {
        m_whyNoHeight = "the data set has no tactile frames";
        return;
    }
    if (dataset.tactileCalibration.empty()) {
        m_whyNoHeight = "the data set has no calibration of its tactile sensor";
        return;
    }
    if (dataset.tactileCalibration == "known") return;
    m_reference = fabrics::readTactileReference(dataset);
    m_calibration = signals::calibrationOf(dataset, m_reference);
}

cv::Mat MeasuredSignals::height(const protocols::FabricId& fabric, int index) const
{
    cv::Mat height;
    if (m_calibration) {
        height = signals::heightFromFrame(fabrics::readTactileFrame(m_dataset, fabric, index), m_reference, *m_calibration,
                                          signals::IntegrationQuality::Fast);
    } else {
        const auto known = fabrics::readKnownHeight(m_dataset, fabric, index);
        if (!known)
            throw protocols::badInput({"the known height of tactile sample " + std::to_string(index) + " is missing",
                                       fabrics::knownHeightPath(m_dataset, fabric, index).string(),
                                       "a height file for every frame, because dataset.json has the calibration \"known\"",
                                       "add the file, or name a calibration file in dataset.json"});
        if (!cv::checkRange(*known))
            throw protocols::badInput({"holds heights that are not finite",
                                       fabrics::knownHeightPath(m_dataset, fabric, index).string(), "a number in every pixel",
                                       "fill the gaps, or remove the frame and its height"});
        height = signals::zeroedRelief(*known, {m_pitchMm, m_pitchMm}, std::nullopt, signals::Calibration{}.zeroPercentile);
    }
    height.convertTo(height, CV_32F);
    return height;
}

signals::FrictionTrace MeasuredSignals::trace(const protocols::FabricId& fabric, int index) const
{
    const auto record = fabrics::readFriction(m_dataset, fabric, index);
    const auto file = fabrics::samplePath(m_dataset, fabric, fabrics::Modality::Friction, index).string();
    if (!record.isCoefficient())
        throw protocols::badInput({"the friction record contains " + record.quantity + ", not a coefficient", file,
                                   "columns t_s,normal_n,tangential_n or t_s,mu",
                                   "evaluate a data set with coefficients of friction"});
    signals::FrictionTrace trace = signals::frictionTrace(record, file);
    if (!(trace.mmPerSample < m_traceMmPerSample)) return trace;
    Trace averaged = atSpacing({std::move(trace.values), trace.mmPerSample}, m_traceMmPerSample);
    trace.values = std::move(averaged.values);
    trace.sampleRateHz *= trace.mmPerSample / averaged.mmPerSample;
    trace.mmPerSample = averaged.mmPerSample;
    return trace;
}

}  // namespace study::evaluation
