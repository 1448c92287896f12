#include "rendering/composition/frame_images.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <optional>

#include "rendering/composition/tiled_patch.h"
#include "rendering/signals/tactile/photometric_stereo.h"

namespace rendering {

namespace {

/// The part of a larger map that the screen shows.
cv::Mat middleOf(const cv::Mat& map)
{
    const cv::Size kept(std::min(map.cols, displayWidthPx), std::min(map.rows, displayHeightPx));
    return map(cv::Rect((map.cols - kept.width) / 2, (map.rows - kept.height) / 2, kept.width, kept.height));
}

ScaledMap accurateMap(const cv::Mat& frame, const cv::Mat& reference, const signals::Calibration& calibration,
                      Extension extension)
{
    Sources sources;
    sources.relief = signals::heightFromFrame(frame, reference, calibration);
    sources.reliefMmPerPixel = calibration.mmPerPixel;
    return compose(protocols::conditionNamed("h"), sources, DisplayScale::Pixels, extension);
}

}  // namespace

FrameImages::FrameImages(const signals::Calibration& calibration, const cv::Mat& reference, const MapRange& range,
                         Extension extension)
    : m_heights(calibration, reference), m_range(range), m_extension(extension)
{
}

const cv::Mat& FrameImages::imageOf(const cv::Mat& frame)
{
    const cv::Mat shown = middleOf(m_heights.heightOf(frame));
    m_image.create(displayHeightPx, displayWidthPx, CV_8UC1);
    const bool mayTile = m_extension == Extension::Tile && shown.size() != m_image.size() && shown.rows > 1;
    if (m_range.constant())
        m_image.setTo(0);
    else if (const auto tiled = mayTile ? tiledPatch(shown) : std::nullopt)
        fillRows(*tiled);
    else
        mirror(shown);
    return m_image;
}

/// Levels first, then the mirror: a quarter of the memory that heights would move.
void FrameImages::mirror(const cv::Mat& shown)
{
    shown.convertTo(m_levels, CV_8U, gain(), -m_range.min * gain());
    const int left = (m_image.cols - shown.cols) / 2, top = (m_image.rows - shown.rows) / 2;
    cv::copyMakeBorder(m_levels, m_image, top, m_image.rows - shown.rows - top, left, m_image.cols - shown.cols - left,
                       cv::BORDER_REFLECT);
}

double FrameImages::gain() const { return 255 / (m_range.max - m_range.min); }

void FrameImages::fillRows(const TiledPatch& tiled)
{
    const auto columns = tiled.mirroredColumns();
    const auto least = static_cast<float>(m_range.min), scale = static_cast<float>(gain());
    m_values.resize(static_cast<std::size_t>(displayWidthPx));
    m_texture.resize(m_values.size());
    for (int i = 0; i < m_image.rows; ++i) {
        tiled.valuesOfRow(i, columns, m_texture, m_values);
        auto* level = m_image.ptr<unsigned char>(i);
        for (const float value : m_values)
            *level++ = static_cast<unsigned char>(std::min(std::max((value - least) * scale + 0.5F, 0.F), 255.F));
    }
}

cv::Mat frameImage(const cv::Mat& frame, const cv::Mat& reference, const signals::Calibration& calibration, const MapRange& range,
                   Extension extension)
{
    return mapToDisplay(accurateMap(frame, reference, calibration, extension), range);
}

MapRange frameRange(const cv::Mat& frame, const cv::Mat& reference, const signals::Calibration& calibration, Extension extension)
{
    MapRange range;
    range.include(accurateMap(frame, reference, calibration, extension));
    return range;
}

}  // namespace rendering
