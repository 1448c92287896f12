// Sums, moments, grids, ranks, tables and matrices: numbers computed by hand, many as exact fractions.
#include <QTest>
#include <cmath>
#include <limits>
#include <vector>

#include "stats/kernels/block_sums.h"
#include "stats/kernels/bordered_blocks.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/exact_sum.h"
#include "stats/kernels/matrix.h"
#include "stats/kernels/moments.h"
#include "stats/kernels/quasi_newton.h"
#include "stats/kernels/ranks.h"
#include "stats/kernels/two_way.h"
#include "stats/models/factor.h"
#include "tests/stats/exact_numbers.h"

namespace {

using Numbers = std::vector<double>;
using stats::Matrix;

Matrix matrixOf(std::size_t rows, std::size_t columns, const Numbers& values)
{
    Matrix result(rows, columns);
    for (std::size_t i = 0; i < values.size(); ++i) result(i / columns, i % columns) = values[i];
    return result;
}

void compareMatrix(const Matrix& found, std::size_t rows, std::size_t columns, const Numbers& expected)
{
    QCOMPARE(found.rows(), rows);
    QCOMPARE(found.columns(), columns);
    for (std::size_t i = 0; i < expected.size(); ++i)
        compareNumbers({{qPrintable(QString::number(i)), found(i / columns, i % columns), expected[i], 1e-13}});
}

/// 1/4, 5/4, 9/4, ... in an order that is neither ascending nor descending, on an offset.
Numbers quarters(std::size_t n, double offset)
{
    Numbers x(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = offset + 0.25 + static_cast<double>(i * 11 % n);
    return x;
}

}  // namespace

class KernelsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // k + 1/4, 0 <= k < n: mean (n - 1)/2 + 1/4, sum of squares n (n^2 - 1)/12. Samples above 4096 values are summed in
    // blocks of 1024; the sizes lie on both sides of these limits.
    void momentsOfAnArithmeticSeries_data()
    {
        QTest::addColumn<int>("n");
        QTest::addColumn<double>("offset");
        for (const int n : {1, 2, 5, 1000, 4096, 4097, 5000, 9216, 9219})
            for (const double offset : {0.0, 1e9, -3e5}) QTest::addRow("%d from %g", n, offset) << n << offset;
    }

    void momentsOfAnArithmeticSeries()
    {
        QFETCH(int, n);
        QFETCH(double, offset);
        const Numbers x = quarters(static_cast<std::size_t>(n), offset);
        const auto moments = stats::momentsOf(x);
        const double count = n;
        const double squares = count * (count * count - 1) / 12;
        QCOMPARE(moments.n, x.size());
        compareNumbers({{"mean", moments.mean(), offset + 0.25 + (count - 1) / 2, 1e-15},
                        {"mean - offset", moments.meanMinus(offset), 0.25 + (count - 1) / 2, 1e-13},
                        {"sum of squares", moments.squares, squares, 1e-13},
                        {"smallest", moments.smallest, offset + 0.25, 0},
                        {"largest", moments.largest, offset + 0.25 + count - 1, 0}});
        if (n > 1) compareNumbers({{"variance", moments.variance(), squares / (count - 1), 1e-13}});
        // The differences are all equal to the offset.
        const Numbers y = quarters(x.size(), 0);
        const auto pairs = stats::pairedMomentsOf(x, y);
        compareNumbers({{"mean of y", pairs.y.mean(), 0.25 + (count - 1) / 2, 1e-15},
                        {"mean of x", pairs.x.mean(), *stats::Value(moments.mean()), 1e-15},
                        {"squares of x", pairs.x.squares, squares, 1e-13},
                        {"mean of the differences", pairs.differences.mean(), offset, 1e-15},
                        {"their squares", pairs.differences.squares, 0}});
        QVERIFY(stats::isConstant(pairs.differences));
        QCOMPARE(stats::isConstant(moments), n == 1);
    }

    // 11 numbers: eight in vector registers, then three more.
    void sumsOfABlock()
    {
        const Numbers x{4, -2, 7, 0.5, 3, 9, -6, 1, 2.5, 8, -5};
        stats::BlockSums sums;
        stats::blockSums(x.data(), x.size(), sums);
        compareNumbers({{"mean", sums.mean, 2},
                        {"smallest", sums.smallest, -6},
                        {"largest", sums.largest, 9},
                        {"squares", sums.squares, 247.5}});
        QVERIFY(std::fabs(sums.residual) < 1e-14);
        QCOMPARE(stats::sumOfMagnitudes(x.data(), x.size()), 48.0);
        Numbers differences(11);
        stats::subtract(x.data(), Numbers(11, 0.5).data(), differences.data(), 11);
        QCOMPARE(differences, (Numbers{3.5, -2.5, 6.5, 0, 2.5, 8.5, -6.5, 0.5, 2, 7.5, -5.5}));
    }

    // The first addition loses the 1; its error term restores it.
    void sumsKeepTheirRoundingErrors()
    {
        const Numbers x{1e16, 1, -1e16, 3, 1e17, 0.5, -1e17};
        QCOMPARE(stats::exactSum(x.size(), [&](std::size_t i) { return x[i]; }), 4.5);
        QCOMPARE(stats::orderFreeSum(x.size(), [&](std::size_t i) { return x[i]; }), 4.5);
        stats::ExactSum sum;
        for (const double one : x) sum.add(one);
        QCOMPARE(sum.total(), 4.5);
    }

    void scalesOfSamples()
    {
        const Numbers x{1, 2}, large{std::ldexp(1, 700), std::ldexp(3, 700)}, small{std::ldexp(1, -400)}, zeros{0, 0};
        const stats::ScaledSamples plain({x}, {5});
        QCOMPARE(plain.exponent(), 0);
        QCOMPARE(plain.scaled(5), 5.0);
        QVERIFY(plain.sample(0).data() == x.data());
        const stats::ScaledSamples scaled({large, x}, {std::ldexp(1, 701)});
        QCOMPARE(scaled.exponent(), 701);
        QCOMPARE(scaled.sample(0)[1], 1.5);
        QCOMPARE(scaled.sample(1)[0], std::ldexp(1, -701));
        QCOMPARE(scaled.scaled(std::ldexp(1, 700)), 0.5);
        QCOMPARE(*scaled.unscaled(1.5), std::ldexp(3, 700));
        QVERIFY(scaled.unscaledSquare(1.5).decimal().starts_with("1.660141782165487") &&
                scaled.unscaledSquare(1.5).decimal().ends_with("e+422"));
        const stats::ScaledSamples tiny({small});
        QCOMPARE(tiny.exponent(), -400);
        QCOMPARE(*tiny.unscaledSquare(1), std::ldexp(1, -800));
        QCOMPARE(stats::ScaledSamples({zeros}).exponent(), 0);
        // Samples between 2^-200 and 2^200 are not scaled.
        const Numbers edge{std::ldexp(1.5, 200)}, beyond{std::ldexp(1, 201)}, low{std::ldexp(1, -200)},
            lower{std::ldexp(1, -201)};
        QCOMPARE(stats::ScaledSamples({edge}).exponent(), 0);
        QCOMPARE(stats::ScaledSamples({beyond}).exponent(), 201);
        QCOMPARE(stats::ScaledSamples({low}).exponent(), 0);
        QCOMPARE(stats::ScaledSamples({lower}).exponent(), -201);
    }

    void constancyIsJudgedByTheLastBit()
    {
        const auto constant = [](const Numbers& x) { return stats::isConstant(stats::momentsOf(x)); };
        const double next = std::nextafter(1.0, 2.0);
        QVERIFY(constant({1, 1}) && constant({1, next}) && !constant({1, 1, std::nextafter(next, 2.0)}) && constant({-3, -3}));
        QCOMPARE(stats::unitInLastPlace(-1.0), std::numeric_limits<double>::epsilon());
        QCOMPARE(stats::unitInLastPlace(1e16), 2.0);
        QCOMPARE(stats::nonFiniteFault(Numbers{1, 2}, "x"), std::string());
        QCOMPARE(stats::nonFiniteFault(Numbers{1e308, 1e308}, "x"), std::string());
        QCOMPARE(stats::nonFiniteFault(Numbers{1, 2, std::nan("")}, "x"), std::string("value 3 of x is not a number"));
        QCOMPARE(stats::nonFiniteFault(Numbers{-HUGE_VAL, 2}, "y"), std::string("value 1 of y is infinite"));
    }

    void decimalGrids()
    {
        const auto grid = stats::decimalGridOf(Numbers{5.4, -3, 0.25, 0});
        QVERIFY(grid.has_value());
        QCOMPARE(grid->places, 2);
        QCOMPARE(grid->units, (std::vector<std::int64_t>{540, -300, 25, 0}));
        QCOMPARE(grid->unitsPerOne(), 100.0);
        QCOMPARE(stats::decimalGridOf(Numbers{1e-9})->places, 9);
        QVERIFY(!stats::decimalGridOf(Numbers{1e-10}));
        QCOMPARE(stats::decimalGridOf(Numbers{1e15})->places, 0);
        QVERIFY(!stats::decimalGridOf(Numbers{2e15}));
        QVERIFY(!stats::decimalGridOf(Numbers{1e10, 1e-9}));
        compareNumbers({{"mean of decimals", stats::meanOf(Numbers{0.1, 0.2, 0.6}), 0.3},
                        {"mean off the grid", stats::meanOf(Numbers{1.0 / 3, 2.0 / 3}), 0.5},
                        {"mean of 1500", stats::meanOf(Numbers(1500, 0.7)), 0.7},
                        {"mean beyond 9e15 units", stats::meanOf(Numbers(20, 6e14)), 6e14},
                        {"huge mean", stats::meanOf(Numbers{1e308, 1.5e308}), 1.25e308}});
        compareReasons({{"infinite", stats::meanOf(Numbers{HUGE_VAL}), "infinite"}});
    }

    void midRanksOfTies()
    {
        const auto ranks = stats::midRanks<double>(Numbers{3, 1, 3, 2, 3, 1});
        QCOMPARE(ranks.doubled, (std::vector<long long>{10, 3, 10, 6, 10, 3}));
        QCOMPARE(ranks.ties, (std::vector<std::size_t>{2, 1, 3}));
        const std::vector<long long> whole{7, -7, 0};
        QCOMPARE(stats::midRanks<long long>(whole).doubled, (std::vector<long long>{6, 2, 4}));
    }

    // 2 blocks, 3 conditions: grand mean 3, blocks -1 and 1, conditions -1, 0, 1, and residuals of 1/2.
    void tablesAreTakenApart()
    {
        const auto table = stats::blockTableOf({{1.5, 2, 2.5}, {2.5, 4, 5.5}});
        const auto effects = stats::twoWayEffects(table.table.values, table.table);
        QCOMPARE(effects.block, (Numbers{-1, 1}));
        QCOMPARE(effects.condition, (Numbers{-1, 0, 1}));
        QCOMPARE(effects.residual, (Numbers{0.5, 0, -0.5, -0.5, 0, 0.5}));
        compareNumbers(
            {{"blocks", effects.ssBlock, 6}, {"conditions", effects.ssCondition, 4}, {"residual", effects.ssResidual, 1}});
        QCOMPARE(effects.grain, std::numeric_limits<double>::epsilon() * 4);
        QVERIFY(!effects.hasNoResiduals() && !effects.isConstant());
        const auto additive = stats::blockTableOf({{0.1, 0.2}, {0.3, 0.4}}).table;
        QVERIFY(stats::twoWayEffects(additive.values, additive).hasNoResiduals());
        QVERIFY(!stats::twoWayEffects(additive.values, additive).isConstant());
        const auto onlyBlocks = stats::blockTableOf({{1, 1}, {2, 2}}).table,
                   onlyConditions = stats::blockTableOf({{1, 2}, {1, 2}}).table;
        QVERIFY(!stats::twoWayEffects(onlyBlocks.values, onlyBlocks).isConstant());
        QVERIFY(!stats::twoWayEffects(onlyConditions.values, onlyConditions).isConstant());
        QCOMPARE(table.table.column(1), (Numbers{2, 4}));
        QCOMPARE(table.table.at(1, 2), 5.5);
        QCOMPARE(stats::blockTableOf({{1, 2}, {1}}).fault, std::string("rows differ in length"));
    }

    // [[4,2,2],[2,5,3],[2,3,6]] = U'U with U = [[2,1,1],[0,2,1],[0,0,2]].
    void cholesky()
    {
        const Matrix a = matrixOf(3, 3, {4, 2, 2, 2, 5, 3, 2, 3, 6});
        Matrix upper = a;
        QCOMPARE(stats::factorise(upper), std::size_t{3});
        compareMatrix(upper, 3, 3, {2, 1, 1, 2, 2, 1, 2, 3, 2});  // the part below the diagonal is unchanged
        const Matrix lower = stats::inverseOfTransposed(upper, 3);
        compareMatrix(lower, 3, 3, {0.5, 0, 0, -0.25, 0.5, 0, -0.125, -0.25, 0.5});
        // adj(a)/64
        compareMatrix(stats::inverseFrom(lower, 3), 3, 3,
                      {21 / 64.0, -6 / 64.0, -4 / 64.0, -6 / 64.0, 20 / 64.0, -8 / 64.0, -4 / 64.0, -8 / 64.0, 16 / 64.0});
        compareMatrix(stats::inverseFrom(stats::inverseOfTransposed(upper, 2), 2), 2, 2,
                      {5 / 16.0, -2 / 16.0, -2 / 16.0, 4 / 16.0});
        const auto x = stats::solved(a, Numbers{8, 10, 11});
        compareNumbers({{"x", x[0], 1}, {"y", x[1], 1}, {"z", x[2], 1}});
        Matrix dependent = matrixOf(3, 3, {1, 2, 1, 2, 4, 3, 1, 3, 9});
        QCOMPARE(stats::factorise(dependent), std::size_t{1});
        QVERIFY(stats::solved(matrixOf(2, 2, {1, 1, 1, 1}), Numbers{1, 2}).empty());
    }

    void productsOfMatrices()
    {
        const Matrix a = matrixOf(2, 3, {1, 2, 3, 4, 5, 6});
        QCOMPARE(stats::product(a, Numbers{1, 0, -1}), (Numbers{-2, -2}));
        QCOMPARE(stats::dot(Numbers{1, 2, 3}, Numbers{4, -5, 6}), 12.0);
        QCOMPARE(stats::quadraticForm(Numbers{2, -1}, a, Numbers{1, 0, -1}), -2.0);
    }

    // [[2,1,0],[1,2,1],[0,1,2]]: 2 and 2 +- sqrt 2.
    void eigenvaluesOfATridiagonalMatrix()
    {
        const Matrix a = matrixOf(3, 3, {2, 1, 0, 1, 2, 1, 0, 1, 2});
        const auto eigen = stats::eigenOf(a);
        Numbers values = eigen.values;
        std::sort(values.begin(), values.end());
        compareNumbers(
            {{"least", values[0], 2 - std::sqrt(2)}, {"middle", values[1], 2}, {"largest", values[2], 2 + std::sqrt(2)}});
        for (std::size_t k = 0; k < 3; ++k) {
            const auto v = eigen.vectors.row(k);
            const auto image = stats::product(a, v);
            QVERIFY(std::fabs(stats::dot(v, v) - 1) < 1e-14);
            for (std::size_t i = 0; i < 3; ++i) QVERIFY(std::fabs(image[i] - eigen.values[k] * v[i]) < 1e-13);
        }
    }

    // A function of Rosenbrock's kind, whose minimum 3 is at (1, 1).
    void minimumOfACurvedValley()
    {
        const auto valley = [](std::span<const double> x) {
            const double a = 1 - x[0], b = x[1] - x[0] * x[0];
            return stats::PointOfFunction{true, a * a + 10 * b * b + 3, {-2 * a - 40 * x[0] * b, 20 * b}};
        };
        Matrix guess(2, 2);
        guess(0, 0) = guess(1, 1) = 0.1;
        const auto minimum = stats::minimised(valley, {-1, 0.5}, guess);
        QVERIFY2(minimum.why.empty(), minimum.why.c_str());
        compareNumbers(
            {{"x", minimum.place[0], 1, 1e-4}, {"y", minimum.place[1], 1, 1e-4}, {"value", minimum.at.value, 3, 1e-8}});
        const auto hessian = stats::hessianOf(valley, Numbers{1, 1});
        for (const auto& [i, j, second] : {std::tuple{0, 0, 82.0}, {0, 1, -40.0}, {1, 0, -40.0}, {1, 1, 20.0}})
            compareNumbers(
                {{"second derivative", hessian(static_cast<std::size_t>(i), static_cast<std::size_t>(j)), second, 1e-7}});
        const auto nowhere = [](std::span<const double>) { return stats::PointOfFunction{}; };
        QVERIFY(stats::minimised(nowhere, {0, 0}, guess).why.find("did not converge in 300 steps") != std::string::npos);
        QCOMPARE(stats::hessianOf(nowhere, Numbers{1, 1}).rows(), std::size_t{0});
        const auto slope = [](std::span<const double> x) { return stats::PointOfFunction{true, -x[0], {-1.0}}; };
        QVERIFY(!stats::minimised(slope, {0}, Matrix(guess)).why.empty());
    }

    void factorsOfRows()
    {
        const auto a = stats::factorOf("a", std::vector<std::string>{"x", "y", "x", "z"});
        QCOMPARE(a.levels, (std::vector<std::string>{"x", "y", "z"}));
        QCOMPARE(a.of, (std::vector<std::size_t>{0, 1, 0, 2}));
        const auto b = stats::factorOf("b", std::vector<std::string>{"1", "1", "2", "1"});
        const auto both = stats::interactionOf(a, b);
        QCOMPARE(both.name, std::string("a:b"));
        QCOMPARE(both.levels, (std::vector<std::string>{"x:1", "y:1", "x:2", "z:1"}));
        QCOMPARE(both.of, (std::vector<std::size_t>{0, 1, 2, 3}));
        const auto some = stats::rowsOf(a, std::vector<std::size_t>{3, 0});
        QCOMPARE(some.levels, (std::vector<std::string>{"x", "z"}));
        QCOMPARE(some.of, (std::vector<std::size_t>{1, 0}));
        const auto coded = stats::treatmentCoded(a);
        QCOMPARE(coded.names, (std::vector<std::string>{"(Intercept)", "ay", "az"}));
        QCOMPARE(coded.columns, (std::vector<Numbers>{{1, 1, 1, 1}, {0, 1, 0, 0}, {0, 0, 0, 1}}));
    }

    // Halves of a tenth are not doubles: 0.15 is 0.1499..., 0.35 is 0.3499..., and 8.5 / 5 is 1.7.
    void halvesAreRoundedUp()
    {
        const Numbers whole = stats::roundedHalvesUp(Numbers{4.5, 4.49, 0.5, 9.999, 0, -0.5, -1.5, -0.51, 1e300}, 1);
        QCOMPARE(whole, (Numbers{5, 4, 1, 10, 0, 0, -1, -1, 1e300}));
        QCOMPARE(stats::roundedHalvesUp(Numbers{0.15, 0.35, 0.149, 0.85, 1.05}, 0.1), (Numbers{0.2, 0.4, 0.1, 0.9, 1.1}));
        QCOMPARE(stats::roundedHalvesUp(Numbers{2.5, 7.4, 97.5, 8.5, 1.0 / 3}, 5), (Numbers{5, 5, 100, 10, 0}));
        QVERIFY(std::isnan(stats::roundedHalvesUp(Numbers{std::numeric_limits<double>::quiet_NaN()}, 1)[0]));
    }

    void blocksWithABorderActAsTheWholeMatrix_data()
    {
        QTest::addColumn<std::vector<std::uint32_t>>("blockOf");
        constexpr std::uint32_t border = stats::BorderedShape::inBorder;
        using Blocks = std::vector<std::uint32_t>;
        QTest::newRow("mixed order") << Blocks{0, border, 1, 0, 2, 1, border, 0};
        QTest::newRow("one block, no border") << Blocks{0, 0, 0, 0};
        QTest::newRow("border only") << Blocks{border, border, border};
        QTest::newRow("diagonal") << Blocks{0, 1, 2, 3};
        QTest::newRow("nothing") << Blocks{};
    }

    void blocksWithABorderActAsTheWholeMatrix()
    {
        QFETCH(std::vector<std::uint32_t>, blockOf);
        const stats::BorderedShape shape(blockOf);
        const auto n = static_cast<std::uint32_t>(blockOf.size());
        const auto isStored = [&](std::uint32_t i, std::uint32_t j) {
            constexpr std::uint32_t border = stats::BorderedShape::inBorder;
            return blockOf[i] == blockOf[j] || blockOf[i] == border || blockOf[j] == border;
        };
        // A diagonal that dominates makes the matrix positive definite.
        Matrix whole(n, n);
        Numbers entries(shape.entries());
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = i; j < n; ++j) {
                if (!isStored(i, j)) continue;
                const double value = i == j ? 9 + i : (i + 2 * j) % 4 * 0.5 - 0.5;
                whole(i, j) = whole(j, i) = entries[shape.place(j, i)] = value;
                QCOMPARE(shape.place(i, j), shape.place(j, i));
            }
        const stats::BorderedFactor factor(shape, entries);
        QVERIFY(factor.exists());
        Matrix upper = whole;
        QCOMPARE(stats::factorise(upper), std::size_t(n));
        const Matrix inverse = stats::inverseFrom(stats::inverseOfTransposed(upper, n), n);
        double logDeterminant = 0;
        Numbers right;
        for (std::uint32_t i = 0; i < n; ++i) {
            logDeterminant += 2 * std::log(upper(i, i));
            right.push_back(1.5 * i - 2);
        }
        compareNumbers({{"log determinant", factor.logDeterminant(), logDeterminant, 1e-13}});
        const Numbers found = factor.solved(right), expected = stats::product(inverse, right), parts = factor.inverse();
        for (std::uint32_t i = 0; i < n; ++i) {
            compareNumbers({{"solution", found[i], expected[i], 1e-12}});
            for (std::uint32_t j = i; j < n; ++j)
                if (isStored(i, j)) QVERIFY(std::fabs(parts[shape.place(i, j)] - inverse(i, j)) < 1e-15);
        }
    }

    void aMatrixThatIsNotPositiveHasNoFactor()
    {
        const stats::BorderedShape shape(std::vector<std::uint32_t>{0, 1, stats::BorderedShape::inBorder});
        Numbers entries(shape.entries());
        for (std::uint32_t i = 0; i < 3; ++i) entries[shape.place(i, i)] = 1;
        QVERIFY(stats::BorderedFactor(shape, entries).exists());
        entries[shape.place(0, 2)] = entries[shape.place(1, 2)] = 0.8;  // 1 - 0.64 - 0.64 < 0
        QVERIFY(!stats::BorderedFactor(shape, entries).exists());
        entries[shape.place(0, 0)] = -1;
        QVERIFY(!stats::BorderedFactor(shape, entries).exists());
    }
};

QTEST_GUILESS_MAIN(KernelsTest)
#include "kernels_test.moc"
