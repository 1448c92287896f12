#include "protocols/orders/same_different.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "protocols/orders/annealing.h"
#include "protocols/orders/sequence_counts.h"

namespace protocols {

namespace {

using Orders = std::vector<std::vector<Rendering>>;
using Places = std::vector<std::size_t>;

// Halves and other pieces count more than pairs.
constexpr std::int64_t costOfHalf = 64;
constexpr std::int64_t costOfOther = 64;

std::vector<int> shuffledRange(int count, Random& random)
{
    std::vector<int> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), 0);
    random.shuffle(numbers);
    return numbers;
}

/// Two fabrics and an odd number of labels, or three fabrics and one label. If each piece lay there equally often, halves of one
/// participant would be impossible: one tray that is left cannot be given another of the same few fabrics.
bool hasLeftOverTray(const StudySize& size)
{
    return (size.fabrics == 2 && size.labels % 2 == 1) || (size.fabrics == 3 && size.labels == 1);
}

/// Which presentations are "same". The parity of the sum of three shuffled numbers halves every margin at once.
class Halves {
public:
    Halves(const StudySize& size, Random& random)
        : m_people(shuffledRange(size.participants, random)),
          m_labels(shuffledRange(size.labels, random)),
          m_fabrics(shuffledRange(size.fabrics, random)),
          m_isRotated(hasLeftOverTray(size) && size.fabrics == 3)
    {
        // An odd number of presentations has one "same" more, or one less.
        if (size.participants % 2 == 1 && size.labels % 2 == 1 && size.fabrics % 2 == 1)
            m_turn = static_cast<int>(random.below(2));
    }

    bool isSame(std::size_t participant, int label, int fabric) const
    {
        if (m_isRotated) {
            const int rank = rankOf(participant, fabric);
            return rank == 0 || (rank == 1 && (m_people[participant] + m_turn) % 2 == 0);
        }
        return (m_people[participant] + m_labels[static_cast<std::size_t>(label)] + m_fabrics[static_cast<std::size_t>(fabric)] +
                m_turn) %
                   2 ==
               0;
    }

    /// Where a tray is left over: 0 for the fabric that lies there once more, and the last for the one that lies there once less.
    int rankOf(std::size_t participant, int fabric) const
    {
        const int kinds = static_cast<int>(m_fabrics.size());
        return (m_people[participant] + m_fabrics[static_cast<std::size_t>(fabric)]) % kinds;
    }

    /// The labels that a fabric has where it is the same, or where it is not.
    std::vector<int> labelsOf(std::size_t participant, int fabric, bool same) const
    {
        std::vector<int> labels;
        for (int label = 0; label < static_cast<int>(m_labels.size()); ++label)
            if (isSame(participant, label, fabric) == same) labels.push_back(label);
        return labels;
    }

private:
    std::vector<int> m_people, m_labels, m_fabrics;
    bool m_isRotated = false;
    int m_turn = 0;
};

/// The pieces on the trays. One that is left over lies there in place of another.
Orders laidPieces(Orders pieces, const StudySize& size, const Halves& halves, Random& random)
{
    if (!hasLeftOverTray(size)) return pieces;
    for (std::size_t participant = 0; participant < pieces.size(); ++participant) {
        auto& own = pieces[participant];
        int more = 0;
        Places less;
        for (int fabric = 0; fabric < size.fabrics; ++fabric)
            if (halves.rankOf(participant, fabric) == 0) more = fabric;
        for (std::size_t at = 0; at < own.size(); ++at)
            if (halves.rankOf(participant, own[at].fabric) == size.fabrics - 1) less.push_back(at);
        own[less[random.below(less.size())]].fabric = more;
    }
    return pieces;
}

/// What a participant sees beside the trays that are not the same, where the piece of one is left over.
void showTheOnlyOthers(std::vector<Rendering>& order, const std::vector<Rendering>& pieces, const Places& places,
                       const std::vector<bool>& same, int fabrics)
{
    std::vector<int> left(static_cast<std::size_t>(fabrics), static_cast<int>(order.size()) / fabrics);
    for (std::size_t at = 0; at < order.size(); ++at)
        if (same[at]) --left[static_cast<std::size_t>(order[at].fabric)];
    for (const std::size_t at : places) {
        // Of two that may be shown, the one that no other tray may show.
        const auto mayShow = [&](std::size_t tray, int fabric) {
            return pieces[tray].fabric != fabric && left[static_cast<std::size_t>(fabric)] > 0;
        };
        int best = 0, fewest = static_cast<int>(places.size()) + 1;
        for (int fabric = 0; fabric < fabrics; ++fabric) {
            const auto trays = static_cast<int>(std::ranges::count_if(places, [&](auto tray) { return mayShow(tray, fabric); }));
            if (!mayShow(at, fabric) || trays >= fewest) continue;
            best = fabric;
            fewest = trays;
        }
        order[at].fabric = best;
        --left[static_cast<std::size_t>(best)];
    }
}

/// [participant][position]: a random half of the trays of each piece.
std::vector<std::vector<bool>> drawSame(const Orders& pieces, const StudySize& size, const Halves& halves, Random& random)
{
    std::vector<std::vector<bool>> same;
    for (std::size_t participant = 0; participant < pieces.size(); ++participant) {
        auto& own = same.emplace_back(pieces[participant].size());
        for (int fabric = 0; fabric < size.fabrics; ++fabric) {
            std::vector<std::size_t> places;
            for (std::size_t at = 0; at < own.size(); ++at)
                if (pieces[participant][at].fabric == fabric) places.push_back(at);
            random.shuffle(places);
            places.resize(halves.labelsOf(participant, fabric, true).size());
            for (const std::size_t at : places) own[at] = true;
        }
    }
    return same;
}

/// State of the search: what is shown beside each tray. A move exchanges two renderings that are not the same as their pieces, or
/// the labels of two presentations of one fabric. Trays and what is the same never change.
class ShownSearch {
public:
    ShownSearch(const Orders& pieces, const std::vector<std::vector<bool>>& same, const StudySize& size,
                const std::vector<Places>& others, const Copies& copies, Orders orders)
        : m_pieces(pieces),
          m_same(same),
          m_others(others),
          m_orders(std::move(orders)),
          m_labels(static_cast<std::size_t>(size.labels)),
          m_fabrics(static_cast<std::size_t>(size.fabrics)),
          m_labelOrder(size.labels, pieces.size(), pieces.front().size()),
          m_fabricOrder(size.fabrics, pieces.size(), pieces.front().size()),
          m_beside(m_fabrics * m_fabrics),
          m_sameOfCell(m_labels * m_fabrics),
          m_sameOfPerson(pieces.size() * m_labels),
          m_repetitions(copies, size, pieces.front().size())
    {
        const std::size_t length = pieces.front().size();
        m_excess = -m_labelOrder.least() - m_fabricOrder.least() - m_repetitions.least();
        std::vector<std::int64_t> sameOf(m_fabrics), otherOf(m_fabrics);
        for (std::size_t participant = 0; participant < pieces.size(); ++participant) {
            for (std::size_t at = 0; at < length; ++at) {
                const auto fabric = static_cast<std::size_t>(m_orders[participant][at].fabric);
                ++(same[participant][at] ? sameOf : otherOf)[fabric];
                countPlace(participant, at, true);
                if (at > 0) countStep(participant, at - 1, true);
            }
            m_excess += m_repetitions.addAll(participant, m_orders[participant]);
            m_excess -= costOfHalf * leastSquares(std::ranges::count(same[participant], true), size.labels);
        }
        for (const std::int64_t count : sameOf) m_excess -= costOfHalf * leastSquares(count, size.labels);
        for (const std::int64_t count : otherOf) m_excess -= costOfOther * leastSquares(count, size.fabrics - 1);
    }

    std::int64_t excess() const { return m_excess; }
    const Orders& orders() const { return m_orders; }

    std::int64_t applyRandomMove(Random& random)
    {
        m_participant = random.below(m_orders.size());
        const auto& order = m_orders[m_participant];
        const auto& places = m_others[m_participant];
        m_swapsAll = !places.empty() && random.below(2) == 0;
        if (m_swapsAll) {
            m_first = places[random.below(places.size())];
            m_second = places[random.below(places.size())];
            const auto& own = m_pieces[m_participant];
            m_moves = m_first != m_second && order[m_first].fabric != own[m_second].fabric &&
                      order[m_second].fabric != own[m_first].fabric;
        } else {
            m_first = m_second = random.below(order.size());
            for (auto steps = 1 + random.below(m_labels); steps > 0; --steps) m_second = nextOfFabric(order, m_second);
            m_moves = m_first != m_second;
        }
        return exchange();
    }

    void undoMove() { exchange(); }

private:
    /// The next place, in a circle, that shows the same fabric.
    static std::size_t nextOfFabric(const std::vector<Rendering>& order, std::size_t at)
    {
        const int fabric = order[at].fabric;
        do at = at + 1 == order.size() ? 0 : at + 1;
        while (order[at].fabric != fabric);
        return at;
    }

    std::int64_t exchange()
    {
        if (!m_moves) return 0;
        const std::int64_t before = m_excess;
        auto& order = m_orders[m_participant];
        countAround(false);
        std::swap(order[m_first].label, order[m_second].label);
        if (m_swapsAll) std::swap(order[m_first].fabric, order[m_second].fabric);
        countAround(true);
        return m_excess - before;
    }

    /// The two places, their transitions and their repetitions, each once.
    void countAround(bool adding)
    {
        m_excess += m_repetitions.around(m_participant, m_orders[m_participant], m_first, m_second, adding);
        const std::size_t low = std::min(m_first, m_second), high = std::max(m_first, m_second);
        countPlace(m_participant, low, adding);
        countPlace(m_participant, high, adding);
        if (low > 0) countStep(m_participant, low - 1, adding);
        countStep(m_participant, low, adding);
        if (high - 1 > low) countStep(m_participant, high - 1, adding);
        if (high + 1 < m_orders[m_participant].size()) countStep(m_participant, high, adding);
    }

    static std::int64_t change(SquaredCounts& counts, std::size_t cell, bool adding)
    {
        return adding ? counts.add(cell) : counts.remove(cell);
    }

    void countPlace(std::size_t participant, std::size_t at, bool adding)
    {
        const Rendering& shown = m_orders[participant][at];
        const auto label = static_cast<std::size_t>(shown.label), fabric = static_cast<std::size_t>(shown.fabric);
        const auto piece = static_cast<std::size_t>(m_pieces[participant][at].fabric);
        m_excess += m_labelOrder.place(at, shown.label, adding) + m_fabricOrder.place(at, shown.fabric, adding);
        if (m_same[participant][at])
            m_excess += costOfHalf * (change(m_sameOfCell, label * m_fabrics + fabric, adding) +
                                      change(m_sameOfPerson, participant * m_labels + label, adding));
        else
            m_excess += costOfOther * change(m_beside, fabric * m_fabrics + piece, adding);
    }

    void countStep(std::size_t participant, std::size_t at, bool adding)
    {
        const Rendering &from = m_orders[participant][at], &to = m_orders[participant][at + 1];
        m_excess += m_labelOrder.step(from.label, to.label, adding) + m_fabricOrder.step(from.fabric, to.fabric, adding);
    }

    const Orders& m_pieces;
    const std::vector<std::vector<bool>>& m_same;
    const std::vector<Places>& m_others;
    Orders m_orders;
    std::size_t m_labels, m_fabrics;
    SequenceCounts m_labelOrder, m_fabricOrder;
    SquaredCounts m_beside;        ///< [shown][on the tray], where they differ
    SquaredCounts m_sameOfCell;    ///< [label][fabric], where they are the same
    SquaredCounts m_sameOfPerson;  ///< [participant][label], where they are the same
    RepetitionCounts m_repetitions;
    std::int64_t m_excess = 0;
    std::size_t m_participant = 0, m_first = 0, m_second = 0;
    bool m_moves = false, m_swapsAll = false;
};

/// [participant]: the places where the rendering is not that of the piece.
std::vector<Places> placesOfOthers(const std::vector<std::vector<bool>>& same)
{
    std::vector<Places> places;
    for (const auto& own : same) {
        auto& list = places.emplace_back();
        for (std::size_t at = 0; at < own.size(); ++at)
            if (!own[at]) list.push_back(at);
    }
    return places;
}

/// Gives every place that is left a fabric of another such place that does not lie there: the places in groups of one piece,
/// turned by the size of the greatest group.
void exchangeOthers(std::vector<Rendering>& order, const std::vector<Rendering>& pieces, Places places, int fabrics,
                    Random& random)
{
    const auto ranks = shuffledRange(fabrics, random);
    const auto rankOf = [&](std::size_t at) { return ranks[static_cast<std::size_t>(pieces[at].fabric)]; };
    random.shuffle(places);
    std::ranges::stable_sort(places, {}, rankOf);
    std::size_t greatest = 0;
    for (std::size_t begin = 0, at = 0; at < places.size(); ++at) {
        if (rankOf(places[begin]) != rankOf(places[at])) begin = at;
        greatest = std::max(greatest, at + 1 - begin);
    }
    for (std::size_t i = 0; i < places.size(); ++i)
        order[places[i]].fabric = pieces[places[(i + greatest) % places.size()]].fabric;
}

/// Gives every shown fabric its labels, so that the halves are exact.
void drawLabels(Orders& orders, const std::vector<std::vector<bool>>& same, const StudySize& size, const Halves& halves,
                Random& random)
{
    for (std::size_t participant = 0; participant < orders.size(); ++participant)
        for (int fabric = 0; fabric < size.fabrics; ++fabric)
            for (const bool isSame : {true, false}) {
                auto labels = halves.labelsOf(participant, fabric, isSame);
                random.shuffle(labels);
                for (std::size_t at = 0; at < orders[participant].size(); ++at) {
                    Rendering& shown = orders[participant][at];
                    if (shown.fabric != fabric || same[participant][at] != isSame) continue;
                    shown.label = labels.back();
                    labels.pop_back();
                }
            }
}

}  // namespace

SameDifferentOrders drawSameDifferent(const Orders& drawnPieces, const StudySize& size, Random& random, const Copies& copies)
{
    const Halves halves(size, random);
    const Orders pieces = laidPieces(drawnPieces, size, halves, random);
    const auto same = drawSame(pieces, size, halves, random);
    // From here on, nothing changes what lies on a tray or which trays are the same.
    Orders orders = pieces;
    const auto others = placesOfOthers(same);
    for (std::size_t participant = 0; participant < pieces.size(); ++participant)
        if (hasLeftOverTray(size))
            showTheOnlyOthers(orders[participant], pieces[participant], others[participant], same[participant], size.fabrics);
        else
            exchangeOthers(orders[participant], pieces[participant], others[participant], size.fabrics, random);
    drawLabels(orders, same, size, halves, random);
    const std::int64_t count = std::int64_t{size.participants} * size.labels * size.fabrics;
    ShownSearch search(pieces, same, size, others, copies, std::move(orders));
    annealAgain(search, random, {.moves = std::clamp<std::int64_t>(count * 2000, 100'000, 3'000'000), .hot = 64});
    SameDifferentOrders drawn{search.orders(), {}};
    for (const auto& list : pieces) {
        auto& trays = drawn.trays.emplace_back();
        for (const Rendering& piece : list) trays.push_back({piece.fabric});
    }
    return drawn;
}

}  // namespace protocols
