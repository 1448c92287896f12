// All orders of one participant's true fabrics that fit the trays, counted one by one.
#pragma once

#include <cstddef>
#include <vector>

namespace study::leaks {

/// Counts forward and backward through the list. A state is the number of times that each fabric was true so far, as digits of
/// one number, and the slot that is true now. Each fabric is true equally often, and of more than two never twice in a row.
class CountedOrders {
public:
    static constexpr std::size_t mostStates = 20'000;

    /// `list`: [presentation][slot], fabrics from 0 to `fabrics` - 1. Must live longer.
    CountedOrders(const std::vector<std::vector<int>>& list, std::size_t fabrics);

    /// False for a list whose length is no multiple of the fabrics, and for one with more states.
    bool isCountable() const { return m_states > 0; }

    /// Puts the number of orders with this true slot, times a constant of each presentation, into [presentation][slot].
    void fill(std::vector<std::vector<double>>& belief) const;

private:
    std::size_t digitOf(std::size_t at, std::size_t slot) const { return m_digit[static_cast<std::size_t>(m_list[at][slot])]; }
    template <class Step>
    void forEachStep(std::size_t at, const Step& step) const;

    const std::vector<std::vector<int>>& m_list;
    std::size_t m_slots;
    bool m_mayRepeat;
    std::size_t m_times = 0, m_states = 0;
    std::vector<std::size_t> m_digit;  ///< [fabric]: the value of one more
};

}  // namespace study::leaks
