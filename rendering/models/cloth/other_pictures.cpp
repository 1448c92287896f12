#include "rendering/models/cloth/other_pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "protocols/random.h"
#include "rendering/fabrics/drawn/jpeg_loss.h"

namespace rendering::models {

namespace {

using protocols::Random;

bool happens(Random& random, double share) { return random.uniform() < share; }

cv::Scalar colour(Random& random, double low = 0, double high = 255)
{
    return {random.uniform(low, high), random.uniform(low, high), random.uniform(low, high)};
}

/// Fractal noise in 0 to 1, CV_32FC1: sum of octaves whose amplitude falls with the exponent `steepness`.
cv::Mat fractal(int side, double steepness, Random& random)
{
    cv::Mat sum = cv::Mat::zeros(side, side, CV_32F), octave;
    for (int cells = 3; cells <= side; cells *= 2) {
        cv::Mat grid(cells + 3, cells + 3, CV_32F);
        for (float& value : cv::Mat_<float>(grid)) value = float(random.normal());
        cv::resize(grid, octave, {side, side}, 0, 0, cv::INTER_CUBIC);
        sum += octave * std::pow(3.0 / cells, steepness);
    }
    cv::normalize(sum, sum, 0, 1, cv::NORM_MINMAX);
    return sum;
}

cv::Mat inThree(const cv::Mat& plane)
{
    cv::Mat result;
    cv::merge(std::vector<cv::Mat>{plane, plane, plane}, result);
    return result;
}

/// A leaf at a place: ellipse or polygon, 0 to 255.
cv::Mat leafMask(int side, cv::Point2d centre, double radius, Random& random)
{
    cv::Mat mask = cv::Mat::zeros(side, side, CV_8U);
    if (happens(random, 0.35)) {
        const cv::Size axes(int(radius) + 1, std::max(1, int(radius * random.uniform(0.2, 1))));
        cv::ellipse(mask, cv::Point(centre), axes, random.uniform(0, 180), 0, 360, 255, -1, cv::LINE_AA);
    } else {
        std::vector<double> angles(std::size_t(3 + random.below(6)));
        for (double& angle : angles) angle = random.uniform(0, 2 * std::numbers::pi);
        std::sort(angles.begin(), angles.end());
        std::vector<cv::Point> corners;
        for (const double angle : angles) {
            const double reach = radius * random.uniform(0.5, 1.2);
            corners.emplace_back(int(centre.x + reach * std::cos(angle)), int(centre.y + reach * std::sin(angle)));
        }
        cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{corners}, 255, cv::LINE_AA);
    }
    if (happens(random, 0.4)) cv::GaussianBlur(mask, mask, {}, random.uniform(0.5, 0.3 * radius + 0.6));
    return mask;
}

/// Leaf upon leaf. Their number falls with the cube of their size, as things in a scene do.
cv::Mat leaves(int side, Random& random)
{
    cv::Mat picture(side, side, CV_32FC3, colour(random));
    std::vector<cv::Scalar> palette(std::size_t(3 + random.below(6)));
    for (cv::Scalar& one : palette) one = colour(random);
    const int count = int(std::exp(random.uniform(std::log(6.0), std::log(400.0))));
    const double least = random.uniform(2, 20), most = random.uniform(60, 0.6 * side);
    for (int i = 0; i < count; ++i) {
        const double share = random.uniform();
        const double radius = 1 / std::sqrt(1 / (least * least) + share * (1 / (most * most) - 1 / (least * least)));
        const cv::Point2d centre(random.uniform(-0.1, 1.1) * side, random.uniform(-0.1, 1.1) * side);
        cv::Mat cover;
        leafMask(side, centre, radius, random).convertTo(cover, CV_32F, 1.0 / 255);
        const double angle = random.uniform(0, 2 * std::numbers::pi), shade = 0.3 * random.normal() / std::max(radius, 8.0);
        cv::Mat light(side, side, CV_32F);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                light.at<float>(y, x) = float(
                    std::clamp(1 + shade * ((x - centre.x) * std::cos(angle) + (y - centre.y) * std::sin(angle)), 0.2, 1.8));
        if (happens(random, 0.15))
            light = light.mul(1 + random.uniform(0, 0.25) * (fractal(side, random.uniform(-0.5, 0.5), random) - 0.5));
        const cv::Scalar paint = palette[random.below(palette.size())] + cv::Scalar::all(25 * random.normal());
        const cv::Mat leaf = inThree(light).mul(cv::Mat(side, side, CV_32FC3, paint)), three = inThree(cover);
        picture = picture.mul(cv::Scalar::all(1) - three) + leaf.mul(three);
    }
    return picture;
}

cv::Mat landscape(int side, Random& random)
{
    const cv::Scalar top = colour(random, 80, 255), bottom = colour(random, 80, 255);
    cv::Mat picture(side, side, CV_32FC3);
    for (int y = 0; y < side; ++y) picture.row(y).setTo(top + (bottom - top) * (double(y) / side));
    if (happens(random, 0.7))
        picture += inThree((fractal(side, random.uniform(0.1, 0.8), random) - 0.5) * random.uniform(20, 160));
    double horizon = random.uniform(0.3, 0.8);
    const auto ridges = 1 + random.below(4);
    for (std::uint64_t k = 0; k < ridges; ++k) {
        const cv::Mat line = fractal(side, random.uniform(0.3, 0.8), random).row(side / 2).clone();
        const cv::Mat ground = inThree(1 + random.uniform(0.1, 1.2) * (fractal(side, random.uniform(-0.4, 0.5), random) - 0.5))
                                   .mul(cv::Mat(side, side, CV_32FC3, colour(random, 10, 200)));
        for (int x = 0; x < side; ++x) {
            const int from = std::clamp(int(side * (horizon + 0.25 * (double(line.at<float>(x)) - 0.5))), 0, side - 1);
            ground(cv::Rect(x, from, 1, side - from)).copyTo(picture(cv::Rect(x, from, 1, side - from)));
        }
        horizon = std::min(0.95, horizon + random.uniform(0.05, 0.2));
    }
    return picture;
}

cv::Mat printedText(int side, Random& random)
{
    const double paper = happens(random, 0.75) ? random.uniform(150, 255) : random.uniform(0, 60);
    const cv::Scalar ink = cv::Scalar::all(paper > 128 ? random.uniform(0, 90) : random.uniform(160, 255));
    cv::Mat page(side, side, CV_8UC3, cv::Scalar::all(paper));
    const double size = random.uniform(0.35, 2.2), margin = random.uniform(0, 0.2) * side;
    const double right = happens(random, 0.8) ? side - margin * random.uniform(0.5, 1.5) : side * random.uniform(0.3, 0.9);
    const double last = side * random.uniform(0.8, 1.05);
    for (double y = random.uniform(10, 60); y < last;
         y += size * random.uniform(28, 44) + (happens(random, 0.12) ? 60 * size : 0))
        for (double x = margin; x < right;) {
            std::string word(std::size_t(1 + random.below(9)), 'a');
            for (char& letter : word) letter = char('a' + random.below(26));
            cv::putText(page, word, cv::Point(int(x), int(y)), int(random.below(8)), size, ink,
                        std::max(1, int(size * random.uniform(0.7, 2))), cv::LINE_AA);
            x += 20 * size * (double(word.size()) + 0.7);
        }
    page.convertTo(page, CV_32F);
    return page;
}

cv::Mat plainColour(int side, Random& random)
{
    static constexpr double extremes[] = {0, 2, 5, 250, 255};
    cv::Mat picture(side, side, CV_32FC3, happens(random, 0.33) ? cv::Scalar::all(extremes[random.below(5)]) : colour(random));
    if (happens(random, 0.5)) return picture;
    const cv::Scalar rise = colour(random, -150, 150);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double place = (x * std::cos(angle) + y * std::sin(angle)) / side;
            picture.at<cv::Vec3f>(y, x) += cv::Vec3f(float(rise[0] * place), float(rise[1] * place), float(rise[2] * place));
        }
    return picture;
}

cv::Mat clouds(int side, Random& random)
{
    const cv::Mat shade = fractal(side, random.uniform(0.7, 1.3), random);
    return inThree(shade).mul(cv::Mat(side, side, CV_32FC3, colour(random, 60, 255)));
}

cv::Mat lineDrawing(int side, Random& random)
{
    static constexpr double papers[] = {255, 250, 240, 20};
    cv::Mat page(side, side, CV_8UC3, cv::Scalar::all(papers[random.below(4)]));
    const auto place = [&] { return cv::Point(int(random.below(std::uint64_t(side))), int(random.below(std::uint64_t(side)))); };
    const auto count = 4 + random.below(56);
    for (std::uint64_t i = 0; i < count; ++i) {
        const cv::Scalar ink = happens(random, 0.5) ? colour(random) : cv::Scalar::all(random.uniform(0, 120));
        const int width = 1 + int(random.below(4));
        const cv::Point from = place(), to = place();
        switch (random.below(4)) {
            case 0:
                cv::line(page, from, to, ink, width, cv::LINE_AA);
                break;
            case 1:
                cv::rectangle(page, from, to, ink, happens(random, 0.7) ? width : -1);
                break;
            case 2:
                cv::circle(page, from, 3 + int(random.below(std::uint64_t(side / 4))), ink, happens(random, 0.7) ? width : -1,
                           cv::LINE_AA);
                break;
            default:
                cv::putText(page, std::to_string(random.below(10000)), from, 0, random.uniform(0.4, 1.2), ink, 1, cv::LINE_AA);
        }
    }
    page.convertTo(page, CV_32F);
    return page;
}

/// What a camera and its file do to any picture.
cv::Mat photographed(cv::Mat picture, Random& random)
{
    if (happens(random, 0.3)) {
        cv::Mat grey;
        cv::cvtColor(picture, grey, cv::COLOR_RGB2GRAY);
        picture = inThree(grey);
    }
    if (happens(random, 0.5)) cv::GaussianBlur(picture, picture, {}, random.uniform(0.4, 2.5));
    if (happens(random, 0.6)) {
        const double noise = random.uniform(0, 6);
        for (cv::Vec3f& pixel : cv::Mat_<cv::Vec3f>(picture))
            for (int c = 0; c < 3; ++c) pixel[c] += float(noise * random.normal());
    }
    cv::Mat rgb;
    picture.convertTo(rgb, CV_8U);
    return happens(random, 0.6) ? fabrics::afterJpeg(rgb, 50 + int(random.below(47))) : rgb;
}

}  // namespace

cv::Mat drawOtherPicture(std::uint64_t seed, std::uint64_t index)
{
    Random random = Random::stream(seed, "other picture/" + std::to_string(index));
    static constexpr int sides[] = {192, 256, 384, 512};
    const int side = sides[random.below(4)];
    const double kind = random.uniform();
    if (kind < 0.42) return photographed(leaves(side, random), random);
    if (kind < 0.64) return photographed(landscape(side, random), random);
    if (kind < 0.78) return photographed(printedText(side, random), random);
    if (kind < 0.86) return photographed(plainColour(side, random), random);
    if (kind < 0.89) return photographed(clouds(side, random), random);
    return photographed(lineDrawing(side, random), random);
}

}  // namespace rendering::models
