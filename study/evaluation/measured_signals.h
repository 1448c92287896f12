// Measured signals, in the form used to train the generators: the height map of a press and the friction trace of a stroke.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "rendering/fabrics/dataset.h"
#include "rendering/signals/friction_trace.h"
#include "rendering/signals/tactile/photometric_stereo.h"

namespace study::evaluation {

/// Reads signals from the data set and keeps only the calibration of the sensor. Safe to call from several threads.
class MeasuredSignals {
public:
    /// `pitchIfUnknownMm`: pixel pitch of the presses if the data set does not give it. `traceMmPerSample`: spacing of the
    /// model's traces, to which denser records are averaged; 0: records keep their own.
    MeasuredSignals(const rendering::fabrics::Dataset& dataset, double pitchIfUnknownMm, double traceMmPerSample = 0);

    /// Pixel pitch of the height maps.
    double pitchMm() const { return m_pitchMm; }

    /// Sample spacing of the model's traces; 0 where it was not stated.
    double traceMmPerSample() const { return m_traceMmPerSample; }

    /// Reason why the data set gives no height maps; empty if it does.
    const std::string& whyNoHeight() const { return m_whyNoHeight; }

    /// Reason why the data set gives no coefficient of friction; empty if it does.
    const std::string& whyNoFriction() const { return m_whyNoFriction; }

    /// Height map, CV_32FC1, mm, ≥ 0: photometric stereo of the frame, or the known height if the calibration is "known".
    cv::Mat height(const protocols::FabricId& fabric, int index) const;

    /// Friction trace at the spacing of the model or of its record, whichever is wider. The mean is that of the record. Throws
    /// badInput if the record is not a coefficient of friction.
    rendering::signals::FrictionTrace trace(const protocols::FabricId& fabric, int index) const;

private:
    const rendering::fabrics::Dataset& m_dataset;
    double m_pitchMm, m_traceMmPerSample;
    std::string m_whyNoHeight, m_whyNoFriction;
    cv::Mat m_reference;
    std::optional<rendering::signals::Calibration> m_calibration;  ///< none: the data set has known heights
};

}  // namespace study::evaluation
