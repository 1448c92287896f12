#include "rendering/signals/slope_differences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "rendering/signals/cosine_transform.h"
#include "rendering/signals/mirrored_columns.h"
#include "stats/kernels/vector_clones.h"

namespace rendering::signals {

namespace {

constexpr int slopesAround = 6;  ///< number of point slopes that the polynomial interpolates
constexpr double mostStretched =
    16;  ///< pixels wider than this have columns that are nearly free; there the recursions lose digits

/// Integral from node 0 to node 1 of the polynomial through `count` nodes from `first`, as weights of the values at these
/// nodes.
std::array<double, slopesAround> integralWeights(int first, int count)
{
    cv::Mat powers(count, count, CV_64FC1), integrals(count, 1, CV_64FC1), weights;
    for (int k = 0; k < count; ++k) {
        for (int node = 0; node < count; ++node) powers.at<double>(k, node) = std::pow(first + node, k);
        integrals.at<double>(k) = 1.0 / (k + 1);
    }
    cv::solve(powers, integrals, weights, cv::DECOMP_LU);
    std::array<double, slopesAround> result{};
    std::copy_n(weights.ptr<double>(), count, result.begin());
    return result;
}

/// Slopes and weights that give the rise from sample j to j + 1.
template <class T>
struct Stencil {
    int first = 0;
    std::array<T, slopesAround> weights{};
};

template <class T>
std::vector<Stencil<T>> stencils(int length)
{
    const int count = std::min(slopesAround, length);
    std::vector<Stencil<T>> result;
    for (int j = 0; j + 1 < length; ++j) {
        Stencil<T> stencil;
        stencil.first = std::clamp(j + 1 - count / 2, 0, length - count);
        const auto weights = integralWeights(stencil.first - j, count);
        std::transform(weights.begin(), weights.end(), stencil.weights.begin(), [](double w) { return static_cast<T>(w); });
        result.push_back(stencil);
        // All stencils in the middle are equal.
        while (static_cast<int>(result.size()) + 1 < length && stencil.first == j + 1 - count / 2 &&
               stencil.first + count < length) {
            ++j;
            ++stencil.first;
            result.push_back(stencil);
        }
    }
    return result;
}

// The loops over a row, for the widest vectors that the processor has.
template <class T>
[[gnu::always_inline]] inline void insideOfRow(const T* __restrict s, T* __restrict rise, const T* w, int n)
{
    for (int j = 0; j < n; ++j) rise[j] = w[0] * (s[j] + s[j + 5]) + w[1] * (s[j + 1] + s[j + 4]) + w[2] * (s[j + 2] + s[j + 3]);
}

template <class T>
[[gnu::always_inline]] inline void acrossSixRows(const T* const* row, T* __restrict rise, const T* w, int n)
{
    const T *a = row[0], *b = row[1], *c = row[2], *d = row[3], *e = row[4], *f = row[5];
    for (int j = 0; j < n; ++j) rise[j] = w[0] * a[j] + w[1] * b[j] + w[2] * c[j] + w[3] * d[j] + w[4] * e[j] + w[5] * f[j];
}

template <class T>
struct RisesAround {
    const T *left, *right, *above, *below;
    T scaleX, scaleY;
};

template <class T>
[[gnu::always_inline]] inline void sourcesOfRow(const RisesAround<T>& rises, T* __restrict out, std::size_t n)
{
    const auto [left, right, above, below, scaleX, scaleY] = rises;
    for (std::size_t j = 0; j < n; ++j) out[j] = scaleX * (left[j] - right[j]) + scaleY * (above[j] - below[j]);
}

STATS_VECTOR_CLONES void inside(const float* s, float* rise, const float* w, int n) { insideOfRow(s, rise, w, n); }
STATS_VECTOR_CLONES void inside(const double* s, double* rise, const double* w, int n) { insideOfRow(s, rise, w, n); }
STATS_VECTOR_CLONES void across(const float* const* s, float* rise, const float* w, int n) { acrossSixRows(s, rise, w, n); }
STATS_VECTOR_CLONES void across(const double* const* s, double* rise, const double* w, int n) { acrossSixRows(s, rise, w, n); }
STATS_VECTOR_CLONES void joined(const RisesAround<float>& rises, float* out, std::size_t n) { sourcesOfRow(rises, out, n); }
STATS_VECTOR_CLONES void joined(const RisesAround<double>& rises, double* out, std::size_t n) { sourcesOfRow(rises, out, n); }

/// Rises between the neighbours in one row of slopes.
template <class T>
void risesOfRow(const T* slope, T* rise, const std::vector<Stencil<T>>& all, int count)
{
    const int last = static_cast<int>(all.size());
    const auto one = [&](int at) {
        const auto& stencil = all[static_cast<std::size_t>(at)];
        T sum = 0;
        for (int k = 0; k < count; ++k) sum += stencil.weights[static_cast<std::size_t>(k)] * slope[stencil.first + k];
        rise[at] = sum;
    };
    int j = 0;
    for (; j < last && j < count / 2 - 1; ++j) one(j);
    if (count == slopesAround) {
        const auto w = all[static_cast<std::size_t>(std::min(j, last - 1))].weights;
        const int end = std::max(j, last - (count / 2 - 1));
        if (end > j) inside(slope + j - 2, rise + j, w.data(), end - j);
        j = end;
    }
    for (; j < last; ++j) one(j);
}

/// Rises from a row to the next.
template <class T>
void risesToNextRow(const cv::Mat& slopes, T* rise, const Stencil<T>& stencil, int count)
{
    if (count == slopesAround) {
        std::array<const T*, slopesAround> rows{};
        for (int k = 0; k < count; ++k) rows[static_cast<std::size_t>(k)] = slopes.ptr<T>(stencil.first + k);
        return across(rows.data(), rise, stencil.weights.data(), slopes.cols);
    }
    std::fill_n(rise, slopes.cols, T(0));
    for (int k = 0; k < count; ++k) {
        const T* slope = slopes.ptr<T>(stencil.first + k);
        const T weight = stencil.weights[static_cast<std::size_t>(k)];
        for (int j = 0; j < slopes.cols; ++j) rise[j] += weight * slope[j];
    }
}

template <class T>
cv::Mat pointRisesAlongX(const cv::Mat& slopes)
{
    cv::Mat rises = cv::Mat::zeros(slopes.size(), slopes.type());
    const auto all = stencils<T>(slopes.cols);
    for (int i = 0; i < slopes.rows; ++i) risesOfRow(slopes.ptr<T>(i), rises.ptr<T>(i), all, std::min(slopesAround, slopes.cols));
    return rises;
}

template <class T>
cv::Mat pointRisesAlongY(const cv::Mat& slopes)
{
    cv::Mat rises = cv::Mat::zeros(slopes.size(), slopes.type());
    const auto all = stencils<T>(slopes.rows);
    for (int i = 0; i + 1 < slopes.rows; ++i)
        risesToNextRow(slopes, rises.ptr<T>(i), all[static_cast<std::size_t>(i)], std::min(slopesAround, slopes.rows));
    return rises;
}

std::vector<double> eigenvalues(int length, double pitch, bool central)
{
    std::vector<double> values(static_cast<std::size_t>(length));
    for (int k = 0; k < length; ++k) {
        const double angle = std::numbers::pi * k / length;
        const double s = (central ? std::sin(angle) : 2 * std::sin(angle / 2)) / pitch;
        values[static_cast<std::size_t>(k)] = s * s;
    }
    return values;
}

/// out[j] = scale * (in[j + 1] - in[j - 1]) along a row, mirrored at the ends.
template <class T>
void centralRow(const T* in, T* out, int length, T scale)
{
    if (length == 1) return;
    out[0] = scale * (in[1] - in[0]);
    for (int j = 1; j + 1 < length; ++j) out[j] = scale * (in[j + 1] - in[j - 1]);
    out[length - 1] = scale * (in[length - 1] - in[length - 2]);
}

/// Adds the transpose of centralRow to `out`.
template <class T>
void addCentralRowTransposed(const T* in, T* out, int length, T scale)
{
    if (length == 1) return;
    out[0] -= scale * (in[0] + in[1]);
    for (int j = 1; j + 1 < length; ++j) out[j] += scale * (in[j - 1] - in[j + 1]);
    out[length - 1] += scale * (in[length - 2] + in[length - 1]);
}

/// Rows above and below, or the row itself at a mirrored border.
template <class T>
std::pair<const T*, const T*> neighbours(const cv::Mat& image, int row)
{
    return {image.ptr<T>(std::max(0, row - 1)), image.ptr<T>(std::min(image.rows - 1, row + 1))};
}

}  // namespace

template <class T>
SlopeDifferences<T>::SlopeDifferences(cv::Size size, const Pitch& pitch, SlopeKind kind)
    : m_size(size), m_pitch(pitch), m_kind(kind)
{
    const auto narrowed = [this](const std::vector<double>& values) { return std::vector<T>(values.begin(), values.end()); };
    m_alongX = narrowed(eigenvalues(size.width, pitch.x, central()));
    m_alongY = narrowed(eigenvalues(size.height, pitch.y, central()));
}

template <class T>
Slopes SlopeDifferences<T>::between(const Slopes& slopes) const
{
    if (m_kind == SlopeKind::Point) return {pointRisesAlongX<T>(slopes.x), pointRisesAlongY<T>(slopes.y)};
    Slopes result{slopes.x.clone(), slopes.y.clone()};
    if (m_kind == SlopeKind::Forward) {
        result.x.col(m_size.width - 1) = 0;
        result.y.row(m_size.height - 1) = 0;
        return result;
    }
    for (const int j : {0, m_size.width - 1}) result.x.col(j) *= m_size.width > 1 ? 0.5 : 0;
    for (const int i : {0, m_size.height - 1}) result.y.row(i) *= m_size.height > 1 ? 0.5 : 0;
    return result;
}

template <class T>
Slopes SlopeDifferences<T>::of(const cv::Mat& height) const
{
    Slopes result{cv::Mat::zeros(m_size, cv::DataType<T>::type), cv::Mat::zeros(m_size, cv::DataType<T>::type)};
    const T alongX = static_cast<T>((central() ? 0.5 : 1) / m_pitch.x),
            alongY = static_cast<T>((central() ? 0.5 : 1) / m_pitch.y);
    for (int i = 0; i < m_size.height; ++i) {
        const T* h = height.ptr<T>(i);
        T* x = result.x.ptr<T>(i);
        T* y = result.y.ptr<T>(i);
        if (central()) {
            centralRow(h, x, m_size.width, alongX);
            const auto [above, below] = neighbours<T>(height, i);
            for (int j = 0; j < m_size.width; ++j) y[j] = alongY * (below[j] - above[j]);
            continue;
        }
        for (int j = 0; j + 1 < m_size.width; ++j) x[j] = alongX * (h[j + 1] - h[j]);
        if (i + 1 == m_size.height) continue;
        const T* next = height.ptr<T>(i + 1);
        for (int j = 0; j < m_size.width; ++j) y[j] = alongY * (next[j] - h[j]);
    }
    return result;
}

template <class T>
cv::Mat SlopeDifferences<T>::transposed(const Slopes& differences) const
{
    cv::Mat sources = cv::Mat::zeros(m_size, cv::DataType<T>::type);
    const T alongX = static_cast<T>((central() ? 0.5 : 1) / m_pitch.x),
            alongY = static_cast<T>((central() ? 0.5 : 1) / m_pitch.y);
    for (int i = 0; i < m_size.height; ++i) {
        T* out = sources.ptr<T>(i);
        const T* x = differences.x.ptr<T>(i);
        const T* y = differences.y.ptr<T>(i);
        if (central()) {
            addCentralRowTransposed(x, out, m_size.width, alongX);
            if (m_size.height == 1) continue;
            const auto [above, below] = neighbours<T>(differences.y, i);
            const T ofAbove = i == 0 ? T(-1) : T(1), ofBelow = i + 1 == m_size.height ? T(1) : T(-1);
            for (int j = 0; j < m_size.width; ++j) out[j] += alongY * (ofAbove * above[j] + ofBelow * below[j]);
            continue;
        }
        out[0] -= alongX * x[0];
        for (int j = 1; j < m_size.width; ++j) out[j] += alongX * (x[j - 1] - x[j]);
        for (int j = 0; j < m_size.width; ++j) out[j] -= alongY * y[j];
        if (i == 0) continue;
        const T* above = differences.y.ptr<T>(i - 1);
        for (int j = 0; j < m_size.width; ++j) out[j] += alongY * above[j];
    }
    return sources;
}

template <class T>
cv::Mat SlopeDifferences<T>::sources(const Slopes& slopes) const
{
    if (m_kind != SlopeKind::Point) return transposed(between(slopes));
    const int width = m_size.width, height = m_size.height, countX = std::min(slopesAround, width),
              countY = std::min(slopesAround, height);
    const auto alongX = stencils<T>(width), alongY = stencils<T>(height);
    const T scaleX = static_cast<T>(1 / m_pitch.x), scaleY = static_cast<T>(1 / m_pitch.y);
    const auto length = static_cast<std::size_t>(width);
    std::vector<T> right(length + 1, T(0)), above(length, T(0)), below(length, T(0));  // right[0]: no rise enters a row.
    cv::Mat result(m_size, cv::DataType<T>::type);
    for (int i = 0; i < height; ++i) {
        risesOfRow(slopes.x.ptr<T>(i), right.data() + 1, alongX, countX);
        right[length] = 0;
        if (i + 1 < height)
            risesToNextRow(slopes.y, below.data(), alongY[static_cast<std::size_t>(i)], countY);
        else
            std::fill(below.begin(), below.end(), T(0));
        joined(RisesAround<T>{right.data(), right.data() + 1, above.data(), below.data(), scaleX, scaleY}, result.ptr<T>(i),
               length);
        std::swap(above, below);
    }
    return result;
}

template <class T>
cv::Mat SlopeDifferences<T>::surfaceOf(const cv::Mat& sources) const
{
    if (!central() && m_pitch.x < mostStretched * m_pitch.y) return surfaceOfRises(sources);
    cv::Mat spectrum = cosineTransform(sources);
    for (int i = 0; i < m_size.height; ++i) {
        T* row = spectrum.ptr<T>(i);
        const T alongY = m_alongY[static_cast<std::size_t>(i)];
        for (int j = 0; j < m_size.width; ++j) row[j] /= alongY + m_alongX[static_cast<std::size_t>(j)];
    }
    spectrum.at<T>(0, 0) = 0;  // Slopes do not contain the mean.
    return inverseCosineTransform(spectrum);
}

/// Rows are transformed; along a column the second differences of each frequency have a direct solution.
template <class T>
cv::Mat SlopeDifferences<T>::surfaceOfRises(const cv::Mat& sources) const
{
    cv::Mat spectrum = cosineTransformOfRows(sources, m_pitch.y * m_pitch.y);
    solveMirroredColumns(spectrum, eigenvalues(m_size.width, m_pitch.x / m_pitch.y, false));
    return inverseCosineTransformOfRows(spectrum);
}

template <class T>
cv::Mat SlopeDifferences<T>::heightFactors() const
{
    cv::Mat factors(m_size, cv::DataType<T>::type);
    for (int i = 0; i < m_size.height; ++i)
        for (int j = 0; j < m_size.width; ++j)
            factors.at<T>(i, j) = 1 / (m_alongY[static_cast<std::size_t>(i)] + m_alongX[static_cast<std::size_t>(j)]);
    factors.at<T>(0, 0) = 0;  // Slopes do not contain the mean.
    return factors;
}

template <class T>
Slopes SlopeDifferences<T>::weights(const cv::Mat& measured, double weightOfGaps) const
{
    Slopes result{cv::Mat(m_size, cv::DataType<T>::type), cv::Mat(m_size, cv::DataType<T>::type)};
    const auto weight = [&](bool known) { return static_cast<T>(known ? 1 : weightOfGaps); };
    for (int i = 0; i < m_size.height; ++i)
        for (int j = 0; j < m_size.width; ++j) {
            const bool here = measured.at<uchar>(i, j) != 0;
            const bool right = j + 1 < m_size.width && measured.at<uchar>(i, j + 1) != 0;
            const bool below = i + 1 < m_size.height && measured.at<uchar>(i + 1, j) != 0;
            result.x.at<T>(i, j) = weight(here && right);
            result.y.at<T>(i, j) = weight(here && below);
        }
    return result;
}

template class SlopeDifferences<float>;
template class SlopeDifferences<double>;

}  // namespace rendering::signals
