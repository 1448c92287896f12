#include "stats/anova/within_anova.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "stats/anova/anova_effects.h"
#include "stats/kernels/distributions.h"
#include "stats/kernels/exact_sum.h"
#include "stats/kernels/matrix.h"
#include "stats/kernels/moments.h"

namespace stats {
namespace {

/// Participants who have a value in every cell, with their group.
struct CompleteTable {
    std::size_t cells = 0;
    std::vector<double> values;  ///< row-major [participants x cells]
    std::vector<std::size_t> group;
    std::vector<double> groupSize;

    std::size_t participants() const { return group.size(); }
};

struct CellMean {
    double sum = 0;
    double count = 0;
};

/// Averages the repetitions; participants with an empty cell are left out. `cell` and `group` hold one number a row.
CompleteTable completeTable(std::span<const double> values, const Factor& participant, std::span<const std::size_t> cell,
                            std::size_t cells, std::span<const std::size_t> group)
{
    std::map<std::size_t, std::map<std::size_t, CellMean>> means;
    std::map<std::size_t, std::size_t> groupOf;
    for (std::size_t row = 0; row < values.size(); ++row) {
        if (std::isnan(values[row])) continue;
        CellMean& mean = means[participant.of[row]][cell[row]];
        mean.sum += values[row];
        ++mean.count;
        groupOf[participant.of[row]] = group[row];
    }
    CompleteTable table{cells, {}, {}, {}};
    std::map<std::size_t, std::size_t> newGroup;
    for (const auto& [who, ofCell] : means) {
        if (ofCell.size() < cells) continue;
        for (const auto& [place, mean] : ofCell) table.values.push_back(mean.sum / mean.count);
        const std::size_t number = newGroup.try_emplace(groupOf[who], newGroup.size()).first->second;
        table.group.push_back(number);
        if (number == table.groupSize.size()) table.groupSize.push_back(0);
        ++table.groupSize[number];
    }
    return table;
}

/// Deviations of participants in the space of one effect, orthogonal to all other effects.
struct EffectSpace {
    std::size_t columns = 0;
    double dimension = 0;        ///< degrees of freedom of the effect
    std::vector<double> values;  ///< row-major [participants x columns]
    Matrix projector;            ///< onto the space [columns x columns]; empty unless sphericity may be tested

    std::span<const double> row(std::size_t i) const { return std::span(values).subspan(i * columns, columns); }
};

double centring(std::size_t i, std::size_t j, std::size_t levels)
{
    return (i == j ? 1.0 : 0.0) - 1 / static_cast<double>(levels);
}

/// Means over the columns of one participant's cells [a x b].
struct MarginalMeans {
    MarginalMeans(std::span<const double> cells, std::size_t levelsA, std::size_t levelsB) : a(levelsA), b(levelsB)
    {
        for (std::size_t j = 0; j < levelsA; ++j)
            for (std::size_t k = 0; k < levelsB; ++k) {
                const double value = cells[j * levelsB + k];
                a[j] += value / static_cast<double>(levelsB);
                b[k] += value / static_cast<double>(levelsA);
                all += value / static_cast<double>(cells.size());
            }
    }
    std::vector<double> a, b;
    double all = 0;
};

EffectSpace mainSpace(std::size_t levels, std::size_t participants)
{
    EffectSpace space{levels, static_cast<double>(levels - 1), {}, {}};
    if (static_cast<double>(participants) <= space.dimension) return space;
    space.projector = Matrix(levels, levels);
    for (std::size_t i = 0; i < levels; ++i)
        for (std::size_t j = 0; j < levels; ++j) space.projector(i, j) = centring(i, j, levels);
    return space;
}

EffectSpace interactionSpace(std::size_t levelsA, std::size_t levelsB, std::size_t participants)
{
    const std::size_t cells = levelsA * levelsB;
    EffectSpace space{cells, static_cast<double>((levelsA - 1) * (levelsB - 1)), {}, {}};
    if (static_cast<double>(participants) <= space.dimension) return space;
    space.projector = Matrix(cells, cells);
    for (std::size_t i = 0; i < cells; ++i)
        for (std::size_t j = 0; j < cells; ++j)
            space.projector(i, j) = centring(i / levelsB, j / levelsB, levelsA) * centring(i % levelsB, j % levelsB, levelsB);
    return space;
}

/// One stratum: an effect space with the participants' groups, its means, and the deviations from them.
struct ErrorStratum {
    const EffectSpace& space;
    const CompleteTable& table;
    std::vector<std::vector<double>> groupMeans;
    std::vector<double> weightedMean;
    std::vector<double> unweightedMean;
    std::vector<double> residuals;  ///< row-major [participants x columns]

    ErrorStratum(const EffectSpace& of, const CompleteTable& whole)
        : space(of),
          table(whole),
          groupMeans(whole.groupSize.size(), std::vector<double>(of.columns)),
          weightedMean(of.columns),
          unweightedMean(of.columns),
          residuals(of.values)
    {
        const std::size_t n = table.participants(), columns = space.columns, groups = groupMeans.size();
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < columns; ++j) {
                const double value = space.row(i)[j];
                groupMeans[table.group[i]][j] += value / table.groupSize[table.group[i]];
                weightedMean[j] += value / static_cast<double>(n);
            }
        for (const auto& mean : groupMeans)
            for (std::size_t j = 0; j < columns; ++j) unweightedMean[j] += mean[j] / static_cast<double>(groups);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < columns; ++j) residuals[i * columns + j] -= groupMeans[table.group[i]][j];
    }

    double errorDegrees() const { return static_cast<double>(table.participants() - groupMeans.size()); }

    double squaresOfMean(SumsOfSquares type) const
    {
        const bool weighted = type == SumsOfSquares::TypeII;
        double inverse = 0;
        for (const double size : table.groupSize) inverse += 1 / size;
        const auto groups = static_cast<double>(groupMeans.size());
        const double weight = weighted ? static_cast<double>(table.participants()) : groups * groups / inverse;
        const auto& mean = weighted ? weightedMean : unweightedMean;
        return weight * orderFreeSum(mean.size(), [&](std::size_t j) { return mean[j] * mean[j]; });
    }

    double squaresBetweenGroups() const
    {
        double squares = 0;
        for (std::size_t g = 0; g < groupMeans.size(); ++g)
            squares += table.groupSize[g] * orderFreeSum(space.columns, [&](std::size_t j) {
                           const double distance = groupMeans[g][j] - weightedMean[j];
                           return distance * distance;
                       });
        return squares;
    }

    double squaresOfError() const
    {
        return orderFreeSum(residuals.size(), [&](std::size_t i) { return residuals[i] * residuals[i]; });
    }

    /// True where the residuals are no larger than the rounding errors of a table without residuals.
    bool hasNoResiduals(double grain) const
    {
        return std::all_of(residuals.begin(), residuals.end(), [&](double x) { return std::fabs(x) <= 16 * grain; });
    }
};

/// Sum of the squares of the entries of R'R, which are those of RR'; the smaller of the two is computed.
double squaresOfProducts(std::span<const double> rows, std::size_t n, std::size_t columns)
{
    double squares = 0;
    const bool byColumn = columns <= n;
    const std::size_t order = byColumn ? columns : n, length = byColumn ? n : columns;
    const auto at = [&](std::size_t vector, std::size_t i) {
        return byColumn ? rows[i * columns + vector] : rows[vector * columns + i];
    };
    for (std::size_t x = 0; x < order; ++x)
        for (std::size_t y = 0; y <= x; ++y) {
            double product = 0;
            for (std::size_t i = 0; i < length; ++i) product += at(x, i) * at(y, i);
            squares += (x == y ? 1 : 2) * product * product;
        }
    return squares;
}

MauchlyTest sphericityOf(const ErrorStratum& stratum, double trace)
{
    const double p = stratum.space.dimension;
    if (p < 2 || stratum.errorDegrees() < p || stratum.space.projector.rows() == 0)
        return mauchlyTest(std::nullopt, p, stratum.errorDegrees());
    // Outside the space of the effect the matrix is the identity, which leaves the determinant as it is.
    const std::size_t columns = stratum.space.columns;
    Matrix matrix(columns, columns);
    for (std::size_t x = 0; x < columns; ++x)
        for (std::size_t y = 0; y < columns; ++y) {
            double product = 0;
            for (std::size_t i = 0; i < stratum.table.participants(); ++i)
                product += stratum.residuals[i * columns + x] * stratum.residuals[i * columns + y];
            matrix(x, y) = product / (trace / p) + (x == y ? 1.0 : 0.0) - stratum.space.projector(x, y);
        }
    if (factorise(matrix) < columns) return mauchlyTest(std::nullopt, p, stratum.errorDegrees());
    double logarithm = 0;
    for (std::size_t x = 0; x < columns; ++x) logarithm += 2 * std::log(matrix(x, x));
    return mauchlyTest(logarithm, p, stratum.errorDegrees());
}

void setCorrections(AnovaEffect& effect, const ErrorStratum& stratum, double errorSquares)
{
    const double p = stratum.space.dimension, degrees = stratum.errorDegrees();
    const double squares = squaresOfProducts(stratum.residuals, stratum.table.participants(), stratum.space.columns);
    const double epsilon = std::clamp(errorSquares * errorSquares / (p * squares), 1 / p, 1.0);
    const auto tailAt = [&](double correction) {
        return fisherUpper(*effect.f, correction * *effect.df1, correction * *effect.df2);
    };
    effect.within = true;
    effect.epsilonGg = epsilon;
    effect.pGg = tailAt(epsilon).p;
    effect.logPGg = tailAt(epsilon).logP;
    effect.mauchly = sphericityOf(stratum, errorSquares);
    const double denominator = p * (degrees - p * epsilon);
    if (p < 2)
        effect.epsilonHf = 1.0;
    else if (denominator > 1e-9 * p * degrees)
        effect.epsilonHf = ((degrees + 1) * p * epsilon - 2) / denominator;
    else
        effect.epsilonHf = Value::undefined("too few participants for the Huynh-Feldt correction");
    effect.pHf = effect.logPHf = effect.epsilonHf;
    if (!effect.epsilonHf.exists()) return;
    const TailProbability tail = tailAt(std::clamp(*effect.epsilonHf, epsilon, 1.0));
    effect.pHf = tail.p;
    effect.logPHf = tail.logP;
}

/// `df1`: degrees of freedom of the effect, a multiple of the dimension of its space for an interaction with groups.
AnovaEffect withinEffect(const std::string& name, const ErrorStratum& stratum, double squares, double df1, double generalError,
                         const ScaledSamples& scale, double grain)
{
    if (stratum.hasNoResiduals(grain))
        return untestedEffect(name, "no error variance: the effect is the same for every participant");
    const double error = stratum.squaresOfError(), p = stratum.space.dimension;
    AnovaEffect effect = testedEffect(name, {squares, error, generalError, df1, p * stratum.errorDegrees()}, scale);
    setCorrections(effect, stratum, error);
    return effect;
}

/// Distance between neighbouring doubles at the largest value, and the table relative to a number near its mean.
double centre(CompleteTable& table, std::span<const double> scaled)
{
    const Moments all = momentsOf(scaled);
    std::transform(scaled.begin(), scaled.end(), table.values.begin(), [&](double x) { return (x - all.shift) - all.residual; });
    return unitInLastPlace(std::max(std::fabs(all.smallest), std::fabs(all.largest)));
}

/// Factors over the rows that have a value.
struct PresentRows {
    PresentRows(std::span<const double> values, std::initializer_list<const Factor*> of)
    {
        std::vector<std::size_t> rows;
        for (std::size_t row = 0; row < values.size(); ++row)
            if (!std::isnan(values[row])) {
                rows.push_back(row);
                y.push_back(values[row]);
            }
        for (const Factor* factor : of) factors.push_back(rowsOf(*factor, rows));
    }
    std::vector<double> y;
    std::vector<Factor> factors;
};

TwoWayAnova emptyAnova(std::span<const double> values, const PresentRows& rows, const std::string& a, const std::string& b)
{
    TwoWayAnova anova;
    anova.values = rows.y.size();
    anova.missing = values.size() - rows.y.size();
    anova.effects[0].name = a;
    anova.effects[1].name = b;
    anova.effects[2].name = a + ":" + b;
    return anova;
}

void count(TwoWayAnova& anova, const CompleteTable& table, const Factor& participant)
{
    anova.participants = table.participants();
    anova.dropped = participant.levels.size() - table.participants();
    anova.balanced = std::ranges::adjacent_find(table.groupSize, std::ranges::not_equal_to{}) == table.groupSize.end();
}

std::string whyIncomplete(const TwoWayAnova& anova)
{
    return "needs at least 2 participants with a value in every cell; there " +
           std::string(anova.participants == 1 ? "is " : "are ") + std::to_string(anova.participants);
}

}  // namespace

TwoWayAnova twoWayWithin(std::span<const double> values, const Factor& participant, const Factor& wholeA, const Factor& wholeB)
{
    const PresentRows rows(values, {&participant, &wholeA, &wholeB});
    TwoWayAnova anova = emptyAnova(values, rows, wholeA.name, wholeB.name);
    if (const std::string fault = nonFiniteFault(rows.y, "the values"); !fault.empty()) return refusedAnova(anova, fault);
    const Factor &a = rows.factors[1], &b = rows.factors[2];
    const std::size_t levelsA = a.levels.size(), levelsB = b.levels.size();
    if (levelsA < 2 || levelsB < 2) return refusedAnova(anova, "each factor needs at least 2 levels with values");
    std::vector<std::size_t> cell, group(rows.y.size());
    for (std::size_t row = 0; row < rows.y.size(); ++row) cell.push_back(a.of[row] * levelsB + b.of[row]);
    CompleteTable table = completeTable(rows.y, rows.factors[0], cell, levelsA * levelsB, group);
    count(anova, table, participant);
    const std::size_t n = table.participants();
    if (n < 2) return refusedAnova(anova, whyIncomplete(anova));
    const std::vector<double> means = table.values;
    const ScaledSamples scaled({means});
    const double grain = centre(table, scaled.sample(0));

    EffectSpace spaceA = mainSpace(levelsA, n), spaceB = mainSpace(levelsB, n), spaceAb = interactionSpace(levelsA, levelsB, n);
    const double rootA = std::sqrt(static_cast<double>(levelsA)), rootB = std::sqrt(static_cast<double>(levelsB));
    std::vector<double> level;
    for (std::size_t i = 0; i < n; ++i) {
        const auto cells = std::span(table.values).subspan(i * table.cells, table.cells);
        const MarginalMeans mean(cells, levelsA, levelsB);
        level.push_back(mean.all);
        for (const double x : mean.a) spaceA.values.push_back(rootB * (x - mean.all));
        for (const double x : mean.b) spaceB.values.push_back(rootA * (x - mean.all));
        for (std::size_t c = 0; c < cells.size(); ++c)
            spaceAb.values.push_back(cells[c] - mean.a[c / levelsB] - mean.b[c % levelsB] + mean.all);
    }
    const ErrorStratum ofA(spaceA, table), ofB(spaceB, table), ofAb(spaceAb, table);
    const double participants = static_cast<double>(table.cells) * momentsOf(level).squares;
    const double general = participants + ofA.squaresOfError() + ofB.squaresOfError() + ofAb.squaresOfError();
    std::size_t place = 0;
    for (const ErrorStratum* stratum : {&ofA, &ofB, &ofAb}) {
        AnovaEffect& effect = anova.effects[place++];
        effect = withinEffect(effect.name, *stratum, stratum->squaresOfMean(SumsOfSquares::TypeII), stratum->space.dimension,
                              general, scaled, grain);
    }
    if (std::ranges::none_of(anova.effects, [](const AnovaEffect& effect) { return effect.why.empty(); }))
        anova.why = anova.effects[0].why;
    return anova;
}

TwoWayAnova twoWayMixed(std::span<const double> values, const Factor& participant, const Factor& between, const Factor& within,
                        SumsOfSquares type)
{
    const PresentRows rows(values, {&participant, &between, &within});
    TwoWayAnova anova = emptyAnova(values, rows, between.name, within.name);
    if (const std::string fault = nonFiniteFault(rows.y, "the values"); !fault.empty()) return refusedAnova(anova, fault);
    const Factor &people = rows.factors[0], &groups = rows.factors[1], &conditions = rows.factors[2];
    const std::size_t levels = conditions.levels.size();
    if (levels < 2 || groups.levels.size() < 2) return refusedAnova(anova, "each factor needs at least 2 levels with values");
    std::vector<std::optional<std::size_t>> groupOf(people.levels.size());
    for (std::size_t row = 0; row < rows.y.size(); ++row) {
        auto& group = groupOf[people.of[row]];
        if (group && *group != groups.of[row])
            return refusedAnova(anova,
                                "participant " + people.levels[people.of[row]] + " is in more than one level of " + between.name);
        group = groups.of[row];
    }
    CompleteTable table = completeTable(rows.y, people, conditions.of, levels, groups.of);
    count(anova, table, participant);
    const std::size_t n = table.participants();
    if (n < 2) return refusedAnova(anova, whyIncomplete(anova));
    if (table.groupSize.size() < 2) return refusedAnova(anova, "only one group has participants with a value in every cell");
    if (n <= table.groupSize.size()) return refusedAnova(anova, "each group has one complete participant: there is no error");
    const std::vector<double> means = table.values;
    const ScaledSamples scaled({means});
    const double grain = centre(table, scaled.sample(0));

    EffectSpace level{1, static_cast<double>(table.groupSize.size() - 1), {}, {}}, space = mainSpace(levels, n);
    const double root = std::sqrt(static_cast<double>(levels));
    for (std::size_t i = 0; i < n; ++i) {
        const auto cells = std::span(table.values).subspan(i * levels, levels);
        const MarginalMeans mean(cells, levels, 1);
        level.values.push_back(root * mean.all);
        for (const double x : cells) space.values.push_back(x - mean.all);
    }
    const ErrorStratum ofPeople(level, table), ofCells(space, table);
    const double general = ofPeople.squaresOfError() + ofCells.squaresOfError();
    if (ofPeople.hasNoResiduals(grain))
        anova.effects[0] = untestedEffect(between.name, "no error variance: participants of a group have equal means");
    else
        anova.effects[0] = testedEffect(
            between.name,
            {ofPeople.squaresBetweenGroups(), ofPeople.squaresOfError(), general, level.dimension, ofPeople.errorDegrees()},
            scaled);
    anova.effects[1] = withinEffect(within.name, ofCells, ofCells.squaresOfMean(type), space.dimension, general, scaled, grain);
    anova.effects[2] = withinEffect(anova.effects[2].name, ofCells, ofCells.squaresBetweenGroups(),
                                    space.dimension * level.dimension, general, scaled, grain);
    if (std::ranges::none_of(anova.effects, [](const AnovaEffect& effect) { return effect.why.empty(); }))
        anova.why = anova.effects[1].why;
    return anova;
}

}  // namespace stats
