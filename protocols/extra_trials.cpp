#include "protocols/extra_trials.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

namespace protocols {

namespace {

std::vector<int> shuffledNumbers(int count, Random& random)
{
    std::vector<int> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), 0);
    random.shuffle(numbers);
    return numbers;
}

std::size_t placeOf(int fabric) { return static_cast<std::size_t>(fabric); }

}  // namespace

int pieceOf(const DesignTrial& trial) { return trial.alternatives.empty() ? trial.fabric : trial.alternatives.front(); }

ExtraPieces::ExtraPieces(const Phase& phase, const StudySize& size, Random random)
    : m_phase(phase), m_size(size), m_random(random), m_repeated(placeOf(size.fabrics)), m_mismatched(placeOf(size.fabrics))
{
}

std::vector<int> ExtraPieces::nextPieces(int count)
{
    std::vector<int> pieces;
    for (int round = 0; round < count / m_size.fabrics; ++round)
        for (int fabric = 0; fabric < m_size.fabrics; ++fabric) pieces.push_back(fabric);
    std::set<int> surplus;  // no piece gets two of these
    while (static_cast<int>(surplus.size()) < count % m_size.fabrics) {
        if (m_left.empty()) {
            m_left = shuffledNumbers(m_size.fabrics, m_random);
            std::ranges::stable_partition(m_left, [&](int fabric) { return surplus.contains(fabric); });
        }
        surplus.insert(m_left.back());
        m_left.pop_back();
    }
    pieces.insert(pieces.end(), surplus.begin(), surplus.end());
    m_random.shuffle(pieces);
    return pieces;
}

std::vector<int> ExtraPieces::take(std::vector<int>& pieces, int count, int mostOfEach, std::vector<int>& uses) const
{
    std::vector<int> taken, own(uses.size());
    const auto usesOf = [&](int piece) {
        return std::tuple(own[placeOf(piece)] >= mostOfEach, own[placeOf(piece)], uses[placeOf(piece)]);
    };
    for (; count > 0; --count) {
        const auto least = std::ranges::min_element(pieces, {}, usesOf);
        taken.push_back(*least);
        ++own[placeOf(*least)];
        ++uses[placeOf(*least)];
        pieces.erase(least);
    }
    return taken;
}

ExtraPieces::Dealt ExtraPieces::next()
{
    auto pieces = nextPieces(m_phase.catchTrials + m_phase.anchors.presentations());
    Dealt dealt;
    // A piece has as many presentations that can come again as there are labels.
    dealt.repeated = take(pieces, m_phase.anchors.repeated, m_size.labels, m_repeated);
    dealt.mismatched = take(pieces, m_phase.anchors.mismatched, static_cast<int>(pieces.size()), m_mismatched);
    dealt.caught = std::move(pieces);
    for (auto* list : {&dealt.repeated, &dealt.mismatched}) m_random.shuffle(*list);
    return dealt;
}

std::vector<DesignTrial> withCatchTrials(const std::vector<DesignTrial>& trials, std::vector<int> pieces, Random& random)
{
    constexpr int tries = 50;
    std::vector<DesignTrial> all = trials;
    const bool hasTrays = !trials.front().alternatives.empty();
    const std::size_t count = pieces.size();
    // From the end, so that earlier places keep their numbers.
    for (std::size_t stretch = count; stretch > 0; --stretch) {
        const std::size_t begin = trials.size() * (stretch - 1) / count, end = trials.size() * stretch / count;
        std::size_t place = 0;
        const auto isNextTo = [&](int piece) {
            return pieceOf(trials[place - 1]) == piece || (place < trials.size() && pieceOf(trials[place]) == piece);
        };
        for (int attempt = 0; attempt < tries; ++attempt) {
            place = std::max<std::size_t>(1, begin + random.below(std::max<std::size_t>(1, end - begin)));
            std::swap(pieces[random.below(stretch)], pieces[stretch - 1]);
            if (!isNextTo(pieces[stretch - 1])) break;
        }
        const int piece = pieces[stretch - 1];
        all.insert(all.begin() + static_cast<std::ptrdiff_t>(place),
                   {trials.front().phase, catchTrialLabel, piece, hasTrays ? Tray{piece} : Tray{}});
    }
    return all;
}

std::size_t AnchorDraws::Uses::renderingOf(const DesignTrial& trial) const
{
    return static_cast<std::size_t>(trial.label) * ofFabric.size() + static_cast<std::size_t>(trial.fabric);
}

std::size_t AnchorDraws::Uses::of(const DesignTrial& trial) const
{
    constexpr std::size_t weight = 1000;
    return (ofLabel[static_cast<std::size_t>(trial.label)] * weight + ofFabric[static_cast<std::size_t>(trial.fabric)]) * weight +
           ofRendering[renderingOf(trial)];
}

void AnchorDraws::Uses::add(const DesignTrial& trial)
{
    ++ofLabel[static_cast<std::size_t>(trial.label)];
    ++ofFabric[static_cast<std::size_t>(trial.fabric)];
    ++ofRendering[renderingOf(trial)];
}

std::size_t AnchorDraws::Uses::unevenness() const
{
    std::size_t sum = 0;
    for (const auto* counts : {&ofLabel, &ofFabric})
        for (const std::size_t count : *counts) sum += count * count;
    return sum;
}

AnchorDraws::AnchorDraws(const Phase& phase, const StudySize& size, int blockLength, Random random)
    : m_phase(phase),
      m_size(size),
      m_blockLength(static_cast<std::size_t>(std::max(1, blockLength))),
      m_random(random),
      m_images(placeOf(size.fabrics)),
      m_pairs(placeOf(size.fabrics) * placeOf(size.fabrics))
{
    const auto labels = static_cast<std::size_t>(size.labels), fabrics = static_cast<std::size_t>(size.fabrics);
    m_uses = {std::vector<std::size_t>(labels), std::vector<std::size_t>(fabrics), std::vector<std::size_t>(labels * fabrics)};
}

std::vector<DesignTrial> AnchorDraws::with(const std::vector<DesignTrial>& trials, const ExtraPieces::Dealt& pieces)
{
    std::vector<DesignTrial> list = trials;
    addMismatched(list, pieces.mismatched);
    addRepeated(list, pieces.repeated);
    return list;
}

/// An image beside each piece: another fabric, and none a second time before all were felt. The evenest of several draws.
std::vector<int> AnchorDraws::drawImages(const std::vector<int>& pieces)
{
    constexpr int draws = 20;
    const auto fabrics = placeOf(m_size.fabrics);
    std::vector<int> best;
    std::size_t least = 0;
    for (int draw = 0; draw < draws; ++draw) {
        auto images = m_images, pairs = m_pairs, shown = std::vector<std::size_t>(fabrics);
        std::vector<int> drawn(pieces.size());
        for (const int at : shuffledNumbers(static_cast<int>(pieces.size()), m_random)) {
            const int piece = pieces[placeOf(at)];
            const auto numbers = shuffledNumbers(m_size.fabrics, m_random);
            const auto usesOf = [&](int image) {
                return std::tuple(image == piece, shown[placeOf(image)], images[placeOf(image)],
                                  pairs[placeOf(image) * fabrics + placeOf(piece)]);
            };
            const int image = *std::ranges::min_element(numbers, {}, usesOf);
            drawn[placeOf(at)] = image;
            ++shown[placeOf(image)];
            ++images[placeOf(image)];
            ++pairs[placeOf(image) * fabrics + placeOf(piece)];
        }
        constexpr std::size_t weight = 1000;
        std::size_t uneven = 0;
        for (const std::size_t times : shown) uneven += weight * weight * times * times;
        for (const std::size_t times : images) uneven += weight * times * times;
        for (const std::size_t times : pairs) uneven += times * times;
        if (!best.empty() && uneven >= least) continue;
        best = drawn;
        least = uneven;
    }
    return best;
}

void AnchorDraws::addMismatched(std::vector<DesignTrial>& list, const std::vector<int>& pieces)
{
    constexpr int tries = 20;
    const std::size_t length = list.size();
    const std::size_t stretches = pieces.size();
    const auto images = drawImages(pieces);
    // From the end, so that earlier places keep their numbers.
    for (std::size_t stretch = stretches; stretch > 0; --stretch) {
        const int image = images[stretch - 1], piece = pieces[stretch - 1];
        ++m_images[placeOf(image)];
        ++m_pairs[placeOf(image) * placeOf(m_size.fabrics) + placeOf(piece)];
        const DesignTrial trial{list.front().phase, mismatchedLabel, image, {piece}, {}, AnchorKind::Mismatched};
        const std::size_t begin = length * (stretch - 1) / stretches, end = length * stretch / stretches;
        std::size_t place = 1;
        for (int attempt = 0; attempt < tries; ++attempt) {
            place = std::max<std::size_t>(1, begin + 1 + m_random.below(std::max<std::size_t>(1, end - begin)));
            if (mayStandBeside(trial, list, place)) break;
        }
        list.insert(list.begin() + static_cast<std::ptrdiff_t>(std::min(place, list.size())), trial);
    }
}

void AnchorDraws::addRepeated(std::vector<DesignTrial>& list, const std::vector<int>& pieces)
{
    if (pieces.empty()) return;
    m_repeats = pieces.size();
    std::vector<int> left(placeOf(m_size.fabrics));
    for (const int piece : pieces) ++left[placeOf(piece)];
    std::optional<Drawn> drawn;
    for (std::size_t gap = std::min(m_blockLength + 1, list.size() / 2); gap >= 2 && !drawn; gap = gap * 3 / 4)
        for (const Rule rule : {Rule::Spread, Rule::Neighbours, Rule::Places})
            if (!drawn) drawn = evenest(list, left, gap, rule);
    if (!drawn) {
        // All of them at the end, in the order of the list.
        drawn = Drawn{list, m_uses, left};
        for (const DesignTrial& trial : list) {
            if (trial.label < 0 || drawn->left[placeOf(pieceOf(trial))] == 0) continue;
            drawn->list.push_back(repetitionOf(trial));
            drawn->add(trial);
        }
    }
    list = std::move(drawn->list);
    m_uses = std::move(drawn->uses);
}

/// The evenest of several draws.
std::optional<AnchorDraws::Drawn> AnchorDraws::evenest(const std::vector<DesignTrial>& list, const std::vector<int>& left,
                                                       std::size_t gap, Rule rule)
{
    constexpr int draws = 100;
    std::optional<Drawn> best;
    for (int draw = 0; draw < draws; ++draw) {
        auto drawn = tryRepeats(list, left, gap, rule);
        if (drawn && (!best || drawn->uses.unevenness() < best->uses.unevenness())) best = std::move(drawn);
    }
    return best;
}

/// In ascending order, from 0 to `room` - 1.
std::vector<std::size_t> AnchorDraws::drawPlaces(std::size_t room, Rule rule)
{
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < m_repeats; ++k) {
        const std::size_t begin = room * k / m_repeats, end = room * (k + 1) / m_repeats;
        const bool isFree = rule == Rule::Neighbours;
        places.push_back(isFree ? m_random.below(room) : begin + m_random.below(std::max<std::size_t>(1, end - begin)));
    }
    std::ranges::sort(places);
    return places;
}

std::optional<AnchorDraws::Drawn> AnchorDraws::tryRepeats(const std::vector<DesignTrial>& list, const std::vector<int>& left,
                                                          std::size_t gap, Rule rule)
{
    const std::vector<std::size_t> places = drawPlaces(list.size() + 1 - gap, rule);
    Drawn drawn{list, m_uses, left};
    std::vector<bool> used(list.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
        const std::size_t at = gap + places[k] + k;
        const auto original = originalFor(drawn, used, at, gap, rule);
        if (!original) return std::nullopt;
        used[*original] = true;
        drawn.add(drawn.list[*original]);
        const DesignTrial repetition = repetitionOf(drawn.list[*original]);
        drawn.list.insert(drawn.list.begin() + static_cast<std::ptrdiff_t>(at), repetition);
        used.insert(used.begin() + static_cast<std::ptrdiff_t>(at), true);
    }
    return drawn;
}

/// The least repeated rendering that may come again at `at`; equal ones by a draw.
std::optional<std::size_t> AnchorDraws::originalFor(const Drawn& drawn, const std::vector<bool>& used, std::size_t at,
                                                    std::size_t gap, Rule rule)
{
    const auto& list = drawn.list;
    std::vector<std::size_t> best;
    for (std::size_t i = 0; i + gap <= at; ++i) {
        if (used[i] || list[i].label < 0 || drawn.left[placeOf(pieceOf(list[i]))] == 0) continue;
        if (rule != Rule::Places && !mayStandBeside(list[i], list, at)) continue;
        const std::size_t uses = drawn.uses.of(list[i]), least = best.empty() ? uses : drawn.uses.of(list[best.front()]);
        if (least < uses) continue;
        if (uses < least) best.clear();
        best.push_back(i);
    }
    if (best.empty()) return std::nullopt;
    return best[m_random.below(best.size())];
}

bool AnchorDraws::mayStandBeside(const DesignTrial& trial, const std::vector<DesignTrial>& list, std::size_t at) const
{
    const bool isAlone = std::holds_alternative<TrueAlone>(trayRuleOf(m_phase.task));
    const auto collides = [&](const DesignTrial& neighbour) {
        if (trial.label == neighbour.label || pieceOf(trial) == pieceOf(neighbour)) return true;
        return isAlone && (trial.fabric == pieceOf(neighbour) || pieceOf(trial) == neighbour.fabric);
    };
    return !(at > 0 && collides(list[at - 1])) && !(at < list.size() && collides(list[at]));
}

DesignTrial AnchorDraws::repetitionOf(const DesignTrial& trial)
{
    DesignTrial repetition = trial;
    repetition.anchor = AnchorKind::Repeated;
    return repetition;
}

}  // namespace protocols
