#include "protocols/orders/extra_trials.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace protocols {

namespace {

constexpr int noPiece = -1;

std::size_t placeOf(int fabric) { return static_cast<std::size_t>(fabric); }

bool isOfCondition(const DesignTrial& trial) { return trial.label >= 0 && trial.anchor == AnchorKind::None; }

/// [piece]: where the presentations of the conditions lie that can come again.
std::vector<std::vector<std::size_t>> originalsIn(const std::vector<DesignTrial>& list, int fabrics)
{
    std::vector<std::vector<std::size_t>> originals(placeOf(fabrics));
    for (std::size_t at = 0; at < list.size(); ++at)
        if (isOfCondition(list[at])) originals[placeOf(list[at].fabric)].push_back(at);
    return originals;
}

/// Whether each presentation finds a place of its own that is no earlier than its first possible one.
bool fits(std::vector<std::size_t> earliest, const std::vector<std::size_t>& places, std::size_t firstPlace = 0)
{
    if (earliest.size() > places.size() - firstPlace) return false;
    std::ranges::sort(earliest);
    const auto ends = static_cast<std::ptrdiff_t>(earliest.size());
    return std::equal(earliest.begin(), earliest.end(), places.end() - ends, std::less_equal<>());
}

void insertAt(std::vector<DesignTrial>& list, const std::vector<std::size_t>& places, const DesignTrial& trial)
{
    for (const std::size_t at : places) list.insert(list.begin() + static_cast<std::ptrdiff_t>(at), trial);
}

/// Where trials lie after others were inserted.
void moveBehind(std::vector<std::size_t>& places, const std::vector<std::size_t>& inserted)
{
    for (std::size_t& at : places)
        for (const std::size_t other : inserted) at += other <= at;
}

}  // namespace

std::size_t ExtraTrials::Repeats::renderingOf(const DesignTrial& trial) const
{
    return static_cast<std::size_t>(trial.label) * ofFabric.size() + static_cast<std::size_t>(trial.fabric);
}

std::size_t ExtraTrials::Repeats::of(const DesignTrial& trial) const
{
    constexpr std::size_t weight = 1000;
    return (ofLabel[static_cast<std::size_t>(trial.label)] * weight + ofFabric[static_cast<std::size_t>(trial.fabric)]) * weight +
           ofRendering[renderingOf(trial)];
}

void ExtraTrials::Repeats::add(const DesignTrial& trial)
{
    ++ofLabel[static_cast<std::size_t>(trial.label)];
    ++ofFabric[static_cast<std::size_t>(trial.fabric)];
    ++ofRendering[renderingOf(trial)];
}

std::size_t ExtraTrials::Repeats::unevenness() const
{
    std::size_t sum = 0;
    for (const auto* counts : {&ofLabel, &ofFabric})
        for (const std::size_t count : *counts) sum += count * count;
    return sum;
}

ExtraTrials::ExtraTrials(const Phase& phase, const StudySize& size, int blockLength, Random random)
    : m_phase(phase), m_size(size), m_blockLength(static_cast<std::size_t>(std::max(1, blockLength))), m_random(random)
{
    const auto labels = static_cast<std::size_t>(size.labels), fabrics = placeOf(size.fabrics);
    const std::vector<std::size_t> ofEach(fabrics);
    m_uses = {ofEach, ofEach, {std::vector<std::size_t>(labels), ofEach, std::vector<std::size_t>(labels * fabrics)}};
}

std::vector<DesignTrial> ExtraTrials::with(const std::vector<DesignTrial>& trials)
{
    if (m_phase.catchTrials + m_phase.anchors.presentations() == 0) return trials;
    const std::size_t others = trials.size() + placeOf(m_phase.catchTrials);
    std::optional<Draft> best;
    for (std::size_t gap = std::max<std::size_t>(2, std::min(m_blockLength + 1, others / 2)); gap >= 2 && !best;
         gap = gap * 3 / 4)
        best = bestOfSeveral(trials, gap);
    // Two presentations are enough for one other in between, if all repetitions come last and any piece may come again.
    for (std::size_t gap = 2; !best; --gap) best = drawn(trials, gap, stretchesOf(trials.size(), others), true);
    m_uses = std::move(best->uses);
    return std::move(best->list);
}

/// The first draw without fault. Only a few draws insist on the pieces with the fewest uses. Stretches stay while they can: early
/// repetitions have few originals, and other stretches would move more of them to the end.
std::optional<ExtraTrials::Draft> ExtraTrials::bestOfSeveral(const std::vector<DesignTrial>& trials, std::size_t gap)
{
    constexpr int rounds = 4, draws = 12, drawsForFewestUses = 6;
    const auto faults = [](const Draft& draft) { return std::pair(draft.cost, draft.exchanged); };
    std::optional<Draft> best;
    for (int round = 0; round < rounds; ++round) {
        const Stretches stretches = stretchesOf(trials.size(), gap);
        for (int draw = 0; draw < draws; ++draw) {
            auto next = drawn(trials, gap, stretches);
            if (next && (!best || faults(*next) < faults(*best))) best = std::move(next);
            if (best && best->cost == 0 && (best->exchanged == 0 || draw + 1 >= drawsForFewestUses)) return best;
        }
    }
    return best;
}

std::optional<ExtraTrials::Draft> ExtraTrials::drawn(const std::vector<DesignTrial>& trials, std::size_t gap,
                                                     const Stretches& stretches, bool isLastResort)
{
    Draft draft = withoutPieces(trials, gap, stretches);
    if (!dealPieces(draft, isLastResort)) return std::nullopt;
    repeat(draft);
    layCaught(draft);
    for (std::size_t at = 1; at < draft.list.size(); ++at)
        if (!isOfCondition(draft.list[at])) draft.cost += costAt(draft.list, at);
    return draft;
}

/// Each kind is inserted into a list that holds the kinds before.
ExtraTrials::Stretches ExtraTrials::stretchesOf(std::size_t trials, std::size_t firstRepetition)
{
    const std::size_t withCaught = trials + placeOf(m_phase.catchTrials);
    const int repeated = m_phase.anchors.repeated;
    Stretches stretches;
    stretches.caught = drawStretches(1, withCaught, m_phase.catchTrials);
    stretches.repeated = drawStretches(firstRepetition, withCaught + placeOf(repeated), repeated);
    return stretches;
}

/// Equal stretches of a circle from `begin` to `end`, so that all places are equally likely. The one that would go beyond the end
/// is cut there, and one of its parts is drawn.
std::vector<ExtraTrials::Stretch> ExtraTrials::drawStretches(std::size_t begin, std::size_t end, int count)
{
    std::vector<Stretch> stretches;
    if (count == 0) return stretches;
    const std::size_t room = end - begin, turn = m_random.below(room);
    for (std::size_t k = 0; k < placeOf(count); ++k) {
        const std::size_t from = turn + room * k / placeOf(count), to = turn + room * (k + 1) / placeOf(count);
        const std::size_t place = from + m_random.below(to - from);
        Stretch stretch{from, std::min(to, room)};
        if (place >= room) stretch = {std::max(from, room) - room, to - room};
        stretches.push_back({begin + stretch.begin, begin + stretch.end});
    }
    std::ranges::sort(stretches, {}, &Stretch::begin);
    return stretches;
}

ExtraTrials::Draft ExtraTrials::withoutPieces(const std::vector<DesignTrial>& trials, std::size_t gap, const Stretches& stretches)
{
    const int phase = trials.front().phase;
    Draft draft{trials, drawPlaces(stretches.caught), drawPlaces(stretches.repeated), gap, {}, {}, 0, 0, m_uses};
    insertAt(draft.list, draft.caught, {phase, catchTrialLabel, noPiece, {}});
    insertAt(draft.list, draft.repeated, {phase, noPiece, noPiece, {}, {}, AnchorKind::Repeated});
    moveBehind(draft.caught, draft.repeated);
    return draft;
}

ExtraTrials::Places ExtraTrials::drawPlaces(const std::vector<Stretch>& stretches)
{
    Places places;
    for (const Stretch& stretch : stretches) places.push_back(stretch.begin + m_random.below(stretch.end - stretch.begin));
    return places;
}

std::vector<int> ExtraTrials::shuffledFabrics()
{
    std::vector<int> fabrics(placeOf(m_size.fabrics));
    std::iota(fabrics.begin(), fabrics.end(), 0);
    m_random.shuffle(fabrics);
    return fabrics;
}

/// False where the repetitions find no originals for their places.
bool ExtraTrials::dealPieces(Draft& draft, bool isLastResort)
{
    const int count = m_phase.catchTrials + m_phase.anchors.presentations(), rounds = count / m_size.fabrics;
    draft.left.assign(placeOf(m_size.fabrics), rounds);
    draft.again.assign(placeOf(m_size.fabrics), 0);
    auto pieces = shuffledFabrics();
    std::ranges::stable_sort(pieces, {}, [&](int piece) { return m_uses.surplus[placeOf(piece)]; });
    pieces.resize(placeOf(count % m_size.fabrics));
    for (const int piece : pieces) ++draft.left[placeOf(piece)];
    dealRepetitions(draft, rounds, isLastResort);
    if (std::accumulate(draft.again.begin(), draft.again.end(), 0) < m_phase.anchors.repeated) return false;
    for (std::size_t piece = 0; piece < draft.left.size(); ++piece) {
        draft.uses.surplus[piece] += draft.left[piece] > rounds;
        draft.uses.repeated[piece] += static_cast<std::size_t>(draft.again[piece]);
        draft.left[piece] -= draft.again[piece];
    }
    return true;
}

/// Takes the least repeated of the pieces that are due. Where the originals of these come too late for the places, others take
/// the place of those that would lie there once more, and as the last resort of any.
void ExtraTrials::dealRepetitions(Draft& draft, int rounds, bool isLastResort)
{
    const auto originals = originalsIn(draft.list, m_size.fabrics);
    Places earliest;
    const auto takes = [&](int piece) {
        const auto copy = placeOf(draft.again[placeOf(piece)]);
        if (earliest.size() == draft.repeated.size() || copy >= originals[placeOf(piece)].size()) return false;
        earliest.push_back(originals[placeOf(piece)][copy] + draft.gap);
        const bool isTaken = fits(earliest, draft.repeated);
        if (isTaken)
            ++draft.again[placeOf(piece)];
        else
            earliest.pop_back();
        return isTaken;
    };
    auto pieces = shuffledFabrics();
    std::ranges::stable_sort(pieces, {}, [&](int piece) { return m_uses.repeated[placeOf(piece)]; });
    for (int round = 0; round <= rounds; ++round)
        for (const int piece : pieces)
            if (draft.left[placeOf(piece)] > round) takes(piece);
    std::ranges::stable_sort(pieces, {}, [&](int piece) { return m_uses.surplus[placeOf(piece)]; });
    const auto takesFrom = [&](int piece, const auto& mayGive) {
        const auto giver = std::find_if(pieces.rbegin(), pieces.rend(), mayGive);
        if (giver == pieces.rend() || !takes(piece)) return false;
        ++draft.left[placeOf(piece)];
        --draft.left[placeOf(*giver)];
        ++draft.exchanged;
        return true;
    };
    for (const int piece : pieces)
        if (draft.left[placeOf(piece)] == rounds && draft.again[placeOf(piece)] == rounds)
            takesFrom(piece,
                      [&](int other) { return draft.left[placeOf(other)] > rounds && draft.again[placeOf(other)] <= rounds; });
    if (!isLastResort) return;
    const auto isDue = [&](int piece) { return draft.left[placeOf(piece)] > draft.again[placeOf(piece)]; };
    for (const int piece : pieces)
        while (!isDue(piece) && takesFrom(piece, isDue)) {
        }
}

/// The draw with the least cost of neighbours, then the evenest.
void ExtraTrials::repeat(Draft& draft)
{
    constexpr int draws = 50;
    if (draft.repeated.empty()) return;
    const auto rankOf = [](const Draft& drawn) { return std::pair(drawn.cost, drawn.uses.repeats.unevenness()); };
    std::optional<Draft> best;
    for (int draw = 0; draw < draws; ++draw) {
        auto next = tryRepeats(draft);
        if (next && (!best || rankOf(*next) < rankOf(*best))) best = std::move(next);
    }
    if (best) draft = std::move(*best);
    draft.cost = 0;
}

/// Each place takes the original that stands best beside its neighbours, then the least repeated one, equal ones by a draw. What
/// is left can always be placed.
std::optional<ExtraTrials::Draft> ExtraTrials::tryRepeats(const Draft& draft)
{
    Draft next = draft;
    auto originals = originalsIn(draft.list, m_size.fabrics);
    auto due = draft.again;
    const auto restFits = [&](std::size_t firstPlace) {
        Places earliest;
        for (std::size_t piece = 0; piece < due.size(); ++piece)
            for (std::size_t copy = 0; copy < placeOf(due[piece]); ++copy) earliest.push_back(originals[piece][copy] + draft.gap);
        return fits(std::move(earliest), draft.repeated, firstPlace);
    };
    for (std::size_t k = 0; k < draft.repeated.size(); ++k) {
        const std::size_t at = draft.repeated[k];
        std::vector<std::tuple<std::size_t, std::size_t, std::uint64_t, std::size_t>> candidates;
        for (std::size_t piece = 0; piece < due.size(); ++piece) {
            if (due[piece] == 0) continue;
            for (const std::size_t original : originals[piece]) {
                if (original + draft.gap > at) break;
                next.list[at] = draft.list[original];
                candidates.emplace_back(costAt(next.list, at), next.uses.repeats.of(draft.list[original]), m_random.next(),
                                        original);
            }
        }
        std::ranges::sort(candidates);
        bool isPlaced = false;
        for (const auto& [cost, uses, draw, original] : candidates) {
            const auto piece = placeOf(draft.list[original].fabric);
            const auto before = originals[piece];
            std::erase(originals[piece], original);
            --due[piece];
            isPlaced = restFits(k + 1);
            if (isPlaced) {
                next.list[at] = draft.list[original];
                next.list[at].anchor = AnchorKind::Repeated;
                next.uses.repeats.add(draft.list[original]);
                next.cost += cost;
                break;
            }
            originals[piece] = before;
            ++due[piece];
        }
        if (!isPlaced) return std::nullopt;
    }
    return next;
}

/// Catch trials, at their places.
void ExtraTrials::layCaught(Draft& draft)
{
    std::vector<int> rest;
    for (const int piece : shuffledFabrics()) rest.insert(rest.end(), placeOf(draft.left[placeOf(piece)]), piece);
    m_random.shuffle(rest);
    for (std::size_t k = 0; k < rest.size(); ++k) draft.list[draft.caught[k]].fabric = rest[k];
    exchangeNeighbours(draft, draft.caught);
}

/// Exchanges presentations of one kind, as long as one stands better beside its neighbours and no other worse.
void ExtraTrials::exchangeNeighbours(Draft& draft, const Places& places) const
{
    auto& list = draft.list;
    for (const std::size_t at : places)
        for (const std::size_t other : places) {
            const std::size_t before = costAt(list, at) + costAt(list, other);
            if (costAt(list, at) == 0) break;
            std::swap(list[at], list[other]);
            if (costAt(list, at) + costAt(list, other) >= before) std::swap(list[at], list[other]);
        }
}

std::size_t ExtraTrials::costOf(const DesignTrial& trial, const DesignTrial& neighbour) const
{
    constexpr std::size_t costOfPiece = 8;
    if (trial.fabric == noPiece || neighbour.fabric == noPiece) return 0;
    if (trial.fabric == neighbour.fabric) return m_size.fabrics > 2 ? costOfPiece : 0;
    return m_size.labels > 2 && trial.label >= 0 && trial.label == neighbour.label ? 1 : 0;
}

/// Two neighbours count. The last presentation would find its place easily with one, so that the second before it counts, too.
std::size_t ExtraTrials::costAt(const std::vector<DesignTrial>& list, std::size_t at) const
{
    const std::size_t other = at + 1 < list.size() ? at + 1 : at - std::min<std::size_t>(at, 2);
    return (at > 0 ? costOf(list[at - 1], list[at]) : 0) + (other != at ? costOf(list[at], list[other]) : 0);
}

}  // namespace protocols
