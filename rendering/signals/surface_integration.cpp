#include "rendering/signals/surface_integration.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <tuple>
#include <utility>

#include "protocols/files/errors.h"
#include "rendering/signals/cosine_transform.h"
#include "rendering/signals/gap_multigrid.h"
#include "rendering/signals/high_pass.h"
#include "rendering/signals/joined_lattices.h"
#include "rendering/signals/known_places.h"
#include "rendering/signals/slope_differences.h"

namespace rendering::signals {

namespace {

constexpr double weightOfGaps = 1e-3;
constexpr double fewGaps = 1e-3;           ///< share of the pixels; so few gaps are bridged well enough by the slopes around them
constexpr double mostStretchedSingle = 8;  ///< pixels longer than this need sources in double precision
constexpr std::size_t largeMap = 4'000'000;  ///< pixels; more iterations gain far less there than the noise of the slopes
constexpr MultigridOptions thorough{.residualToReach = 1e-6, .mostIterations = 60},
    quick{.residualToReach = 1e-4, .mostIterations = 12, .residualToAccept = 5e-4};

std::string sizeText(const cv::Mat& image) { return std::to_string(image.cols) + " x " + std::to_string(image.rows); }

void requireShape(const Slopes& slopes, const Pitch& pitch)
{
    if (slopes.x.empty() || slopes.x.size() != slopes.y.size())
        throw protocols::badInput(
            {.what = "the slopes along x (" + sizeText(slopes.x) + ") and y (" + sizeText(slopes.y) + ") differ in size",
             .where = "",
             .expected = "two images of one size",
             .nextStep = "choose two files of one measurement"});
    if (slopes.x.channels() != 1 || slopes.y.channels() != 1)
        throw protocols::badInput({.what = "the slopes have several channels",
                                   .where = "",
                                   .expected = "one channel",
                                   .nextStep = "split the channels"});
    if (!(pitch.x > 0 && pitch.y > 0 && std::isfinite(pitch.x) && std::isfinite(pitch.y)))
        throw protocols::badInput({.what = "the pitch of the slopes is not positive",
                                   .where = "",
                                   .expected = "mm per pixel above 0",
                                   .nextStep = "correct --pitch"});
}

void requireWhole(const Slopes& slopes)
{
    if (!cv::checkRange(slopes.x) || !cv::checkRange(slopes.y))
        throw protocols::badInput({.what = "the slopes hold values that are not finite",
                                   .where = "",
                                   .expected = "a finite number at every pixel",
                                   .nextStep = "mark the gaps in a mask"});
}

template <class T>
cv::Mat as(const cv::Mat& values)
{
    if (values.type() == cv::DataType<T>::type) return values;
    cv::Mat result;
    values.convertTo(result, cv::DataType<T>::type);
    return result;
}

template <class T>
cv::Mat integrated(const Slopes& slopes, const Pitch& pitch, SlopeKind kind)
{
    const SlopeDifferences<T> differences(slopes.x.size(), pitch, kind);
    return differences.surfaceOf(differences.sources({as<T>(slopes.x), as<T>(slopes.y)}));
}

/// Rises between neighbours; those that a gap touches count less.
template <class T>
WeightedRises risesAroundGaps(Slopes whole, const cv::Mat& known, const Pitch& pitch, SlopeKind kind)
{
    const SlopeDifferences<T> differences(known.size(), pitch, kind);
    Slopes weights = differences.weights(known, weightOfGaps), pulls = differences.between(whole);
    whole = {};
    const double unit =
        std::pow(std::min(pitch.x, pitch.y), 2);  // so that weights in double pixels cannot leave single precision
    for (const auto& [pull, weight, step] : {std::tuple{&pulls.x, &weights.x, pitch.x}, {&pulls.y, &weights.y, pitch.y}}) {
        cv::multiply(*pull, *weight, *pull, unit);
        *weight *= unit / (step * step);
    }
    return {{as<float>(weights.x), as<float>(weights.y)}, differences.transposed(pulls)};
}

/// Continued slopes as a surface of least squares.
template <class T>
cv::Mat surfaceAroundGaps(const Slopes& slopes, const Slopes& known, const cv::Mat& both, const Pitch& pitch, SlopeKind kind)
{
    const WeightedRises rises =
        risesAroundGaps<T>({continued(as<T>(slopes.x), known.x), continued(as<T>(slopes.y), known.y)}, both, pitch, kind);
    cv::Mat height = surfaceOfWeightedRises(rises, both.total() > largeMap ? quick : thorough);
    height -= cv::mean(height)[0];
    return height;
}

template <class T>
double curlShare(const Slopes& slopes, const cv::Mat& heightMm, const Pitch& pitch, SlopeKind kind)
{
    const SlopeDifferences<T> differences(slopes.x.size(), pitch, kind);
    const Slopes found = differences.of(as<T>(heightMm));
    Slopes given = differences.between({as<T>(slopes.x), as<T>(slopes.y)});
    double all = 0, unexplained = 0;
    for (const auto& [fitted, measured] : {std::pair{&found.x, &given.x}, {&found.y, &given.y}}) {
        const cv::Mat finite = *measured - *measured == 0;  // A difference with itself is 0 unless the value is not finite.
        all += std::pow(cv::norm(*measured, cv::NORM_L2, finite), 2);
        unexplained += std::pow(cv::norm(*measured, *fitted, cv::NORM_L2, finite), 2);
    }
    return all > 0 ? std::sqrt(unexplained / all) : 0;
}

cv::Mat finite(const cv::Mat& values)
{
    return values - values == 0;  // The difference of a value with itself is 0 unless the value is not finite.
}

}  // namespace

SlopeKind slopeKindNamed(std::string_view name)
{
    for (const auto& [known, kind] :
         {std::pair{"point", SlopeKind::Point}, {"central", SlopeKind::Central}, {"forward", SlopeKind::Forward}})
        if (name == known) return kind;
    throw protocols::badInput({.what = "unknown kind of slopes '" + std::string(name) + "'",
                               .where = "",
                               .expected = "point, central or forward",
                               .nextStep = "correct the option"});
}

cv::Mat integrate(const Slopes& slopes, const Pitch& pitch, SlopeKind kind, IntegrationQuality quality)
{
    requireShape(slopes, pitch);
    cv::Mat height =
        quality == IntegrationQuality::Full ? integrated<double>(slopes, pitch, kind) : integrated<float>(slopes, pitch, kind);
    // The transform spreads a value that is not finite over the whole surface, so one pixel reveals it.
    const bool finite = height.depth() == CV_64F ? std::isfinite(height.at<double>(0, 0)) : std::isfinite(height.at<float>(0, 0));
    if (!finite || height.total() == 1) requireWhole(slopes);
    return height;
}

cv::Mat measuredPlaces(const Slopes& slopes) { return finite(slopes.x) & finite(slopes.y); }

cv::Mat integrateAround(const Slopes& slopes, const cv::Mat& measured, const Pitch& pitch, SlopeKind kind)
{
    requireShape(slopes, pitch);
    cv::Mat knownX = finite(slopes.x), knownY = finite(slopes.y);
    if (!measured.empty()) {
        knownX &= measured != 0;
        knownY &= measured != 0;
    }
    const cv::Mat known = knownX & knownY;
    const int missing = static_cast<int>(known.total()) - cv::countNonZero(known);
    if (missing == static_cast<int>(known.total()))
        throw protocols::badInput({.what = "no slope is measured",
                                   .where = "",
                                   .expected = "finite numbers",
                                   .nextStep = "check the mask and the files of slopes"});
    if (kind == SlopeKind::Central && missing > 0)
        return joinedLattices({continued(as<double>(slopes.x), knownX), continued(as<double>(slopes.y), knownY)}, knownX, knownY,
                              pitch);
    Slopes used{known, known};
    if (kind == SlopeKind::Forward) {  // The last slope of a row or column means nothing, and no gap continues it.
        used = {known.clone(), known.clone()};
        used.x.col(known.cols - 1) = 0;
        used.y.row(known.rows - 1) = 0;
    }
    // A profile can have all its rises, so their weights do not matter.
    const bool profile = known.rows == 1 || known.cols == 1;
    if (profile || missing < fewGaps * static_cast<double>(known.total()))
        return integrated<double>({continued(slopes.x, used.x), continued(slopes.y, used.y)}, pitch, kind);
    return std::max(pitch.x / pitch.y, pitch.y / pitch.x) > mostStretchedSingle
               ? surfaceAroundGaps<double>(slopes, used, known, pitch, kind)
               : surfaceAroundGaps<float>(slopes, used, known, pitch, kind);
}

double curlResidual(const Slopes& slopes, const cv::Mat& heightMm, const Pitch& pitch, SlopeKind kind)
{
    requireShape(slopes, pitch);
    const double largest =
        std::max(cv::norm(slopes.x, cv::NORM_INF, finite(slopes.x)), cv::norm(slopes.y, cv::NORM_INF, finite(slopes.y)));
    // Their squares would leave the range of numbers, and the share does not depend on the unit.
    constexpr double mostSquared = 1e15, leastSquared = 1e-15;
    if (largest > mostSquared || (largest > 0 && largest < leastSquared)) {
        const double unit = std::ldexp(1, -std::clamp(std::ilogb(largest), -1000, 1000));
        return curlShare<double>({as<double>(slopes.x) * unit, as<double>(slopes.y) * unit}, as<double>(heightMm) * unit, pitch,
                                 kind);
    }
    return slopes.x.total() > largeMap ? curlShare<float>(slopes, heightMm, pitch, kind)
                                       : curlShare<double>(slopes, heightMm, pitch, kind);
}

cv::Mat withoutLowFrequency(const cv::Mat& heightMm, const Pitch& pitch, double cutoffMm)
{
    const cv::Mat shares = highPassShares(heightMm.size(), pitch, cutoffMm);
    cv::Mat spectrum = cosineTransform(as<double>(heightMm));
    cv::multiply(spectrum, shares, spectrum);
    cv::Mat result;
    inverseCosineTransform(spectrum).convertTo(result, heightMm.depth());
    return result;
}

cv::Mat withoutTilt(const cv::Mat& heightMm, const cv::Mat& places)
{
    const cv::Mat height = as<double>(heightMm);
    cv::Matx33d normal = cv::Matx33d::zeros();
    cv::Vec3d right;
    int count = 0;
    const auto terms = [&](int i, int j) {  // Relative to the middle, so that the terms are nearly orthogonal.
        return cv::Vec3d((2.0 * j - height.cols + 1) / height.cols, (2.0 * i - height.rows + 1) / height.rows, 1);
    };
    for (int i = 0; i < height.rows; ++i)
        for (int j = 0; j < height.cols; ++j) {
            if (!places.empty() && !places.at<uchar>(i, j)) continue;
            const auto t = terms(i, j);
            normal += t * t.t();
            right += height.at<double>(i, j) * t;
            ++count;
        }
    if (count < 3)
        throw protocols::badInput({.what = "there are too few places to level the surface",
                                   .where = "",
                                   .expected = "at least three pixels outside the contact",
                                   .nextStep = "use a frame with an untouched border"});
    cv::Vec3d plane;
    cv::solve(normal, right, plane, cv::DECOMP_SVD);  // A single row or column leaves one slope undetermined.
    cv::Mat result(height.size(), CV_64FC1);
    for (int i = 0; i < height.rows; ++i)
        for (int j = 0; j < height.cols; ++j) result.at<double>(i, j) = height.at<double>(i, j) - plane.dot(terms(i, j));
    result.convertTo(result, heightMm.depth());
    return result;
}

}  // namespace rendering::signals
