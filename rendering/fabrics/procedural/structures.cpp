#include "rendering/fabrics/procedural/structures.h"

namespace rendering::fabrics {

namespace {

/// Builds a draft; `rule(warp, weft)` returns whether the warp is up.
template <class Rule>
Draft draftOf(int warps, int wefts, Rule rule)
{
    Draft draft{warps, wefts, {}};
    for (int weft = 0; weft < wefts; ++weft)
        for (int warp = 0; warp < warps; ++warp) draft.ups.push_back(rule(warp, weft) ? 1 : 0);
    return draft;
}

Draft plain()
{
    return draftOf(2, 2, [](int warp, int weft) { return (warp + weft) % 2 == 0; });
}

Draft basket(int size)
{
    return draftOf(2 * size, 2 * size, [size](int warp, int weft) { return (warp / size + weft / size) % 2 == 0; });
}

/// Each warp is up over `up` wefts and down under `down`, one warp further to the right at each weft.
Draft twill(int up, int down)
{
    const int repeat = up + down;
    return draftOf(repeat, repeat, [=](int warp, int weft) { return (warp + weft) % repeat < up; });
}

/// 2/2 twill whose direction turns every `width` warps, with the break of a true herringbone.
Draft herringbone(int width)
{
    return draftOf(2 * width, 4, [=](int warp, int weft) {
        const int step = warp < width ? warp : 2 * width - 1 - warp + 2;
        return (step + weft) % 4 < 2;
    });
}

/// Warp-faced satin: each weft rises over one warp in `repeat`, `move` warps further each time.
Draft satin(int repeat, int move)
{
    return draftOf(repeat, repeat, [=](int warp, int weft) { return warp != (weft * move) % repeat; });
}

/// Honeycomb: diamonds of warp floats and of weft floats side by side, with plain weave between them.
Draft honeycomb()
{
    return draftOf(8, 8, [](int warp, int weft) {
        const int across = warp < 4 ? warp : 7 - warp;
        const int along = weft < 4 ? weft : 7 - weft;
        if (across + along == 3) return true;
        return across + along > 3 ? true : (warp + weft) % 7 == 0;
    });
}

/// Irregular crepe of short floats without a visible direction.
Draft crepe()
{
    static constexpr const char* rows[] = {"10110100", "01001011", "11010010", "00101101",
                                           "10011010", "01100101", "01011001", "10100110"};
    return draftOf(8, 8, [](int warp, int weft) { return rows[weft][warp] == '1'; });
}

// Each fabric takes two lines: name, structure; construction, draft; warp and weft as spacing, diameter,
// flatness, twist, unevenness; crimp share, displacement, leno, cells, pile; hairiness, sheen, fibre
// friction, colour.
// clang-format off
std::vector<Structure> makeTable()
{
    using enum Construction;
    return {
        {"Plain cotton", "plain weave", Woven, plain(), {.46, .40, .62, 28, .08}, {.50, .42, .60, 28, .09},
         .5, .030, 0, {}, 0, .30, .05, .20, {.92, .91, .87}},
        {"Poplin", "plain weave, fine, weft rib", Woven, plain(), {.25, .25, .60, 22, .04}, {.42, .36, .75, 22, .05},
         .8, .012, 0, {}, 0, .12, .08, .17, {.93, .94, .95}},
        {"Serge", "twill 2/2", Woven, twill(2, 2), {.40, .44, .75, 32, .06}, {.46, .42, .60, 32, .06},
         .62, .020, 0, {}, 0, .45, .04, .29, {.90, .88, .82}},
        {"Drill", "twill 3/1", Woven, twill(3, 1), {.38, .42, .75, 35, .06}, {.56, .44, .65, 30, .08},
         .55, .020, 0, {}, 0, .20, .06, .23, {.91, .90, .88}},
        {"Sateen", "satin 5", Woven, satin(5, 2), {.28, .31, .55, 18, .04}, {.34, .30, .60, 18, .05},
         .45, .012, 0, {}, 0, .08, .28, .15, {.94, .93, .91}},
        {"Silk satin", "satin 8", Woven, satin(8, 3), {.25, .29, .45, 6, .02}, {.30, .26, .50, 6, .03},
         .35, .008, 0, {}, 0, .02, .45, .12, {.95, .93, .90}},
        {"Panama", "basket 2x2", Woven, basket(2), {.50, .50, .60, 25, .07}, {.50, .50, .60, 25, .07},
         .5, .022, 0, {}, 0, .25, .05, .22, {.90, .89, .85}},
        {"Gauze", "leno, open", Woven, plain(), {.80, .26, .75, 30, .12}, {.95, .30, .75, 30, .12},
         .5, .070, .16, {}, 0, .40, .03, .24, {.94, .94, .92}},
        {"Jersey", "single jersey knit", Jersey, {}, {.95, .34, .85, 20, .05}, {.70, .34, .85, 20, .05},
         .5, .030, 0, {}, 0, .35, .04, .25, {.92, .92, .93}},
        {"Rib knit", "rib 2x2 knit", Rib, {}, {.85, .42, .80, 22, .06}, {.80, .42, .80, 22, .06},
         .5, .035, 0, {.30, 3.4, true}, 0, .45, .03, .36, {.89, .88, .84}},
        {"Corduroy", "cut weft pile, ribs", Corduroy, plain(), {.40, .36, .60, 25, .06}, {.40, .36, .60, 25, .06},
         .5, .030, 0, {0, 2.1, true}, .75, .80, .02, .43, {.88, .86, .80}},
        {"Canvas", "plain weave, heavy", Woven, plain(), {.82, .74, .66, 30, .12}, {.90, .76, .66, 30, .14},
         .55, .050, 0, {}, 0, .35, .03, .26, {.88, .86, .79}},
        {"Herringbone", "twill 2/2, turned", Woven, herringbone(6), {.46, .50, .75, 30, .07}, {.56, .48, .58, 30, .07},
         .66, .022, 0, {}, 0, .60, .03, .32, {.89, .88, .86}},
        {"Crepe", "crepe, high twist", Woven, crepe(), {.34, .31, .75, 48, .10}, {.36, .32, .75, 48, .12},
         .5, .060, 0, {.16, 1.1, false}, 0, .15, .06, .21, {.93, .92, .90}},
        {"Waffle", "honeycomb weave", Woven, honeycomb(), {.42, .40, .70, 25, .08}, {.42, .40, .70, 25, .08},
         .5, .035, 0, {.62, 3.36, true}, 0, .40, .03, .27, {.94, .93, .89}},
    };
}
// clang-format on

}  // namespace

std::span<const Structure> allStructures()
{
    static const std::vector<Structure> table = makeTable();
    return table;
}

}  // namespace rendering::fabrics
