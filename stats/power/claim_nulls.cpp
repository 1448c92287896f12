#include "stats/power/claim_nulls.h"

#include <algorithm>
#include <cmath>

#include "stats/claims/claims.h"
#include "stats/power/logistic_share.h"
#include "stats/tests/rank_tests.h"

namespace stats {
namespace {

constexpr double bound = 0.5;

Value least(const std::vector<ContrastClaim>& claims)
{
    Value smallest = Value::undefined("no contrast can be tested");
    for (const ContrastClaim& claim : claims)
        if (claim.pAdjusted.exists() && (!smallest.exists() || *claim.pAdjusted < *smallest)) smallest = claim.pAdjusted;
    return smallest;
}

CalibrationRow row(const char* test) { return {test, {}, Promise::Printed, {}, Value::undefined("not an exact test")}; }

/// A test that the report marks as not made for this null.
CalibrationRow shown(const char* test) { return {test, {}, Promise::Shown, {}, Value::undefined("not an exact test")}; }

Value pOfParticipantMeans(const AnswerCube& cube, std::span<const ContrastPair> pairs)
{
    return contrastClaims(cube, pairs.first(1), {}, Generalisation::TheseFabrics).front().difference.p;
}

Value pOfCochran(const AnswerCube& cube)
{
    BlockTable blocks{cube.participants() * cube.fabrics(), cube.conditions(), {}};
    for (std::size_t p = 0; p < cube.participants(); ++p)
        for (std::size_t f = 0; f < cube.fabrics(); ++f)
            for (std::size_t c = 0; c < cube.conditions(); ++c) blocks.values.push_back(cube.at(c, p, f));
    return cochranTest(blocks).p;
}

CalibrationFamily ratingFamily(const CalibrationOptions& options, const ClaimNull& null)
{
    CalibrationFamily family;
    family.truth = null.text();
    family.tests = {row("contrast, these fabrics"),
                    row("any contrast of all pairs, these fabrics"),
                    row(contrastOfFabricsLikeThese),
                    row(anyContrastOfFabricsLikeThese),
                    row("equivalence at a bound, fabrics like these"),
                    shown(participantMeansOfSampledFabrics)};
    family.analysis = [design = options.design, scale = options.ratings, null](Draws& draws, std::span<Value> p) {
        const auto rating = [&](const DrawnCell& cell) {
            const double raw = scale.centre + cell.effects + draws.normal(claimResidualSd);
            return std::clamp(std::round(raw / scale.scaleStep) * scale.scaleStep, scale.scaleMin, scale.scaleMax);
        };
        const std::vector<ContrastPair> pairs = allPairs(design.conditions);
        for (const Generalisation truth : {Generalisation::TheseFabrics, Generalisation::FabricsLikeThese}) {
            AnswerCube cube = drawnStudy(design, null, truth, draws, rating);
            const auto claims = contrastClaims(cube, pairs, {}, truth);
            const std::size_t at = truth == Generalisation::TheseFabrics ? 0 : 2;
            p[at] = claims.front().difference.p;
            p[at + 1] = least(claims);
            if (at == 0) continue;
            p[5] = pOfParticipantMeans(cube, pairs);
            for (std::size_t k = 0; k < design.participants * design.fabrics; ++k)
                cube.at(0, k / design.fabrics, k % design.fabrics) += bound;
            p[4] = contrastClaims(cube, std::span(pairs).first(1), Bounds{-bound, bound}, truth).front().equivalence.p;
        }
    };
    return family;
}

CalibrationFamily choiceFamily(const CalibrationOptions& options, const ClaimNull& null)
{
    CalibrationFamily family;
    family.truth = null.text();
    family.tests = {row(contrastOfFabricsLikeThese),
                    row(anyContrastOfFabricsLikeThese),
                    row("one condition above chance, fabrics like these"),
                    row("any condition above chance, fabrics like these"),
                    shown(participantMeansOfSampledFabrics),
                    shown(cochranOfSampledFabrics)};
    const StudyDesign& design = options.design;
    const double chance = 1.0 / design.alternatives;
    std::vector<double> atShare, atChance;
    for (std::size_t c = 0; c < design.conditions; ++c) {
        const double sd = std::hypot(null.participantsSd(c), null.fabricsSd(c));
        atShare.push_back(interceptFor(contrastShare, sd));
        atChance.push_back(interceptFor(chance, sd));
    }
    family.analysis = [=](Draws& draws, std::span<Value> p) {
        const auto truth = Generalisation::FabricsLikeThese;
        const auto draw = [&](const std::vector<double>& intercepts) {
            return drawnStudy(design, null, truth, draws, [&](const DrawnCell& cell) {
                return draws.happens(shareOfLogOdds(intercepts[cell.condition] + cell.effects)) ? 1.0 : 0.0;
            });
        };
        const AnswerCube answers = draw(atShare);
        const std::vector<ContrastPair> pairs = allPairs(design.conditions);
        const auto claims = contrastClaims(answers, pairs, {}, truth);
        p[4] = pOfParticipantMeans(answers, pairs);
        p[5] = pOfCochran(answers);
        p[0] = claims.front().difference.p;
        p[1] = least(claims);
        const AnswerCube guesses = draw(atChance);
        const auto above = chanceClaims(guesses, chance, truth);
        p[2] = above.front().above.p;
        p[3] = Value::undefined("no condition can be tested");
        for (const ChanceClaim& claim : above)
            if (claim.pAdjusted.exists() && (!p[3].exists() || *claim.pAdjusted < *p[3])) p[3] = claim.pAdjusted;
    };
    return family;
}

}  // namespace

std::vector<CalibrationFamily> claimFamilies(const CalibrationOptions& options)
{
    std::vector<CalibrationFamily> families;
    for (const ClaimNull& null : claimNulls())
        families.push_back(null.isChoice ? choiceFamily(options, null) : ratingFamily(options, null));
    return families;
}

}  // namespace stats
