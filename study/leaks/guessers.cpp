#include "study/leaks/guessers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>

#include "protocols/random.h"
#include "stats/tests/binomial.h"
#include "study/leaks/tray_guessers.h"

namespace study::leaks {

namespace {

/// Counts hits. Ties are broken by a draw whose seed never changes.
class Tally {
public:
    Tally(std::string attack, std::string what, std::string target)
        : m_guess{std::move(attack), std::move(what), std::move(target)}
    {
    }

    /// `scores`: one for each class. All equal: no opinion.
    void take(const std::vector<double>& scores, std::size_t truth, double chance)
    {
        const auto [least, most] = std::ranges::minmax(scores);
        if (!(most > least)) return;
        std::vector<std::size_t> best;
        for (std::size_t i = 0; i < scores.size(); ++i)
            if (scores[i] >= most - 1e-12) best.push_back(i);
        m_guess.hits += best[m_random.below(best.size())] == truth;
        ++m_guess.trials;
        m_chances += chance;
    }

    void addTo(std::vector<Guess>& guesses)
    {
        if (m_guess.trials == 0) return;
        m_guess.chance = m_chances / static_cast<double>(m_guess.trials);
        if (m_guess.chance >= 1) return;
        m_guess.p = *stats::binomialTest(m_guess.hits, m_guess.trials, m_guess.chance).pGreater;
        guesses.push_back(m_guess);
    }

private:
    Guess m_guess;
    double m_chances = 0;
    protocols::Random m_random{1};
};

/// A part of a value.
struct View {
    const char* name;
    std::string (*of)(const std::string& value);
};
constexpr View views[] = {
    {"", [](const std::string& value) { return value; }},
    {"first character of ", [](const std::string& value) { return value.substr(0, 1); }},
    {"first two characters of ", [](const std::string& value) { return value.substr(0, 2); }},
    {"last character of ", [](const std::string& value) { return value.empty() ? value : value.substr(value.size() - 1); }},
    {"last two characters of ",
     [](const std::string& value) { return value.size() < 2 ? value : value.substr(value.size() - 2); }},
    {"length of ", [](const std::string& value) { return value.empty() ? value : std::to_string(value.size()); }},
};

std::optional<double> numberIn(const std::string& text)
{
    double number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    return fault == std::errc() && end == text.data() + text.size() && std::isfinite(number) ? std::optional(number)
                                                                                             : std::nullopt;
}

/// What a guess can be: the classes of a trial, by name. For a piece they differ from trial to trial.
struct Question {
    std::string target;
    std::vector<std::size_t> trials;                ///< guessed at
    std::vector<std::vector<std::string>> classes;  ///< [of those trials]
    std::vector<std::size_t> truth;                 ///< index into its classes
    std::vector<double> chance;
};

Question pieces(const SeenStudy& study, const Truth& truth)
{
    Question question{"true piece", {}, {}, {}, {}};
    for (std::size_t i = 0; i < study.trials.size(); ++i) {
        const auto& tray = study.trials[i].tray;
        const auto at = std::ranges::find(tray, truth.trials[i].fabric);
        if (!study.isChoice(study.trials[i]) || at == tray.end()) continue;
        question.trials.push_back(i);
        question.classes.push_back(tray);
        question.truth.push_back(static_cast<std::size_t>(at - tray.begin()));
        question.chance.push_back(1.0 / static_cast<double>(tray.size()));
    }
    return question;
}

/// Trials with one of the same classes each. The chance is the share of the commonest.
Question classesOf(const std::string& target, const std::vector<std::size_t>& trials, const std::vector<std::string>& truth)
{
    const std::set<std::string> names(truth.begin(), truth.end());
    const std::vector<std::string> classes(names.begin(), names.end());
    std::size_t commonest = 0;
    for (const auto& name : classes) commonest = std::max(commonest, static_cast<std::size_t>(std::ranges::count(truth, name)));
    const double chance = truth.empty() ? 1 : static_cast<double>(commonest) / static_cast<double>(truth.size());
    Question question{target, trials, {}, {}, std::vector<double>(trials.size(), chance)};
    for (const auto& own : truth) {
        question.classes.push_back(classes);
        question.truth.push_back(static_cast<std::size_t>(std::ranges::find(classes, own) - classes.begin()));
    }
    return question;
}

Question conditions(const SeenStudy& study, const Truth& truth)
{
    std::vector<std::size_t> trials;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < study.trials.size(); ++i) {
        trials.push_back(i);
        names.push_back(truth.trials[i].condition);
    }
    return classesOf("condition", trials, names);
}

Question sameness(const SeenStudy& study, const Truth& truth)
{
    std::vector<std::size_t> trials;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < study.trials.size(); ++i) {
        const auto& trial = study.trials[i];
        if (study.isChoice(trial) || study.showsTruth(trial)) continue;
        trials.push_back(i);
        names.push_back(trial.tray.front() == truth.trials[i].fabric ? "same" : "different");
    }
    return classesOf("same or different", trials, names);
}

/// Trials of which the guesser knows a class: the fabric on the tray of a rating trial, or the truth of another half.
struct Known {
    std::vector<std::size_t> trials;
    std::vector<std::string> classes;
};

/// The classes of known trials with an equal value, each by its share of the class.
class ByEqualValues {
public:
    ByEqualValues(const Known& known, const std::vector<std::string>& values)
    {
        std::map<std::string, double> totals;
        for (std::size_t i = 0; i < known.trials.size(); ++i) {
            const auto& value = values[known.trials[i]];
            if (value.empty()) continue;
            m_counts[value][known.classes[i]] += 1;
            totals[known.classes[i]] += 1;
        }
        for (auto& [value, counts] : m_counts)
            for (auto& [name, count] : counts) count /= totals[name];
    }

    double score(const std::string& value, const std::string& name) const
    {
        const auto found = m_counts.find(value);
        if (found == m_counts.end()) return 0;
        const auto count = found->second.find(name);
        return count == found->second.end() ? 0 : count->second;
    }

    bool knows(const std::string& value) const { return m_counts.contains(value); }

private:
    std::map<std::string, std::map<std::string, double>> m_counts;
};

/// The distance of each class from the value: that of its nearest known value by number, or by rank among all.
class ByOrder {
public:
    ByOrder(const Known& known, const std::vector<std::string>& values) : m_places(placesOf(values))
    {
        for (std::size_t i = 0; i < known.trials.size(); ++i)
            if (!values[known.trials[i]].empty()) m_known[known.classes[i]].insert(m_places[known.trials[i]]);
    }

    double score(std::size_t trial, const std::string& name) const
    {
        const auto found = m_known.find(name);
        if (found == m_known.end()) return -std::numeric_limits<double>::max();
        const double place = m_places[trial];
        const auto above = found->second.lower_bound(place);
        double nearest = std::numeric_limits<double>::max();
        if (above != found->second.end()) nearest = *above - place;
        if (above != found->second.begin()) nearest = std::min(nearest, place - *std::prev(above));
        return -nearest;
    }

private:
    static std::vector<double> placesOf(const std::vector<std::string>& values)
    {
        std::vector<double> numbers;
        for (const auto& value : values) {
            const auto number = numberIn(value.empty() ? "0" : value);
            if (!number) break;
            numbers.push_back(*number);
        }
        if (numbers.size() == values.size()) return numbers;
        std::vector<std::string> sorted = values;
        std::ranges::sort(sorted);
        numbers.clear();
        for (const auto& value : values)
            numbers.push_back(static_cast<double>(std::ranges::lower_bound(sorted, value) - sorted.begin()));
        return numbers;
    }

    std::vector<double> m_places;
    std::map<std::string, std::set<double>> m_known;
};

/// Number of equal letters at equal places in the most similar known value of the class.
class ByLetters {
public:
    ByLetters(const Known& known, const std::vector<std::string>& values)
    {
        for (std::size_t i = 0; i < known.trials.size(); ++i)
            if (const auto& value = values[known.trials[i]]; !value.empty()) m_known[known.classes[i]].push_back(&value);
    }

    double score(const std::string& value, const std::string& name) const
    {
        constexpr std::size_t most = 64;
        const auto found = m_known.find(name);
        if (found == m_known.end()) return -1;
        std::size_t best = 0;
        for (const std::string* other : found->second) {
            const std::size_t length = std::min({value.size(), other->size(), most});
            std::size_t equal = 0;
            for (std::size_t at = 0; at < length; ++at) equal += value[at] == (*other)[at];
            best = std::max(best, equal);
        }
        return static_cast<double>(best);
    }

private:
    std::map<std::string, std::vector<const std::string*>> m_known;
};

/// Log likelihood of all letters, each place taken as independent (naive Bayes).
class ByAllLetters {
public:
    ByAllLetters(const Known& known, const std::vector<std::string>& values)
    {
        for (std::size_t i = 0; i < known.trials.size(); ++i) {
            auto& own = m_known[known.classes[i]];
            ++own.values;
            const auto& value = values[known.trials[i]];
            for (std::size_t at = 0; at < std::min(value.size(), most); ++at) ++own.letters[{at, value[at]}];
        }
    }

    double score(const std::string& value, const std::string& name) const
    {
        const auto found = m_known.find(name);
        if (found == m_known.end()) return -std::numeric_limits<double>::max();
        double sum = 0;
        for (std::size_t at = 0; at < std::min(value.size(), most); ++at) {
            const auto count = found->second.letters.find({at, value[at]});
            const double seen = count == found->second.letters.end() ? 0 : count->second;
            sum += std::log((seen + 0.5) / (found->second.values + 8));
        }
        return sum;
    }

private:
    static constexpr std::size_t most = 200;
    struct Letters {
        double values = 0;
        std::map<std::pair<std::size_t, char>, double> letters;
    };
    std::map<std::string, Letters> m_known;
};

Known ratingsOf(const SeenStudy& study)
{
    Known known;
    for (std::size_t i = 0; i < study.trials.size(); ++i)
        if (study.showsTruth(study.trials[i])) {
            known.trials.push_back(i);
            known.classes.push_back(study.trials[i].tray.front());
        }
    return known;
}

/// The classes of each trial of the question as the guesser learns them: the fabric, or the number of the slot.
using NameOf = std::function<std::string(const Question&, std::size_t item, std::size_t which)>;

std::string byName(const Question& question, std::size_t item, std::size_t which) { return question.classes[item][which]; }
std::string byPlace(const Question&, std::size_t, std::size_t which) { return std::to_string(which); }

Known knownHalf(const SeenStudy& study, const Question& question, int parity, const NameOf& nameOf)
{
    Known known;
    for (std::size_t item = 0; item < question.trials.size(); ++item)
        if (study.trials[question.trials[item]].slot % 2 == parity) {
            known.trials.push_back(question.trials[item]);
            known.classes.push_back(nameOf(question, item, question.truth[item]));
        }
    return known;
}

class Values {
public:
    Values(const SeenStudy& study, const Truth& truth)
        : m_study(study),
          m_pieces(pieces(study, truth)),
          m_conditions(conditions(study, truth)),
          m_sameness(sameness(study, truth)),
          m_ratings(ratingsOf(study))
    {
    }

    std::vector<Guess> all(const std::vector<Feature>& features)
    {
        for (const Feature& feature : features) {
            fromRatings(feature);
            fromNames(feature);
            learned(m_pieces, feature, byPlace, "learned slot");
            learned(m_pieces, feature, byName, "learned fabric");
            learned(m_conditions, feature, byName, "learned condition");
            if (!m_sameness.trials.empty()) learned(m_sameness, feature, byName, "learned sameness");
        }
        return std::move(m_guesses);
    }

private:
    /// One set of known trials serves the trials of the question for which `guesses` says so.
    template <class Score>
    void score(Tally& tally, const Question& question, const std::vector<std::string>& values, const NameOf& nameOf, int parity,
               const Score& scoreOf)
    {
        for (std::size_t item = 0; item < question.trials.size(); ++item) {
            const std::size_t trial = question.trials[item];
            if ((parity >= 0 && m_study.trials[trial].slot % 2 != parity) || values[trial].empty()) continue;
            std::vector<double> scores;
            for (std::size_t which = 0; which < question.classes[item].size(); ++which)
                scores.push_back(scoreOf(trial, nameOf(question, item, which)));
            tally.take(scores, question.truth[item], question.chance[item]);
        }
    }

    static std::vector<std::string> seen(const View& view, const Feature& feature)
    {
        std::vector<std::string> values;
        for (const auto& value : feature.values) values.push_back(view.of(value));
        return values;
    }

    void fromRatings(const Feature& feature)
    {
        for (const View& view : views) {
            const auto values = seen(view, feature);
            Tally tally("equal to a rating trial", view.name + feature.name, m_pieces.target);
            const ByEqualValues equal(m_ratings, values);
            score(tally, m_pieces, values, byName, -1,
                  [&](std::size_t trial, const std::string& name) { return equal.score(values[trial], name); });
            tally.addTo(m_guesses);
        }
        near("rating trial", feature, m_pieces, byName, {{-1, m_ratings}});
    }

    /// The nearest by order and by letters, and all letters together. `known`: by the parity of the slots that it serves.
    void near(const std::string& source, const Feature& feature, const Question& question, const NameOf& nameOf,
              const std::vector<std::pair<int, Known>>& known)
    {
        Tally order("nearest by order: " + source, feature.name, question.target);
        Tally letters("nearest by letters: " + source, feature.name, question.target);
        Tally allLetters("all letters together: " + source, feature.name, question.target);
        for (const auto& [parity, own] : known) {
            const ByOrder byOrder(own, feature.values);
            const ByLetters byLetters(own, feature.values);
            const ByAllLetters byAllLetters(own, feature.values);
            const auto& values = feature.values;
            score(order, question, values, nameOf, parity,
                  [&](std::size_t trial, const std::string& name) { return byOrder.score(trial, name); });
            score(letters, question, values, nameOf, parity,
                  [&](std::size_t trial, const std::string& name) { return byLetters.score(values[trial], name); });
            score(allLetters, question, values, nameOf, parity,
                  [&](std::size_t trial, const std::string& name) { return byAllLetters.score(values[trial], name); });
        }
        for (Tally* tally : {&order, &letters, &allLetters}) tally->addTo(m_guesses);
    }

    void learned(const Question& question, const Feature& feature, const NameOf& nameOf, const std::string& source)
    {
        const std::vector<std::pair<int, Known>> halves{{0, knownHalf(m_study, question, 1, nameOf)},
                                                        {1, knownHalf(m_study, question, 0, nameOf)}};
        for (const View& view : views) {
            const auto values = seen(view, feature);
            Tally tally("equal values: " + source, view.name + feature.name, question.target);
            for (const auto& [parity, known] : halves) {
                const ByEqualValues equal(known, values);
                score(tally, question, values, nameOf, parity,
                      [&](std::size_t trial, const std::string& name) { return equal.score(values[trial], name); });
            }
            tally.addTo(m_guesses);
        }
        near(source, feature, question, nameOf, halves);
    }

    void fromNames(const Feature& feature)
    {
        Tally named("names a piece", feature.name, m_pieces.target);
        Tally number("number modulo the slots", feature.name, m_pieces.target);
        Tally bytes("sum of bytes modulo the slots", feature.name, m_pieces.target);
        for (std::size_t item = 0; item < m_pieces.trials.size(); ++item) {
            const auto& trial = m_study.trials[m_pieces.trials[item]];
            const auto& value = feature.values[m_pieces.trials[item]];
            if (value.empty()) continue;
            named.take(namesIn(value, trial), m_pieces.truth[item], m_pieces.chance[item]);
            number.take(slotOf(lastNumberIn(value), trial), m_pieces.truth[item], m_pieces.chance[item]);
            std::uint64_t sum = 0;
            for (const char byte : value) sum += static_cast<unsigned char>(byte);
            bytes.take(slotOf(sum, trial), m_pieces.truth[item], m_pieces.chance[item]);
        }
        for (Tally* tally : {&named, &number, &bytes}) tally->addTo(m_guesses);
        Tally condition("names a condition", feature.name, m_conditions.target);
        for (std::size_t item = 0; item < m_conditions.trials.size(); ++item) {
            std::vector<double> scores;
            for (const auto& name : m_conditions.classes[item])
                scores.push_back(feature.values[m_conditions.trials[item]] == name);
            condition.take(scores, m_conditions.truth[item], m_conditions.chance[item]);
        }
        condition.addTo(m_guesses);
    }

    std::vector<double> namesIn(const std::string& value, const SeenTrial& trial) const
    {
        std::vector<double> scores;
        for (const auto& fabric : trial.tray) {
            bool named = value.find(fabric) != std::string::npos;
            const auto slot = static_cast<std::size_t>(trial.slot) - 1;
            if (slot < m_study.pieceCodes.size())
                if (const auto code = m_study.pieceCodes[slot].find(fabric); code != m_study.pieceCodes[slot].end())
                    named = named || value.find(code->second) != std::string::npos;
            scores.push_back(named);
        }
        return scores;
    }

    /// The last 15 hexadecimal digits as a number; decimal text gives another number with equal chances.
    static std::uint64_t lastNumberIn(const std::string& value)
    {
        if (const auto decimal = numberIn(value); decimal && *decimal >= 0 && *decimal < 9e18)
            return static_cast<std::uint64_t>(*decimal);
        const std::string end = value.size() > 15 ? value.substr(value.size() - 15) : value;
        std::uint64_t number = 0;
        const auto [at, fault] = std::from_chars(end.data(), end.data() + end.size(), number, 16);
        return fault == std::errc() && at == end.data() + end.size() ? number : static_cast<unsigned char>(value.back());
    }

    static std::vector<double> slotOf(std::uint64_t number, const SeenTrial& trial)
    {
        std::vector<double> scores(trial.tray.size());
        scores[number % scores.size()] = 1;
        return scores;
    }

    const SeenStudy& m_study;
    Question m_pieces, m_conditions, m_sameness;
    Known m_ratings;
    std::vector<Guess> m_guesses;
};

}  // namespace

std::vector<Guess> guessesByValues(const SeenStudy& study, const std::vector<Feature>& features, const Truth& truth)
{
    return Values(study, truth).all(features);
}

std::vector<Guess> guessesByTrays(const SeenStudy& study, const Truth& truth)
{
    constexpr std::int64_t moves = 400'000;
    std::vector<Guess> guesses;
    for (std::size_t phase = 0; phase < study.protocol.phases.size(); ++phase) {
        SeenTrays trays;
        std::vector<std::vector<std::size_t>> items;
        int slot = 0;
        for (std::size_t i = 0; i < study.trials.size(); ++i) {
            const auto& trial = study.trials[i];
            if (trial.phase != static_cast<int>(phase) || !study.isChoice(trial)) continue;
            if (trial.slot != slot) {
                slot = trial.slot;
                trays.emplace_back();
                items.emplace_back();
            }
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
