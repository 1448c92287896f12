#include "rendering/models/networks/batches.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "rendering/models/ring_spectrum.h"

namespace rendering::models {

namespace {

cv::Mat turnedAsTaken(const cv::Mat& image, cv::Point2d centre, double angleDeg, int side, double zoom)
{
    // getRotationMatrix2D turns anticlockwise for positive angles; WARP_INVERSE_MAP is not set, so the
    // matrix maps source to destination.
    cv::Mat turn =
        cv::getRotationMatrix2D(cv::Point2f(static_cast<float>(centre.x), static_cast<float>(centre.y)), angleDeg, 1 / zoom);
    turn.at<double>(0, 2) += (side - 1) / 2.0 - centre.x;
    turn.at<double>(1, 2) += (side - 1) / 2.0 - centre.y;
    cv::Mat crop;
    cv::warpAffine(image, crop, turn, {side, side}, image.type() == CV_32FC1 ? cv::INTER_CUBIC : cv::INTER_LINEAR,
                   cv::BORDER_REFLECT_101);
    return crop;
}

/// A place for the centre of a turned crop: anywhere that keeps it inside where there is room.
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

/// Brightness and white balance of one picture, and its noise.
struct Jitter {
    float gain[3] = {1, 1, 1};
    float noise = 0;
    bool grey = false;
};

/// A third of the training pictures are zoomed, by up to so much either way.
constexpr std::uint64_t oneInSoManyZoomed = 3;
constexpr double mostZoom = 1.5;

double drawZoom(protocols::Random& random)
{
    if (random.below(oneInSoManyZoomed) != 0) return 1;
    return std::exp(random.uniform(-std::log(mostZoom), std::log(mostZoom)));
}

/// How many pictures lose their colour, so that fabrics are told apart by their texture too.
constexpr std::uint64_t oneInSoManyGrey = 4;

Jitter drawJitter(protocols::Random& random)
{
    Jitter jitter;
    jitter.grey = random.below(oneInSoManyGrey) == 0;
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

/// In an aligned data set the samples of one index belong together; else any of the fabric does.
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

/// Where both show one place, the crop keeps to what both show.
cv::Point2d photographCentre(const TrainingData& data, const TrainingPhotograph& photograph, const TrainingHeight& height,
                             double side, double angleDeg, protocols::Random& random)
{
    const cv::Size whole = photograph.rgb.size(), felt = height.heightMm.size();
    const cv::Size shared =
        data.aligned ? cv::Size(std::min(whole.width, felt.width), std::min(whole.height, felt.height)) : whole;
    return drawCentre(shared, side, angleDeg, random) +
           cv::Point2d((whole.width - shared.width) / 2.0, (whole.height - shared.height) / 2.0);
}

/// Where the height map's crop lies: the place of the photograph's crop where both show one place.
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

/// A measured sample beside the drawn one, for validation.
void appendOther(Batch& batch, const TrainingData& data, const FabricSamples& fabric, double angle, protocols::Random& random)
{
    const TrainingHeight& height = drawn(fabric.heights, random);
    const TrainingStroke& stroke = drawn(fabric.strokes, random);
    const double heightAngle = angle - height.rotationDeg;
    const cv::Mat felt =
        turnedCrop(height.heightMm, drawCentre(height.heightMm.size(), batch.crop, heightAngle, random), heightAngle, batch.crop);
    appendMap(batch.otherHeights, felt, static_cast<float>(1 / data.architecture.heightScaleMm));
    appendMap(batch.otherLogRatios, stroke.target.logRatio, 1);
    batch.otherRings.insert(batch.otherRings.end(), height.rings.begin(), height.rings.end());
    batch.otherMeans.push_back(stroke.target.mean);
}

void appendRings(Batch& batch, const TrainingHeight& height, const cv::Mat& felt, double zoom)
{
    if (felt.empty()) return;
    const std::vector<float> rings = zoom == 1 ? height.rings : ringPowers(felt, batch.crop);
    batch.rings.insert(batch.rings.end(), rings.begin(), rings.end());
}

void appendDrawn(Batch& batch, const TrainingData& data, const FabricSamples& fabric, const BatchWish& wish,
                 protocols::Random& random)
{
    const TrainingPhotograph& photograph = drawn(fabric.photographs, random);
    const TrainingHeight& height = partner(fabric.heights, photograph.index, data.aligned, random);
    const TrainingStroke& stroke = partner(fabric.strokes, photograph.index, data.aligned, random);
    // Half the pictures stay as taken, unblurred by interpolation; the height map turns with them.
    const bool free = wish.augment && random.below(2) == 1;
    const double angle = free ? random.uniform(-180, 180) : photograph.rotationDeg;
    const double photographAngle = angle - photograph.rotationDeg, heightAngle = angle - height.rotationDeg;
    const double zoom = wish.augment ? drawZoom(random) : 1, shownPx = batch.crop * zoom;
    const cv::Point2d photographAt = photographCentre(data, photograph, height, shownPx, photographAngle, random);
    cv::Mat seen = turnedCrop(photograph.rgb, photographAt, photographAngle, batch.crop, zoom), felt;
    if (wish.heights) {
        const cv::Point2d heightAt = heightCentre(data, photograph, photographAt, height, shownPx, heightAngle, random);
        felt = turnedCrop(height.heightMm, heightAt, heightAngle, batch.crop + 2 * batch.margin, zoom) / zoom;
    }
    if (wish.augment) flipJointly(seen, felt, random);
    appendPhotograph(batch.photographs, seen, wish.augment ? drawJitter(random) : Jitter{}, random);
    appendMap(batch.heights, felt, static_cast<float>(1 / data.architecture.heightScaleMm));
    appendMap(batch.logRatios, stroke.target.logRatio, 1);
    batch.means.push_back(stroke.target.mean);
    appendRings(batch, height, felt, zoom);
    if (!wish.augment) appendOther(batch, data, fabric, angle, random);
}

}  // namespace

cv::Mat turnedCrop(const cv::Mat& image, cv::Point2d centre, double angleDeg, int side, double zoom)
{
    const cv::Rect whole(static_cast<int>(std::floor(centre.x - (side - 1) / 2.0)),
                         static_cast<int>(std::floor(centre.y - (side - 1) / 2.0)), side, side);
    const cv::Rect inside = whole & cv::Rect(0, 0, image.cols, image.rows);
    if (std::abs(angleDeg) < 1e-9 && zoom == 1 && inside == whole) return image(whole).clone();
    return turnedAsTaken(image, centre, angleDeg, side, zoom);
}

Batch drawBatch(const TrainingData& data, const std::vector<FabricSamples>& part, const BatchWish& wish,
                protocols::Random& random)
{
    Batch batch;
    batch.size = wish.size;
    batch.crop = data.architecture.crop;
    batch.margin = data.aligned ? 0 : wish.margin;
    batch.rows = data.architecture.rows;
    batch.frames = data.architecture.frames;
    std::vector<std::size_t> deck;
    for (int i = 0; i < wish.size; ++i) {
        if (deck.empty()) {
            for (std::size_t fabric = 0; fabric < part.size(); ++fabric) deck.push_back(fabric);
            random.shuffle(deck);
        }
        appendDrawn(batch, data, part[deck.back()], wish, random);
        deck.pop_back();
    }
    return batch;
}

}  // namespace rendering::models
