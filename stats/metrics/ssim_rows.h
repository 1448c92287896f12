// The three inner loops of structural similarity over one row of a tile, for 64- and 32-bit numbers.
#pragma once

#include <cstddef>

namespace stats {

/// Number of windows across a tile, and width of the widest window.
constexpr std::size_t ssimTileWidth = 64;
constexpr std::size_t ssimWidestWindow = 11;

/// Number of weighted sums: of a, b, a^2, b^2 and ab.
constexpr std::size_t ssimQuantities = 5;

template <typename Number>
struct SsimRow {
    Number quantity[ssimQuantities][ssimTileWidth];
};

/// A symmetric window of 2 half + 1 weights, half 5 or 3; only the first half + 1 are stored, the centre last.
template <typename Number>
struct SsimWeights {
    Number weight[ssimWidestWindow / 2 + 1];
    std::size_t half;
};

template <typename Number>
struct SsimTerms {
    Number shiftA;  ///< subtracted from the pixels of a
    Number shiftB;
    Number c1;
    Number c2;
    Number momentFactor;  ///< 1, or N / (N - 1)
};

/// Sum and extremes of the similarities, one entry for each column of a tile.
template <typename Number>
struct SsimColumns {
    Number sum[ssimTileWidth];
    Number smallest[ssimTileWidth];
    Number largest[ssimTileWidth];
};

// All functions work on ssimTileWidth columns; a narrower tile ignores the surplus.

/// Filters along a row. a, b: ssimTileWidth + 2 half shifted pixels.
void filterAlong(const double* a, const double* b, const SsimWeights<double>& weights, SsimRow<double>& out);
void filterAlong(const float* a, const float* b, const SsimWeights<float>& weights, SsimRow<float>& out);

/// Filters down the columns. rows: 2 half + 1 filtered rows, from top to bottom.
void filterDown(const SsimRow<double>* const* rows, const SsimWeights<double>& weights, SsimRow<double>& out);
void filterDown(const SsimRow<float>* const* rows, const SsimWeights<float>& weights, SsimRow<float>& out);

/// Adds the similarity of one window in each column.
void addSimilarities(const SsimRow<double>& sums, const SsimTerms<double>& terms, SsimColumns<double>& columns);
void addSimilarities(const SsimRow<float>& sums, const SsimTerms<float>& terms, SsimColumns<float>& columns);

/// Number of NaN and infinite pixels among n.
std::size_t countNotFinite(const double* pixels, std::size_t n);
std::size_t countNotFinite(const float* pixels, std::size_t n);

}  // namespace stats
