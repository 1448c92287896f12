// Counts the hits of one guesser.
#pragma once

#include <string>
#include <vector>

#include "protocols/random.h"
#include "study/leaks/guessers.h"

namespace study::leaks {

/// Counts hits. Ties are broken by a draw whose seed never changes. A guesser who learns from each half of the slots for the
/// other has two parts. By chance the halves may agree, and then both parts hit more often together. So each part has a test of
/// its own, with Bonferroni's correction.
class Tally {
public:
    Tally(std::string attack, std::string what, std::string target);

    void beginPart();
    /// `scores`: one for each class. All equal: no opinion.
    void take(const std::vector<double>& scores, std::size_t truth, double chance);
    /// Nothing is added where the guesser had no opinion about any trial, or where chance alone is always right.
    void addTo(std::vector<Guess>& guesses);

private:
    struct Part {
        long long hits = 0, trials = 0;
        double chances = 0;
    };
    Guess m_guess;
    std::vector<Part> m_parts;
    protocols::Random m_random{1};
};

}  // namespace study::leaks
