#include "rendering/fabrics/drawn/weave_draft.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rendering::fabrics {

namespace {

using protocols::Random;

constexpr int longestAllowed = 12;
constexpr int neverBound = 100;  // Length of the float of a yarn that stays on one side.

template <class Rule>
Draft draftFrom(int warps, int wefts, Rule rule)
{
    Draft draft{warps, wefts, {}};
    for (int weft = 0; weft < wefts; ++weft)
        for (int warp = 0; warp < warps; ++warp) draft.ups.push_back(rule(warp, weft) ? 1 : 0);
    return draft;
}

int wholeBetween(Random& random, int low, int high) { return low + int(random.below(std::uint64_t(high - low + 1))); }

std::string numberWord(int number) { return std::to_string(number); }

/// Length of the run around `place` in a ring of `size` crossings, and how many of it lie before.
struct Run {
    int length, before;
};
template <class SideAt>
Run runAround(int size, int place, SideAt sideAt)
{
    const bool side = sideAt(place);
    int before = 0, after = 0;
    while (before < size && sideAt((place - before - 1 + 2 * size) % size) == side) ++before;
    while (after < size && sideAt((place + after + 1) % size) == side) ++after;
    if (before >= size) return {neverBound, place};
    return {before + after + 1, before};
}

double longestFloatOf(const Draft& draft)
{
    double longest = 1;
    for (const bool ofWarp : {true, false})
        for (const FloatPlace& place : floatPlaces(draft, ofWarp)) longest = std::max(longest, double(place.length));
    return longest;
}

NamedDraft drawPlainOrRib(Random& random)
{
    const int across = random.uniform() < 0.65 ? 1 : wholeBetween(random, 1, 3),
              along = random.uniform() < 0.65 ? 1 : wholeBetween(random, 1, 3);
    const Draft draft =
        draftFrom(2 * across, 2 * along, [=](int warp, int weft) { return (warp / across + weft / along) % 2 == 0; });
    if (across == 1 && along == 1) return {draft, "plain weave"};
    return {draft, (across == along ? "basket " : "rib ") + numberWord(across) + "×" + numberWord(along)};
}

/// Ups and downs of one repeat of a twill, such as 2/2 or 3/1/1/2.
std::vector<int> twillSteps(Random& random)
{
    static const std::vector<std::vector<int>> usual = {{2, 2}, {2, 1}, {1, 2}, {3, 1}, {1, 3}, {3, 3}, {2, 2}, {3, 2}, {4, 1}};
    if (random.uniform() < 0.75) return usual[random.below(usual.size())];
    return {wholeBetween(random, 1, 4), wholeBetween(random, 1, 3), wholeBetween(random, 1, 3), wholeBetween(random, 1, 3)};
}

std::string nameOfSteps(const std::vector<int>& steps)
{
    std::string name = numberWord(steps[0]);
    for (std::size_t i = 1; i < steps.size(); ++i) name += "/" + numberWord(steps[i]);
    return name;
}

std::vector<bool> sidesOf(const std::vector<int>& steps)
{
    std::vector<bool> sides;
    for (std::size_t i = 0; i < steps.size(); ++i) sides.insert(sides.end(), std::size_t(steps[i]), i % 2 == 0);
    return sides;
}

NamedDraft drawTwill(Random& random)
{
    const std::vector<int> steps = twillSteps(random);
    const std::vector<bool> sides = sidesOf(steps);
    const int repeat = int(sides.size());
    const bool left = random.uniform() < 0.5, steep = repeat % 2 == 1 && random.uniform() < 0.2;
    const int move = (steep ? 2 : 1) * (left ? repeat - 1 : 1);
    const Draft draft =
        draftFrom(repeat, repeat, [&](int warp, int weft) { return bool(sides[std::size_t((warp + move * weft) % repeat)]); });
    return {draft, (steep ? "steep twill " : "twill ") + nameOfSteps(steps)};
}

/// A twill that turns every `width` warps: herringbone with a break, or pointed without.
NamedDraft drawTurnedTwill(Random& random)
{
    const std::vector<int> steps = random.uniform() < 0.7
                                       ? std::vector<int>{2, 2}
                                       : std::vector<int>{wholeBetween(random, 1, 3), wholeBetween(random, 1, 3)};
    const std::vector<bool> sides = sidesOf(steps);
    const int repeat = int(sides.size()), width = wholeBetween(random, 4, 16), broken = random.uniform() < 0.7 ? repeat / 2 : 0;
    const bool alongWeft = random.uniform() < 0.25;
    const auto sideAt = [&](int turning, int other) {
        const int step = turning < width ? turning : 2 * width - 1 - turning + broken;
        return bool(sides[std::size_t((step + other) % repeat)]);
    };
    const Draft draft = alongWeft ? draftFrom(repeat, 2 * width, [&](int warp, int weft) { return sideAt(weft, warp); })
                                  : draftFrom(2 * width, repeat, [&](int warp, int weft) { return sideAt(warp, weft); });
    return {draft, (broken != 0 ? "herringbone " : "pointed twill ") + nameOfSteps(steps)};
}

NamedDraft drawSatin(Random& random)
{
    static constexpr int repeats[] = {5, 5, 5, 7, 8, 8, 10};
    const int repeat = repeats[random.below(std::size(repeats))];
    int move = 0;
    do move = wholeBetween(random, 2, repeat - 2);
    while (std::gcd(move, repeat) != 1);
    const bool weftFaced = random.uniform() < 0.35;
    const Draft draft =
        draftFrom(repeat, repeat, [=](int warp, int weft) { return (warp == (weft * move) % repeat) == weftFaced; });
    return {draft, (weftFaced ? "sateen " : "satin ") + numberWord(repeat), 1, true};
}

/// Short floats without a direction: a random draft of which long floats are broken.
Draft brokenUp(Draft draft, int longest, Random& random)
{
    for (int round = 0; round < 40; ++round) {
        bool changed = false;
        for (const bool ofWarp : {true, false}) {
            const std::vector<FloatPlace> places = floatPlaces(draft, ofWarp);
            for (std::size_t i = 0; i < places.size(); ++i)
                if (places[i].length > float(longest) && places[i].middle > 0.5f && random.uniform() < 0.5) {
                    draft.ups[i] ^= 1;
                    changed = true;
                }
        }
        if (!changed) break;
    }
    return draft;
}

NamedDraft drawCrepe(Random& random)
{
    const int warps = wholeBetween(random, 6, 16), wefts = wholeBetween(random, 6, 16);
    Draft draft = draftFrom(warps, wefts, [&](int warp, int weft) {
        return random.uniform() < 0.7 ? (warp + weft) % 2 == 0 : random.uniform() < 0.5;
    });
    return {brokenUp(std::move(draft), 3, random), "crepe"};
}

/// A small figure that is mirrored, as a dobby loom makes it.
NamedDraft drawDobby(Random& random)
{
    const int halfWarps = wholeBetween(random, 3, 8), halfWefts = wholeBetween(random, 3, 8);
    const Draft figure = draftFrom(halfWarps, halfWefts, [&](int, int) { return random.uniform() < 0.5; });
    const bool mirrored = random.uniform() < 0.7;
    const auto folded = [mirrored](int place, int half) {
        return place < half ? place : mirrored ? 2 * half - 1 - place : place - half;
    };
    Draft draft = draftFrom(2 * halfWarps, 2 * halfWefts, [&](int warp, int weft) {
        return figure.warpIsUp(folded(warp, halfWarps), folded(weft, halfWefts)) !=
               (!mirrored && (warp < halfWarps) != (weft < halfWefts));
    });
    return {brokenUp(std::move(draft), 5, random), "dobby " + numberWord(2 * halfWarps) + "×" + numberWord(2 * halfWefts)};
}

NamedDraft drawHoneycomb(Random& random)
{
    const int half = wholeBetween(random, 3, 6);
    const Draft draft = draftFrom(2 * half - 2, 2 * half - 2, [=](int warp, int weft) {
        const int across = warp < half ? warp : 2 * half - 2 - warp, along = weft < half ? weft : 2 * half - 2 - weft;
        return across + along == half - 1 || (across + along < half - 1 ? across == 0 && along == 0 : (across + along) != half);
    });
    return {draft, "honeycomb " + numberWord(2 * half - 2)};
}

/// Blocks of warp-faced and weft-faced satin or twill side by side.
NamedDraft drawDamask(Random& random)
{
    const int repeat = random.uniform() < 0.5 ? 5 : 4, blocks = wholeBetween(random, 2, 4),
              size = repeat * wholeBetween(random, 2, 3);
    const int move = repeat == 5 ? 2 : 1;
    const Draft figure = draftFrom(blocks, blocks, [&](int, int) { return random.uniform() < 0.5; });
    const Draft draft = draftFrom(blocks * size, blocks * size, [&](int warp, int weft) {
        return (warp % repeat == (weft * move) % repeat) == figure.warpIsUp(warp / size, weft / size);
    });
    return {draft, "damask of blocks of " + numberWord(size), 1, true};
}

}  // namespace

std::vector<FloatPlace> floatPlaces(const Draft& draft, bool ofWarp)
{
    std::vector<FloatPlace> places(draft.ups.size());
    for (int weft = 0; weft < draft.wefts; ++weft)
        for (int warp = 0; warp < draft.warps; ++warp) {
            const Run run = ofWarp ? runAround(draft.wefts, weft, [&](int k) { return draft.warpIsUp(warp, k); })
                                   : runAround(draft.warps, warp, [&](int k) { return draft.warpIsUp(k, weft); });
            const float along = (float(run.before) + 0.5f) / float(run.length) * 2 - 1;
            places[std::size_t(weft * draft.warps + warp)] = {float(run.length), run.length == 1 ? 0 : 1 - along * along};
        }
    return places;
}

NamedDraft drawDraft(Random& random)
{
    using Maker = NamedDraft (*)(Random&);
    // Twills and plain weaves are most of what is worn, so they are listed more often.
    static constexpr Maker makers[] = {drawPlainOrRib, drawPlainOrRib, drawPlainOrRib,  drawTwill,     drawTwill,
                                       drawTwill,      drawTwill,      drawTurnedTwill, drawSatin,     drawSatin,
                                       drawSatin,      drawCrepe,      drawDobby,       drawHoneycomb, drawDamask};
    for (;;) {
        NamedDraft drawn = makers[random.below(std::size(makers))](random);
        drawn.longestFloat = longestFloatOf(drawn.draft);
        if (drawn.longestFloat <= longestAllowed) return drawn;
    }
}

}  // namespace rendering::fabrics
