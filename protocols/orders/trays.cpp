#include "protocols/orders/trays.h"

#include <array>
#include <bitset>
#include <map>
#include <utility>

#include "protocols/orders/annealing.h"
#include "protocols/orders/foil_sets.h"

namespace protocols {

namespace {

using Orders = std::vector<std::vector<Rendering>>;
using Trays = std::vector<std::vector<Tray>>;
using Places = std::vector<std::size_t>;

// Of a fabric that was not on the tray before, where few swaps are wanted. From 3 on the strongest guesser rises above chance.
constexpr std::int64_t costOfNewPiece = 2;

/// [participant][true fabric]: its places in the order.
std::vector<std::vector<Places>> placesOf(const Orders& orders, const StudySize& size)
{
    std::vector<std::vector<Places>> places;
    for (const auto& order : orders) {
        auto& own = places.emplace_back(static_cast<std::size_t>(size.fabrics));
        for (std::size_t at = 0; at < order.size(); ++at) own[static_cast<std::size_t>(order[at].fabric)].push_back(at);
    }
    return places;
}

/// Two different presentations of one fabric to one participant.
struct PlacePair {
    std::size_t participant = 0;
    std::size_t first = 0;
    std::size_t second = 0;
};

bool isAdditional(const Rendering& shown) { return shown.label == additionalLabel; }

/// What is even stays even among the presentations of the conditions alone: one of these and an additional one are no pair, and
/// the first stands twice then.
PlacePair randomPair(const Orders& orders, const std::vector<std::vector<Places>>& places, Random& random)
{
    const std::size_t participant = random.below(places.size());
    const Places& own = places[participant][random.below(places[participant].size())];
    PlacePair pair{participant, own[random.below(own.size())], own[random.below(own.size())]};
    const auto& order = orders[participant];
    if (isAdditional(order[pair.first]) != isAdditional(order[pair.second])) pair.second = pair.first;
    return pair;
}

/// The true fabric of more than two never repeats immediately. With foils in random places, a fabric on two trays in a row would
/// therefore more often be a foil. This search compares trays that share the same number of fabrics with the trays before and
/// after. Among these it makes each fabric equally often the true one. `newPieceCost` is added for each fabric of a tray that was
/// not on the tray before.
class NeighbourSearch {
public:
    NeighbourSearch(const Orders& orders, const StudySize& size, int alternatives, std::int64_t newPieceCost, Trays sets)
        : m_orders(orders),
          m_places(placesOf(orders, size)),
          m_alternatives(alternatives),
          m_newPieceCost(newPieceCost),
          m_sets(std::move(sets)),
          m_surplus(surplusCells(alternatives), 0)
    {
        for (const auto& list : m_sets) {
            auto& members = m_members.emplace_back();
            for (const Tray& tray : list) members.push_back(membersOf(tray));
        }
        for (std::size_t participant = 0; participant < m_sets.size(); ++participant)
            for (std::size_t at = 0; at < m_sets[participant].size(); ++at) count(participant, at, 1);
    }

    std::int64_t excess() const { return m_excess; }
    const Trays& sets() const { return m_sets; }

    std::int64_t applyRandomMove(Random& random)
    {
        m_pair = randomPair(m_orders, m_places, random);
        return swapSets();
    }

    void undoMove() { swapSets(); }

private:
    using Members = std::bitset<128>;
    static constexpr std::size_t patterns = 4;  // 1: also on the tray before; 2: also on the tray after
    static constexpr int mostForClasses = 5;    // with more alternatives two trays hardly ever look alike

    static std::size_t surplusCells(int alternatives)
    {
        const auto base = static_cast<std::size_t>(alternatives + 1);
        return alternatives > mostForClasses ? patterns : base * base * base * base * patterns;
    }

    static Members membersOf(const Tray& tray)
    {
        Members members;
        for (const int fabric : tray) members.set(static_cast<std::size_t>(fabric));
        return members;
    }

    std::int64_t swapSets()
    {
        if (m_pair.first == m_pair.second) return 0;
        const std::int64_t before = m_excess;
        countAround(-1);
        std::swap(m_sets[m_pair.participant][m_pair.first], m_sets[m_pair.participant][m_pair.second]);
        std::swap(m_members[m_pair.participant][m_pair.first], m_members[m_pair.participant][m_pair.second]);
        countAround(1);
        return m_excess - before;
    }

    /// Counts the two trays and their neighbours, each once.
    void countAround(std::int64_t sign)
    {
        const std::size_t low = std::min(m_pair.first, m_pair.second);
        const std::size_t high = std::max(m_pair.first, m_pair.second);
        const std::size_t last = m_sets[m_pair.participant].size() - 1;
        const std::size_t lowEnd = std::min(low + 1, last);
        for (std::size_t at = low == 0 ? 0 : low - 1; at <= lowEnd; ++at) count(m_pair.participant, at, sign);
        for (std::size_t at = std::max(high - 1, lowEnd + 1); at <= std::min(high + 1, last); ++at)
            count(m_pair.participant, at, sign);
    }

    /// Adds a tray to the surplus of its class: alternatives x (1 if the true fabric shows the pattern) minus the number of
    /// fabrics that show it. The sum is 0 if the pattern reveals nothing.
    void count(std::size_t participant, std::size_t at, std::int64_t sign)
    {
        const auto& members = m_members[participant];
        const Members before = at > 0 ? members[at - 1] : Members();
        const Members after = at + 1 < members.size() ? members[at + 1] : Members();
        const auto patternOf = [&](int fabric) {
            const auto bit = static_cast<std::size_t>(fabric);
            return (before[bit] ? 1u : 0u) + (after[bit] ? 2u : 0u);
        };
        std::array<std::int64_t, patterns> showing{};
        for (const int fabric : m_sets[participant][at]) ++showing[patternOf(fabric)];
        m_excess += sign * m_newPieceCost * (showing[0] + showing[2]);
        std::size_t kind = 0;
        if (m_alternatives <= mostForClasses)
            for (const std::int64_t fabrics : showing)
                kind = kind * static_cast<std::size_t>(m_alternatives + 1) + static_cast<std::size_t>(fabrics);
        const std::size_t truePattern = patternOf(m_orders[participant][at].fabric);
        for (std::size_t pattern = 0; pattern < patterns; ++pattern) {
            const std::int64_t due = pattern == truePattern ? m_alternatives : 0;
            std::int64_t& surplus = m_surplus[kind * patterns + pattern];
            m_excess -= surplus * surplus;
            surplus += sign * (due - showing[pattern]);
            m_excess += surplus * surplus;
        }
    }

    const Orders& m_orders;
    std::vector<std::vector<Places>> m_places;
    int m_alternatives;
    std::int64_t m_newPieceCost;
    Trays m_sets;
    std::vector<std::vector<Members>> m_members;
    std::vector<std::int64_t> m_surplus;  ///< [class][pattern]
    std::int64_t m_excess = 0;
    PlacePair m_pair;
};

/// Moves sets for additional presentations to the end of each list of sets, as evenly over sets and foils as they come. So the
/// sets that are left stay nearly even among the presentations of the conditions.
class AdditionalSets {
public:
    explicit AdditionalSets(std::size_t fabrics) : m_uses(fabrics), m_foils(fabrics) {}

    void beginParticipant() { std::ranges::fill(m_foils, 0); }

    void moveToEnd(std::size_t fabric, std::vector<FoilSet>& sets, std::size_t count)
    {
        for (std::size_t end = sets.size(); count > 0; --count, --end) {
            const auto usesOf = [&](const FoilSet& set) {
                int foils = 0;
                for (const int foil : set) foils += m_foils[static_cast<std::size_t>(foil)];
                return std::pair(foils, m_uses[fabric][set]);
            };
            const auto last = sets.begin() + static_cast<std::ptrdiff_t>(end);
            const auto chosen = std::ranges::min_element(sets.begin(), last, {}, usesOf);
            ++m_uses[fabric][*chosen];
            for (const int foil : *chosen) ++m_foils[static_cast<std::size_t>(foil)];
            std::iter_swap(chosen, last - 1);
        }
    }

private:
    std::vector<std::map<FoilSet, int>> m_uses;  ///< [true fabric][set], over the study
    std::vector<int> m_foils;                    ///< [fabric], of the present participant
};

/// Trays with the true fabric first, then its foils.
Trays setsInOrder(const Orders& orders, const StudySize& size, int alternatives, Random& random)
{
    const auto places = placesOf(orders, size);
    std::vector<std::vector<int>> timesTrue;
    for (const auto& participant : places) {
        auto& times = timesTrue.emplace_back();
        for (const Places& own : participant) times.push_back(static_cast<int>(own.size()));
    }
    auto foilSets = drawFoilSets(timesTrue, alternatives - 1, random);
    AdditionalSets additional(static_cast<std::size_t>(size.fabrics));
    Trays trays;
    for (std::size_t participant = 0; participant < orders.size(); ++participant) {
        auto& list = trays.emplace_back(orders[participant].size());
        additional.beginParticipant();
        for (std::size_t fabric = 0; fabric < places[participant].size(); ++fabric) {
            Places own = places[participant][fabric];
            const auto extras =
                std::ranges::stable_partition(own, [&](std::size_t at) { return !isAdditional(orders[participant][at]); });
            additional.moveToEnd(fabric, foilSets[participant][fabric], extras.size());
            for (std::size_t i = 0; i < own.size(); ++i) {
                Tray& tray = list[own[i]];
                tray = {static_cast<int>(fabric)};
                const FoilSet& foils = foilSets[participant][fabric][i];
                tray.insert(tray.end(), foils.begin(), foils.end());
            }
        }
    }
    return trays;
}

/// Moves the true fabric from the first place into a slot, and the foils in random order into the others. True slots are equally
/// frequent over all presentations of a label, and follow no other rule: slots that are even for a participant or a piece name
/// true pieces to whoever counts.
void layOut(Trays& trays, const Orders& orders, int alternatives, Random& random)
{
    std::map<int, std::vector<Tray*>> ofLabel;
    for (std::size_t participant = 0; participant < trays.size(); ++participant)
        for (std::size_t at = 0; at < trays[participant].size(); ++at)
            ofLabel[orders[participant][at].label].push_back(&trays[participant][at]);
    std::vector<std::size_t> slots(static_cast<std::size_t>(alternatives));
    for (std::size_t slot = 0; slot < slots.size(); ++slot) slots[slot] = slot;
    for (auto& [label, own] : ofLabel) {
        random.shuffle(own);
        for (std::size_t i = 0; i < own.size(); ++i) {
            if (i % slots.size() == 0) random.shuffle(slots);
            Tray& tray = *own[i];
            Tray foils(tray.begin() + 1, tray.end());
            random.shuffle(foils);
            foils.insert(foils.begin() + static_cast<std::ptrdiff_t>(slots[i % slots.size()]), tray.front());
            tray = std::move(foils);
        }
    }
}

bool holds(const Tray& tray, int fabric) { return std::ranges::find(tray, fabric) != tray.end(); }

/// The fabrics of `set` in slots: one that lies on the tray before keeps its slot, the others take the free slots at random.
Tray placedAfter(const Tray& before, const Tray& set, Random& random)
{
    Tray coming;
    for (const int fabric : set)
        if (!holds(before, fabric)) coming.push_back(fabric);
    random.shuffle(coming);
    Tray tray = before;
    for (int& fabric : tray)
        if (!holds(set, fabric)) {
            fabric = coming.back();
            coming.pop_back();
        }
    return tray;
}

/// Slots for the trays, so that each piece stays while it is needed. No search makes true slots even here: a guesser found 36 to
/// 45 % of them in layouts that had been chosen so.
Trays laidOutInPlace(const Trays& sets, Random& random)
{
    Trays trays;
    for (const auto& list : sets) {
        auto& placed = trays.emplace_back();
        for (const Tray& set : list) {
            placed.push_back(placed.empty() ? set : placedAfter(placed.back(), set, random));
            if (placed.size() == 1) random.shuffle(placed.front());
        }
    }
    return trays;
}

}  // namespace

Trays drawTrays(const Orders& orders, const StudySize& size, int alternatives, TrayAim aim, Random& random)
{
    const std::int64_t places = std::int64_t{size.participants} * size.labels * size.fabrics;
    const std::int64_t moves = std::clamp<std::int64_t>(places * 400, 20'000, 1'000'000);
    const std::int64_t newPieceCost = aim == TrayAim::FewSwaps ? costOfNewPiece : 0;
    NeighbourSearch neighbours(orders, size, alternatives, newPieceCost, setsInOrder(orders, size, alternatives, random));
    anneal(neighbours, random, {.moves = moves, .hot = 16});
    Trays trays = neighbours.sets();
    if (aim == TrayAim::FewSwaps) return laidOutInPlace(trays, random);
    layOut(trays, orders, alternatives, random);
    return trays;
}

}  // namespace protocols
