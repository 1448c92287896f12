#include "protocols/orders/laid_pieces.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "protocols/orders/annealing.h"
#include "protocols/orders/sequence_counts.h"

namespace protocols {

namespace {

using PieceLists = std::vector<std::vector<int>>;

/// State of the search: the pieces of all lists, whatever is presented beside them. A move exchanges two of one list.
class PieceSearch {
public:
    PieceSearch(int fabrics, PieceLists lists)
        : m_lists(std::move(lists)), m_counts(fabrics, m_lists.size(), m_lists.front().size()), m_excess(-m_counts.least())
    {
        for (const auto& list : m_lists)
            for (std::size_t at = 0; at < list.size(); ++at) {
                m_excess += m_counts.place(at, list[at], true);
                if (at > 0) m_excess += m_counts.step(list[at - 1], list[at], true);
            }
    }

    std::int64_t excess() const { return m_excess; }
    const PieceLists& lists() const { return m_lists; }

    std::int64_t applyRandomMove(Random& random)
    {
        m_list = random.below(m_lists.size());
        m_first = random.below(m_lists[m_list].size());
        m_second = random.below(m_lists[m_list].size());
        return exchange();
    }

    void undoMove() { exchange(); }

private:
    std::int64_t exchange()
    {
        auto& list = m_lists[m_list];
        if (list[m_first] == list[m_second]) return 0;
        const std::int64_t before = m_excess;
        countAround(list, false);
        std::swap(list[m_first], list[m_second]);
        countAround(list, true);
        return m_excess - before;
    }

    /// The two places and their transitions, each once.
    void countAround(const std::vector<int>& list, bool adding)
    {
        const std::size_t low = std::min(m_first, m_second), high = std::max(m_first, m_second);
        const auto step = [&](std::size_t at) { m_excess += m_counts.step(list[at], list[at + 1], adding); };
        m_excess += m_counts.place(low, list[low], adding) + m_counts.place(high, list[high], adding);
        if (low > 0) step(low - 1);
        step(low);
        if (high - 1 > low) step(high - 1);
        if (high + 1 < list.size()) step(high);
    }

    PieceLists m_lists;
    SequenceCounts m_counts;
    std::int64_t m_excess;
    std::size_t m_list = 0, m_first = 0, m_second = 0;
};

/// Additional presentations of one piece.
struct Additional {
    int caught = 0, mismatched = 0, repeated = 0;
};

/// The places where a piece lies, ascending.
using PlacesOfPiece = std::vector<std::size_t>;

/// Which presentations are additional, participant by participant.
class KindDeal {
public:
    KindDeal(const Phase& phase, const StudySize& size, int blockLength, Random& random)
        : m_caught(phase.catchTrials),
          m_mismatched(phase.anchors.mismatched),
          m_repeated(phase.anchors.repeated),
          m_size(size),
          m_blockLength(static_cast<std::size_t>(std::max(1, blockLength))),
          m_random(random),
          m_surplusUses(static_cast<std::size_t>(size.fabrics)),
          m_repeatedUses(m_surplusUses),
          m_mismatchedUses(m_surplusUses)
    {
    }

    /// [piece]: the additional presentations of the next participant. Those with one more are the ones that had it least.
    std::vector<int> drawCounts()
    {
        const int count = m_caught + m_mismatched + m_repeated;
        std::vector<int> counts(m_surplusUses.size(), count / m_size.fabrics);
        auto pieces = piecesByUses(m_surplusUses);
        pieces.resize(static_cast<std::size_t>(count % m_size.fabrics));
        for (const std::size_t piece : pieces) {
            ++counts[piece];
            ++m_surplusUses[piece];
        }
        return counts;
    }

    LaidPieces deal(std::vector<int> pieces, const std::vector<int>& counts)
    {
        const std::size_t others = pieces.size() - static_cast<std::size_t>(m_repeated);
        std::size_t gap = std::max<std::size_t>(2, std::min(m_blockLength + 1, others / 2));
        auto repeated = dealRepetitions(placesIn(pieces), counts, gap);
        while (!repeated) {
            repeated = exchangeUntilApart(pieces, counts, gap);
            if (!repeated) gap = std::max<std::size_t>(2, gap * 3 / 4);
        }
        const auto places = placesIn(pieces);
        LaidPieces laid{std::move(pieces), {}, {}};
        laid.kinds.resize(laid.pieces.size());
        const auto additional = dealOthers(counts, *repeated);
        for (std::size_t piece = 0; piece < places.size(); ++piece) drawPlaces(laid, places[piece], additional[piece], gap);
        std::ranges::sort(laid.repetitions, {}, &RepetitionPlace::place);
        return laid;
    }

private:
    std::vector<std::size_t> piecesByUses(const std::vector<int>& uses)
    {
        std::vector<std::size_t> pieces(uses.size());
        std::iota(pieces.begin(), pieces.end(), std::size_t{0});
        m_random.shuffle(pieces);
        std::ranges::stable_sort(pieces, {}, [&](std::size_t piece) { return uses[piece]; });
        return pieces;
    }

    /// As few exchanges as help, so that pairs and stretches stay nearly even.
    std::optional<std::vector<int>> exchangeUntilApart(std::vector<int>& pieces, const std::vector<int>& counts, std::size_t gap)
    {
        constexpr int mostExchanges = 8, draws = 50;
        for (int exchanges = 1; exchanges <= mostExchanges; ++exchanges)
            for (int draw = 0; draw < draws; ++draw) {
                auto exchanged = pieces;
                for (int exchange = 0; exchange < exchanges; ++exchange) exchangeTwo(exchanged);
                auto repeated = dealRepetitions(placesIn(exchanged), counts, gap);
                if (!repeated) continue;
                pieces = std::move(exchanged);
                return repeated;
            }
        return std::nullopt;
    }

    /// Two places of the list, where no piece of more than two then comes twice in a row.
    void exchangeTwo(std::vector<int>& pieces)
    {
        const std::size_t one = m_random.below(pieces.size()), other = m_random.below(pieces.size());
        const auto isAgain = [&](std::size_t at) {
            return (at > 0 && pieces[at - 1] == pieces[at]) || (at + 1 < pieces.size() && pieces[at + 1] == pieces[at]);
        };
        std::swap(pieces[one], pieces[other]);
        if (!mayRepeat(m_size.fabrics) && (isAgain(one) || isAgain(other))) std::swap(pieces[one], pieces[other]);
    }

    std::vector<PlacesOfPiece> placesIn(const std::vector<int>& pieces) const
    {
        std::vector<PlacesOfPiece> places(m_surplusUses.size());
        for (std::size_t at = 0; at < pieces.size(); ++at) places[static_cast<std::size_t>(pieces[at])].push_back(at);
        return places;
    }

    /// Whether so many of these places can be repetitions: at best the last ones, of the first ones.
    static bool findOriginals(const PlacesOfPiece& places, int repetitions, std::size_t gap)
    {
        const auto count = static_cast<std::size_t>(repetitions), last = places.size() - count;
        for (std::size_t i = 0; i < count; ++i)
            if (places[i] + gap > places[last + i]) return false;
        return true;
    }

    /// [piece]: repetitions, of the least repeated pieces first. None where the pieces do not allow so many.
    std::optional<std::vector<int>> dealRepetitions(const std::vector<PlacesOfPiece>& places, const std::vector<int>& counts,
                                                    std::size_t gap)
    {
        std::vector<int> again(places.size());
        int left = m_repeated;
        const auto pieces = piecesByUses(m_repeatedUses);
        for (int before = left + 1; left > 0 && left < before;) {
            before = left;
            for (const std::size_t piece : pieces) {
                if (left == 0 || again[piece] == std::min(counts[piece], m_size.labels)) continue;
                if (!findOriginals(places[piece], again[piece] + 1, gap)) continue;
                ++again[piece];
                --left;
            }
        }
        if (left > 0) return std::nullopt;
        return again;
    }

    /// Mismatched presentations of the pieces that this participant, then the study, has least; the rest are catch trials.
    std::vector<Additional> dealOthers(const std::vector<int>& counts, const std::vector<int>& repeated)
    {
        std::vector<Additional> additional;
        for (std::size_t piece = 0; piece < counts.size(); ++piece) {
            additional.push_back({counts[piece] - repeated[piece], 0, repeated[piece]});
            m_repeatedUses[piece] += repeated[piece];
        }
        for (int count = 0; count < m_mismatched; ++count) {
            const auto pieces = piecesByUses(m_mismatchedUses);
            const std::size_t least = *std::ranges::min_element(pieces, {}, [&](std::size_t piece) {
                return std::tuple(additional[piece].caught == 0, additional[piece].mismatched, m_mismatchedUses[piece]);
            });
            --additional[least].caught;
            ++additional[least].mismatched;
            ++m_mismatchedUses[least];
        }
        return additional;
    }

    /// A random walk over everything that the distance allows, so that each choice is equally likely.
    void drawPlaces(LaidPieces& laid, const PlacesOfPiece& places, const Additional& additional, std::size_t gap)
    {
        constexpr std::size_t movesOfEach = 60;
        if (places.empty()) return;
        std::vector<Presented> kinds(places.size(), Presented::OfCondition);
        auto next = kinds.end();
        for (const auto& [kind, count] :
             {std::pair(Presented::Repeated, additional.repeated), std::pair(Presented::Caught, additional.caught),
              std::pair(Presented::Mismatched, additional.mismatched)})
            for (int i = 0; i < count; ++i) *--next = kind;
        for (std::size_t move = 0; move < movesOfEach * places.size(); ++move) {
            auto &one = kinds[m_random.below(kinds.size())], &other = kinds[m_random.below(kinds.size())];
            std::swap(one, other);
            if (!isAllowed(places, kinds, gap)) std::swap(one, other);
        }
        for (std::size_t i = 0; i < places.size(); ++i) laid.kinds[places[i]] = kinds[i];
        drawOriginals(laid, places, kinds, gap);
    }

    static PlacesOfPiece placesOf(Presented kind, const PlacesOfPiece& places, const std::vector<Presented>& kinds)
    {
        PlacesOfPiece own;
        for (std::size_t i = 0; i < places.size(); ++i)
            if (kinds[i] == kind) own.push_back(places[i]);
        return own;
    }

    static bool isAllowed(const PlacesOfPiece& places, const std::vector<Presented>& kinds, std::size_t gap)
    {
        if (places.front() == 0 && kinds.front() != Presented::OfCondition) return false;
        const auto originals = placesOf(Presented::OfCondition, places, kinds),
                   repetitions = placesOf(Presented::Repeated, places, kinds);
        for (std::size_t i = 0; i < repetitions.size(); ++i)
            if (originals[i] + gap > repetitions[i]) return false;
        return true;
    }

    /// From the first repetition on, so that any choice leaves enough for the later ones.
    void drawOriginals(LaidPieces& laid, const PlacesOfPiece& places, const std::vector<Presented>& kinds, std::size_t gap)
    {
        auto originals = placesOf(Presented::OfCondition, places, kinds);
        for (const std::size_t place : placesOf(Presented::Repeated, places, kinds)) {
            const auto early = std::ranges::count_if(originals, [&](std::size_t original) { return original + gap <= place; });
            const auto drawn = originals.begin() + static_cast<std::ptrdiff_t>(m_random.below(static_cast<std::uint64_t>(early)));
            laid.repetitions.push_back({place, *drawn});
            originals.erase(drawn);
        }
    }

    int m_caught, m_mismatched, m_repeated;
    StudySize m_size;
    std::size_t m_blockLength;
    Random& m_random;
    std::vector<int> m_surplusUses, m_repeatedUses, m_mismatchedUses;  ///< [piece]: over the participants so far
};

}  // namespace

std::vector<LaidPieces> drawLaidPieces(const Phase& phase, const StudySize& size, int blockLength, Random& random)
{
    KindDeal deal(phase, size, blockLength, random);
    PieceLists counts, lists;
    for (int participant = 0; participant < size.participants; ++participant) {
        const auto& own = counts.emplace_back(deal.drawCounts());
        auto& list = lists.emplace_back();
        for (int piece = 0; piece < size.fabrics; ++piece)
            list.insert(list.end(), static_cast<std::size_t>(size.labels + own[static_cast<std::size_t>(piece)]), piece);
        random.shuffle(list);
    }
    const auto places = static_cast<std::int64_t>(lists.size() * lists.front().size());
    PieceSearch search(size.fabrics, std::move(lists));
    anneal(search, random, {.moves = std::clamp<std::int64_t>(places * 2000, 100'000, 3'000'000), .hot = 4});
    std::vector<LaidPieces> laid;
    for (std::size_t participant = 0; participant < counts.size(); ++participant)
        laid.push_back(deal.deal(search.lists()[participant], counts[participant]));
    return laid;
}

}  // namespace protocols
