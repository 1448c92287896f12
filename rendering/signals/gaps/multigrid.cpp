#include "rendering/signals/gaps/multigrid.h"

#include <algorithm>
#include <array>
#include <utility>

#include "rendering/signals/gaps/row_work.h"

namespace rendering::signals {

namespace {

constexpr int coarsestPx = 3;
constexpr int stepsOnCoarsest = 16;
/// Steps of Chebyshev's polynomial of degree 2 on [0.5, 2], where the eigenvalues of the short waves lie.
constexpr std::array<float, 2> relaxation{0.5617F, 1.3895F};

using Shares = cv::Vec<float, 6>;
using Corners = std::array<float, 4>;

/// Adds the pull of the row `other` towards a row, through couplings with the point straight ahead, or one to the right
/// (shift 1) or left (shift -1).
void pull(const float* coupling, const float* here, const float* other, float* out, int columns, int shift)
{
    const int from = std::max(0, -shift), to = columns - std::max(0, shift);
    for (int j = from; j < to; ++j) out[j] += coupling[j] * (here[j] - other[j + shift]);
}

/// The same, seen from the lower point: the coupling is stored at the upper one.
void pullUp(const float* coupling, const float* here, const float* upper, float* out, int columns, int shift)
{
    const int from = std::max(0, shift), to = columns + std::min(0, shift);
    for (int j = from; j < to; ++j) out[j] += coupling[j - shift] * (here[j] - upper[j - shift]);
}

/// Coupling of two neighbouring points; 0 where one lies outside.
float coupling(const Couplings& c, int i, int j, int down, int right)
{
    if (down < 0 || (down == 0 && right < 0)) return coupling(c, i + down, j + right, -down, -right);
    if (i < 0 || j < 0 || i >= c.size().height || j >= c.size().width || i + down >= c.size().height || j + right < 0 ||
        j + right >= c.size().width)
        return 0;
    if (down == 0) return c.right.at<float>(i, j);
    if (right == 0) return c.below.at<float>(i, j);
    if (!c.diagonal()) return 0;
    return (right > 0 ? c.belowRight : c.belowLeft).at<float>(i, j);
}

/// Coarse couplings can be below 0. Without them in the sum, no eigenvalue exceeds 2, and relaxation never amplifies a wave.
cv::Mat inverseDiagonalOf(const Couplings& c)
{
    cv::Mat result(c.size(), CV_32FC1);
    forRows(result.rows, [&](int i) {
        float* out = result.ptr<float>(i);
        for (int j = 0; j < result.cols; ++j) {
            float sum = 0;
            for (int down = -1; down <= 1; ++down)
                for (int right = c.diagonal() || down == 0 ? -1 : 0; right <= (c.diagonal() || down == 0 ? 1 : 0); ++right)
                    if (down != 0 || right != 0) sum += std::max(0.F, coupling(c, i, j, down, right));
            out[j] = sum > 0 ? 1 / sum : 0.F;
        }
    });
    return result;
}

/// Share of the first of two ends, whose pulls are a and b.
float shareOf(float a, float b) { return a > 0 && b > 0 ? a / (a + b) : a > 0 ? 1.F : b > 0 ? 0.F : 0.5F; }

/// Interpolation that follows the couplings (Dendy, "Black box multigrid", 1982): a point on an edge balances the pulls towards
/// both ends, and a middle point those towards its eight neighbours. So nothing is interpolated across a weak coupling.
Shares sharesAt(const Couplings& c, int i, int j)
{
    const auto rows = c.size().height, columns = c.size().width;
    const bool hasRight = j + 2 < columns, hasBelow = i + 2 < rows;
    const auto across = [&](int row, int column, int towards) {
        float sum = 0;
        for (int down = -1; down <= 1; ++down) sum += coupling(c, row, column, down, towards);
        return sum;
    };
    const auto along = [&](int row, int column, int towards) {
        float sum = 0;
        for (int right = -1; right <= 1; ++right) sum += coupling(c, row, column, towards, right);
        return sum;
    };
    const auto onRow = [&](int row) { return hasRight ? shareOf(across(row, j + 1, -1), across(row, j + 1, 1)) : 1.F; };
    const auto onColumn = [&](int column) { return hasBelow ? shareOf(along(i + 1, column, -1), along(i + 1, column, 1)) : 1.F; };
    const float top = onRow(i), left = onColumn(j);
    Shares result(top, left, 0.25F, 0.25F, 0.25F, 0.25F);
    if (i + 1 >= rows || j + 1 >= columns) return result;
    const float bottom = hasBelow ? onRow(i + 2) : 0, right = hasRight ? onColumn(j + 2) : 0;
    const auto to = [&](int down, int aside) { return std::max(0.F, coupling(c, i + 1, j + 1, down, aside)); };
    Corners middle{to(-1, -1) + to(-1, 0) * top + to(0, -1) * left, to(-1, 1) + to(-1, 0) * (1 - top) + to(0, 1) * right,
                   to(1, -1) + to(1, 0) * bottom + to(0, -1) * (1 - left),
                   to(1, 1) + to(1, 0) * (1 - bottom) + to(0, 1) * (1 - right)};
    const float sum = middle[0] + middle[1] + middle[2] + middle[3];
    const float even = 1.F / static_cast<float>((hasRight ? 2 : 1) * (hasBelow ? 2 : 1));
    const Corners alone{even, hasRight ? even : 0, hasBelow ? even : 0, hasRight && hasBelow ? even : 0};
    for (std::size_t k = 0; k < 4; ++k) result[static_cast<int>(k) + 2] = sum > 0 ? middle[k] / sum : alone[k];
    return result;
}

/// Couplings of the coarse points that give interpolated surfaces the same energy (Galerkin). The energy of a fine coupling
/// belongs to one square, and involves only its corners.
class Coarsening {
public:
    Coarsening(const Level& fine, Couplings& coarse) : m_fine(fine), m_coarse(coarse) {}

    void addSquare(int row, int column)
    {
        const auto& c = m_fine.couplings;
        const int i = 2 * row, j = 2 * column;
        m_row = row;
        m_column = column;
        const auto own = m_fine.share.at<Shares>(row, column);
        Corners points[3][3]{};
        points[0][0] = {1, 0, 0, 0};
        points[0][2] = {0, 1, 0, 0};
        points[2][0] = {0, 0, 1, 0};
        points[2][2] = {0, 0, 0, 1};
        points[0][1] = {own[0], 1 - own[0], 0, 0};
        points[1][0] = {own[1], 0, 1 - own[1], 0};
        points[1][1] = {own[2], own[3], own[4], own[5]};
        if (row + 1 < m_fine.share.rows) {
            const float s = m_fine.share.at<Shares>(row + 1, column)[0];
            points[2][1] = {0, 0, s, 1 - s};
        }
        if (column + 1 < m_fine.share.cols) {
            const float s = m_fine.share.at<Shares>(row, column + 1)[1];
            points[1][2] = {0, s, 0, 1 - s};
        }
        for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b) {
                add(coupling(c, i + a, j + b, 0, 1), points[a][b], points[a][b + 1]);
                add(coupling(c, i + a, j + b, 1, 0), points[a][b], points[a + 1][b]);
                if (!c.diagonal()) continue;
                add(coupling(c, i + a, j + b, 1, 1), points[a][b], points[a + 1][b + 1]);
                add(coupling(c, i + a, j + b + 1, 1, -1), points[a][b + 1], points[a + 1][b]);
            }
    }

private:
    void add(float strength, const Corners& p, const Corners& q)
    {
        if (strength == 0) return;
        const float d0 = p[0] - q[0], d1 = p[1] - q[1], d2 = p[2] - q[2], d3 = p[3] - q[3];
        const int i = m_row, j = m_column;
        const auto give = [&](cv::Mat& to, int row, int column, float product) {
            if (product != 0) to.at<float>(row, column) -= strength * product;
        };
        give(m_coarse.right, i, j, d0 * d1);
        give(m_coarse.below, i, j, d0 * d2);
        give(m_coarse.belowRight, i, j, d0 * d3);
        give(m_coarse.belowLeft, i, j + 1, d1 * d2);
        give(m_coarse.below, i, j + 1, d1 * d3);
        give(m_coarse.right, i + 1, j, d2 * d3);
    }

    const Level& m_fine;
    Couplings& m_coarse;
    int m_row = 0, m_column = 0;
};

Couplings coarsened(Level& fine)
{
    const cv::Size half((fine.couplings.size().width + 1) / 2, (fine.couplings.size().height + 1) / 2);
    fine.share.create(half, CV_32FC(6));
    forRows(half.height, [&](int i) {
        for (int j = 0; j < half.width; ++j) fine.share.at<Shares>(i, j) = sharesAt(fine.couplings, 2 * i, 2 * j);
    });
    const auto none = [&] { return cv::Mat(cv::Mat::zeros(half, CV_32FC1)); };
    Couplings coarse{none(), none(), none(), none()};
    // A row of squares adds to two rows of points, so even and odd rows take turns.
    for (const int parity : {0, 1})
        forRows((half.height + 1 - parity) / 2, [&](int k) {
            Coarsening rows(fine, coarse);
            for (int j = 0; j < half.width; ++j) rows.addSquare(2 * k + parity, j);
        });
    return coarse;
}

/// One step from `from` to `to`; an empty `from` stands for 0.
void smooth(const Level& level, const cv::Mat& from, cv::Mat& to, float step)
{
    forRows(to.rows, [&](int i) {
        const float *sources = level.sources.ptr<float>(i), *inverse = level.inverseDiagonal.ptr<float>(i);
        float* out = to.ptr<float>(i);
        if (from.empty()) {
            for (int j = 0; j < to.cols; ++j) out[j] = step * inverse[j] * sources[j];
            return;
        }
        const float* in = from.ptr<float>(i);
        multiplyRow(level.couplings, from, i, out);
        for (int j = 0; j < to.cols; ++j) out[j] = in[j] + step * inverse[j] * (sources[j] - out[j]);
    });
}

/// Transposed interpolation.
void gatherRow(const cv::Mat& fine, const cv::Mat& share, int i, float* out)
{
    const int columns = share.cols;
    std::fill_n(out, columns, 0.F);
    for (int square = std::max(0, i - 1); square <= i; ++square) {
        const auto* s = share.ptr<Shares>(square);
        const float *upper = fine.ptr<float>(2 * square),
                    *middle = 2 * square + 1 < fine.rows ? fine.ptr<float>(2 * square + 1) : nullptr;
        const bool own = square == i;
        for (int j = 0; j < columns; ++j) {
            const bool hasRight = 2 * j + 1 < fine.cols;
            if (own) {
                out[j] += upper[2 * j];
                if (hasRight) out[j] += s[j][0] * upper[2 * j + 1];
                if (hasRight && j + 1 < columns) out[j + 1] += (1 - s[j][0]) * upper[2 * j + 1];
            }
            if (!middle) continue;
            out[j] += (own ? s[j][1] : 1 - s[j][1]) * middle[2 * j];
            if (!hasRight) continue;
            out[j] += s[j][own ? 2 : 4] * middle[2 * j + 1];
            if (j + 1 < columns) out[j + 1] += s[j][own ? 3 : 5] * middle[2 * j + 1];
        }
    }
}

void restrictResidual(Level& fine, Level& coarse)
{
    cv::Mat& residual = fine.spare;
    forRows(residual.rows, [&](int i) {
        float* out = residual.ptr<float>(i);
        const float* sources = fine.sources.ptr<float>(i);
        multiplyRow(fine.couplings, fine.found, i, out);
        for (int j = 0; j < residual.cols; ++j) out[j] = sources[j] - out[j];
    });
    forRows(coarse.sources.rows, [&](int i) { gatherRow(residual, fine.share, i, coarse.sources.ptr<float>(i)); });
}

/// Adds the interpolated correction.
void spread(const cv::Mat& coarse, const cv::Mat& share, cv::Mat& fine)
{
    forRows(coarse.rows, [&](int i) {
        const auto* s = share.ptr<Shares>(i);
        const float *here = coarse.ptr<float>(i), *lower = coarse.ptr<float>(std::min(i + 1, coarse.rows - 1));
        float *upper = fine.ptr<float>(2 * i), *middle = 2 * i + 1 < fine.rows ? fine.ptr<float>(2 * i + 1) : nullptr;
        for (int j = 0; j < coarse.cols; ++j) {
            const int right = std::min(j + 1, coarse.cols - 1);
            const bool hasRight = 2 * j + 1 < fine.cols;
            upper[2 * j] += here[j];
            if (hasRight) upper[2 * j + 1] += s[j][0] * here[j] + (1 - s[j][0]) * here[right];
            if (!middle) continue;
            middle[2 * j] += s[j][1] * here[j] + (1 - s[j][1]) * lower[j];
            if (hasRight)
                middle[2 * j + 1] += s[j][2] * here[j] + s[j][3] * here[right] + s[j][4] * lower[j] + s[j][5] * lower[right];
        }
    });
}

}  // namespace

void multiplyRow(const Couplings& c, const cv::Mat& in, int i, float* out)
{
    const int columns = in.cols;
    const float* here = in.ptr<float>(i);
    std::fill_n(out, columns, 0.F);
    pull(c.right.ptr<float>(i), here, here, out, columns, 1);
    pullUp(c.right.ptr<float>(i), here, here, out, columns, 1);
    if (i + 1 < in.rows) {
        const float* lower = in.ptr<float>(i + 1);
        pull(c.below.ptr<float>(i), here, lower, out, columns, 0);
        if (c.diagonal()) {
            pull(c.belowRight.ptr<float>(i), here, lower, out, columns, 1);
            pull(c.belowLeft.ptr<float>(i), here, lower, out, columns, -1);
        }
    }
    if (i > 0) {
        const float* upper = in.ptr<float>(i - 1);
        pullUp(c.below.ptr<float>(i - 1), here, upper, out, columns, 0);
        if (c.diagonal()) {
            pullUp(c.belowRight.ptr<float>(i - 1), here, upper, out, columns, 1);
            pullUp(c.belowLeft.ptr<float>(i - 1), here, upper, out, columns, -1);
        }
    }
}

Multigrid::Multigrid(Couplings couplings)
{
    for (;;) {
        Level level{std::move(couplings), {}, {}, {}, {}, {}};
        const cv::Size size = level.couplings.size();
        level.inverseDiagonal = inverseDiagonalOf(level.couplings);
        level.spare.create(size, CV_32FC1);
        level.found.create(size, CV_32FC1);
        if (!m_levels.empty()) level.sources.create(size, CV_32FC1);
        const bool last = std::max(size.width, size.height) <= coarsestPx;
        if (!last) couplings = coarsened(level);
        m_levels.push_back(std::move(level));
        if (last) break;
    }
}

const cv::Mat& Multigrid::cycle(const cv::Mat& sources)
{
    m_levels.front().sources = sources;
    solve(0);
    return m_levels.front().found;
}

void Multigrid::solve(std::size_t at)
{
    Level& level = m_levels[at];
    // Slopes do not contain the mean, and rounding must not raise it from cycle to cycle.
    if (at + 1 == m_levels.size()) level.sources -= cv::mean(level.sources)[0];
    smooth(level, {}, level.spare, relaxation[0]);
    smooth(level, level.spare, level.found, relaxation[1]);
    if (at + 1 == m_levels.size()) {
        for (int k = 0; k < stepsOnCoarsest; ++k) {
            smooth(level, level.found, level.spare, relaxation[0]);
            smooth(level, level.spare, level.found, relaxation[1]);
        }
        return;
    }
    restrictResidual(level, m_levels[at + 1]);
    solve(at + 1);
    spread(m_levels[at + 1].found, level.share, level.found);
    smooth(level, level.found, level.spare, relaxation[1]);
    smooth(level, level.spare, level.found, relaxation[0]);
}

}  // namespace rendering::signals
