#include "protocols/trays.h"

#include <array>
#include <bitset>
#include <map>
#include <utility>

#include "protocols/annealing.h"
#include "protocols/foil_sets.h"

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

/// The true fabric never repeats immediately. With foils in random places, a fabric on two trays in a row would therefore more
/// often be a foil. This search compares trays that share the same number of fabrics with the trays before and after.
/// Among these it makes each fabric equally often the true one. `newPieceCost` is added for each fabric of a tray that was not
/// on the tray before.
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

/// State of the search: trays with the true fabric in its slot. A move exchanges the true slots of two presentations of one
/// fabric, or two foils on one tray. Both keep the true slots per participant x fabric. These must not be evener than the slots
/// of all trays with the piece: a slot where it lies once more would else hold a foil more often. Where the trays of a piece do
/// not go into the slots, its numbers are therefore drawn, of all its trays and, in proportion, of the true ones; for a piece
/// that lies there seldom, any true slots will do. A third move, which exchanges the true fabric and a foil of one tray, reaches
/// them. It also helps where true slots cannot be even, as with one presentation.
class SlotSearch {
public:
    SlotSearch(const Orders& orders, const StudySize& size, int alternatives, Trays trays, Random& random)
        : m_orders(orders),
          m_places(placesOf(orders, size)),
          m_fabrics(static_cast<std::size_t>(size.fabrics)),
          m_slots(static_cast<std::size_t>(alternatives)),
          m_trays(std::move(trays)),
          m_trueSlots(static_cast<std::size_t>(size.labels + 1) * m_slots),
          m_pieceSlots(m_trays.size() * m_fabrics * m_slots),
          m_cells(m_trays.size() * m_fabrics * classes),
          m_slotsOfCell(m_cells.size() * m_slots),
          m_slotsOfPerson(m_trays.size() * m_slots)
    {
        aimAtSlots(random);
        std::vector<std::int64_t> trueOf(static_cast<std::size_t>(size.labels + 1)), pieces(m_trays.size() * m_fabrics);
        for (std::size_t participant = 0; participant < m_trays.size(); ++participant)
            for (std::size_t at = 0; at < m_trays[participant].size(); ++at) {
                const Rendering& shown = m_orders[participant][at];
                ++trueOf[rowOf(shown)];
                for (const int fabric : m_trays[participant][at])
                    pieces[participant * m_fabrics + static_cast<std::size_t>(fabric)] += countsSlot(shown, fabric);
                count(participant, at, true);
            }
        for (const std::int64_t presentations : trueOf) m_excess -= m_trueWeight * leastSquares(presentations, alternatives);
        for (std::size_t piece = 0; piece < pieces.size(); ++piece)
            if (m_aims.empty() || m_aims[piece] != Aim::Drawn) m_excess -= leastSquares(pieces[piece], alternatives);
    }

    std::int64_t excess() const { return m_excess; }
    const Trays& trays() const { return m_trays; }
    /// Whether the third kind of move is needed.
    bool hasFreeSlots() const { return m_hasFree; }

    std::int64_t applyRandomMove(Random& random)
    {
        m_pair = randomPair(m_orders, m_places, random);
        if (m_hasFree && random.below(3) == 0) return exchangeTrue(random);
        m_betweenTrays = m_slots == 2 || random.below(2) == 0;
        m_slot = m_betweenTrays ? trueSlot(m_pair.first) : random.below(m_slots);
        m_otherSlot = m_betweenTrays ? trueSlot(m_pair.second) : random.below(m_slots);
        const std::size_t shown = trueSlot(m_pair.first);
        m_moves = m_slot != m_otherSlot && (m_betweenTrays || (m_slot != shown && m_otherSlot != shown));
        return swapSlots();
    }

    void undoMove() { swapSlots(); }

private:
    static constexpr std::int64_t cellWeight = 2;
    static constexpr std::int64_t seldom = 6;  // trays with a piece in a slot; for fewer, drawn numbers are too coarse
    static constexpr std::size_t classes = 2;  // presentations of the conditions, and additional ones

    enum class Aim {
        Even,
        Drawn,  ///< numbers of trays and true slots are drawn
        Open    ///< trays even, true slots any
    };

    /// The presentations of a fabric to a participant; the additional ones apart.
    struct Cell {
        std::int64_t times = 0;
        bool isFree = false;  ///< the third move may change its true slots
    };

    std::size_t cellOf(std::size_t participant, const Rendering& shown) const
    {
        return (participant * m_fabrics + static_cast<std::size_t>(shown.fabric)) * classes + (isAdditional(shown) ? 1 : 0);
    }

    std::int64_t least(std::int64_t times) const { return leastSquares(times, static_cast<std::int64_t>(m_slots)); }

    void aimAtSlots(Random& random)
    {
        std::vector<std::int64_t> trays(m_trays.size() * m_fabrics);  // with the piece
        for (std::size_t participant = 0; participant < m_trays.size(); ++participant) {
            for (const Rendering& shown : m_orders[participant]) ++m_cells[cellOf(participant, shown)].times;
            for (const Tray& tray : m_trays[participant])
                for (const int fabric : tray) ++trays[participant * m_fabrics + static_cast<std::size_t>(fabric)];
        }
        const auto slots = static_cast<std::int64_t>(m_slots);
        for (std::size_t at = 0; at < m_cells.size(); ++at) {
            Cell& cell = m_cells[at];
            cell.isFree = cell.times > 0 && (cell.times % slots != 0 || trays[at / classes] % slots != 0);
            m_hasFree = m_hasFree || cell.isFree;
        }
        if (!m_hasFree) return;
        m_trueWeight = 2;
        for (const auto& list : m_trays) m_excess -= least(static_cast<std::int64_t>(list.size()));
        m_aims.resize(trays.size());
        for (std::size_t piece = 0; piece < trays.size(); ++piece) {
            if (trays[piece] % slots != 0) m_aims[piece] = trays[piece] < seldom * slots ? Aim::Open : Aim::Drawn;
            if (m_aims[piece] == Aim::Drawn) drawNumbers(piece, trays[piece], random);
            if (m_aims[piece] != Aim::Even) continue;
            for (std::size_t kind = 0; kind < classes; ++kind)
                m_excess -= cellWeight * least(m_cells[piece * classes + kind].times);
        }
    }

    /// Of `trays` with the piece, in each slot, and of its true presentations as many as are due: systematic sampling, so that
    /// their expected number in a slot is in proportion to the trays there.
    void drawNumbers(std::size_t piece, std::int64_t trays, Random& random)
    {
        std::vector<std::size_t> slots(m_slots);
        for (std::size_t slot = 0; slot < m_slots; ++slot) slots[slot] = slot;
        random.shuffle(slots);
        std::array<std::int64_t, classes> start{};
        for (auto& one : start) one = static_cast<std::int64_t>(random.below(static_cast<std::size_t>(trays)));
        const auto count = static_cast<std::int64_t>(m_slots);
        std::int64_t before = 0;
        for (std::int64_t i = 0; i < count; ++i) {
            const std::size_t slot = slots[static_cast<std::size_t>(i)];
            const std::int64_t after = before + trays / count + (i < trays % count ? 1 : 0);
            m_excess += aimAt(m_pieceSlots, piece * m_slots + slot, after - before);
            for (std::size_t kind = 0; kind < classes; ++kind) {
                const std::size_t cell = piece * classes + kind;
                const auto due = [&](std::int64_t sum) { return (m_cells[cell].times * sum + start[kind]) / trays; };
                m_excess += cellWeight * aimAt(m_slotsOfCell, cell * m_slots + slot, due(after) - due(before));
            }
            before = after;
        }
    }

    /// From now on squares are those of the distance from `number`. Returns the change of the sum.
    static std::int64_t aimAt(SquaredCounts& counts, std::size_t at, std::int64_t number)
    {
        std::int64_t change = 0;
        for (std::int64_t i = 0; i < number; ++i) change += counts.remove(at);
        return change;
    }

    std::int64_t exchangeTrue(Random& random)
    {
        m_betweenTrays = false;
        m_slot = trueSlot(m_pair.first);
        m_otherSlot = random.below(m_slots);
        const Rendering& shown = m_orders[m_pair.participant][m_pair.first];
        m_moves = m_slot != m_otherSlot && m_cells[cellOf(m_pair.participant, shown)].isFree;
        return swapSlots();
    }

    /// With two slots and without the third move, a move takes each true piece and its foil together. There even slots of foils
    /// alone reveal less, except beside additional presentations, whose true slots are no longer halves.
    bool countsSlot(const Rendering& shown, int fabric) const
    {
        return m_slots > 2 || m_hasFree || fabric != shown.fabric || isAdditional(shown);
    }

    std::size_t rowOf(const Rendering& shown) const
    {
        return isAdditional(shown) ? m_trueSlots.size() / m_slots - 1 : static_cast<std::size_t>(shown.label);
    }

    std::size_t trueSlot(std::size_t at) const { return trueSlotOf(m_pair.participant, at); }

    std::size_t trueSlotOf(std::size_t participant, std::size_t at) const
    {
        const Tray& tray = m_trays[participant][at];
        return static_cast<std::size_t>(std::ranges::find(tray, m_orders[participant][at].fabric) - tray.begin());
    }

    std::int64_t swapSlots()
    {
        if (!m_moves) return 0;
        const std::int64_t before = m_excess;
        swapWithin(m_pair.first);
        if (m_betweenTrays) swapWithin(m_pair.second);
        return m_excess - before;
    }

    void swapWithin(std::size_t at)
    {
        count(m_pair.participant, at, false);
        Tray& tray = m_trays[m_pair.participant][at];
        std::swap(tray[m_slot], tray[m_otherSlot]);
        count(m_pair.participant, at, true);
    }

    void count(std::size_t participant, std::size_t at, bool adding)
    {
        const Tray& tray = m_trays[participant][at];
        const Rendering& shown = m_orders[participant][at];
        for (std::size_t slot = 0; slot < m_slots; ++slot) {
            const auto fabric = static_cast<std::size_t>(tray[slot]);
            const bool isTrue = tray[slot] == shown.fabric;
            const auto change = [&](SquaredCounts& counts, std::size_t row) {
                return adding ? counts.add(row * m_slots + slot) : counts.remove(row * m_slots + slot);
            };
            if (isTrue) m_excess += m_trueWeight * change(m_trueSlots, rowOf(shown));
            if (isTrue && m_hasFree) {
                const std::size_t cell = cellOf(participant, shown);
                if (m_aims[cell / classes] != Aim::Open) m_excess += cellWeight * change(m_slotsOfCell, cell);
                m_excess += change(m_slotsOfPerson, participant);
            }
            if (countsSlot(shown, tray[slot])) m_excess += change(m_pieceSlots, participant * m_fabrics + fabric);
        }
    }

    const Orders& m_orders;
    std::vector<std::vector<Places>> m_places;
    std::size_t m_fabrics;
    std::size_t m_slots;
    Trays m_trays;
    SquaredCounts m_trueSlots;                     ///< [label, last the additional ones][slot], over the study
    SquaredCounts m_pieceSlots;                    ///< [participant][piece][slot], see countsSlot()
    std::vector<Aim> m_aims;                       ///< [participant][piece]; empty without the third move
    std::vector<Cell> m_cells;                     ///< [participant][fabric][class]
    SquaredCounts m_slotsOfCell, m_slotsOfPerson;  ///< true slots: [cell][slot], [participant][slot]
    bool m_hasFree = false;                        ///< see hasFreeSlots()
    std::int64_t m_trueWeight = 4;
    std::int64_t m_excess = 0;
    PlacePair m_pair;
    std::size_t m_slot = 0;
    std::size_t m_otherSlot = 0;
    bool m_betweenTrays = false;
    bool m_moves = false;
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

/// True slots for one participant x fabric, each equally often. A remainder goes to the slots that the participant has used
/// least, then the study.
std::vector<std::size_t> evenSlots(std::size_t count, std::vector<int>& own, std::vector<int>& study, Random& random)
{
    std::vector<std::size_t> slots(own.size());
    for (std::size_t slot = 0; slot < slots.size(); ++slot) slots[slot] = slot;
    random.shuffle(slots);
    std::ranges::stable_sort(
        slots, [&](std::size_t a, std::size_t b) { return std::pair(own[a], study[a]) < std::pair(own[b], study[b]); });
    std::vector<std::size_t> drawn;
    for (std::size_t i = 0; i < count; ++i) {
        drawn.push_back(slots[i % slots.size()]);
        ++own[drawn.back()];
        ++study[drawn.back()];
    }
    random.shuffle(drawn);
    return drawn;
}

/// Moves the true fabric from the first place into its slot and the foils in random order into the others.
void layOut(Trays& trays, const Orders& orders, const StudySize& size, int alternatives, Random& random)
{
    const auto places = placesOf(orders, size);
    std::vector<int> study(static_cast<std::size_t>(alternatives), 0);
    for (std::size_t participant = 0; participant < trays.size(); ++participant) {
        std::vector<int> own(study.size(), 0);
        for (const bool additional : {false, true})
            for (Places list : places[participant]) {
                std::erase_if(list, [&](std::size_t at) { return isAdditional(orders[participant][at]) != additional; });
                if (list.empty()) continue;
                const std::vector<std::size_t> slots = evenSlots(list.size(), own, study, random);
                for (std::size_t i = 0; i < list.size(); ++i) {
                    Tray& tray = trays[participant][list[i]];
                    Tray foils(tray.begin() + 1, tray.end());
                    random.shuffle(foils);
                    foils.insert(foils.begin() + static_cast<std::ptrdiff_t>(slots[i]), tray.front());
                    tray = std::move(foils);
                }
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
    layOut(trays, orders, size, alternatives, random);
    SlotSearch slots(orders, size, alternatives, std::move(trays), random);
    annealAgain(slots, random, {.moves = slots.hasFreeSlots() ? 3 * moves : moves, .hot = 4});
    return slots.trays();
}

}  // namespace protocols
