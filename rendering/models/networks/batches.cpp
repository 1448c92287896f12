#include "rendering/models/networks/batches.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "rendering/models/ring_spectrum.h"

namespace rendering::models {

namespace {

cv::Mat warpedCrop(const cv::Mat& image, cv::Point2d centre, double angleDeg, int side, double zoom)
{
    // getRotationMatrix2D rotates anticlockwise for positive angles. The matrix maps source to destination, because
    // WARP_INVERSE_MAP is not set.
    cv::Mat turn =
        cv::getRotationMatrix2D(cv::Point2f(static_cast<float>(centre.x), static_cast<float>(centre.y)), angleDeg, 1 / zoom);
    turn.at<double>(0, 2) += (side - 1) / 2.0 - centre.x;
    turn.at<double>(1, 2) += (side - 1) / 2.0 - centre.y;
    cv::Mat crop;
    cv::warpAffine(image, crop, turn, {side, side}, image.type() == CV_32FC1 ? cv::INTER_CUBIC : cv::INTER_LINEAR,
                   cv::BORDER_REFLECT_101);
    return crop;
}

/// Draws the centre of a rotated crop such that the crop stays inside where there is room.
cv::Point2d drawCentre(const cv::Size& size, double side, double angleDeg, protocols::Random& random)
{
    const double radians = angleDeg * CV_PI / 180;
    const double half = side / 2.0 * (std::abs(std::cos(radians)) + std::abs(std::sin(radians)));
    const auto along = [&](int length) {
        const double middle = (length - 1) / 2.0, room = std::max(0.0, middle - half);
        return middle + std::round(random.uniform(-room, room));
    };
    const double x = along(size.width);
    return {x, along(size.height)};
}

/// Changes of brightness and white balance of one picture, and its noise.
struct Jitter {
    float gain[3] = {1, 1, 1};
    float noise = 0;
    bool grey = false;
};

/// One in three training pictures is zoomed, by up to mostZoom or its inverse.
constexpr std::uint64_t oneInThisManyZoomed = 3;
constexpr double mostZoom = 1.5;

double drawZoom(protocols::Random& random)
{
    if (random.below(oneInThisManyZoomed) != 0) return 1;
    return std::exp(random.uniform(-std::log(mostZoom), std::log(mostZoom)));
}

/// One in four training pictures loses its colour, so that the networks learn to use the texture too.
constexpr std::uint64_t oneInThisManyGrey = 4;

Jitter drawJitter(protocols::Random& random)
{
    Jitter jitter;
    jitter.grey = random.below(oneInThisManyGrey) == 0;
    const double brightness = random.uniform(0.85, 1.15);
    for (float& gain : jitter.gain) gain = static_cast<float>(brightness * random.uniform(0.95, 1.05));
    jitter.noise = static_cast<float>(random.uniform(0, 0.02));
    return jitter;
}

void appendPhotograph(std::vector<float>& out, const cv::Mat& crop, const Jitter& jitter, protocols::Random& random)
{
    for (int channel = 0; channel < 3; ++channel)
        for (int row = 0; row < crop.rows; ++row)
            for (int column = 0; column < crop.cols; ++column) {
                const cv::Vec3b& pixel = crop.at<cv::Vec3b>(row, column);
                const float shade = jitter.grey ? static_cast<float>(pixel[0] + pixel[1] + pixel[2]) / 3 : pixel[channel];
                float value = shade / 255.0F * jitter.gain[channel];
                if (jitter.noise > 0) value += jitter.noise * static_cast<float>(random.normal());
                out.push_back(std::clamp(value, 0.0F, 1.0F));
            }
}

void appendMap(std::vector<float>& out, const cv::Mat& map, float scale)
{
    for (int row = 0; row < map.rows; ++row)
        for (int column = 0; column < map.cols; ++column) out.push_back(map.at<float>(row, column) * scale);
}

template <class Sample>
const Sample& drawn(const std::vector<Sample>& samples, protocols::Random& random)
{
    return samples[random.below(samples.size())];
}

/// In an aligned data set the sample with the same index, else any sample of the fabric.
template <class Sample>
const Sample& partner(const std::vector<Sample>& samples, int index, bool aligned, protocols::Random& random)
{
    if (aligned)
        for (const Sample& sample : samples)
            if (sample.index == index) return sample;
    return drawn(samples, random);
}

void flipJointly(cv::Mat& photograph, cv::Mat& height, protocols::Random& random)
{
    for (const int axis : {0, 1})
        if (random.below(2) == 1) {
            cv::flip(photograph, photograph, axis);
            if (!height.empty()) cv::flip(height, height, axis);
        }
}

/// Draws the centre of the photograph's crop. In an aligned data set the crop lies in the area that both maps show.
cv::Point2d photographCentre(const TrainingData& data, const TrainingPhotograph& photograph, const TrainingHeight& height,
                             double side, double angleDeg, protocols::Random& random)
{
    const cv::Size whole = photograph.rgb.size(), map = height.heightMm.size();
    const cv::Size shared = data.aligned ? cv::Size(std::min(whole.width, map.width), std::min(whole.height, map.height)) : whole;
    return drawCentre(shared, side, angleDeg, random) +
           cv::Point2d((whole.width - shared.width) / 2.0, (whole.height - shared.height) / 2.0);
}

/// Centre of the height map's crop: in an aligned data set the place of the photograph's crop, else drawn.
cv::Point2d heightCentre(const TrainingData& data, const TrainingPhotograph& photograph, cv::Point2d photographAt,
                         const TrainingHeight& height, double side, double angleDeg, protocols::Random& random)
{
    const cv::Point2d free = drawCentre(height.heightMm.size(), side, angleDeg, random);
    if (!data.aligned || height.index != photograph.index) return free;
    const double turn = (photograph.rotationDeg - height.rotationDeg) * CV_PI / 180;
    const double x = photographAt.x - (photograph.rgb.cols - 1) / 2.0, y = photographAt.y - (photograph.rgb.rows - 1) / 2.0;
    return {(height.heightMm.cols - 1) / 2.0 + x * std::cos(turn) - y * std::sin(turn),
            (height.heightMm.rows - 1) / 2.0 + x * std::sin(turn) + y * std::cos(turn)};
}

/// Appends another measured sample of the fabric, for validation.
void appendOther(Batch& batch, const TrainingData& data, const TrainingFabric& fabric, double angle, protocols::Random& random)
{
    const TrainingHeight& height = drawn(fabric.heights, random);
    const TrainingStroke& stroke = drawn(fabric.strokes, random);
    const double heightAngle = angle - height.rotationDeg;
    const cv::Mat heightCrop =
        turnedCrop(height.heightMm, drawCentre(height.heightMm.size(), batch.crop, heightAngle, random), heightAngle, batch.crop);
    appendMap(batch.otherHeights, heightCrop, static_cast<float>(1 / data.architecture.heightScaleMm));
    appendMap(batch.otherLogRatios, stroke.target.logRatio, 1);
    batch.otherRings.insert(batch.otherRings.end(), height.rings.begin(), height.rings.end());
    batch.otherMeans.push_back(stroke.target.mean);
}

void appendRings(Batch& batch, const TrainingHeight& height, const cv::Mat& heightCrop, double zoom)
{
    if (heightCrop.empty()) return;
    const std::vector<float> rings = zoom == 1 ? height.rings : ringPowers(heightCrop, batch.crop);
    batch.rings.insert(batch.rings.end(), rings.begin(), rings.end());
}

void appendDrawn(Batch& batch, const TrainingData& data, const TrainingFabric& fabric, const BatchOptions& options,
                 protocols::Random& random)
{
    const TrainingPhotograph& photograph = drawn(fabric.photographs, random);
    const TrainingHeight& height = partner(fabric.heights, photograph.index, data.aligned, random);
    const TrainingStroke& stroke = partner(fabric.strokes, photograph.index, data.aligned, random);
    // Half of the pictures keep their orientation, so that interpolation does not blur them; the height map is rotated.
    const bool free = options.augment && random.below(2) == 1;
    const double angle = free ? random.uniform(-180, 180) : photograph.rotationDeg;
    const double photographAngle = angle - photograph.rotationDeg, heightAngle = angle - height.rotationDeg;
    const double zoom = options.augment ? drawZoom(random) : 1, shownPx = batch.crop * zoom;
    const cv::Point2d photographAt = photographCentre(data, photograph, height, shownPx, photographAngle, random);
    cv::Mat photographCrop = turnedCrop(photograph.rgb, photographAt, photographAngle, batch.crop, zoom), heightCrop;
    if (options.heights) {
        const cv::Point2d heightAt = heightCentre(data, photograph, photographAt, height, shownPx, heightAngle, random);
        heightCrop = turnedCrop(height.heightMm, heightAt, heightAngle, batch.crop + 2 * batch.margin, zoom) / zoom;
    }
    if (options.augment) flipJointly(photographCrop, heightCrop, random);
    appendPhotograph(batch.photographs, photographCrop, options.augment ? drawJitter(random) : Jitter{}, random);
    appendMap(batch.heights, heightCrop, static_cast<float>(1 / data.architecture.heightScaleMm));
    appendMap(batch.logRatios, stroke.target.logRatio, 1);
    batch.means.push_back(stroke.target.mean);
    appendRings(batch, height, heightCrop, zoom);
    if (!options.augment) appendOther(batch, data, fabric, angle, random);
}

}  // namespace

cv::Mat turnedCrop(const cv::Mat& image, cv::Point2d centre, double angleDeg, int side, double zoom)
{
    const cv::Rect whole(static_cast<int>(std::floor(centre.x - (side - 1) / 2.0)),
                         static_cast<int>(std::floor(centre.y - (side - 1) / 2.0)), side, side);
    const cv::Rect inside = whole & cv::Rect(0, 0, image.cols, image.rows);
    if (std::abs(angleDeg) < 1e-9 && zoom == 1 && inside == whole) return image(whole).clone();
    return warpedCrop(image, centre, angleDeg, side, zoom);
}

Batch drawBatch(const TrainingData& data, const std::vector<TrainingFabric>& part, const BatchOptions& options,
                protocols::Random& random)
{
    Batch batch;
    batch.size = options.size;
    batch.crop = data.architecture.crop;
    batch.margin = data.aligned ? 0 : options.margin;
    batch.rows = data.architecture.rows;
    batch.frames = data.architecture.frames;
    std::vector<std::size_t> deck;
    for (int i = 0; i < options.size; ++i) {
        if (deck.empty()) {
            for (std::size_t fabric = 0; fabric < part.size(); ++fabric) deck.push_back(fabric);
            random.shuffle(deck);
        }
        appendDrawn(batch, data, part[deck.back()], options, random);
        deck.pop_back();
    }
    return batch;
}

}  // namespace rendering::models
