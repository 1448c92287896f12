// Friction images of condition h from frames of a tactile sensor, one after another and from memory to memory: what a live view
// of a sensor needs. The quality is `fast`: single precision, and mirrored at the patch's borders unless the caller wants copies,
// whose lattice takes most of the time. frameImage() is the accurate one that it is compared with.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "rendering/composition/display_mapping.h"
#include "rendering/composition/screen_extension.h"
#include "rendering/signals/tactile/frame_heights.h"

namespace rendering {

struct TiledPatch;

/// Prepared for one sensor and one range. One thread. Two values share nothing.
class FrameImages {
public:
    /// `range`: of the heights that the display's levels stand for, mm. Throws badInput where the reference does not fit.
    FrameImages(const signals::Calibration& calibration, const cv::Mat& reference, const MapRange& range,
                Extension extension = Extension::Mirror);

    /// Levels of the display, CV_8UC1 [800 x 1280]; valid until the next call. The image follows from this frame alone.
    /// Throws badInput where the frame does not fit the calibration.
    const cv::Mat& imageOf(const cv::Mat& frame);

private:
    double gain() const;
    void fillRows(const TiledPatch& tiled);
    void mirror(const cv::Mat& shown);

    signals::FrameHeights m_heights;
    MapRange m_range;
    Extension m_extension;
    cv::Mat m_levels;  ///< of the frame's own pixels
    cv::Mat m_image;
    std::vector<float> m_values, m_texture;  ///< of one row
};

/// The same image in double precision, by the functions that `vis2hap render` uses.
cv::Mat frameImage(const cv::Mat& frame, const cv::Mat& reference, const signals::Calibration& calibration, const MapRange& range,
                   Extension extension = Extension::Mirror);

/// Range of the accurate map of one frame.
MapRange frameRange(const cv::Mat& frame, const cv::Mat& reference, const signals::Calibration& calibration,
                    Extension extension = Extension::Mirror);

}  // namespace rendering
