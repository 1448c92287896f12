#include "rendering/signals/tactile/slope_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace rendering::signals {

namespace {

constexpr int blockPx = 64;  ///< pixels of a block, whose monomials fit into the first-level cache

/// Inputs of a block of pixels, one row for each input.
class Inputs {
public:
    Inputs(int channels, bool byPlace, double lightScale)
        : m_channels(channels),
          m_byPlace(byPlace),
          m_scale(static_cast<float>(lightScale)),
          m_values(static_cast<std::size_t>((channels + 2) * blockPx))
    {
    }
    int count() const { return m_channels + (m_byPlace ? 2 : 0); }
    float* row(int input) { return m_values.data() + static_cast<std::ptrdiff_t>(input) * blockPx; }

    void take(const cv::Mat& light, int y, int x, int length)
    {
        const float* pixel = light.ptr<float>(y) + static_cast<std::ptrdiff_t>(x) * m_channels;
        for (int c = 0; c < m_channels; ++c)
            for (int i = 0; i < length; ++i) row(c)[i] = m_scale * pixel[i * m_channels + c];
        if (!m_byPlace) return;
        for (int i = 0; i < length; ++i) row(m_channels)[i] = frameCoordinate(x + i, light.cols);
        std::fill_n(row(m_channels + 1), length, frameCoordinate(y, light.rows));
    }

private:
    int m_channels;
    bool m_byPlace;
    float m_scale;
    std::vector<float> m_values;
};

/// Monomials of a block of pixels and their weighted sums. Compiled for AVX2 as well; no product is fused, so the bits are equal.
__attribute__((target_clones("avx2", "default"))) void sumMonomials(const std::vector<Monomial>& all, const float* weightsX,
                                                                    const float* weightsY, const float* inputs, float* products,
                                                                    float* __restrict sumsX, float* __restrict sumsY)
{
    for (int i = 0; i < blockPx; ++i) sumsX[i] = weightsX[0];
    for (int i = 0; i < blockPx; ++i) sumsY[i] = weightsY[0];
    for (std::size_t m = 1; m < all.size(); ++m) {
        const float* __restrict parent = products + static_cast<std::ptrdiff_t>(all[m].parent) * blockPx;
        const float* __restrict factor = inputs + static_cast<std::ptrdiff_t>(all[m].factor) * blockPx;
        float* __restrict product = products + m * blockPx;
        const float x = weightsX[m], y = weightsY[m];
        for (int i = 0; i < blockPx; ++i) product[i] = parent[i] * factor[i];
        for (int i = 0; i < blockPx; ++i) sumsX[i] += x * product[i];
        for (int i = 0; i < blockPx; ++i) sumsY[i] += y * product[i];
    }
}

std::array<std::vector<float>, 2> narrowed(const std::array<std::vector<double>, 2>& values)
{
    return {std::vector<float>(values[0].begin(), values[0].end()), std::vector<float>(values[1].begin(), values[1].end())};
}

/// Fills slopes block by block: `work(inputs, length, x, y)` computes dh/dx and dh/dy of one block.
template <class Work>
Slopes byBlocks(const cv::Mat& light, Inputs inputs, Work work)
{
    Slopes slopes{cv::Mat(light.size(), CV_32FC1), cv::Mat(light.size(), CV_32FC1)};
    for (int y = 0; y < light.rows; ++y)
        for (int x = 0; x < light.cols; x += blockPx) {
            const int length = std::min(blockPx, light.cols - x);
            inputs.take(light, y, x, length);
            work(inputs, length, slopes.x.ptr<float>(y) + x, slopes.y.ptr<float>(y) + x);
        }
    return slopes;
}

Slopes slopesBy(const LinearMap& map, const cv::Mat& light)
{
    const int channels = light.channels();
    CV_Assert(static_cast<int>(map.gain[0].size()) == channels && static_cast<int>(map.gain[1].size()) == channels);
    const auto gains = narrowed(map.gain);
    return byBlocks(light, Inputs(channels, false, 1), [&](Inputs& inputs, int length, float* x, float* y) {
        std::fill_n(x, length, static_cast<float>(map.offset[0]));
        std::fill_n(y, length, static_cast<float>(map.offset[1]));
        for (int c = 0; c < channels; ++c) {
            const float* value = inputs.row(c);
            const float gx = gains[0][static_cast<std::size_t>(c)], gy = gains[1][static_cast<std::size_t>(c)];
            for (int i = 0; i < length; ++i) x[i] += gx * value[i];
            for (int i = 0; i < length; ++i) y[i] += gy * value[i];
        }
    });
}

Slopes slopesBy(const PolynomialMap& map, const cv::Mat& light)
{
    Inputs inputs(light.channels(), map.byPlace, map.lightScale);
    const auto all = monomials(inputs.count(), map.degree);
    CV_Assert(map.coefficients[0].size() == all.size() && map.coefficients[1].size() == all.size());
    const auto coefficients = narrowed(map.coefficients);
    std::vector<float> products(all.size() * blockPx, 1.F);
    std::array<float, blockPx> sumsX{}, sumsY{};
    return byBlocks(light, inputs, [&](Inputs& block, int length, float* x, float* y) {
        sumMonomials(all, coefficients[0].data(), coefficients[1].data(), block.row(0), products.data(), sumsX.data(),
                     sumsY.data());
        std::copy_n(sumsX.data(), length, x);
        std::copy_n(sumsY.data(), length, y);
    });
}

Slopes outputsOf(const NetworkMap& map, const cv::Mat& light)
{
    const Inputs inputs(light.channels(), map.byPlace, map.lightScale);
    CV_Assert(!map.sizes.empty() && map.sizes.front() == inputs.count() && map.sizes.back() == 2);
    std::vector<std::vector<float>> weights;
    for (const auto& layer : map.weights) weights.emplace_back(layer.begin(), layer.end());
    const auto widest = static_cast<std::size_t>(*std::max_element(map.sizes.begin(), map.sizes.end()));
    std::vector<float> from(widest * blockPx), to(widest * blockPx);
    return byBlocks(light, inputs, [&](Inputs& block, int length, float* x, float* y) {
        for (int i = 0; i < map.sizes.front(); ++i) std::copy_n(block.row(i), length, from.data() + i * blockPx);
        for (std::size_t layer = 0; layer < weights.size(); ++layer) {
            const int inCount = map.sizes[layer], outCount = map.sizes[layer + 1];
            const bool last = layer + 1 == weights.size();
            for (int out = 0; out < outCount; ++out) {
                const float* w = weights[layer].data() + static_cast<std::ptrdiff_t>(out) * (inCount + 1);
                float* sum = last ? (out == 0 ? x : y) : to.data() + out * blockPx;
                std::fill_n(sum, length, w[inCount]);
                for (int in = 0; in < inCount; ++in)
                    for (int i = 0; i < length; ++i) sum[i] += w[in] * from[static_cast<std::size_t>(in * blockPx + i)];
                if (!last) std::transform(sum, sum + length, sum, [](float value) { return std::tanh(value); });
            }
            std::swap(from, to);
        }
    });
}

Slopes slopesBy(const NetworkMap& map, const cv::Mat& light)
{
    const Slopes lit = outputsOf(map, light), rest = outputsOf(map, cv::Mat::zeros(light.size(), light.type()));
    return {lit.x - rest.x, lit.y - rest.y};
}

}  // namespace

float frameCoordinate(int index, int length) { return length > 1 ? static_cast<float>(2.0 * index / (length - 1) - 1) : 0.F; }

std::string_view kindOf(const SlopeMap& map)
{
    static constexpr std::string_view kinds[] = {"linear", "polynomial", "network"};
    return kinds[map.index()];
}

std::vector<Monomial> monomials(int inputs, int degree)
{
    std::vector<Monomial> all{{}};
    std::size_t first = 0;
    for (int d = 1; d <= degree; ++d) {
        const std::size_t end = all.size();
        for (std::size_t parent = first; parent < end; ++parent)
            for (int factor = std::max(0, all[parent].factor); factor < inputs; ++factor)
                all.push_back({static_cast<int>(parent), factor});
        first = end;
    }
    return all;
}

Slopes slopesOf(const SlopeMap& map, const cv::Mat& light)
{
    CV_Assert(light.depth() == CV_32F);
    return std::visit([&light](const auto& known) { return slopesBy(known, light); }, map);
}

}  // namespace rendering::signals
