#include "rendering/fabrics/drawn/drawn_fabric.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "rendering/fabrics/drawn/drawn_dye.h"
#include "rendering/fabrics/drawn/drawn_friction.h"

namespace rendering::fabrics {

namespace {

using protocols::Random;

/// What a fibre usually looks and feels like.
struct FibreHabit {
    double adhesion, sheenLow, sheenHigh, hairLow, hairHigh, uneven, twist;
};
/// In the order of Fibre.
constexpr FibreHabit fibreHabits[] = {
    {0.17, 0.02, 0.16, 0.10, 0.55, 0.07, 26}, {0.16, 0.05, 0.20, 0.05, 0.30, 0.14, 22}, {0.18, 0.03, 0.12, 0.40, 1.00, 0.20, 18},
    {0.19, 0.01, 0.08, 0.35, 1.00, 0.09, 24}, {0.14, 0.35, 0.90, 0.00, 0.06, 0.03, 6},  {0.14, 0.20, 0.70, 0.00, 0.12, 0.02, 8},
    {0.15, 0.12, 0.45, 0.03, 0.20, 0.04, 15}, {0.18, 0.06, 0.22, 0.30, 0.90, 0.07, 18},
};
const FibreHabit& habitOf(Fibre fibre) { return fibreHabits[std::size_t(fibre)]; }

double logUniform(Random& random, double low, double high) { return low * std::exp(random.uniform() * std::log(high / low)); }
bool chance(Random& random, double share) { return random.uniform() < share; }
/// Positive and skewed to the right, with a median of 1.
double spreadAround(Random& random, double deviation) { return std::exp(deviation * random.normal()); }

ClothKind drawKind(Random& random)
{
    using enum ClothKind;
    static constexpr ClothKind kinds[] = {Weave,     Weave, Weave,   Weave,   Weave,  Weave,    Weave,  Weave,
                                          Weave,     Weave, Weave,   Weave,   Jersey, Jersey,   Jersey, Rib,
                                          Interlock, Purl,  CutPile, CutPile, Terry,  Corduroy, Fleece, Fleece};
    return kinds[random.below(std::size(kinds))];
}

Fibre drawFibre(ClothKind kind, const NamedDraft& weave, Random& random)
{
    using enum Fibre;
    static constexpr Fibre ofWeaves[] = {Cotton, Cotton, Cotton, Linen, Jute, Wool, Silk, Polyester, Polyester, Viscose, Acrylic};
    static constexpr Fibre ofSatins[] = {Silk, Silk, Polyester, Polyester, Viscose, Cotton};
    static constexpr Fibre ofKnits[] = {Cotton, Cotton, Cotton, Wool, Acrylic, Polyester, Viscose};
    static constexpr Fibre ofPiles[] = {Cotton, Cotton, Polyester, Wool, Acrylic, Viscose};
    static constexpr Fibre ofFleece[] = {Polyester, Wool, Wool, Acrylic};
    switch (kind) {
        case ClothKind::Weave:
            return weave.isFine ? ofSatins[random.below(std::size(ofSatins))] : ofWeaves[random.below(std::size(ofWeaves))];
        case ClothKind::Jersey:
        case ClothKind::Rib:
        case ClothKind::Interlock:
        case ClothKind::Purl:
            return ofKnits[random.below(std::size(ofKnits))];
        case ClothKind::Fleece:
            return ofFleece[random.below(std::size(ofFleece))];
        case ClothKind::CutPile:
        case ClothKind::Terry:
        case ClothKind::Corduroy:
            return ofPiles[random.below(std::size(ofPiles))];
    }
    return Cotton;
}

DrawnYarns drawYarns(double spacingMm, double cover, Fibre fibre, Random& random)
{
    const FibreHabit& habit = habitOf(fibre);
    DrawnYarns yarns;
    yarns.spacingMm = std::clamp(spacingMm, 0.15, 3.0);
    yarns.diameterMm = yarns.spacingMm * cover;
    yarns.flatness = random.uniform(0.42, 0.85);
    yarns.twistDegrees = habit.twist * spreadAround(random, 0.3) * (chance(random, 0.3) ? -1 : 1);
    yarns.plies = chance(random, 0.3) ? 2 : chance(random, 0.1) ? 3 : 1;
    yarns.unevenness = habit.uneven * spreadAround(random, 0.5);
    yarns.displacement = 0.015 + habit.uneven * 0.6 * spreadAround(random, 0.6);
    if (chance(random, 0.15)) yarns.looseShare = random.uniform(0.002, 0.04);
    if (chance(random, 0.08)) yarns.missingShare = random.uniform(0.001, 0.012);
    return yarns;
}

void drawWoven(DrawnFabric& fabric, Random& random)
{
    const bool fine = fabric.weave.isFine || fabric.fibre == Fibre::Silk;
    const bool coarse = fabric.fibre == Fibre::Jute;
    const double spacing = coarse ? logUniform(random, 0.7, 3.0)
                           : fine ? logUniform(random, 0.15, 0.5)
                                  : logUniform(random, 0.17, 1.5);
    const bool open =
        coarse ? fabric.weave.longestFloat < 2.5 && chance(random, 0.8) : fabric.weave.longestFloat < 1.5 && chance(random, 0.25);
    const double cover = open ? random.uniform(0.4, 0.8) : random.uniform(0.85, 1.12);
    fabric.warp = drawYarns(spacing, cover, fabric.fibre, random);
    const double ratio = chance(random, 0.5) ? spreadAround(random, 0.08) : spreadAround(random, 0.32);
    fabric.weft = drawYarns(spacing * std::clamp(ratio, 0.5, 2.0), std::min(1.15, cover * spreadAround(random, 0.07)),
                            fabric.fibre, random);
    fabric.warp.spread = fabric.weave.longestFloat > 1.5 ? random.uniform(0.0, 0.35) : random.uniform(0.0, 0.12);
    fabric.weft.spread = fabric.weave.longestFloat > 1.5 ? random.uniform(0.0, 0.35) : random.uniform(0.0, 0.12);
    // A system that shows most lies over the other, which hardly bends.
    const auto& ups = fabric.weave.draft.ups;
    const double shown = double(std::count(ups.begin(), ups.end(), 1)) / double(ups.size());
    if (fabric.weave.isFine) (shown > 0.5 ? fabric.warp : fabric.weft).spread += random.uniform(0.05, 0.3);
    fabric.crimpShare = std::clamp(0.5 + 0.55 * (shown - 0.5) + 0.15 * random.normal(), 0.12, 0.88);
    fabric.looseness = random.uniform(0.45, 1.05);
    const double napped = fabric.hairiness > 0.3 && chance(random, 0.3) ? 1 : 0;
    if (napped > 0) {
        fabric.pile.heightMm = random.uniform(0.05, 0.35);
        fabric.pile.widthMm = logUniform(random, 0.04, 0.12);
        fabric.pile.lengthMm = logUniform(random, 0.6, 3.0);
        fabric.pile.spacingMm = logUniform(random, 0.25, 0.9);
        fabric.pile.order = random.uniform(0.1, 0.8);
    }
}

void drawKnitted(DrawnFabric& fabric, Random& random)
{
    const bool fine = fabric.kind == ClothKind::Interlock || chance(random, 0.5);
    const double wale = fine ? logUniform(random, 0.35, 1.0) : logUniform(random, 0.8, 3.0);
    const double course = std::clamp(wale * random.uniform(0.6, 0.95), 0.15, 3.0);
    fabric.warp = drawYarns(wale, random.uniform(0.34, 0.50), fabric.fibre, random);
    fabric.weft = fabric.warp;
    fabric.weft.spacingMm = course;
    fabric.warp.flatness = fabric.weft.flatness = random.uniform(0.6, 0.95);
    fabric.looseness = random.uniform(0.6, 1.1);
    fabric.pile.ribPeriodMm = double(1 + random.below(3)) * wale;  // Wales of one side of a rib.
    fabric.pile.ribShare = random.uniform(0.3, 1.1);               // Depth of a rib in yarn diameters.
}

void drawPiled(DrawnFabric& fabric, Random& random)
{
    DrawnPile& pile = fabric.pile;
    const double ground = logUniform(random, 0.3, 0.7);
    fabric.warp = drawYarns(ground, 0.9, fabric.fibre, random);
    fabric.weft = drawYarns(ground, 0.9, fabric.fibre, random);
    switch (fabric.kind) {
        case ClothKind::CutPile:
            pile.spacingMm = logUniform(random, 0.15, 0.6);
            pile.heightMm = random.uniform(0.25, 0.9) * pile.spacingMm;
            pile.widthMm = pile.spacingMm * random.uniform(1.0, 1.7);
            pile.lengthMm = pile.spacingMm * random.uniform(0.8, 3.0);
            pile.order = random.uniform(0.5, 1.0);
            break;
        case ClothKind::Terry:
            pile.spacingMm = logUniform(random, 0.8, 2.4);
            pile.widthMm = pile.spacingMm * random.uniform(0.22, 0.4);
            pile.heightMm = pile.spacingMm * random.uniform(0.5, 1.4);
            pile.lengthMm = pile.spacingMm * random.uniform(0.7, 1.6);
            pile.order = random.uniform(0.0, 0.6);
            break;
        case ClothKind::Corduroy:
            pile.ribPeriodMm = logUniform(random, 0.8, 4.5);
            pile.ribShare = random.uniform(0.62, 0.95);
            pile.heightMm = pile.ribPeriodMm * random.uniform(0.12, 0.38);
            pile.spacingMm = logUniform(random, 0.25, 0.7);
            pile.widthMm = pile.spacingMm * random.uniform(0.9, 1.5);
            pile.lengthMm = pile.ribPeriodMm;
            break;
        default: {
            const bool curly = chance(random, 0.35), felt = !curly && chance(random, 0.35);
            pile.widthMm = curly  ? logUniform(random, 0.7, 2.5)
                           : felt ? logUniform(random, 0.05, 0.15)
                                  : logUniform(random, 0.12, 0.45);
            pile.lengthMm = pile.widthMm * (curly ? random.uniform(1.5, 3.5) : random.uniform(6, 18));
            pile.heightMm = pile.widthMm * (curly  ? random.uniform(0.35, 0.9)
                                            : felt ? random.uniform(0.8, 2.0)
                                                   : random.uniform(0.8, 3.0));
            pile.spacingMm = curly ? pile.widthMm * random.uniform(0.55, 0.85)
                                   : std::sqrt(pile.widthMm * pile.lengthMm) * random.uniform(0.4, 0.6);
            pile.order = felt ? random.uniform(0, 0.3) : random.uniform(0.2, 0.85);
        }
    }
    fabric.hairiness = std::max(fabric.hairiness, 0.3);
}

Slack drawSlack(const DrawnFabric& fabric, Random& random)
{
    Slack slack;
    const double thread = std::min(fabric.warp.spacingMm, fabric.weft.spacingMm);
    slack.waveMm = chance(random, 0.7) ? logUniform(random, 0.01, 0.4) : 0;
    slack.waveLengthMm = logUniform(random, 8, 60);
    slack.creaseMm = chance(random, 0.15) ? logUniform(random, 0.02, 0.25) : 0;
    slack.creaseLengthMm = logUniform(random, 10, 50);
    slack.wanderMm = thread * logUniform(random, 0.05, 0.7);
    slack.wanderLengthMm = thread * logUniform(random, 8, 40);
    slack.skewDegrees = 2.5 * random.normal();
    if (chance(random, 0.1)) slack.skewDegrees *= 3;
    return slack;
}

std::string fixedText(double value, int digits)
{
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.*f", digits, value);
    return buffer;
}

/// The plain weave under a pile.
NamedDraft plainGround()
{
    NamedDraft ground;
    ground.draft.warps = ground.draft.wefts = 2;
    ground.draft.ups.assign(4, 0);
    ground.draft.ups[0] = ground.draft.ups[3] = 1;
    ground.name = "plain weave";
    return ground;
}

}  // namespace

DrawnFabric drawFabric(std::uint64_t seed, std::uint64_t index)
{
    Random random = Random::stream(seed, "drawn/" + std::to_string(index));
    DrawnFabric fabric;
    fabric.seed = random.next();
    fabric.kind = drawKind(random);
    fabric.weave = fabric.kind == ClothKind::Weave ? drawDraft(random) : plainGround();
    fabric.fibre = drawFibre(fabric.kind, fabric.weave, random);
    const FibreHabit& habit = habitOf(fabric.fibre);
    fabric.hairiness = random.uniform(habit.hairLow, habit.hairHigh);
    fabric.sheen = random.uniform(habit.sheenLow, habit.sheenHigh);
    fabric.pile.napDegrees = random.uniform(0, 360);
    switch (fabric.kind) {
        case ClothKind::Weave:
            drawWoven(fabric, random);
            break;
        case ClothKind::Jersey:
        case ClothKind::Rib:
        case ClothKind::Interlock:
        case ClothKind::Purl:
            drawKnitted(fabric, random);
            break;
        case ClothKind::CutPile:
        case ClothKind::Terry:
        case ClothKind::Corduroy:
        case ClothKind::Fleece:
            drawPiled(fabric, random);
            break;
    }
    fabric.slack = drawSlack(fabric, random);
    fabric.dye = drawDye(fabric.kind, random);
    fabric.adhesion = habit.adhesion;
    fabric.unseen = std::exp(unseenFrictionSpread * std::clamp(random.normal(), -2.5, 2.5));
    return fabric;
}

std::string nameOf(ClothKind kind)
{
    static constexpr const char* names[] = {"weave",    "jersey", "rib",      "interlock", "purl",
                                            "cut pile", "terry",  "corduroy", "fleece"};
    return names[std::size_t(kind)];
}

std::string inWords(const DrawnFabric& fabric)
{
    const bool woven = fabric.kind == ClothKind::Weave;
    std::string words = woven ? fabric.weave.name : nameOf(fabric.kind);
    const ThreadPeriod period = threadPeriod(fabric);
    if (woven)
        words += ", " + fixedText(fabric.warp.spacingMm, 2) + " × " + fixedText(fabric.weft.spacingMm, 2) + " mm";
    else
        words += ", " + fixedText(period.mm, 2) + " mm";
    words += ", " + nameOf(fabric.fibre);
    if (woven && fabric.pile.heightMm > 0) words += ", napped";
    if (woven && std::max(fabric.warp.diameterMm / fabric.warp.spacingMm, fabric.weft.diameterMm / fabric.weft.spacingMm) < 0.8)
        words += ", open";
    return words;
}

ThreadPeriod threadPeriod(const DrawnFabric& fabric)
{
    switch (fabric.kind) {
        case ClothKind::Weave: {
            const auto& ups = fabric.weave.draft.ups;
            const double shown = double(std::count(ups.begin(), ups.end(), 1)) / double(ups.size());
            const bool warp = shown * fabric.warp.diameterMm / fabric.warp.spacingMm >=
                              (1 - shown) * fabric.weft.diameterMm / fabric.weft.spacingMm;
            return warp ? ThreadPeriod{fabric.warp.spacingMm, 0}
                        : ThreadPeriod{fabric.weft.spacingMm, 90 + fabric.slack.skewDegrees};
        }
        case ClothKind::Jersey:
        case ClothKind::Rib:
        case ClothKind::Interlock:
        case ClothKind::Purl:
            return {fabric.weft.spacingMm, 90 + fabric.slack.skewDegrees};
        case ClothKind::Corduroy:
            return {fabric.pile.ribPeriodMm, 0};
        case ClothKind::Terry:
        case ClothKind::CutPile:
            return {fabric.pile.spacingMm, 0};
        case ClothKind::Fleece:
            return {2.5 * fabric.pile.widthMm, fabric.pile.napDegrees + 90};
    }
    return {};
}

}  // namespace rendering::fabrics
