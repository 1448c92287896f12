#include "protocols/extra_trials.h"

#include <algorithm>
#include <numeric>

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

}  // namespace protocols
