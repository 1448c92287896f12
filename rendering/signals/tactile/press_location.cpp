// locate() alternates between fitting the model of the light and refining the circles (a bundle adjustment).
#include "rendering/signals/tactile/press_location.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "protocols/files/errors.h"
#include "rendering/signals/tactile/frame_light.h"
#include "rendering/signals/tactile/upper_median.h"

namespace rendering::signals {

namespace {

constexpr int degree = 3;
constexpr int rounds = 4;
constexpr double windowRadii = 1.65;  ///< in ball radii; the model is fitted within this distance of the centre
constexpr int mostWindowPixels = 1500;
constexpr double ringPx = 0.5;            ///< distance between the rings of a profile
constexpr double equalDepthPx = 0.75;     ///< smaller differences of the radii are noise; the presses have one depth
constexpr double gelDiffersAbove = 0.08;  ///< median change of light far from the ball; the gel itself causes about 0.02

/// Model terms of a pixel: all monomials p^i q^j, 1 <= i + j <= degree, each times 1, u and v.
constexpr int slopeTerms = 9;
constexpr int terms = 3 * slopeTerms;
using LightTerms = cv::Vec<double, terms>;

LightTerms termsOf(double p, double q, double u, double v)
{
    const double ps[] = {1, p, p * p, p * p * p}, qs[] = {1, q, q * q, q * q * q};
    LightTerms all;
    int k = 0;
    for (int total = 1; total <= degree; ++total)
        for (int i = 0; i <= total; ++i) {
            const double product = ps[i] * qs[total - i];
            all[k++] = product;
            all[k++] = product * u;
            all[k++] = product * v;
        }
    return all;
}

/// Slope of the gel at a place relative to the centre of the ball, in px; it rises towards the centre.
cv::Point2d gelSlope(cv::Point2d from, double ballPx, double contactPx, double bridgePx)
{
    const double r = std::max(1e-9, std::hypot(from.x, from.y)), inside = std::min(r, contactPx);
    double steep = inside / std::sqrt(std::max(1e-6, ballPx * ballPx - inside * inside));
    if (r > contactPx) steep *= std::exp(-(r - contactPx) / bridgePx);
    return {-from.x / r * steep, -from.y / r * steep};
}

/// Evenly thinned pixels around a place.
struct Window {
    std::vector<cv::Point> pixels;
};

Window windowAround(cv::Point2d centre, double radius, cv::Size size, int step)
{
    Window window;
    for (int y = std::max(0, static_cast<int>(centre.y - radius));
         y < std::min<int>(size.height, static_cast<int>(centre.y + radius) + 1); y += step)
        for (int x = std::max(0, static_cast<int>(centre.x - radius));
             x < std::min<int>(size.width, static_cast<int>(centre.x + radius) + 1); x += step)
            if (std::hypot(x - centre.x, y - centre.y) < radius) window.pixels.emplace_back(x, y);
    return window;
}

class PressLocator {
public:
    explicit PressLocator(const BallPresses& presses)
        : m_size(presses.background.size()), m_ballPx(presses.ballRadiusMm / presses.mmPerPixel)
    {
        for (const auto& press : presses.presses) {
            cv::Mat light;
            lightOf(press.frame, presses.background, LightMeasure::AgainstReference).convertTo(light, CV_64F);
            m_light.push_back(light);
        }
        m_channels = presses.background.channels();
    }

    double ballPx() const { return m_ballPx; }
    std::size_t count() const { return m_light.size(); }
    const cv::Mat& light(std::size_t press) const { return m_light[press]; }

    /// Circle at the place where the light, smoothed over half the ball's radius, changes most.
    ContactCircle firstGuess(std::size_t press) const
    {
        cv::Mat squares = m_light[press].mul(m_light[press]), strength;
        cv::reduce(squares.reshape(1, static_cast<int>(squares.total())), strength, 1, cv::REDUCE_SUM);
        strength = strength.reshape(1, m_size.height);
        cv::GaussianBlur(strength, strength, {}, m_ballPx / 2);
        cv::Point place;
        cv::minMaxLoc(strength, nullptr, nullptr, nullptr, &place);
        return {cv::Point2d(place), 0, 0};
    }

    PressModel fit(const std::vector<ContactCircle>& circles, double contactPx, double bridgePx, double& residual) const
    {
        cv::Mat normal = cv::Mat::zeros(terms, terms, CV_64FC1), right = cv::Mat::zeros(terms, m_channels, CV_64FC1);
        double squares = 0, samples = 0;
        for (std::size_t i = 0; i < count(); ++i)
            for (const auto& pixel : windowOf(circles[i]).pixels) {
                const LightTerms row = termsAt(circles[i], pixel, contactPx, bridgePx);
                addOuter(normal, row);
                const double* value = m_light[i].ptr<double>(pixel.y) + static_cast<std::ptrdiff_t>(pixel.x) * m_channels;
                for (int k = 0; k < terms; ++k)
                    for (int c = 0; c < m_channels; ++c) right.at<double>(k, c) += row[k] * value[c];
                for (int c = 0; c < m_channels; ++c) squares += value[c] * value[c];
                samples += 1;
            }
        cv::completeSymm(normal);
        normal += 1e-6 * samples * cv::Mat::eye(terms, terms, CV_64FC1);
        PressModel model{{}, contactPx, bridgePx};
        cv::solve(normal, right, model.coefficients, cv::DECOMP_CHOLESKY);
        residual = squares - model.coefficients.dot(right);  // Residual of least squares, apart from the ridge.
        return model;
    }

    /// Model with the contact radius and bridge that explain the light best.
    PressModel bestFit(const std::vector<ContactCircle>& circles) const
    {
        PressModel best;
        double least = 0;
        for (const double contact : {0.5, 0.6, 0.7, 0.77, 0.84, 0.91})
            for (const double bridge : {0.15, 0.35, 0.6}) {
                double residual = 0;
                auto model = fit(circles, contact * m_ballPx, bridge * m_ballPx, residual);
                if (best.coefficients.empty() || residual < least) {
                    least = residual;
                    best = model;
                }
            }
        return best;
    }

    /// Refines the centre of one press by Gauss-Newton.
    ContactCircle refined(std::size_t press, ContactCircle circle, const PressModel& model) const
    {
        for (int step = 0; step < 4; ++step) {
            const Window window = windowOf(circle);
            const cv::Mat now = residuals(press, circle, model, window);
            cv::Mat derivatives(now.rows, 2, CV_64FC1);
            constexpr double nudge = 0.05;
            for (int k = 0; k < 2; ++k)
                derivatives.col(k) = (residuals(press, moved(circle, k, nudge), model, window) - now) / nudge;
            cv::Mat normal = derivatives.t() * derivatives, change;
            normal += 1e-3 * cv::trace(normal)[0] * cv::Mat::eye(2, 2, CV_64FC1);
            if (!cv::solve(normal, derivatives.t() * now, change, cv::DECOMP_CHOLESKY)) break;
            for (int k = 0; k < 2; ++k) circle = moved(circle, k, -std::clamp(change.at<double>(k), -2.0, 2.0));
            circle.centrePx.x = std::clamp(circle.centrePx.x, 0.0, m_size.width - 1.0);
            circle.centrePx.y = std::clamp(circle.centrePx.y, 0.0, m_size.height - 1.0);
        }
        circle.explained = explained(press, circle, model);
        return circle;
    }

    /// Explained share with the common radius or with the press's own radius, whichever is larger; presses differ in depth.
    double explainedByOwn(std::size_t press, const ContactCircle& circle, PressModel model) const
    {
        model.contactPx = circle.radiusPx;
        return std::max(circle.explained, explained(press, circle, model));
    }

    /// Mean change of light on each ring around a press.
    std::vector<double> profile(std::size_t press, cv::Point2d centre) const
    {
        const int rings = static_cast<int>(windowRadii * m_ballPx / ringPx);
        std::vector<double> sum(static_cast<std::size_t>(rings)), count(sum);
        for (const auto& pixel : windowAround(centre, windowRadii * m_ballPx, m_size, 1).pixels) {
            const double ring = std::hypot(pixel.x - centre.x, pixel.y - centre.y) / ringPx;
            const auto near = static_cast<std::size_t>(ring);
            const double share = ring - std::floor(ring);
            for (const auto& [at, weight] : {std::pair{near, 1 - share}, {near + 1, share}})
                if (at < sum.size()) {
                    sum[at] += weight * strengthAt(press, pixel);
                    count[at] += weight;
                }
        }
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = count[i] > 0 ? sum[i] / count[i] : 0;
        return sum;
    }

private:
    Window windowOf(const ContactCircle& circle) const
    {
        const double radius = windowRadii * m_ballPx;
        return windowAround(circle.centrePx, radius, m_size,
                            std::max(1, static_cast<int>(std::sqrt(CV_PI * radius * radius / mostWindowPixels))));
    }

    LightTerms termsAt(const ContactCircle& circle, cv::Point pixel, double contactPx, double bridgePx) const
    {
        const auto slope = gelSlope(cv::Point2d(pixel) - circle.centrePx, m_ballPx, contactPx, bridgePx);
        return termsOf(slope.x, slope.y, 2.0 * pixel.x / m_size.width - 1, 2.0 * pixel.y / m_size.height - 1);
    }

    static void addOuter(cv::Mat& normal, const LightTerms& row)
    {
        for (int i = 0; i < terms; ++i) {
            double* target = normal.ptr<double>(i);
            for (int j = i; j < terms; ++j) target[j] += row[i] * row[j];
        }
    }

    static ContactCircle moved(ContactCircle circle, int axis, double by)
    {
        (axis == 0 ? circle.centrePx.x : circle.centrePx.y) += by;
        return circle;
    }

    double strengthAt(std::size_t press, cv::Point pixel) const
    {
        const double* value = m_light[press].ptr<double>(pixel.y) + static_cast<std::ptrdiff_t>(pixel.x) * m_channels;
        return std::sqrt(std::inner_product(value, value + m_channels, value, 0.0));
    }

    cv::Mat residuals(std::size_t press, const ContactCircle& circle, const PressModel& model, const Window& window) const
    {
        cv::Mat result(static_cast<int>(window.pixels.size()) * m_channels, 1, CV_64FC1);
        int next = 0;
        for (const auto& pixel : window.pixels) {
            const LightTerms row = termsAt(circle, pixel, model.contactPx, model.bridgePx);
            const double* value = m_light[press].ptr<double>(pixel.y) + static_cast<std::ptrdiff_t>(pixel.x) * m_channels;
            for (int c = 0; c < m_channels; ++c) {
                double sum = -value[c];
                for (int k = 0; k < terms; ++k) sum += row[k] * model.coefficients.at<double>(k, c);
                result.at<double>(next++) = sum;
            }
        }
        return result;
    }

    double explained(std::size_t press, const ContactCircle& circle, const PressModel& model) const
    {
        const Window window = windowOf(circle);
        const cv::Mat off = residuals(press, circle, model, window);
        double all = 0;
        for (const auto& pixel : window.pixels) {
            const double* value = m_light[press].ptr<double>(pixel.y) + static_cast<std::ptrdiff_t>(pixel.x) * m_channels;
            for (int c = 0; c < m_channels; ++c) all += value[c] * value[c];
        }
        return all > 0 ? 1 - off.dot(off) / all : 0;
    }

    cv::Size m_size;
    double m_ballPx;
    int m_channels = 3;
    std::vector<cv::Mat> m_light;  ///< CV_64FC(n)
};

protocols::Error fault(const std::string& what, const std::string& expected, const std::string& nextStep)
{
    return protocols::badInput({.what = what, .where = "", .expected = expected, .nextStep = nextStep});
}

void requireUsable(const BallPresses& presses)
{
    if (!(presses.ballRadiusMm > 0 && std::isfinite(presses.ballRadiusMm)) ||
        !(presses.mmPerPixel > 0 && std::isfinite(presses.mmPerPixel)))
        throw fault("the radius of the ball or the pitch is not a positive length", "mm and mm per pixel above 0",
                    "check --ball-radius and --mm-per-pixel");
    if (presses.background.empty() || presses.background.channels() != 3)
        throw fault("the presses have no colour frame of the untouched sensor", "background.png among the presses",
                    "save a frame before touching the sensor");
    const double ballPx = presses.ballRadiusMm / presses.mmPerPixel;
    const int shorter = std::min(presses.background.cols, presses.background.rows);
    if (ballPx < 4 || ballPx > shorter)
        throw fault("a ball with a radius of " + std::to_string(ballPx) + " pixels cannot be measured in frames of " +
                        std::to_string(shorter) + " pixels",
                    "a radius of at least 4 pixels that fits into the frame", "check --ball-radius and --mm-per-pixel");
}

double medianChange(const cv::Mat& frame, const cv::Mat& background, cv::Point2d centre, double ballPx)
{
    std::vector<float> changes;
    const cv::Mat light = lightOf(frame, background, LightMeasure::AgainstReference);
    for (int y = 0; y < light.rows; y += 2)
        for (int x = 0; x < light.cols; x += 2) {
            if (std::hypot(x - centre.x, y - centre.y) < 2 * ballPx) continue;
            const auto& value = light.at<cv::Vec3f>(y, x);
            changes.push_back((std::abs(value[0]) + std::abs(value[1]) + std::abs(value[2])) / 3);
        }
    if (changes.empty()) return 0;
    const auto middle = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
    std::nth_element(changes.begin(), middle, changes.end());
    return *middle;
}

/// Far from the ball a press equals the background. Throws badInput where it does not: the background shows another sensor.
void requireOwnBackground(const BallPresses& presses, const PressLocator& locator)
{
    cv::Mat swapped;
    cv::cvtColor(presses.background, swapped, cv::COLOR_RGB2BGR);
    for (std::size_t i = 0; i < presses.presses.size(); ++i) {
        const auto& press = presses.presses[i];
        const auto centre = locator.firstGuess(i).centrePx;
        const double change = medianChange(press.frame, presses.background, centre, locator.ballPx());
        if (change > 0.03 && medianChange(press.frame, swapped, centre, locator.ballPx()) < 0.5 * change)
            throw fault(press.name + " and the background have red and blue swapped", "one order of channels in all frames",
                        "save all frames as RGB");
        if (change > gelDiffersAbove)
            throw fault("far from the ball " + press.name + " differs from the background by " +
                            std::to_string(std::lround(100 * change)) + " % of full scale",
                        "a background of the same sensor under the same light",
                        "record the background again, just before the presses");
    }
}

void requireBalls(const BallPresses& presses, const std::vector<ContactCircle>& circles)
{
    std::string unseen;
    for (std::size_t i = 0; i < circles.size(); ++i)
        if (!(circles[i].explained >= leastExplained)) unseen += (unseen.empty() ? "" : ", ") + presses.presses[i].name;
    if (!unseen.empty())
        throw fault("no ball was found in " + unseen, "presses of the ball with the given radius",
                    "remove these frames, or press again");
}

/// Radius in px at which a profile is highest, interpolated between its rings. This is the edge of contact, where the gel
/// is steepest.
double peakOf(const std::vector<double>& profile, double ballPx)
{
    std::vector<double> smooth(profile.size());
    for (std::size_t i = 2; i + 2 < profile.size(); ++i)
        smooth[i] = (profile[i - 2] + 2 * profile[i - 1] + 3 * profile[i] + 2 * profile[i + 1] + profile[i + 2]) / 9;
    const auto last = std::min(smooth.size(), static_cast<std::size_t>(0.98 * ballPx / ringPx));
    const auto from = static_cast<std::size_t>(0.2 * ballPx / ringPx);
    const auto best = static_cast<std::size_t>(
        std::max_element(smooth.begin() + static_cast<std::ptrdiff_t>(from), smooth.begin() + static_cast<std::ptrdiff_t>(last)) -
        smooth.begin());
    const double before = smooth[best - 1], here = smooth[best], after = smooth[best + 1], bend = before - 2 * here + after;
    const double between = bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
    return std::min((static_cast<double>(best) + between) * ringPx, 0.98 * ballPx);
}

/// Sets the radius of each press and returns the common radius. Presses of equal depth get the common one: `knownUsual`, or
/// the one of all presses together.
double setRadii(const PressLocator& locator, const PressModel& model, std::vector<ContactCircle>& circles,
                std::optional<double> knownUsual = {})
{
    std::vector<double> together, own;
    for (std::size_t i = 0; i < circles.size(); ++i) {
        const auto profile = locator.profile(i, circles[i].centrePx);
        own.push_back(peakOf(profile, locator.ballPx()));
        together.resize(profile.size());
        std::transform(profile.begin(), profile.end(), together.begin(), together.begin(), std::plus<>());
    }
    const double usual = knownUsual.value_or(peakOf(together, locator.ballPx()));
    std::vector<double> deviations(own.size());
    std::transform(own.begin(), own.end(), deviations.begin(), [usual](double radius) { return std::abs(radius - usual); });
    const bool equal = 1.4826 * upperMedian(deviations) < equalDepthPx;
    for (std::size_t i = 0; i < circles.size(); ++i) {
        circles[i].radiusPx = equal ? usual : own[i];
        circles[i].explained = locator.explainedByOwn(i, circles[i], model);
    }
    return usual;
}

}  // namespace

LocatedPresses locate(const BallPresses& presses)
{
    requireUsable(presses);
    if (presses.presses.size() < fewestPresses)
        throw fault("there are only " + std::to_string(presses.presses.size()) + " presses",
                    "at least " + std::to_string(fewestPresses) + ", better 30, spread over the sensor",
                    "press the ball at more places");
    const PressLocator locator(presses);
    requireOwnBackground(presses, locator);
    LocatedPresses found;
    for (std::size_t i = 0; i < locator.count(); ++i) found.circles.push_back(locator.firstGuess(i));
    for (int round = 0; round < rounds; ++round) {
        double residual = 0;
        found.model = round % 2 == 0 ? locator.bestFit(found.circles)
                                     : locator.fit(found.circles, found.model.contactPx, found.model.bridgePx, residual);
        for (std::size_t i = 0; i < locator.count(); ++i) found.circles[i] = locator.refined(i, found.circles[i], found.model);
    }
    found.contactPx = setRadii(locator, found.model, found.circles);
    requireBalls(presses, found.circles);
    return found;
}

std::vector<ContactCircle> locate(const BallPresses& presses, const LocatedPresses& known)
{
    requireUsable(presses);
    const PressLocator locator(presses);
    requireOwnBackground(presses, locator);
    std::vector<ContactCircle> circles;
    for (std::size_t i = 0; i < locator.count(); ++i) {
        ContactCircle circle = locator.firstGuess(i);
        for (int round = 0; round < 3; ++round) circle = locator.refined(i, circle, known.model);
        circles.push_back(circle);
    }
    setRadii(locator, known.model, circles, known.contactPx);
    requireBalls(presses, circles);
    return circles;
}

}  // namespace rendering::signals
