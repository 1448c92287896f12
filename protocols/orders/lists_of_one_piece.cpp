#include "protocols/orders/lists_of_one_piece.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "protocols/orders/annealing.h"
#include "protocols/orders/laid_pieces.h"
#include "protocols/orders/same_different.h"
#include "protocols/orders/sequence_counts.h"

namespace protocols {

namespace {

using Orders = std::vector<std::vector<Rendering>>;
using Places = std::vector<std::size_t>;

/// State of the search: the conditions beside pieces that no longer change. A move exchanges those of two presentations of one
/// fabric.
class LabelSearch {
public:
    LabelSearch(const StudySize& size, const Copies& copies, Orders orders)
        : m_orders(std::move(orders)),
          m_labels(size.labels, m_orders.size(), m_orders.front().size()),
          m_repetitions(copies, size, m_orders.front().size()),
          m_excess(-m_labels.least() - m_repetitions.least())
    {
        for (std::size_t participant = 0; participant < m_orders.size(); ++participant) {
            const auto& order = m_orders[participant];
            auto& places = m_places.emplace_back(static_cast<std::size_t>(size.fabrics));
            for (std::size_t at = 0; at < order.size(); ++at) {
                places[static_cast<std::size_t>(order[at].fabric)].push_back(at);
                m_excess += m_labels.place(at, order[at].label, true);
                if (at > 0) m_excess += m_labels.step(order[at - 1].label, order[at].label, true);
            }
            m_excess += m_repetitions.addAll(participant, order);
        }
    }

    std::int64_t excess() const { return m_excess; }
    const Orders& orders() const { return m_orders; }

    std::int64_t applyRandomMove(Random& random)
    {
        m_participant = random.below(m_orders.size());
        m_first = random.below(m_orders[m_participant].size());
        const auto fabric = static_cast<std::size_t>(m_orders[m_participant][m_first].fabric);
        const Places& places = m_places[m_participant][fabric];
        m_second = places[random.below(places.size())];
        return exchange();
    }

    void undoMove() { exchange(); }

private:
    std::int64_t exchange()
    {
        if (m_first == m_second) return 0;
        const std::int64_t before = m_excess;
        auto& order = m_orders[m_participant];
        countAround(order, false);
        std::swap(order[m_first].label, order[m_second].label);
        countAround(order, true);
        return m_excess - before;
    }

    /// The two places, their transitions and their repetitions, each once.
    void countAround(const std::vector<Rendering>& order, bool adding)
    {
        const std::size_t low = std::min(m_first, m_second), high = std::max(m_first, m_second);
        const auto step = [&](std::size_t at) { m_excess += m_labels.step(order[at].label, order[at + 1].label, adding); };
        m_excess += m_labels.place(low, order[low].label, adding) + m_labels.place(high, order[high].label, adding);
        if (low > 0) step(low - 1);
        step(low);
        if (high - 1 > low) step(high - 1);
        if (high + 1 < order.size()) step(high);
        m_excess += m_repetitions.around(m_participant, order, m_first, m_second, adding);
    }

    Orders m_orders;
    SequenceCounts m_labels;
    RepetitionCounts m_repetitions;
    std::int64_t m_excess;
    std::vector<std::vector<Places>> m_places;  ///< [participant][fabric]
    std::size_t m_participant = 0, m_first = 0, m_second = 0;
};

/// Each piece of a participant gets each label once.
Orders drawConditions(Orders pieces, const StudySize& size, const Copies& copies, Random& random)
{
    for (auto& order : pieces) {
        std::vector<std::vector<int>> labels(static_cast<std::size_t>(size.fabrics));
        for (auto& own : labels) {
            own.resize(static_cast<std::size_t>(size.labels));
            std::iota(own.begin(), own.end(), 0);
            random.shuffle(own);
        }
        for (Rendering& rendering : order) {
            auto& own = labels[static_cast<std::size_t>(rendering.fabric)];
            rendering.label = own.back();
            own.pop_back();
        }
    }
    const std::int64_t count = std::int64_t{size.participants} * size.labels * size.fabrics;
    LabelSearch search(size, copies, std::move(pieces));
    anneal(search, random, {.moves = std::clamp<std::int64_t>(count * 2000, 100'000, 3'000'000), .hot = 16});
    return search.orders();
}

/// [place of the whole list]: the place among the presentations of the conditions.
Places placesWithoutOthers(const LaidPieces& laid)
{
    Places places;
    std::size_t next = 0;
    for (const Presented kind : laid.kinds) {
        places.push_back(next);
        next += kind == Presented::OfCondition;
    }
    for (const auto& [place, original] : laid.repetitions) places[place] = places[original];
    return places;
}

std::vector<Copy> copiesIn(const LaidPieces& laid)
{
    const Places places = placesWithoutOthers(laid);
    const auto showsLabel = [&](std::size_t at) {
        return at < laid.kinds.size() && (laid.kinds[at] == Presented::OfCondition || laid.kinds[at] == Presented::Repeated);
    };
    std::vector<Copy> copies;
    for (const auto& [place, original] : laid.repetitions) {
        Copy& copy = copies.emplace_back(Copy{places[original], {}});
        for (const std::size_t neighbour : {place - 1, place + 1})
            if (showsLabel(neighbour)) copy.neighbours.push_back(places[neighbour]);
    }
    return copies;
}

std::vector<Rendering> piecesOfConditions(const LaidPieces& laid)
{
    std::vector<Rendering> order;
    for (std::size_t at = 0; at < laid.pieces.size(); ++at)
        if (laid.kinds[at] == Presented::OfCondition) order.push_back({0, laid.pieces[at]});
    return order;
}

/// An image of another fabric beside each mismatched piece.
class MismatchedImages {
public:
    explicit MismatchedImages(int fabrics)
        : m_fabrics(static_cast<std::size_t>(fabrics)), m_images(m_fabrics), m_pairs(m_fabrics * m_fabrics)
    {
    }

    /// [mismatched presentation]: another fabric, and none a second time before all were shown. The evenest of several draws.
    std::vector<int> draw(const LaidPieces& laid, Random& random)
    {
        constexpr int draws = 20;
        Places places;
        for (std::size_t at = 0; at < laid.kinds.size(); ++at)
            if (laid.kinds[at] == Presented::Mismatched) places.push_back(at);
        Drawn best;
        std::size_t least = 0;
        for (int draw = 0; draw < draws && !places.empty(); ++draw) {
            Drawn next = drawOnce(laid, places, random);
            const std::size_t uneven = unevennessOf(next);
            if (draw > 0 && uneven >= least) continue;
            best = std::move(next);
            least = uneven;
        }
        if (!places.empty()) {
            m_images = best.images;
            m_pairs = best.pairs;
        }
        return best.fabrics;
    }

private:
    struct Drawn {
        std::vector<int> fabrics;
        std::vector<std::size_t> shown, images, pairs;  ///< counts, with those of earlier participants in the last two
        std::size_t besideItsPiece = 0;
    };

    Drawn drawOnce(const LaidPieces& laid, const Places& places, Random& random) const
    {
        Drawn drawn{std::vector<int>(places.size()), Places(m_fabrics), m_images, m_pairs, 0};
        std::vector<std::size_t> turns(places.size());
        std::iota(turns.begin(), turns.end(), std::size_t{0});
        random.shuffle(turns);
        for (const std::size_t turn : turns) {
            const std::size_t at = places[turn];
            const auto piece = static_cast<std::size_t>(laid.pieces[at]);
            const auto pairOf = [&](std::size_t image) { return image * m_fabrics + piece; };
            const auto liesBeside = [&](std::size_t image) {
                const auto lies = [&](std::size_t other) {
                    return other < laid.pieces.size() && laid.pieces[other] == static_cast<int>(image);
                };
                return m_fabrics > 3 && (lies(at - 1) || lies(at + 1));
            };
            const auto usesOf = [&](std::size_t image) {
                return std::tuple(image == piece, drawn.shown[image], drawn.images[image], drawn.pairs[pairOf(image)],
                                  liesBeside(image));
            };
            std::vector<std::size_t> images(m_fabrics);
            std::iota(images.begin(), images.end(), std::size_t{0});
            random.shuffle(images);
            const std::size_t image = *std::ranges::min_element(images, {}, usesOf);
            drawn.besideItsPiece += liesBeside(image);
            drawn.fabrics[turn] = static_cast<int>(image);
            ++drawn.shown[image];
            ++drawn.images[image];
            ++drawn.pairs[pairOf(image)];
        }
        return drawn;
    }

    static std::size_t unevennessOf(const Drawn& drawn)
    {
        constexpr std::size_t weight = 1000;
        const auto squares = [](const std::vector<std::size_t>& counts) {
            return std::inner_product(counts.begin(), counts.end(), counts.begin(), std::size_t{0});
        };
        return weight * (weight * squares(drawn.shown) + squares(drawn.images)) + 4 * squares(drawn.pairs) + drawn.besideItsPiece;
    }

    std::size_t m_fabrics;
    std::vector<std::size_t> m_images, m_pairs;  ///< [fabric of the image], and [fabric of the image][piece]
};

/// `shown`: of the conditions, with their trays.
std::vector<DesignTrial> listOf(const LaidPieces& laid, int phase, const std::vector<DesignTrial>& shown,
                                const std::vector<int>& images)
{
    std::vector<DesignTrial> list;
    auto nextShown = shown.begin();
    auto nextImage = images.begin();
    auto nextRepetition = laid.repetitions.begin();
    for (std::size_t at = 0; at < laid.kinds.size(); ++at) {
        const int piece = laid.pieces[at];
        switch (laid.kinds[at]) {
            case Presented::OfCondition:
                list.push_back(*nextShown++);
                break;
            case Presented::Caught:
                list.push_back({phase, catchTrialLabel, piece, {piece}});
                break;
            case Presented::Mismatched:
                list.push_back({phase, mismatchedLabel, *nextImage++, {piece}, {}, AnchorKind::Mismatched});
                break;
            case Presented::Repeated:
                list.push_back(list[(nextRepetition++)->original]);
                list.back().anchor = AnchorKind::Repeated;
                break;
        }
    }
    return list;
}

}  // namespace

std::vector<std::vector<DesignTrial>> drawListsOfOnePiece(const Phase& asked, int phase, const StudySize& size, int blockLength,
                                                          Random& orderDraws, Random& trayDraws)
{
    const auto laid = drawLaidPieces(asked, size, blockLength, orderDraws);
    Orders orders;
    Copies copies;
    for (const LaidPieces& own : laid) {
        orders.push_back(piecesOfConditions(own));
        copies.push_back(copiesIn(own));
    }
    std::vector<std::vector<Tray>> trays;
    if (std::holds_alternative<TrueOrOther>(trayRuleOf(asked.task))) {
        auto drawn = drawSameDifferent(orders, size, trayDraws, copies);
        orders = std::move(drawn.orders);
        trays = std::move(drawn.trays);
    } else {
        orders = drawConditions(std::move(orders), size, copies, orderDraws);
    }
    MismatchedImages images(size.fabrics);
    std::vector<std::vector<DesignTrial>> lists;
    for (std::size_t participant = 0; participant < laid.size(); ++participant) {
        std::vector<DesignTrial> shown;
        for (std::size_t at = 0; at < orders[participant].size(); ++at) {
            const Rendering& rendering = orders[participant][at];
            Tray tray = trays.empty() ? Tray{rendering.fabric} : std::move(trays[participant][at]);
            shown.push_back({phase, rendering.label, rendering.fabric, std::move(tray)});
        }
        lists.push_back(listOf(laid[participant], phase, shown, images.draw(laid[participant], trayDraws)));
    }
    return lists;
}

}  // namespace protocols
