// What the instruments said: height of a press and trace of a stroke, as the generators are trained on them.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "rendering/fabrics/dataset.h"
#include "rendering/signals/friction_trace.h"
#include "rendering/signals/photometric_stereo.h"

namespace study::evaluation {

/// Reads; holds the sensor's calibration alone. May be asked from several threads.
class MeasuredSignals {
public:
    /// `pitchIfUnknownMm`: of the presses, where the data set does not state it.
    MeasuredSignals(const rendering::fabrics::Dataset& dataset, double pitchIfUnknownMm);

    double pitchMm() const { return m_pitchMm; }  ///< of the height maps

    /// Why no height can be had from this data set's presses; empty where it can.
    const std::string& whyNoHeight() const { return m_whyNoHeight; }

    /// Why no coefficient of friction can be had; empty where it can.
    const std::string& whyNoFriction() const { return m_whyNoFriction; }

    /// CV_32FC1, mm, >= 0: photometric stereo of the frame, or the known height where the data set says "known".
    cv::Mat height(const protocols::FabricId& fabric, int index) const;

    /// Throws badInput where the record is no coefficient of friction.
    rendering::signals::FrictionTrace trace(const protocols::FabricId& fabric, int index) const;

private:
    const rendering::fabrics::Dataset& m_dataset;
    double m_pitchMm;
    std::string m_whyNoHeight, m_whyNoFriction;
    cv::Mat m_reference;
    std::optional<rendering::signals::Calibration> m_calibration;  ///< none: heights are known
};

}  // namespace study::evaluation
