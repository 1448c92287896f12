#include "stats/claims/claims.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "stats/claims/two_condition_model.h"
#include "stats/tests/multiplicity.h"

namespace stats {
namespace {

bool rejects(const Value& p) { return p.exists() && *p < claimAlpha; }

Verdict verdictOf(const ContrastClaim& claim)
{
    const bool isDifferent = rejects(claim.pAdjusted), isEquivalent = rejects(claim.pEquivalenceAdjusted);
    if (isDifferent) return isEquivalent ? Verdict::DifferentWithinBounds : Verdict::Different;
    return isEquivalent ? Verdict::Equivalent : Verdict::NotDecided;
}

/// An interval of a share ends at 0 and 1.
Interval withinUnit(const Interval& interval)
{
    if (!interval.low.exists()) return interval;
    return {std::max(0.0, *interval.low), std::min(1.0, *interval.high)};
}

MeanTest untestedMean(const std::string& why)
{
    const Value none = Value::undefined(why);
    return {none, none, none};
}

MeanTest withoutBounds() { return untestedMean("no equivalence bounds apply to this question"); }

}  // namespace

std::string_view nameOf(Verdict verdict)
{
    switch (verdict) {
        case Verdict::Different:
            return "different";
        case Verdict::Equivalent:
            return "equivalent";
        case Verdict::DifferentWithinBounds:
            return "different_within_bounds";
        case Verdict::NotDecided:
            break;
    }
    return "not_decided";
}

CrossedMean differenceOf(const AnswerCube& answers, const ContrastPair& contrast, Generalisation generalisation, Degrees degrees,
                         StudentQuantiles& quantiles)
{
    const auto& [a, b] = contrast;
    if (answers.kind() == AnswerValues::Choices)
        return crossedMean(answers.differences(a, b), generalisation, quantiles, degrees);
    if (answers.comparesOtherMeans(a, b))
        return crossedMean(evenDifferences(answers.comparable(a, b), answers.comparable(b, a)), generalisation, quantiles,
                           degrees);
    return differenceOfRatings(answers.comparable(a, b), answers.comparable(b, a), generalisation, degrees, quantiles);
}

std::vector<ContrastClaim> contrastClaims(const AnswerCube& answers, std::span<const ContrastPair> contrasts,
                                          const std::optional<Bounds>& bounds, Generalisation generalisation)
{
    std::vector<ContrastClaim> claims;
    claims.reserve(contrasts.size());
    std::vector<Value> differences, equivalences;
    StudentQuantiles quantiles;
    const Degrees degrees = degreesOf(answers);
    for (const ContrastPair& contrast : contrasts) {
        const CrossedMean mean = differenceOf(answers, contrast, generalisation, degrees, quantiles);
        ContrastClaim claim{contrast.first, contrast.second, mean, {}, {}, {}, {}, {}};
        claim.difference = testOfMean(claim.mean, 0, Tail::TwoSided);
        claim.equivalence = bounds ? equivalenceOfMean(claim.mean, bounds->first, bounds->second) : withoutBounds();
        differences.push_back(claim.difference.p);
        equivalences.push_back(claim.equivalence.p);
        claims.push_back(std::move(claim));
    }
    const std::vector<Value> adjustedDifferences = adjusted(differences, Adjustment::Holm);
    const std::vector<Value> adjustedEquivalences = adjusted(equivalences, Adjustment::Holm);
    for (std::size_t i = 0; i < claims.size(); ++i) {
        claims[i].pAdjusted = adjustedDifferences[i];
        claims[i].pEquivalenceAdjusted = adjustedEquivalences[i];
        claims[i].verdict = verdictOf(claims[i]);
    }
    return claims;
}

std::vector<ChanceClaim> chanceClaims(const AnswerCube& answers, double chance, Generalisation generalisation,
                                      std::span<const std::string> untested)
{
    std::vector<ChanceClaim> claims;
    std::vector<Value> p;
    StudentQuantiles quantiles;
    for (std::size_t c = 0; c < answers.conditions(); ++c) {
        ChanceClaim claim{crossedMean(answers.tableUnder(c), generalisation, quantiles), {}, {}, false};
        claim.above = testOfMean(claim.mean, chance, Tail::Greater);
        if (c < untested.size() && !untested[c].empty()) claim.above = untestedMean(untested[c]);
        claim.mean.ci90 = withinUnit(claim.mean.ci90);
        claim.mean.ci95 = withinUnit(claim.mean.ci95);
        p.push_back(claim.above.p);
        claims.push_back(std::move(claim));
    }
    const std::vector<Value> holm = adjusted(p, Adjustment::Holm);
    for (std::size_t c = 0; c < claims.size(); ++c) {
        claims[c].pAdjusted = holm[c];
        claims[c].isAbove = rejects(holm[c]);
    }
    return claims;
}

}  // namespace stats
