#include "study/bench/extremes/extreme_images.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "stats/metrics/image_metrics.h"

namespace study::bench {

namespace {

using Numbers = std::vector<double>;
using Cases = std::vector<ExtremeCase>;

constexpr std::size_t width = 24, height = 20;
const char* everyWindow = "every window in 50-digit arithmetic";

struct Pair {
    Numbers a, b;
    std::size_t across = width, down = height;
};

/// Whole 1024ths, which 32 bits hold exactly also at 10,000; b is 7/8 of a and 1/8 of another texture, rounded down.
Pair textures(double offset, double scale = 1)
{
    Pair pair;
    for (std::uint64_t i = 0; i < width * height; ++i) {
        const std::uint64_t a = ((i * 2654435761U + 12345U) & 0xFFFFFFFFU) >> 22U,
                            other = ((i * 3266489917U + 99U) & 0xFFFFFFFFU) >> 22U;
        pair.a.push_back(scale * (offset + static_cast<double>(a) / 1024));
        pair.b.push_back(scale * (offset + static_cast<double>((7 * a + other) >> 3U) / 1024));
    }
    return pair;
}

Pair flat(double a, double b, std::size_t side = 16) { return {Numbers(side * side, a), Numbers(side * side, b), side, side}; }

Pair firstWindow()
{
    const Pair whole = textures(0);
    Pair part{{}, {}, 11, 11};
    for (std::size_t y = 0; y < 11; ++y)
        for (std::size_t x = 0; x < 11; ++x) {
            part.a.push_back(whole.a[y * width + x]);
            part.b.push_back(whole.b[y * width + x]);
        }
    return part;
}

stats::Value ssimOf(const Pair& pair, double range)
{
    const auto found = stats::ssim(stats::ImageView{pair.a, pair.across, pair.down}, {pair.b, pair.across, pair.down}, range);
    return found.why.empty() ? found.mean : stats::Value::undefined(found.why);
}

stats::Value floatSsimOf(const Pair& pair, double range)
{
    const std::vector<float> a(pair.a.begin(), pair.a.end()), b(pair.b.begin(), pair.b.end());
    return stats::ssim(stats::FloatImageView{a, pair.across, pair.down}, {b, pair.across, pair.down}, range).mean;
}

ExtremeCase imageCase(const std::string& input, const Pair& pair, double range, const std::string& truth,
                      const std::string& source, double digits, bool single = false)
{
    const bool isAsked = range > 0;  // the others document no answer for a range of 0
    return {"SSIM",
            input,
            single ? "SSIM, 32 bits" : "SSIM",
            truth,
            source,
            digits,
            [=] { return answerOf(single ? floatSsimOf(pair, range) : ssimOf(pair, range)); },
            {!isAsked ? ""
             : single ? "ssim float"
                      : "ssim",
             {{static_cast<double>(pair.across), static_cast<double>(pair.down), range}, pair.a, pair.b}}};
}

}  // namespace

Cases extremeImages()
{
    const char* atOffset = "0.98250582192628715018";
    const char* plain = "0.98241869695011337261";
    Pair damaged = textures(0);
    damaged.a[7] = std::numeric_limits<double>::quiet_NaN();
    return {imageCase("textures on an offset of 1e4", textures(1e4), 1, atOffset, everyWindow, 5, true),
            imageCase("textures on an offset of 1e4", textures(1e4), 1, atOffset, everyWindow, 13),
            imageCase("textures on an offset of 1e8", textures(1e8), 1, "0.98250582192649999641", everyWindow, 13),
            imageCase("textures and range x 2^600", textures(0, 0x1p600), 0x1p600, plain, everyWindow, 13),
            imageCase("textures and range x 2^-600", textures(0, 0x1p-600), 0x1p-600, plain, everyWindow, 13),
            imageCase("11 x 11 pixels: one window", firstWindow(), 1, "0.98578884073563433684", everyWindow, 13),
            imageCase("flat 0 against flat 255", flat(0, 255), 255, "9.999000099990001e-5", "C1/(255^2 + C1)", 12),
            imageCase("an image against itself", {textures(0).a, textures(0).a}, 1, "1", "by definition", 16),
            imageCase("one pixel", flat(1, 1, 1), 1, "refused", "no window fits", 0),
            imageCase("10 x 10 pixels", flat(0.25, 0.5, 10), 1, "refused", "no window fits", 0),
            imageCase("a pixel that is not a number", damaged, 1, "refused", "no such number exists", 0),
            imageCase("a range of 0", textures(0), 0, "refused", "C1 and C2 would be 0", 0)};
}

}  // namespace study::bench
