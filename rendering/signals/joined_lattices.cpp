#include "rendering/signals/joined_lattices.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <queue>
#include <utility>
#include <vector>

#include "rendering/signals/gap_multigrid.h"
#include "rendering/signals/known_places.h"

namespace rendering::signals {

namespace {

/// Weight of the continued slopes in gaps of a lattice. They only place parts that no measured slope reaches.
constexpr float weightBetweenParts = 1e-5F;
constexpr int sweeps = 8;
constexpr std::size_t mostJoints = 8'000'000;

/// Weighted rises of one lattice: its neighbours lie two pixels apart, and the slope between them measures their rise.
WeightedRises risesOfLattice(const Slopes& slopes, const cv::Mat& knownX, const cv::Mat& knownY, const Pitch& pitch,
                             cv::Point first)
{
    const cv::Size size((slopes.x.cols - first.x + 1) / 2, (slopes.x.rows - first.y + 1) / 2);
    const auto none = [&] { return cv::Mat(cv::Mat::zeros(size, CV_32FC1)); };
    WeightedRises result{{none(), none()}, cv::Mat::zeros(size, CV_64FC1)};
    const double squareX = 1 / (4 * pitch.x * pitch.x), squareY = 1 / (4 * pitch.y * pitch.y), unit = std::max(squareX, squareY);
    const auto weightOf = [&](bool known, double square) {
        return static_cast<float>(square / unit) * (known ? 1.F : weightBetweenParts);
    };
    for (int i = 0; i < size.height; ++i)
        for (int j = 0; j < size.width; ++j) {
            const int row = 2 * i + first.y, column = 2 * j + first.x;
            const auto add = [&](cv::Mat& weights, float weight, double rise, int down, int right) {
                weights.at<float>(i, j) = weight;
                const double pull = static_cast<double>(weight) * rise;
                result.sources.at<double>(i, j) -= pull;
                result.sources.at<double>(i + down, j + right) += pull;
            };
            if (j + 1 < size.width)
                add(result.weights.x, weightOf(knownX.at<uchar>(row, column + 1) != 0, squareX),
                    2 * pitch.x * slopes.x.at<double>(row, column + 1), 0, 1);
            if (i + 1 < size.height)
                add(result.weights.y, weightOf(knownY.at<uchar>(row + 1, column) != 0, squareY),
                    2 * pitch.y * slopes.y.at<double>(row + 1, column), 1, 0);
        }
    return result;
}

/// Sets of pixels that measured slopes join.
class Parts {
public:
    explicit Parts(std::size_t pixels) : m_parent(pixels) { std::iota(m_parent.begin(), m_parent.end(), 0U); }

    void join(std::size_t a, std::size_t b)
    {
        const auto x = rootOf(static_cast<std::uint32_t>(a)), y = rootOf(static_cast<std::uint32_t>(b));
        if (x != y) m_parent[std::max(x, y)] = std::min(x, y);
    }

    /// Part of every pixel, numbered from 0.
    std::vector<std::uint32_t> numbered(std::uint32_t& count)
    {
        std::vector<std::uint32_t> part(m_parent.size());
        count = 0;
        for (std::uint32_t p = 0; p < part.size(); ++p) part[p] = rootOf(p) == p ? count++ : part[rootOf(p)];
        return part;
    }

private:
    std::uint32_t rootOf(std::uint32_t p)
    {
        while (m_parent[p] != p) p = m_parent[p] = m_parent[m_parent[p]];
        return p;
    }

    std::vector<std::uint32_t> m_parent;
};

/// What two neighbouring pixels of different parts predict: offset of `second` minus that of `first`.
struct Joint {
    std::uint32_t first, second;
    double difference;
};

/// Joints by the part that they belong to; each joint is found from both sides.
struct Joints {
    std::vector<std::size_t> begin;
    std::vector<std::pair<std::uint32_t, double>> other;  ///< neighbouring part; own offset minus its offset
};

Joints sorted(const std::vector<Joint>& joints, std::uint32_t parts)
{
    Joints result{std::vector<std::size_t>(parts + 1U, 0), {}};
    for (const auto& joint : joints) {
        ++result.begin[joint.first + 1];
        ++result.begin[joint.second + 1];
    }
    std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
    result.other.resize(2 * joints.size());
    auto next = result.begin;
    for (const auto& joint : joints) {
        result.other[next[joint.first]++] = {joint.second, -joint.difference};
        result.other[next[joint.second]++] = {joint.first, joint.difference};
    }
    return result;
}

/// Places parts one after the other, the one with most joints to the placed parts first, at the median of what these predict;
/// then goes over all of them again.
class PlacedParts {
public:
    PlacedParts(const Joints& joints, const std::vector<std::uint32_t>& sizes, const std::vector<int>& latticeOfPart)
        : m_joints(joints),
          m_lattice(latticeOfPart),
          m_offset(sizes.size(), 0),
          m_placed(sizes.size(), false),
          m_seen(sizes.size(), 0)
    {
        std::vector<std::uint32_t> bySize(sizes.size());
        std::iota(bySize.begin(), bySize.end(), 0U);
        std::stable_sort(bySize.begin(), bySize.end(), [&](auto a, auto b) { return sizes[a] > sizes[b]; });
        m_main.fill(-1);
        for (const auto part : bySize) {
            auto& main = m_main[static_cast<std::size_t>(m_lattice[part])];
            if (main < 0) main = part;
        }
        for (const auto part : bySize)
            if (!m_placed[part] && (sizes[part] > 1 || m_joints.begin[part + 1] > m_joints.begin[part])) placeFrom(part);
        for (int k = 0; k < sweeps; ++k)
            for (const auto part : bySize)
                if (m_joints.begin[part + 1] > m_joints.begin[part]) m_offset[part] = predicted(part);
    }

    bool placed(std::uint32_t part) const { return m_placed[part]; }
    double offset(std::uint32_t part) const { return m_offset[part]; }
    double ofLattice(int lattice) const
    {
        const auto main = m_main[static_cast<std::size_t>(lattice)];
        return main >= 0 && m_placed[static_cast<std::size_t>(main)] ? m_offset[static_cast<std::size_t>(main)] : 0;
    }

private:
    /// `seed` has no placed neighbour. Where it lies is what the continued slopes say.
    void placeFrom(std::uint32_t seed)
    {
        std::priority_queue<std::pair<std::size_t, std::uint32_t>> next;
        m_offset[seed] = ofLattice(m_lattice[seed]);
        place(seed, next);
        while (!next.empty()) {
            const auto [joints, part] = next.top();
            next.pop();
            if (m_placed[part] || joints != m_seen[part]) continue;
            m_offset[part] = predicted(part);
            place(part, next);
        }
    }

    void place(std::uint32_t part, std::priority_queue<std::pair<std::size_t, std::uint32_t>>& next)
    {
        m_placed[part] = true;
        std::vector<std::uint32_t> touched;
        for (std::size_t k = m_joints.begin[part]; k < m_joints.begin[part + 1]; ++k) {
            const auto other = m_joints.other[k].first;
            if (m_placed[other]) continue;
            ++m_seen[other];
            touched.push_back(other);
        }
        std::sort(touched.begin(), touched.end());
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
        for (const auto other : touched) next.emplace(m_seen[other], other);
    }

    double predicted(std::uint32_t part)
    {
        m_values.clear();
        for (std::size_t k = m_joints.begin[part]; k < m_joints.begin[part + 1]; ++k)
            if (m_placed[m_joints.other[k].first])
                m_values.push_back(m_offset[m_joints.other[k].first] + m_joints.other[k].second);
        if (m_values.empty()) return m_offset[part];
        const auto middle = m_values.begin() + static_cast<std::ptrdiff_t>(m_values.size() / 2);
        std::nth_element(m_values.begin(), middle, m_values.end());
        if (m_values.size() % 2 == 1) return *middle;
        return 0.5 * (*middle + *std::max_element(m_values.begin(), middle));
    }

    const Joints& m_joints;
    const std::vector<int>& m_lattice;
    std::vector<double> m_offset;
    std::vector<bool> m_placed;
    std::vector<std::size_t> m_seen;
    std::array<std::int64_t, 4> m_main{};
    std::vector<double> m_values;
};

/// Integrates every lattice by itself.
cv::Mat separateLattices(const Slopes& slopes, const cv::Mat& knownX, const cv::Mat& knownY, const Pitch& pitch)
{
    cv::Mat result(slopes.x.size(), CV_64FC1);
    for (int a = 0; a < std::min(2, result.rows); ++a)
        for (int b = 0; b < std::min(2, result.cols); ++b) {
            const cv::Mat lattice = surfaceOfWeightedRises(risesOfLattice(slopes, knownX, knownY, pitch, {b, a}));
            for (int i = a; i < result.rows; i += 2)
                for (int j = b; j < result.cols; j += 2) result.at<double>(i, j) = lattice.at<double>(i / 2, j / 2);
        }
    return result;
}

/// Collects what neighbours predict whose slopes are both measured; every so many of a large map.
class LatticeJoints {
public:
    LatticeJoints(const cv::Mat& height, const std::vector<std::uint32_t>& part) : m_height(height), m_part(part) {}

    void addAlong(const cv::Mat& slopes, const cv::Mat& known, double pitch, int down, int right)
    {
        const int rows = slopes.rows - down, columns = slopes.cols - right;
        const std::size_t every = 1 + 2 * slopes.total() / mostJoints;
        std::size_t number = 0;
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j) {
                if (!known.at<uchar>(i, j) || !known.at<uchar>(i + down, j + right)) continue;
                if (++number % every != 0) continue;
                // At the border the slope is the rise itself.
                const bool begins = down ? i == 0 : j == 0, ends = down ? i + 1 == rows : j + 1 == columns;
                const double here = slopes.at<double>(i, j), there = slopes.at<double>(i + down, j + right);
                const double slope = begins ? here : ends ? there : 0.5 * (here + there);
                const double rise = m_height.at<double>(i + down, j + right) - m_height.at<double>(i, j);
                m_joints.push_back({partAt(i, j), partAt(i + down, j + right), pitch * slope - rise});
            }
    }

    const std::vector<Joint>& all() const { return m_joints; }

private:
    std::uint32_t partAt(int i, int j) const
    {
        return m_part[static_cast<std::size_t>(i) * static_cast<std::size_t>(m_height.cols) + static_cast<std::size_t>(j)];
    }

    const cv::Mat& m_height;
    const std::vector<std::uint32_t>& m_part;
    std::vector<Joint> m_joints;
};

}  // namespace

cv::Mat joinedLattices(const Slopes& slopes, const cv::Mat& knownX, const cv::Mat& knownY, const Pitch& pitch)
{
    cv::Mat height = separateLattices(slopes, knownX, knownY, pitch);
    const int rows = height.rows, columns = height.cols;
    const auto place = [columns](int i, int j) {
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(j);
    };
    Parts joined(height.total());
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            if (j > 0 && j + 1 < columns && knownX.at<uchar>(i, j)) joined.join(place(i, j - 1), place(i, j + 1));
            if (i > 0 && i + 1 < rows && knownY.at<uchar>(i, j)) joined.join(place(i - 1, j), place(i + 1, j));
        }
    std::uint32_t count = 0;
    const auto part = joined.numbered(count);
    std::vector<std::uint32_t> sizes(count, 0);
    std::vector<int> lattice(count, 0);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            ++sizes[part[place(i, j)]];
            lattice[part[place(i, j)]] = 2 * (i % 2) + j % 2;
        }
    LatticeJoints joints(height, part);
    joints.addAlong(slopes.x, knownX, pitch.x, 0, 1);
    joints.addAlong(slopes.y, knownY, pitch.y, 1, 0);
    const Joints byPart = sorted(joints.all(), count);
    const PlacedParts placed(byPart, sizes, lattice);

    // What lies in a gap follows the parts around it.
    cv::Mat shift = cv::Mat::zeros(height.size(), CV_64FC1), known(height.size(), CV_8UC1);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const auto own = part[place(i, j)];
            known.at<uchar>(i, j) = placed.placed(own) ? 255 : 0;
            const double base = placed.ofLattice(lattice[own]);
            height.at<double>(i, j) += base;
            if (placed.placed(own)) shift.at<double>(i, j) = placed.offset(own) - base;
        }
    if (cv::countNonZero(known) > 0) height += continued(shift, known);
    return height - cv::mean(height)[0];
}

}  // namespace rendering::signals
