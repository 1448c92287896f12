#include "stats/models/row_blocks.h"

#include <algorithm>
#include <utility>

#include "stats/models/mixed_model_rows.h"

namespace stats {
namespace {

constexpr std::size_t inNoBlock = static_cast<std::size_t>(-1);

double cubeOf(std::size_t n) { return static_cast<double>(n) * static_cast<double>(n) * static_cast<double>(n); }

bool liesInOneBlockEach(const Factor& group, std::span<const std::size_t> block)
{
    std::vector<std::size_t> known(group.levels.size(), inNoBlock);
    for (std::size_t row = 0; row < block.size(); ++row) {
        std::size_t& own = known[group.of[row]];
        if (own == inNoBlock) own = block[row];
        if (own != block[row]) return false;
    }
    return true;
}

/// Counts a number once a block.
class Once {
public:
    explicit Once(std::size_t numbers) : m_seenIn(numbers, inNoBlock) {}
    std::size_t count(std::size_t number, std::size_t block) { return std::exchange(m_seenIn[number], block) == block ? 0 : 1; }

private:
    std::vector<std::size_t> m_seenIn;
};

void putWork(RowBlocks& blocks, std::span<const RandomTerm> terms, const FixedRows& fixed, std::size_t fixedCount)
{
    std::vector<Once> ofTerms;
    std::size_t border = fixedCount;
    for (std::size_t t = 0; t < terms.size(); ++t) {
        ofTerms.emplace_back(terms[t].group.levels.size());
        if (!blocks.nested[t]) border += terms[t].group.levels.size();
    }
    Once ofFixed(fixedCount);
    blocks.work = 4 * cubeOf(border);
    const auto rows = rowsByBlock(blocks);
    for (std::size_t b = 0; b < blocks.count; ++b) {
        std::size_t own = 0, touched = 0;
        for (const std::size_t row : rows[b]) {
            for (std::size_t t = 0; t < terms.size(); ++t)
                (blocks.nested[t] ? own : touched) += ofTerms[t].count(terms[t].group.of[row], b);
            for (std::size_t k = fixed.starts[row]; k < fixed.starts[row + 1]; ++k) touched += ofFixed.count(fixed.columns[k], b);
        }
        const auto n = static_cast<double>(own), m = static_cast<double>(touched);
        blocks.work += 2 * n * (n * n + n * m + m * m);
    }
}

RowBlocks blocksOf(std::vector<std::size_t> of, std::span<const RandomTerm> terms)
{
    RowBlocks blocks{std::move(of), 0, {}, 0};
    for (const std::size_t block : blocks.of) blocks.count = std::max(blocks.count, block + 1);
    for (const RandomTerm& term : terms) blocks.nested.push_back(liesInOneBlockEach(term.group, blocks.of));
    return blocks;
}

}  // namespace

RowBlocks cheapestBlocks(const FixedEffects& fixed, std::span<const RandomTerm> terms)
{
    const FixedRows rows = fixedRows(fixed);
    std::vector<std::vector<std::size_t>> divisions;
    for (const RandomTerm& term : terms) divisions.push_back(term.group.of);
    if (auto condition = codedLevels(fixed); condition && fixed.columns.size() > 1) divisions.push_back(std::move(*condition));
    RowBlocks best;
    for (std::vector<std::size_t>& division : divisions) {
        RowBlocks blocks = blocksOf(std::move(division), terms);
        putWork(blocks, terms, rows, fixed.columns.size());
        if (best.count == 0 || blocks.work < best.work) best = std::move(blocks);
    }
    return best;
}

std::vector<std::vector<std::size_t>> rowsByBlock(const RowBlocks& blocks)
{
    std::vector<std::vector<std::size_t>> rows(blocks.count);
    for (std::size_t row = 0; row < blocks.of.size(); ++row) rows[blocks.of[row]].push_back(row);
    return rows;
}

FixedRows fixedRows(const FixedEffects& fixed)
{
    FixedRows result;
    for (std::size_t row = 0; row < fixed.columns.front().size(); ++row) {
        for (std::size_t j = 0; j < fixed.columns.size(); ++j) {
            if (fixed.columns[j][row] == 0) continue;
            result.columns.push_back(j);
            result.values.push_back(fixed.columns[j][row]);
        }
        result.starts.push_back(result.columns.size());
    }
    return result;
}

}  // namespace stats
