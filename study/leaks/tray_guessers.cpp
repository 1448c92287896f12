#include "study/leaks/tray_guessers.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "protocols/orders/running_orders.h"
#include "study/leaks/counted_orders.h"

using namespace protocols;

namespace study::leaks {

namespace {

int fabricsIn(const SeenTrays& trays)
{
    int most = 0;
    for (const auto& list : trays)
        for (const auto& tray : list) most = std::max(most, *std::ranges::max_element(tray));
    return most + 1;
}

/// A number for each combination of a true fabric and its foils.
class Sets {
public:
    std::size_t idOf(const std::vector<int>& tray, std::size_t slot)
    {
        std::vector<int> key = tray;
        std::ranges::sort(key);
        key.push_back(tray[slot]);
        return m_ids.emplace(key, m_ids.size()).first->second;
    }
    std::size_t count() const { return m_ids.size(); }

private:
    std::map<std::vector<int>, std::size_t> m_ids;
};

Belief evenBelief(const SeenTrays& trays)
{
    Belief belief;
    for (const auto& list : trays) {
        auto& own = belief.emplace_back();
        for (const auto& tray : list) own.emplace_back(tray.size(), 1.0 / static_cast<double>(tray.size()));
    }
    return belief;
}

/// The weights of counted events, with the counts that are expected under them.
struct Scaled {
    std::vector<double> weight;
    std::vector<double> expected;

    explicit Scaled(std::size_t cells) : weight(cells, 1.0), expected(cells, 0.0) {}

    void fitTo(double target)
    {
        for (std::size_t i = 0; i < weight.size(); ++i)
            if (expected[i] > 0) weight[i] = std::clamp(weight[i] * std::sqrt(target / expected[i]), 1e-4, 1e4);
        std::ranges::fill(expected, 0.0);
    }
};

class Chain {
public:
    explicit Chain(const SeenTrays& trays)
        : m_trays(trays),
          m_fabrics(static_cast<std::size_t>(fabricsIn(trays))),
          m_slots(trays[0][0].size()),
          m_place(trays.size() * m_fabrics),
          m_set(0)
    {
        Sets sets;
        for (const auto& list : trays) {
            auto& own = m_setIds.emplace_back();
            for (const auto& tray : list) {
                auto& ids = own.emplace_back();
                for (std::size_t slot = 0; slot < m_slots; ++slot) ids.push_back(sets.idOf(tray, slot));
            }
        }
        m_set = Scaled(sets.count());
    }

    Belief run(int rounds)
    {
        Belief belief = evenBelief(m_trays);
        const double trials = static_cast<double>(m_trays.size() * m_trays[0].size());
        for (int round = 0; round < rounds; ++round) {
            for (std::size_t participant = 0; participant < m_trays.size(); ++participant)
                passThrough(participant, belief[participant]);
            if (round + 1 == rounds) break;
            m_place.fitTo(trials / static_cast<double>(m_place.weight.size()));
            m_set.fitTo(trials / static_cast<double>(m_set.weight.size()));
        }
        return belief;
    }

private:
    double& placeOf(std::vector<double>& cells, std::size_t participant, std::size_t at, std::size_t slot)
    {
        return cells[participant * m_fabrics + static_cast<std::size_t>(m_trays[participant][at][slot])];
    }

    double step(std::size_t participant, std::size_t at, std::size_t from, std::size_t to) const
    {
        const int a = m_trays[participant][at][from];
        const int b = m_trays[participant][at + 1][to];
        return a == b && !mayRepeat(static_cast<int>(m_fabrics)) ? 0.0 : 1.0;
    }

    static void normalise(std::vector<double>& values)
    {
        double sum = 0;
        for (const double value : values) sum += value;
        if (sum > 0)
            for (double& value : values) value /= sum;
    }

    void passThrough(std::size_t participant, std::vector<std::vector<double>>& belief)
    {
        const std::size_t length = m_trays[participant].size();
        std::vector<std::vector<double>> own(length, std::vector<double>(m_slots));
        for (std::size_t at = 0; at < length; ++at)
            for (std::size_t slot = 0; slot < m_slots; ++slot)
                own[at][slot] = placeOf(m_place.weight, participant, at, slot) * m_set.weight[m_setIds[participant][at][slot]];
        std::vector<std::vector<double>> forward = own;
        std::vector<std::vector<double>> backward(length, std::vector<double>(m_slots, 1.0));
        normalise(forward[0]);
        for (std::size_t at = 1; at < length; ++at) {
            for (std::size_t to = 0; to < m_slots; ++to) {
                double reached = 0;
                for (std::size_t from = 0; from < m_slots; ++from)
                    reached += forward[at - 1][from] * step(participant, at - 1, from, to);
                forward[at][to] *= reached;
            }
            normalise(forward[at]);
        }
        for (std::size_t at = length - 1; at-- > 0;) {
            for (std::size_t from = 0; from < m_slots; ++from) {
                backward[at][from] = 0;
                for (std::size_t to = 0; to < m_slots; ++to)
                    backward[at][from] += step(participant, at, from, to) * own[at + 1][to] * backward[at + 1][to];
            }
            normalise(backward[at]);
        }
        for (std::size_t at = 0; at < length; ++at) {
            for (std::size_t slot = 0; slot < m_slots; ++slot) belief[at][slot] = forward[at][slot] * backward[at][slot];
            normalise(belief[at]);
            for (std::size_t slot = 0; slot < m_slots; ++slot) {
                placeOf(m_place.expected, participant, at, slot) += belief[at][slot];
                m_set.expected[m_setIds[participant][at][slot]] += belief[at][slot];
            }
        }
    }

    const SeenTrays& m_trays;
    std::size_t m_fabrics;
    std::size_t m_slots;
    std::vector<std::vector<std::vector<std::size_t>>> m_setIds;
    Scaled m_place;  ///< [participant][fabric]
    Scaled m_set;    ///< [true fabric and foils]
};

/// A true slot for every presentation, with its cost under the rules of the design.
class Assignment {
public:
    Assignment(const SeenTrays& trays, Random& random)
        : m_trays(trays),
          m_fabrics(static_cast<std::size_t>(fabricsIn(trays))),
          m_slots(trays[0][0].size()),
          m_byFabric(trays.size() * m_fabrics)
    {
        Sets sets;
        for (const auto& list : trays) {
            auto& own = m_setIds.emplace_back();
            auto& chosen = m_chosen.emplace_back();
            for (const auto& tray : list) {
                auto& ids = own.emplace_back();
                for (std::size_t slot = 0; slot < m_slots; ++slot) ids.push_back(sets.idOf(tray, slot));
                chosen.push_back(random.below(m_slots));
            }
        }
        m_setKinds = sets.count();
        m_bySet = std::vector<int>(m_setKinds);
        m_byOwnSet = std::vector<int>(m_setKinds * trays.size());
        for (std::size_t participant = 0; participant < trays.size(); ++participant)
            for (std::size_t at = 0; at < trays[participant].size(); ++at) {
                count(participant, at, 1);
                if (at > 0) countStep(participant, at - 1, 1);
            }
    }

    double cost() const { return m_cost; }
    std::size_t chosen(std::size_t participant, std::size_t at) const { return m_chosen[participant][at]; }

    /// Changes the slot of one presentation, or of two so that each fabric stays equally often true.
    void propose(Random& random)
    {
        m_participant = random.below(m_trays.size());
        m_first = random.below(m_trays[m_participant].size());
        m_second = m_first;
        m_firstWas = m_chosen[m_participant][m_first];
        const std::size_t firstTo = (m_firstWas + 1 + random.below(m_slots - 1)) % m_slots;
        const int given = m_trays[m_participant][m_first][m_firstWas];
        const int taken = m_trays[m_participant][m_first][firstTo];
        set(m_first, firstTo);
        if (random.below(4) == 0) return;
        for (int attempt = 0; attempt < 200; ++attempt) {
            const std::size_t at = random.below(m_trays[m_participant].size());
            const auto& tray = m_trays[m_participant][at];
            if (at == m_first || tray[m_chosen[m_participant][at]] != taken) continue;
            const auto found = std::ranges::find(tray, given);
            if (found == tray.end()) continue;
            m_second = at;
            m_secondWas = m_chosen[m_participant][at];
            set(at, static_cast<std::size_t>(found - tray.begin()));
            return;
        }
    }

    void takeBack()
    {
        if (m_second != m_first) set(m_second, m_secondWas);
        set(m_first, m_firstWas);
    }

private:
    void set(std::size_t at, std::size_t slot)
    {
        const std::size_t participant = m_participant;
        countAround(participant, at, -1);
        m_chosen[participant][at] = slot;
        countAround(participant, at, 1);
    }

    void countAround(std::size_t participant, std::size_t at, int sign)
    {
        count(participant, at, sign);
        if (at > 0) countStep(participant, at - 1, sign);
        if (at + 1 < m_trays[participant].size()) countStep(participant, at, sign);
    }

    void tally(std::vector<int>& counts, std::size_t cell, int sign, double weight)
    {
        const int before = counts[cell];
        counts[cell] += sign;
        m_cost += weight * static_cast<double>(counts[cell] * counts[cell] - before * before);
    }

    void count(std::size_t participant, std::size_t at, int sign)
    {
        const auto& tray = m_trays[participant][at];
        const std::size_t slot = m_chosen[participant][at];
        const auto fabric = static_cast<std::size_t>(tray[slot]);
        const std::size_t row = participant * m_fabrics + fabric;
        tally(m_byFabric, row, sign, 1.0);
        const std::size_t set = m_setIds[participant][at][slot];
        tally(m_bySet, set, sign, 0.7);
        tally(m_byOwnSet, participant * m_setKinds + set, sign, 2.0);
    }

    void countStep(std::size_t participant, std::size_t at, int sign)
    {
        const auto from = static_cast<std::size_t>(m_trays[participant][at][m_chosen[participant][at]]);
        const auto to = static_cast<std::size_t>(m_trays[participant][at + 1][m_chosen[participant][at + 1]]);
        if (from == to && !mayRepeat(static_cast<int>(m_fabrics))) m_cost += sign * 8.0;
    }

    const SeenTrays& m_trays;
    std::size_t m_fabrics;
    std::size_t m_slots;
    std::size_t m_setKinds = 0;
    std::vector<std::vector<std::vector<std::size_t>>> m_setIds;
    std::vector<std::vector<std::size_t>> m_chosen;
    std::vector<int> m_byFabric;  ///< [participant][fabric]
    std::vector<int> m_bySet;     ///< [fabric and foils]
    std::vector<int> m_byOwnSet;  ///< [participant][fabric and foils]
    double m_cost = 0;
    std::size_t m_participant = 0, m_first = 0, m_second = 0, m_firstWas = 0, m_secondWas = 0;
};

}  // namespace

SeenTrays seenOf(const Design& design)
{
    SeenTrays trays;
    for (const auto& participant : design.participants) {
        auto& own = trays.emplace_back();
        for (const DesignTrial& trial : participant)
            if (trial.phase == 0) own.push_back(trial.alternatives);
    }
    return trays;
}

double hitsOf(const Belief& belief, const Design& design)
{
    double hits = 0;
    for (std::size_t participant = 0; participant < belief.size(); ++participant)
        for (std::size_t at = 0; at < belief[participant].size(); ++at) {
            const auto& own = belief[participant][at];
            const DesignTrial& trial = design.participants[participant][at];
            const auto isTrue =
                static_cast<std::size_t>(std::ranges::find(trial.alternatives, trial.fabric) - trial.alternatives.begin());
            const double best = *std::ranges::max_element(own) - 1e-9;
            if (own[isTrue] >= best)
                hits += 1.0 / static_cast<double>(std::ranges::count_if(own, [&](double value) { return value >= best; }));
        }
    return hits;
}

Belief beliefOfCounts(const SeenTrays& trays)
{
    Belief belief = evenBelief(trays);
    const auto fabrics = static_cast<std::size_t>(fabricsIn(trays));
    for (std::size_t participant = 0; participant < trays.size(); ++participant) {
        const CountedOrders orders(trays[participant], fabrics);
        if (orders.isCountable()) orders.fill(belief[participant]);
    }
    return belief;
}

Belief beliefOfChain(const SeenTrays& trays) { return Chain(trays).run(40); }

Belief beliefOfSampler(const SeenTrays& trays, std::int64_t moves, Random& random)
{
    constexpr double hot = 4;
    constexpr double cold = 0.7;
    Assignment assignment(trays, random);
    Belief belief = evenBelief(trays);
    const std::int64_t cooling = moves / 4;
    for (std::int64_t move = 0; move < moves; ++move) {
        const double temperature =
            move < cooling ? hot + (cold - hot) * static_cast<double>(move) / static_cast<double>(cooling) : cold;
        const double before = assignment.cost();
        assignment.propose(random);
        const double change = assignment.cost() - before;
        if (change > 0 && random.uniform() >= std::exp(-change / temperature)) assignment.takeBack();
        if (move < cooling || move % 2000 != 0) continue;
        for (std::size_t participant = 0; participant < trays.size(); ++participant)
            for (std::size_t at = 0; at < trays[participant].size(); ++at)
                belief[participant][at][assignment.chosen(participant, at)] += 1;
    }
    return belief;
}

}  // namespace study::leaks
