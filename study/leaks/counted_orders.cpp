#include "study/leaks/counted_orders.h"

#include <numeric>

#include "protocols/orders/running_orders.h"

namespace study::leaks {

namespace {

void normalise(std::vector<double>& values)
{
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    if (sum > 0)
        for (double& value : values) value /= sum;
}

}  // namespace

CountedOrders::CountedOrders(const std::vector<std::vector<int>>& list, std::size_t fabrics)
    : m_list(list), m_slots(list.front().size()), m_mayRepeat(protocols::mayRepeat(static_cast<int>(fabrics)))
{
    if (list.size() % fabrics != 0) return;
    m_times = list.size() / fabrics;
    std::size_t states = 1;
    for (std::size_t fabric = 0; fabric < fabrics && states <= mostStates; ++fabric) {
        m_digit.push_back(states);
        states *= m_times + 1;
    }
    if (states <= mostStates) m_states = states;
}

/// Calls `step` with each state at a place and each one that may follow it.
template <class Step>
void CountedOrders::forEachStep(std::size_t at, const Step& step) const
{
    for (std::size_t state = 0; state < m_states * m_slots; ++state) {
        const std::size_t counts = state / m_slots;
        for (std::size_t slot = 0; slot < m_slots; ++slot) {
            const bool isRepeat = m_list[at + 1][slot] == m_list[at][state % m_slots];
            const std::size_t digit = digitOf(at + 1, slot);
            if ((!isRepeat || m_mayRepeat) && counts / digit % (m_times + 1) < m_times)
                step(state, (counts + digit) * m_slots + slot);
        }
    }
}

void CountedOrders::fill(std::vector<std::vector<double>>& belief) const
{
    const std::size_t last = m_list.size() - 1;
    std::vector<std::vector<double>> reached(m_list.size(), std::vector<double>(m_states * m_slots));
    for (std::size_t slot = 0; slot < m_slots; ++slot) reached[0][digitOf(0, slot) * m_slots + slot] = 1;
    for (std::size_t at = 0; at < last; ++at) {
        forEachStep(at, [&](std::size_t from, std::size_t to) { reached[at + 1][to] += reached[at][from]; });
        normalise(reached[at + 1]);
    }
    std::vector<double> left(m_states * m_slots, 1.0);
    for (std::size_t at = last + 1; at-- > 0;) {
        for (std::size_t slot = 0; slot < m_slots; ++slot) belief[at][slot] = 0;
        for (std::size_t state = 0; state < left.size(); ++state) belief[at][state % m_slots] += reached[at][state] * left[state];
        if (at == 0) break;
        std::vector<double> before(left.size());
        forEachStep(at - 1, [&](std::size_t from, std::size_t to) { before[from] += left[to]; });
        normalise(before);
        left = std::move(before);
    }
}

}  // namespace study::leaks
