#include "protocols/extra_trials.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace protocols {

namespace {

std::vector<int> shuffledNumbers(int count, Random& random)
{
    std::vector<int> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), 0);
    random.shuffle(numbers);
    return numbers;
}

/// Deals the other fabrics in shuffled rounds, so that each is used equally often.
class OtherFabrics {
public:
    OtherFabrics(int fabrics, Random& random) : m_fabrics(fabrics), m_random(random), m_left(static_cast<std::size_t>(fabrics)) {}

    int nextBeside(int fabric)
    {
        auto& left = m_left[static_cast<std::size_t>(fabric)];
        if (left.empty()) {
            left = shuffledNumbers(m_fabrics, m_random);
            std::erase(left, fabric);
        }
        const int other = left.back();
        left.pop_back();
        return other;
    }

private:
    int m_fabrics;
    Random& m_random;
    std::vector<std::vector<int>> m_left;
};

/// The true fabric and random foils in random order, as many pieces as the phase lays on the tray.
Tray trayOf(const Phase& phase, int fabric, int fabrics, Random& random)
{
    Tray tray = shuffledNumbers(fabrics, random);
    std::erase(tray, fabric);
    tray.resize(static_cast<std::size_t>(piecesOnTray(phase.task) - 1));
    tray.push_back(fabric);
    random.shuffle(tray);
    return tray;
}

}  // namespace

std::vector<std::vector<Tray>> drawSameDifferentTrays(const std::vector<std::vector<Rendering>>& orders, const StudySize& size,
                                                      Random& random)
{
    // The parity of the sum of three shuffled numbers halves every margin at once.
    const auto people = shuffledNumbers(size.participants, random);
    const auto labels = shuffledNumbers(size.labels, random);
    const auto fabrics = shuffledNumbers(size.fabrics, random);
    OtherFabrics others(size.fabrics, random);
    std::vector<std::vector<Tray>> trays;
    for (std::size_t participant = 0; participant < orders.size(); ++participant) {
        auto& list = trays.emplace_back();
        for (const Rendering& rendering : orders[participant]) {
            const int parity = people[participant] + labels[static_cast<std::size_t>(rendering.label)] +
                               fabrics[static_cast<std::size_t>(rendering.fabric)];
            list.push_back({parity % 2 == 0 ? rendering.fabric : others.nextBeside(rendering.fabric)});
        }
    }
    return trays;
}

std::vector<DesignTrial> withCatchTrials(const std::vector<DesignTrial>& trials, const Phase& phase, int fabrics, int count,
                                         Random& random)
{
    std::vector<DesignTrial> all = trials;
    const auto rounds = shuffledNumbers(fabrics, random);
    // From the end, so that earlier places keep their numbers.
    for (int stretch = count; stretch > 0; --stretch) {
        const std::size_t begin = trials.size() * static_cast<std::size_t>(stretch - 1) / static_cast<std::size_t>(count);
        const std::size_t end = trials.size() * static_cast<std::size_t>(stretch) / static_cast<std::size_t>(count);
        const std::size_t place = std::max<std::size_t>(1, begin + random.below(std::max<std::size_t>(1, end - begin)));
        const auto isNextTo = [&](int fabric) {
            return trials[place - 1].fabric == fabric || (place < trials.size() && trials[place].fabric == fabric);
        };
        std::size_t drawn = static_cast<std::size_t>(stretch) % rounds.size();
        for (std::size_t tried = 0; tried < rounds.size() && isNextTo(rounds[drawn]); ++tried)
            drawn = (drawn + 1) % rounds.size();
        const int fabric = rounds[drawn];
        all.insert(all.begin() + static_cast<std::ptrdiff_t>(place),
                   {trials.front().phase, catchTrialLabel, fabric, trayOf(phase, fabric, fabrics, random)});
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
      m_others(static_cast<std::size_t>(size.fabrics))
{
    const auto labels = static_cast<std::size_t>(size.labels), fabrics = static_cast<std::size_t>(size.fabrics);
    m_uses = {std::vector<std::size_t>(labels), std::vector<std::size_t>(fabrics), std::vector<std::size_t>(labels * fabrics)};
}

std::vector<DesignTrial> AnchorDraws::with(const std::vector<DesignTrial>& trials)
{
    std::vector<DesignTrial> list = trials;
    addMismatched(list);
    addRepeated(list);
    return list;
}

void AnchorDraws::addMismatched(std::vector<DesignTrial>& list)
{
    constexpr int tries = 20;
    const std::size_t length = list.size();
    const auto stretches = static_cast<std::size_t>(m_phase.anchors.mismatched);
    std::set<int> shown;  // a participant feels no image a second time before all were felt
    // From the end, so that earlier places keep their numbers.
    for (std::size_t stretch = stretches; stretch > 0; --stretch) {
        if (m_images.empty()) {
            m_images = shuffledNumbers(m_size.fabrics, m_random);
            std::stable_partition(m_images.begin(), m_images.end(), [&](int image) { return shown.contains(image); });
        }
        const int image = m_images.back();
        shown.insert(image);
        m_images.pop_back();
        auto& others = m_others[static_cast<std::size_t>(image)];
        if (others.empty()) {
            others = shuffledNumbers(m_size.fabrics, m_random);
            std::erase(others, image);
        }
        const DesignTrial trial{list.front().phase, mismatchedLabel, image, {others.back()}, {}, AnchorKind::Mismatched};
        others.pop_back();
        const std::size_t begin = length * (stretch - 1) / stretches, end = length * stretch / stretches;
        std::size_t place = 1;
        for (int attempt = 0; attempt < tries; ++attempt) {
            place = std::max<std::size_t>(1, begin + 1 + m_random.below(std::max<std::size_t>(1, end - begin)));
            if (mayStandBeside(trial, list, place)) break;
        }
        list.insert(list.begin() + static_cast<std::ptrdiff_t>(std::min(place, list.size())), trial);
    }
}

void AnchorDraws::addRepeated(std::vector<DesignTrial>& list)
{
    if (m_phase.anchors.repeated == 0) return;
    std::optional<Drawn> drawn;
    for (std::size_t gap = std::min(m_blockLength + 1, list.size() / 2); gap >= 2 && !drawn; gap = gap * 3 / 4)
        for (const Rule rule : {Rule::Spread, Rule::Neighbours, Rule::Places})
            if (!drawn) drawn = evenest(list, gap, rule);
    if (!drawn) {
        // All of them at the end, in the order of the list.
        drawn = Drawn{list, m_uses};
        for (const DesignTrial& trial : list) {
            if (drawn->list.size() == list.size() + static_cast<std::size_t>(m_phase.anchors.repeated)) break;
            if (trial.label < 0) continue;
            drawn->list.push_back(repetitionOf(trial));
            drawn->uses.add(trial);
        }
    }
    list = std::move(drawn->list);
    m_uses = std::move(drawn->uses);
}

/// The evenest of several draws.
std::optional<AnchorDraws::Drawn> AnchorDraws::evenest(const std::vector<DesignTrial>& list, std::size_t gap, Rule rule)
{
    constexpr int draws = 100;
    std::optional<Drawn> best;
    for (int draw = 0; draw < draws; ++draw) {
        auto drawn = tryRepeats(list, gap, rule);
        if (drawn && (!best || drawn->uses.unevenness() < best->uses.unevenness())) best = std::move(drawn);
    }
    return best;
}

/// In ascending order, from 0 to `room` - 1.
std::vector<std::size_t> AnchorDraws::drawPlaces(std::size_t room, Rule rule)
{
    const auto repeats = static_cast<std::size_t>(m_phase.anchors.repeated);
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < repeats; ++k) {
        const std::size_t begin = room * k / repeats, end = room * (k + 1) / repeats;
        const bool isFree = rule == Rule::Neighbours;
        places.push_back(isFree ? m_random.below(room) : begin + m_random.below(std::max<std::size_t>(1, end - begin)));
    }
    std::ranges::sort(places);
    return places;
}

std::optional<AnchorDraws::Drawn> AnchorDraws::tryRepeats(const std::vector<DesignTrial>& list, std::size_t gap, Rule rule)
{
    const std::vector<std::size_t> places = drawPlaces(list.size() + 1 - gap, rule);
    Drawn drawn{list, m_uses};
    std::vector<bool> used(list.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
        const std::size_t at = gap + places[k] + k;
        const auto original = originalFor(drawn, used, at, gap, rule);
        if (!original) return std::nullopt;
        used[*original] = true;
        drawn.uses.add(drawn.list[*original]);
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
        if (used[i] || list[i].label < 0 || (rule != Rule::Places && !mayStandBeside(list[i], list, at))) continue;
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
        if (trial.label == neighbour.label) return true;
        if (!isAlone) return false;
        for (const int fabric : {trial.fabric, trial.alternatives.front()})
            if (fabric == neighbour.fabric || fabric == neighbour.alternatives.front()) return true;
        return false;
    };
    return !(at > 0 && collides(list[at - 1])) && !(at < list.size() && collides(list[at]));
}

DesignTrial AnchorDraws::repetitionOf(const DesignTrial& trial)
{
    DesignTrial repetition = trial;
    repetition.anchor = AnchorKind::Repeated;
    m_random.shuffle(repetition.alternatives);
    return repetition;
}

}  // namespace protocols
