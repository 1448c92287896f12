#include "stats/metrics/ssim_rows.h"

#include <utility>

#include "stats/kernels/vector_clones.h"

namespace stats {
namespace {

// The half width is a constant of the template and the taps are unrolled, so that the sum of a column stays in a
// register.
template <typename Number, std::size_t... tap>
[[gnu::always_inline]] inline void alongOne(const Number* __restrict in, const Number* __restrict weight, Number* __restrict out,
                                            std::index_sequence<tap...>)
{
    constexpr std::size_t half = sizeof...(tap);
    for (std::size_t x = 0; x < ssimTileWidth; ++x)
        out[x] = ((weight[half] * in[x + half]) + ... + (weight[tap] * (in[x + tap] + in[x + 2 * half - tap])));
}

template <std::size_t half, typename Number>
[[gnu::always_inline]] inline void along(const Number* a, const Number* b, const SsimWeights<Number>& weights,
                                         SsimRow<Number>& out)
{
    constexpr std::size_t count = ssimTileWidth + 2 * half;
    constexpr std::make_index_sequence<half> taps;
    Number products[3][count];
    for (std::size_t x = 0; x < count; ++x) {
        products[0][x] = a[x] * a[x];
        products[1][x] = b[x] * b[x];
        products[2][x] = a[x] * b[x];
    }
    alongOne(a, weights.weight, out.quantity[0], taps);
    alongOne(b, weights.weight, out.quantity[1], taps);
    for (std::size_t i = 0; i < 3; ++i) alongOne(products[i], weights.weight, out.quantity[2 + i], taps);
}

template <typename Number, std::size_t... tap>
[[gnu::always_inline]] inline void downOne(const SsimRow<Number>* const* rows, std::size_t q, const Number* __restrict weight,
                                           Number* __restrict out, std::index_sequence<tap...>)
{
    constexpr std::size_t half = sizeof...(tap);
    const Number* const above[] = {rows[tap]->quantity[q]...};
    const Number* const below[] = {rows[2 * half - tap]->quantity[q]...};
    const Number* const centre = rows[half]->quantity[q];
    for (std::size_t x = 0; x < ssimTileWidth; ++x)
        out[x] = ((weight[half] * centre[x]) + ... + (weight[tap] * (above[tap][x] + below[tap][x])));
}

template <std::size_t half, typename Number>
[[gnu::always_inline]] inline void down(const SsimRow<Number>* const* rows, const SsimWeights<Number>& weights,
                                        SsimRow<Number>& out)
{
    for (std::size_t q = 0; q < ssimQuantities; ++q)
        downOne(rows, q, weights.weight, out.quantity[q], std::make_index_sequence<half>());
}

template <typename Number>
[[gnu::always_inline]] inline Number notBelow(Number x, Number limit)
{
    return x < limit ? limit : x;
}

template <typename Number>
[[gnu::always_inline]] inline Number notAbove(Number x, Number limit)
{
    return limit < x ? limit : x;
}

template <typename Number>
[[gnu::always_inline]] inline void similarities(const SsimRow<Number>& sums, const SsimTerms<Number>& terms, Number* values)
{
    const auto& [a, b, aa, bb, ab] = sums.quantity;
    for (std::size_t x = 0; x < ssimTileWidth; ++x) {
        const Number varianceA = terms.momentFactor * notBelow(aa[x] - a[x] * a[x], Number(0));
        const Number varianceB = terms.momentFactor * notBelow(bb[x] - b[x] * b[x], Number(0));
        const Number most = (varianceA + varianceB) / 2;
        const Number covariance = notAbove(notBelow(terms.momentFactor * (ab[x] - a[x] * b[x]), -most), most);
        const Number meanA = terms.shiftA + a[x];
        const Number meanB = terms.shiftB + b[x];
        const Number distance = (terms.shiftA - terms.shiftB) + (a[x] - b[x]);
        // (2 A B + C1)/(A^2 + B^2 + C1), written so that two large means lose no digits of their difference.
        const Number luminance = 1 - distance * distance / (meanA * meanA + meanB * meanB + terms.c1);
        const Number structure = (2 * covariance + terms.c2) / (varianceA + varianceB + terms.c2);
        values[x] = notAbove(notBelow(luminance * structure, Number(-1)), Number(1));
    }
}

template <typename Number>
[[gnu::always_inline]] inline void add(const Number* values, SsimColumns<Number>& columns)
{
    for (std::size_t x = 0; x < ssimTileWidth; ++x) columns.sum[x] += values[x];
    for (std::size_t x = 0; x < ssimTileWidth; ++x) columns.smallest[x] = notAbove(values[x], columns.smallest[x]);
    for (std::size_t x = 0; x < ssimTileWidth; ++x) columns.largest[x] = notBelow(values[x], columns.largest[x]);
}

template <typename Number>
[[gnu::always_inline]] inline std::size_t notFinite(const Number* pixels, std::size_t n)
{
    std::size_t count = 0;
    // A value minus itself is 0 unless it is not finite. This form is vectorised.
    for (std::size_t i = 0; i < n; ++i) count += pixels[i] - pixels[i] == 0 ? 0 : 1;  // NOLINT(misc-redundant-expression)
    return count;
}

}  // namespace

STATS_VECTOR_CLONES std::size_t countNotFinite(const double* pixels, std::size_t n) { return notFinite(pixels, n); }

STATS_VECTOR_CLONES std::size_t countNotFinite(const float* pixels, std::size_t n) { return notFinite(pixels, n); }

STATS_VECTOR_CLONES void filterAlong(const double* a, const double* b, const SsimWeights<double>& weights, SsimRow<double>& out)
{
    weights.half == 5 ? along<5>(a, b, weights, out) : along<3>(a, b, weights, out);
}

STATS_VECTOR_CLONES void filterAlong(const float* a, const float* b, const SsimWeights<float>& weights, SsimRow<float>& out)
{
    weights.half == 5 ? along<5>(a, b, weights, out) : along<3>(a, b, weights, out);
}

STATS_VECTOR_CLONES void filterDown(const SsimRow<double>* const* rows, const SsimWeights<double>& weights, SsimRow<double>& out)
{
    weights.half == 5 ? down<5>(rows, weights, out) : down<3>(rows, weights, out);
}

STATS_VECTOR_CLONES void filterDown(const SsimRow<float>* const* rows, const SsimWeights<float>& weights, SsimRow<float>& out)
{
    weights.half == 5 ? down<5>(rows, weights, out) : down<3>(rows, weights, out);
}

STATS_VECTOR_CLONES void addSimilarities(const SsimRow<double>& sums, const SsimTerms<double>& terms,
                                         SsimColumns<double>& columns)
{
    double values[ssimTileWidth];
    similarities(sums, terms, values);
    add(values, columns);
}

STATS_VECTOR_CLONES void addSimilarities(const SsimRow<float>& sums, const SsimTerms<float>& terms, SsimColumns<float>& columns)
{
    float values[ssimTileWidth];
    similarities(sums, terms, values);
    add(values, columns);
}

}  // namespace stats
