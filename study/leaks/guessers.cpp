#include "study/leaks/guessers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "protocols/random.h"
#include "study/leaks/tally.h"
#include "study/leaks/tray_guessers.h"

namespace study::leaks {

std::vector<Guess> guessesByTrays(const SeenStudy& study, const Truth& truth)
{
    constexpr std::int64_t moves = 400'000;
    std::vector<Guess> guesses;
    for (std::size_t phase = 0; phase < study.protocol.phases.size(); ++phase) {
        SeenTrays trays;
        std::vector<std::vector<std::size_t>> items;
        const SeenTrial* before = nullptr;
        for (std::size_t i = 0; i < study.trials.size(); ++i) {
            const auto& trial = study.trials[i];
            if (trial.phase != static_cast<int>(phase) || !study.isChoice(trial)) continue;
            if (before == nullptr || !trial.isInListOf(*before)) {
                trays.emplace_back();
                items.emplace_back();
            }
            before = &trial;
            auto& tray = trays.back().emplace_back();
            items.back().push_back(i);
            for (const auto& fabric : trial.tray)
                tray.push_back(static_cast<int>(std::ranges::find(study.fabrics, fabric) - study.fabrics.begin()));
        }
        if (trays.empty()) continue;
        const auto count = [&](const char* name, const Belief& belief) {
            Tally tally(name, "the trays of all trials", "true piece");
            for (std::size_t list = 0; list < items.size(); ++list)
                for (std::size_t at = 0; at < items[list].size(); ++at) {
                    const auto& tray = study.trials[items[list][at]].tray;
                    const auto isTrue = std::ranges::find(tray, truth.trials[items[list][at]].fabric) - tray.begin();
                    tally.take(belief[list][at], static_cast<std::size_t>(isTrue), 1.0 / static_cast<double>(tray.size()));
                }
            tally.addTo(guesses);
        };
        count("rules of the design (counts)", beliefOfCounts(trays));
        count("rules of the design (chain)", beliefOfChain(trays));
        protocols::Random random(phase + 1);
        count("rules of the design (sampler)", beliefOfSampler(trays, moves, random));
    }
    return guesses;
}

std::vector<Guess> guessesByFiles(const std::vector<FileMark>& marks, const Truth& truth)
{
    std::vector<Guess> guesses;
    const auto guessAt = [&](const FileMark& mark, const char* target, std::string Truth::Shown::*asked,
                             std::string Truth::Shown::*split) {
        std::set<std::string> groups, classes;
        for (const auto& [code, shown] : truth.files) {
            groups.insert(shown.*split);
            classes.insert(shown.*asked);
        }
        std::map<std::string, bool> isKnown;
        for (bool known = true; const auto& group : groups) {
            isKnown[group] = known;
            known = !known;
        }
        Tally tally("nearest file: " + std::string(asked == &Truth::Shown::condition ? "learned condition" : "learned fabric"),
                    mark.name, target);
        for (const auto& [code, shown] : truth.files) {
            const auto own = mark.values.find(code);
            if (isKnown[shown.*split] || own == mark.values.end()) continue;
            std::vector<double> scores(classes.size(), -std::numeric_limits<double>::max());
            for (const auto& [other, known] : truth.files) {
                const auto value = mark.values.find(other);
                if (!isKnown[known.*split] || value == mark.values.end()) continue;
                double& score = scores[static_cast<std::size_t>(std::distance(classes.begin(), classes.find(known.*asked)))];
                score = std::max(score, -std::abs(value->second - own->second));
            }
            tally.take(scores, static_cast<std::size_t>(std::distance(classes.begin(), classes.find(shown.*asked))),
                       1.0 / static_cast<double>(classes.size()));
        }
        tally.addTo(guesses);
    };
    for (const FileMark& mark : marks) {
        guessAt(mark, "condition of a file", &Truth::Shown::condition, &Truth::Shown::fabric);
        guessAt(mark, "fabric of a file", &Truth::Shown::fabric, &Truth::Shown::condition);
    }
    return guesses;
}

void correctForNumber(std::vector<Guess*> guesses)
{
    std::ranges::stable_sort(guesses, {}, &Guess::p);
    double least = 0;
    for (std::size_t i = 0; i < guesses.size(); ++i) {
        least = std::max(least, std::min(1.0, guesses[i]->p * static_cast<double>(guesses.size() - i)));
        guesses[i]->pAdjusted = least;
    }
}

}  // namespace study::leaks
