// Compensated sums, which add up the rounding errors as well (Knuth's two-sum): [1e16, 1, -1e16] gives 1.
// They must not be compiled with fast-math, which would remove the error terms.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace stats {

/// Compensated sum of the terms added.
class ExactSum {
public:
    void add(double term)
    {
        const double sum = m_sum + term;
        const double part = sum - m_sum;
        m_error += (m_sum - (sum - part)) + (term - part);
        m_sum = sum;
    }
    double total() const { return m_sum + m_error; }

private:
    double m_sum = 0;
    double m_error = 0;
};

/// Compensated sum of term(0) ... term(n-1). It has four interleaved partial sums, so that the compiler can
/// use vector registers and no addition waits for the previous one.
template <typename Term>
double exactSum(std::size_t n, Term term)
{
    constexpr std::size_t lanes = 4;
    std::array<double, lanes> sum{};
    std::array<double, lanes> error{};
    const std::size_t whole = n - n % lanes;
    for (std::size_t i = 0; i < whole; i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const double x = term(i + lane);
            const double next = sum[lane] + x;
            const double part = next - sum[lane];
            error[lane] += (sum[lane] - (next - part)) + (x - part);
            sum[lane] = next;
        }
    ExactSum all;
    for (std::size_t lane = 0; lane < lanes; ++lane) all.add(sum[lane]);
    for (std::size_t i = whole; i < n; ++i) all.add(term(i));
    for (std::size_t lane = 0; lane < lanes; ++lane) all.add(error[lane]);
    return all.total();
}

/// Compensated sum in ascending order of the terms: the order of the rows in a file changes no bit.
template <typename Term>
double orderFreeSum(std::size_t n, Term term)
{
    std::vector<double> terms(n);
    for (std::size_t i = 0; i < n; ++i) terms[i] = term(i);
    std::sort(terms.begin(), terms.end());
    return exactSum(n, [&](std::size_t i) { return terms[i]; });
}

}  // namespace stats
