#include "stats/anova/between_anova.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "stats/anova/anova_effects.h"
#include "stats/kernels/exact_sum.h"
#include "stats/kernels/matrix.h"
#include "stats/kernels/moments.h"

namespace stats {
namespace {

/// A cell that has values. Its mean is the distance from a number near all values.
struct FilledCell {
    std::size_t a = 0;
    std::size_t b = 0;
    double n = 0;
    double mean = 0;
};

/// The filled cells with the number of levels of each factor.
struct CellTable {
    std::vector<FilledCell> cells;
    std::size_t levelsA = 0;
    std::size_t levelsB = 0;

    CellTable swapped() const
    {
        CellTable other{cells, levelsB, levelsA};
        for (FilledCell& cell : other.cells) std::swap(cell.a, cell.b);
        return other;
    }
};

template <typename Term>
double cellSum(const CellTable& table, Term term)
{
    return orderFreeSum(table.cells.size(), [&](std::size_t i) { return term(table.cells[i]); });
}

/// Effects of the additive model: the mean of a cell is effectA + effectB.
struct AdditiveEffects {
    bool exists = false;
    std::vector<double> a;
    std::vector<double> b;
};

/// Least squares with weights n: the effects of b are eliminated, those of a come from the reduced normal equations.
class AdditiveFit {
public:
    explicit AdditiveFit(const CellTable& table) : m_table(table), m_rowsOfB(table.levelsB), m_sizeB(table.levelsB)
    {
        for (const FilledCell& cell : table.cells) {
            m_rowsOfB[cell.b].push_back(&cell);
            m_sizeB[cell.b] += cell.n;
        }
        // The last level of a is the reference.
        const std::size_t free = table.levelsA - 1;
        m_reduced = Matrix(free, free);
        for (std::size_t level = 0; level < table.levelsB; ++level)
            for (const FilledCell* x : m_rowsOfB[level]) {
                if (x->a == free) continue;
                m_reduced(x->a, x->a) += x->n;
                for (const FilledCell* y : m_rowsOfB[level])
                    if (y->a != free) m_reduced(x->a, y->a) -= x->n * y->n / m_sizeB[level];
            }
    }

    AdditiveEffects run() const
    {
        std::vector<double> rest;
        for (const FilledCell& cell : m_table.cells) rest.push_back(cell.mean);
        AdditiveEffects effects{true, std::vector<double>(m_table.levelsA), std::vector<double>(m_table.levelsB)};
        // The second pass fits what the rounding errors of the first one left.
        for (int pass = 0; pass < 2 && effects.exists; ++pass) effects.exists = improve(effects, rest);
        return effects;
    }

private:
    bool improve(AdditiveEffects& effects, std::vector<double>& rest) const
    {
        std::vector<double> meanB(m_table.levelsB), right(m_table.levelsA);
        for (std::size_t i = 0; i < rest.size(); ++i) meanB[m_table.cells[i].b] += m_table.cells[i].n * rest[i];
        for (std::size_t level = 0; level < meanB.size(); ++level) meanB[level] /= m_sizeB[level];
        for (std::size_t i = 0; i < rest.size(); ++i) {
            const FilledCell& cell = m_table.cells[i];
            right[cell.a] += cell.n * (rest[i] - meanB[cell.b]);
        }
        right.pop_back();
        std::vector<double> stepA = solved(m_reduced, right);
        if (stepA.empty()) return false;
        stepA.push_back(0);
        std::vector<double> stepB = meanB;
        for (const FilledCell& cell : m_table.cells) stepB[cell.b] -= cell.n * stepA[cell.a] / m_sizeB[cell.b];
        for (std::size_t level = 0; level < stepA.size(); ++level) effects.a[level] += stepA[level];
        for (std::size_t level = 0; level < stepB.size(); ++level) effects.b[level] += stepB[level];
        for (std::size_t i = 0; i < rest.size(); ++i) {
            const FilledCell& cell = m_table.cells[i];
            rest[i] = cell.mean - effects.a[cell.a] - effects.b[cell.b];
        }
        return true;
    }

    const CellTable& m_table;
    std::vector<std::vector<const FilledCell*>> m_rowsOfB;
    std::vector<double> m_sizeB;
    Matrix m_reduced;
};

AdditiveEffects additiveEffects(const CellTable& table)
{
    if (table.levelsA <= table.levelsB) return AdditiveFit(table).run();
    const CellTable other = table.swapped();
    AdditiveEffects effects = AdditiveFit(other).run();
    std::swap(effects.a, effects.b);
    return effects;
}

/// Squares of the part of the effects of a that the levels of b do not explain.
double squaresBesideB(const CellTable& table, const std::vector<double>& effectsA)
{
    std::vector<double> sum(table.levelsB), size(table.levelsB);
    for (const FilledCell& cell : table.cells) {
        sum[cell.b] += cell.n * effectsA[cell.a];
        size[cell.b] += cell.n;
    }
    return cellSum(table, [&](const FilledCell& cell) {
        const double distance = effectsA[cell.a] - sum[cell.b] / size[cell.b];
        return cell.n * distance * distance;
    });
}

/// Type III: squares of the unweighted means of the levels of a, weighted by the precision of each.
double weightedSquaresOfMeans(const CellTable& table)
{
    std::vector<double> mean(table.levelsA), inverseWeight(table.levelsA);
    const auto b = static_cast<double>(table.levelsB);
    for (const FilledCell& cell : table.cells) {
        mean[cell.a] += cell.mean / b;
        inverseWeight[cell.a] += 1 / (cell.n * b * b);
    }
    double sum = 0, weights = 0;
    for (std::size_t level = 0; level < mean.size(); ++level) {
        sum += mean[level] / inverseWeight[level];
        weights += 1 / inverseWeight[level];
    }
    return orderFreeSum(mean.size(), [&](std::size_t level) {
        const double distance = mean[level] - sum / weights;
        return distance * distance / inverseWeight[level];
    });
}

double interactionSquares(const CellTable& table, const AdditiveEffects& additive)
{
    return cellSum(table, [&](const FilledCell& cell) {
        const double rest = cell.mean - additive.a[cell.a] - additive.b[cell.b];
        return cell.n * rest * rest;
    });
}

std::string faultOfCells(const CellTable& table, std::size_t values, SumsOfSquares type)
{
    const auto all = static_cast<double>(table.levelsA) * static_cast<double>(table.levelsB);
    const bool hasEmpty = static_cast<double>(table.cells.size()) < all;
    if (type == SumsOfSquares::TypeIII && hasEmpty) return "a cell is empty: type III needs a value in every cell";
    if (values <= table.cells.size()) return "there is one value in each cell: interaction and error are the same";
    if (std::min(table.levelsA, table.levelsB) > mostAdditiveLevels)
        return "both factors have more than " + std::to_string(mostAdditiveLevels) + " levels";
    return {};
}

}  // namespace

TwoWayAnova twoWayBetween(std::span<const double> values, const Factor& wholeA, const Factor& wholeB, SumsOfSquares type)
{
    TwoWayAnova anova;
    anova.effects[0].name = wholeA.name;
    anova.effects[1].name = wholeB.name;
    anova.effects[2].name = wholeA.name + ":" + wholeB.name;
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < values.size(); ++row)
        if (!std::isnan(values[row])) rows.push_back(row);
    anova.values = rows.size();
    anova.missing = values.size() - rows.size();
    const Factor a = rowsOf(wholeA, rows), b = rowsOf(wholeB, rows);
    if (a.levels.size() < 2 || b.levels.size() < 2) return refusedAnova(anova, "each factor needs at least 2 levels with values");
    std::vector<double> present;
    for (const std::size_t row : rows) present.push_back(values[row]);
    if (const std::string fault = nonFiniteFault(present, "the values"); !fault.empty()) return refusedAnova(anova, fault);
    const ScaledSamples scaled({present});
    const auto y = scaled.sample(0);
    std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> valuesOfCell;
    for (std::size_t i = 0; i < y.size(); ++i) valuesOfCell[{a.of[i], b.of[i]}].push_back(y[i]);

    CellTable table{{}, a.levels.size(), b.levels.size()};
    const double origin = momentsOf(y).shift;
    std::vector<double> squares;
    bool varies = false;
    for (const auto& [place, cell] : valuesOfCell) {
        const Moments moments = momentsOf(cell);
        table.cells.push_back({place.first, place.second, static_cast<double>(cell.size()), moments.meanMinus(origin)});
        squares.push_back(moments.squares);
        varies = varies || !isConstant(moments);
    }
    const auto sizes = std::ranges::minmax(table.cells, {}, &FilledCell::n);
    anova.balanced = sizes.min.n == sizes.max.n && table.cells.size() == table.levelsA * table.levelsB;
    if (const std::string fault = faultOfCells(table, y.size(), type); !fault.empty()) return refusedAnova(anova, fault);
    if (!varies) return refusedAnova(anova, "no variation within any cell");
    const AdditiveEffects additive = additiveEffects(table);
    if (!additive.exists) return refusedAnova(anova, "the empty cells separate some levels from the others");

    const double error = orderFreeSum(squares.size(), [&](std::size_t i) { return squares[i]; });
    const auto df2 = static_cast<double>(y.size() - table.cells.size());
    const auto tested = [&](std::size_t effect, double ss, double df1) {
        anova.effects[effect] = testedEffect(anova.effects[effect].name, {ss, error, error, df1, df2}, scaled);
    };
    const bool weighted = type == SumsOfSquares::TypeII;
    const CellTable swapped = table.swapped();
    const auto levelsA = static_cast<double>(table.levelsA), levelsB = static_cast<double>(table.levelsB);
    tested(0, weighted ? squaresBesideB(table, additive.a) : weightedSquaresOfMeans(table), levelsA - 1);
    tested(1, weighted ? squaresBesideB(swapped, additive.b) : weightedSquaresOfMeans(swapped), levelsB - 1);
    const double df1 = static_cast<double>(table.cells.size()) - levelsA - levelsB + 1;
    if (df1 > 0)
        tested(2, interactionSquares(table, additive), df1);
    else
        anova.effects[2] = untestedEffect(anova.effects[2].name, "the filled cells leave no interaction");
    return anova;
}

}  // namespace stats
