#include "stats/claims/claims.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "stats/tests/multiplicity.h"

namespace stats {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> numbered(std::size_t count)
{
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) names.push_back(std::to_string(i + 1));
    return names;
}

/// One row for each participant x fabric.
CrossedValues emptyTable(std::size_t participants, std::size_t fabrics)
{
    CrossedValues table{{"participant", numbered(participants), {}}, {"fabric", numbered(fabrics), {}}, {}};
    for (std::size_t p = 0; p < participants; ++p)
        for (std::size_t f = 0; f < fabrics; ++f) {
            table.participant.of.push_back(p);
            table.fabric.of.push_back(f);
        }
    return table;
}

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

MeanTest withoutBounds()
{
    const Value none = Value::undefined("no equivalence bounds apply to this question");
    return {none, none, none};
}

}  // namespace

AnswerCube::AnswerCube(std::size_t conditions, std::size_t participants, std::size_t fabrics)
    : m_conditions(conditions),
      m_participants(participants),
      m_fabrics(fabrics),
      m_values(conditions * participants * fabrics, missing)
{
}

double& AnswerCube::at(std::size_t condition, std::size_t participant, std::size_t fabric)
{
    assert(condition < m_conditions && participant < m_participants && fabric < m_fabrics);
    return m_values[(condition * m_participants + participant) * m_fabrics + fabric];
}

double AnswerCube::at(std::size_t condition, std::size_t participant, std::size_t fabric) const
{
    return m_values[(condition * m_participants + participant) * m_fabrics + fabric];
}

AnswerCube AnswerCube::withoutParticipant(std::size_t participant) const
{
    AnswerCube rest = *this;
    for (std::size_t c = 0; c < m_conditions; ++c)
        for (std::size_t f = 0; f < m_fabrics; ++f) rest.at(c, participant, f) = missing;
    return rest;
}

AnswerCube AnswerCube::withoutFabric(std::size_t fabric) const
{
    AnswerCube rest = *this;
    for (std::size_t c = 0; c < m_conditions; ++c)
        for (std::size_t p = 0; p < m_participants; ++p) rest.at(c, p, fabric) = missing;
    return rest;
}

CrossedValues AnswerCube::valuesUnder(std::size_t condition) const
{
    CrossedValues table = emptyTable(m_participants, m_fabrics);
    for (std::size_t p = 0; p < m_participants; ++p)
        for (std::size_t f = 0; f < m_fabrics; ++f) table.values.push_back(at(condition, p, f));
    return table;
}

CrossedTable AnswerCube::tableUnder(std::size_t condition) const
{
    const auto first = m_values.begin() + static_cast<std::ptrdiff_t>(condition * m_participants * m_fabrics);
    return {m_participants, m_fabrics, {first, first + static_cast<std::ptrdiff_t>(m_participants * m_fabrics)}};
}

CrossedTable AnswerCube::differences(std::size_t a, std::size_t b) const
{
    CrossedTable table = tableUnder(a);
    const double* const other = m_values.data() + b * table.values.size();
    for (std::size_t cell = 0; cell < table.values.size(); ++cell) table.values[cell] -= other[cell];
    return table;
}

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

std::vector<ContrastClaim> contrastClaims(const AnswerCube& answers, std::span<const ContrastPair> contrasts,
                                          const std::optional<Bounds>& bounds, Generalisation generalisation)
{
    std::vector<ContrastClaim> claims;
    claims.reserve(contrasts.size());
    std::vector<Value> differences, equivalences;
    StudentQuantiles quantiles;
    for (const auto& [a, b] : contrasts) {
        ContrastClaim claim{a, b, crossedMean(answers.differences(a, b), generalisation, quantiles), {}, {}, {}, {}, {}};
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

std::vector<ChanceClaim> chanceClaims(const AnswerCube& answers, double chance, Generalisation generalisation)
{
    std::vector<ChanceClaim> claims;
    std::vector<Value> p;
    StudentQuantiles quantiles;
    for (std::size_t c = 0; c < answers.conditions(); ++c) {
        ChanceClaim claim{crossedMean(answers.tableUnder(c), generalisation, quantiles), {}, {}, false};
        claim.above = testOfMean(claim.mean, chance, Tail::Greater);
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
