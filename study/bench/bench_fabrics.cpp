#include "study/bench/bench_fabrics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "rendering/fabrics/drawn/drawn_friction.h"
#include "rendering/fabrics/drawn/drawn_patch.h"
#include "stats/kernels/threads.h"
#include "study/bench/median_time.h"

namespace study::bench {

namespace {

constexpr int patches = 64;

/// Mean time of one new patch of `pixels` squared, drawn by `threads` threads.
BenchRow patchRow(int pixels, unsigned threads)
{
    const double milliseconds = medianMilliseconds(3, [&] {
        stats::onThreads(patches, threads, [&](std::size_t i) { rendering::fabrics::drawPatch(1, i, {pixels, 0.3}); });
    });
    char note[80];
    std::snprintf(note, sizeof note, "%.0f patches a second; every one another construction", 1000 * patches / milliseconds);
    const std::string side = std::to_string(pixels);
    return {"training patch of drawn fabric " + side + "x" + side,
            threads == 1 ? "1 thread" : std::to_string(threads) + " threads",
            milliseconds / patches,
            {},
            "",
            note};
}

constexpr std::size_t rubbedFabrics = 1000;
constexpr std::uint64_t rubbedFamily = 4711;  ///< Neither training nor validation draws from it.

struct RubbedFabric {
    double friction = 0;  ///< measured: with the unseen spread of the law
    rendering::fabrics::FrictionTerms terms;
};

/// The constant that, added to what is known, gives the least mean relative error: a weighted median.
double bestConstant(const std::vector<double>& known, const std::vector<RubbedFabric>& fabrics)
{
    std::vector<std::size_t> order(fabrics.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto rest = [&](std::size_t i) { return fabrics[i].friction - known[i]; };
    std::ranges::sort(order, {}, rest);
    double half = 0, sum = 0;
    for (const RubbedFabric& fabric : fabrics) half += 0.5 / fabric.friction;
    for (const std::size_t i : order)
        if ((sum += 1 / fabrics[i].friction) >= half) return rest(i);
    return 0;
}

/// Mean relative error of the mean friction of somebody who knows the terms `fibre` and `relief` or not, and guesses the rest by
/// the best constant.
BenchRow frictionRow(const std::string& known, bool fibre, bool relief, const std::vector<RubbedFabric>& fabrics)
{
    std::vector<double> guesses;
    for (const RubbedFabric& fabric : fabrics)
        guesses.push_back((fibre ? fabric.terms.fibre : 0) + (relief ? fabric.terms.relief : 0));
    const double constant = fibre && relief ? 0 : bestConstant(guesses, fabrics);
    double error = 0;
    for (std::size_t i = 0; i < fabrics.size(); ++i)
        error += std::abs((guesses[i] + constant) / fabrics[i].friction - 1) / double(fabrics.size());
    return {"mean friction of drawn fabrics",
            known,
            {},
            100 * error,
            "%",
            std::to_string(fabrics.size()) + (fibre && relief ? " fabrics; what is left is the finish, which no photograph shows"
                                                              : " fabrics; the best constant stands for the unknown")};
}

std::vector<RubbedFabric> rubbed()
{
    std::vector<RubbedFabric> fabrics(rubbedFabrics);
    stats::onThreads(fabrics.size(), 2, [&](std::size_t i) {
        const rendering::fabrics::DrawnFabric fabric = rendering::fabrics::drawFabric(rubbedFamily, i);
        const rendering::fabrics::FrictionTerms terms = rendering::fabrics::visibleFriction(fabric);
        fabrics[i] = {terms.sum() * fabric.unseen, terms};
    });
    return fabrics;
}

}  // namespace

std::vector<BenchRow> benchFabrics()
{
    const std::vector<RubbedFabric> fabrics = rubbed();
    return {patchRow(128, 1),
            patchRow(128, 2),
            frictionRow("all known", true, true, fabrics),
            frictionRow("relief unknown", true, false, fabrics),
            frictionRow("fibre unknown", false, true, fabrics),
            frictionRow("both unknown", false, false, fabrics)};
}

}  // namespace study::bench
