#include "study/leaks/guessers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <set>

#include "protocols/random.h"
#include "stats/tests/binomial.h"
#include "study/leaks/tray_guessers.h"

namespace study::leaks {

namespace {

/// Counts hits. Ties are broken by a draw whose seed never changes. A guesser who learns from each half of the slots for the
/// other has two parts. By chance the halves may agree, and then both parts hit more often together. So each part has a test of
/// its own, with Bonferroni's correction.
class Tally {
public:
    Tally(std::string attack, std::string what, std::string target)
        : m_guess{std::move(attack), std::move(what), std::move(target)}
    {
    }

    void beginPart() { m_parts.emplace_back(); }

    /// `scores`: one for each class. All equal: no opinion.
    void take(const std::vector<double>& scores, std::size_t truth, double chance)
    {
        const auto [least, most] = std::ranges::minmax(scores);
        if (!(most > least)) return;
        std::vector<std::size_t> best;
        for (std::size_t i = 0; i < scores.size(); ++i)
            if (scores[i] >= most - 1e-12) best.push_back(i);
        if (m_parts.empty()) beginPart();
        Part& part = m_parts.back();
        part.hits += best[m_random.below(best.size())] == truth;
        ++part.trials;
        part.chances += chance;
    }

    void addTo(std::vector<Guess>& guesses)
    {
        std::erase_if(m_parts, [](const Part& part) { return part.trials == 0; });
        double chances = 0;
        for (const Part& part : m_parts) {
            m_guess.hits += part.hits;
            m_guess.trials += part.trials;
            chances += part.chances;
        }
        if (m_guess.trials == 0) return;
        m_guess.chance = chances / static_cast<double>(m_guess.trials);
        if (m_guess.chance >= 1) return;
        for (const Part& part : m_parts) {
            const double chance = std::min(1.0, part.chances / static_cast<double>(part.trials));
            const double p = *stats::binomialTest(part.hits, part.trials, chance).pGreater;
            m_guess.p = std::min(m_guess.p, p * static_cast<double>(m_parts.size()));
        }
        guesses.push_back(m_guess);
    }

private:
    struct Part {
        long long hits = 0, trials = 0;
        double chances = 0;
    };
    Guess m_guess;
    std::vector<Part> m_parts;
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

/// What a guess can be. Classes are numbers: of a fabric, of a place on the tray, or of a condition.
struct Question {
    std::string target;
    std::vector<std::size_t> trials;        ///< guessed at
    std::vector<std::vector<int>> classes;  ///< [of those trials]
    std::vector<std::size_t> truth;         ///< index into its classes
    std::vector<double> chance;
    int kinds = 0;  ///< number of different classes
};

Question pieces(const SeenStudy& study, const Truth& truth)
{
    Question question{"true piece", {}, {}, {}, {}, static_cast<int>(study.fabrics.size())};
    for (std::size_t i = 0; i < study.trials.size(); ++i) {
        const auto& tray = study.trials[i].tray;
        const auto at = std::ranges::find(tray, truth.trials[i].fabric);
        if (!study.isChoice(study.trials[i]) || at == tray.end()) continue;
        question.trials.push_back(i);
        auto& classes = question.classes.emplace_back();
        for (const auto& fabric : tray)
            classes.push_back(static_cast<int>(std::ranges::find(study.fabrics, fabric) - study.fabrics.begin()));
        question.truth.push_back(static_cast<std::size_t>(at - tray.begin()));
        question.chance.push_back(1.0 / static_cast<double>(tray.size()));
    }
    return question;
}

/// The same question with the places on the tray as classes.
Question places(Question question)
{
    question.kinds = 0;
    for (auto& classes : question.classes) {
        for (std::size_t place = 0; place < classes.size(); ++place) classes[place] = static_cast<int>(place);
        question.kinds = std::max(question.kinds, static_cast<int>(classes.size()));
    }
    return question;
}

/// Trials with one of the same classes each. The chance is the share of the commonest.
Question classesOf(const std::string& target, const std::vector<std::size_t>& trials, const std::vector<std::string>& truth)
{
    const std::set<std::string> names(truth.begin(), truth.end());
    std::vector<int> classes;
    std::ptrdiff_t commonest = 0;
    for (const auto& name : names) {
        classes.push_back(static_cast<int>(classes.size()));
        commonest = std::max(commonest, std::ranges::count(truth, name));
    }
    const double chance = truth.empty() ? 1 : static_cast<double>(commonest) / static_cast<double>(truth.size());
    Question question{target, trials, {}, {}, std::vector<double>(trials.size(), chance), static_cast<int>(classes.size())};
    for (const auto& own : truth) {
        question.classes.push_back(classes);
        question.truth.push_back(static_cast<std::size_t>(std::distance(names.begin(), names.find(own))));
    }
    return question;
}

std::vector<std::string> conditionNames(const Truth& truth)
{
    std::set<std::string> names;
    for (const auto& shown : truth.trials) names.insert(shown.condition);
    return {names.begin(), names.end()};
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

/// Trials of which the guesser knows the class: the fabric on the tray of a rating trial, or the truth of the other slots.
struct Known {
    std::vector<std::size_t> trials;
    std::vector<int> classes;
    int kinds = 0;
    int serves = -1;  ///< parity of the slots that it is used for; -1: all
};

Known ratingsOf(const SeenStudy& study)
{
    Known known;
    known.kinds = static_cast<int>(study.fabrics.size());
    for (std::size_t i = 0; i < study.trials.size(); ++i)
        if (study.showsTruth(study.trials[i])) {
            known.trials.push_back(i);
            const auto fabric = std::ranges::find(study.fabrics, study.trials[i].tray.front()) - study.fabrics.begin();
            known.classes.push_back(static_cast<int>(fabric));
        }
    return known;
}

/// The truth about one half of the slots, for the other.
std::vector<Known> halvesOf(const SeenStudy& study, const Question& question)
{
    std::vector<Known> halves;
    for (const int serves : {0, 1}) {
        Known& known = halves.emplace_back();
        known.kinds = question.kinds;
        known.serves = serves;
        for (std::size_t item = 0; item < question.trials.size(); ++item)
            if (study.trials[question.trials[item]].slot % 2 != serves) {
                known.trials.push_back(question.trials[item]);
                known.classes.push_back(question.classes[item][question.truth[item]]);
            }
    }
    return halves;
}

/// A value beside each trial in the forms that guessers compare.
struct Coded {
    std::vector<int> equal;      ///< equal numbers for equal values; -1: none
    bool repeats = false;        ///< some value stands beside two trials
    std::vector<double> places;  ///< the number, or the rank of the text
    bool isText = false;         ///< not a number
};

std::vector<int> numbersOfEqual(const std::vector<std::string>& values, bool& repeats)
{
    std::map<std::string_view, int> known;
    std::vector<int> numbers;
    repeats = false;
    for (const auto& value : values) {
        if (value.empty()) {
            numbers.push_back(-1);
            continue;
        }
        const auto [at, isNew] = known.emplace(value, static_cast<int>(known.size()));
        repeats = repeats || !isNew;
        numbers.push_back(at->second);
    }
    return numbers;
}

std::vector<double> placesOf(const std::vector<std::string>& values, bool& isText)
{
    std::vector<double> numbers;
    for (const auto& value : values) {
        const auto number = numberIn(value.empty() ? "0" : value);
        if (!number) break;
        numbers.push_back(*number);
    }
    isText = numbers.size() != values.size();
    if (!isText) return numbers;
    std::vector<std::string> sorted = values;
    std::ranges::sort(sorted);
    numbers.clear();
    for (const auto& value : values)
        numbers.push_back(static_cast<double>(std::ranges::lower_bound(sorted, value) - sorted.begin()));
    return numbers;
}

/// The share of each class that has an equal value.
class ByEqualValues {
public:
    ByEqualValues(const Known& known, const std::vector<int>& values)
    {
        std::vector<double> totals(static_cast<std::size_t>(known.kinds));
        for (std::size_t i = 0; i < known.trials.size(); ++i) {
            const int value = values[known.trials[i]];
            if (value < 0) continue;
            const auto at = static_cast<std::size_t>(value);
            if (m_shares.size() <= at) m_shares.resize(at + 1);
            m_shares[at].resize(totals.size());
            ++m_shares[at][static_cast<std::size_t>(known.classes[i])];
            ++totals[static_cast<std::size_t>(known.classes[i])];
        }
        for (auto& shares : m_shares)
            for (std::size_t kind = 0; kind < shares.size(); ++kind) shares[kind] /= std::max(1.0, totals[kind]);
    }

    double score(int value, int kind) const
    {
        const auto at = static_cast<std::size_t>(value);
        return at >= m_shares.size() || m_shares[at].empty() ? 0 : m_shares[at][static_cast<std::size_t>(kind)];
    }

private:
    std::vector<std::vector<double>> m_shares;  ///< [value][class]
};

/// The distance to the nearest known value of the class.
class ByOrder {
public:
    ByOrder(const Known& known, const Coded& values) : m_known(static_cast<std::size_t>(known.kinds))
    {
        for (std::size_t i = 0; i < known.trials.size(); ++i)
            if (values.equal[known.trials[i]] >= 0)
                m_known[static_cast<std::size_t>(known.classes[i])].push_back(values.places[known.trials[i]]);
        for (auto& own : m_known) std::ranges::sort(own);
    }

    double score(double place, int kind) const
    {
        const auto& own = m_known[static_cast<std::size_t>(kind)];
        const auto above = std::ranges::lower_bound(own, place);
        double nearest = std::numeric_limits<double>::max();
        if (above != own.end()) nearest = *above - place;
        if (above != own.begin()) nearest = std::min(nearest, place - *std::prev(above));
        return -nearest;
    }

private:
    std::vector<std::vector<double>> m_known;
};

/// The beginning of a text in words of eight letters.
constexpr std::size_t mostLetters = 96;
using Letters = std::array<std::uint64_t, mostLetters / 8>;

Letters lettersOf(const std::string& text)
{
    Letters letters{};
    std::memcpy(letters.data(), text.data(), std::min(text.size(), mostLetters));
    return letters;
}

/// Number of equal letters at equal places.
int equalLetters(const Letters& a, const Letters& b)
{
    constexpr std::uint64_t low = 0x7f7f7f7f7f7f7f7f, ones = 0x0101010101010101;
    std::uint64_t differences = 0;  // one count in each byte; faster than counting bits
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::uint64_t bits = a[i] ^ b[i];
        differences += ((((bits & low) + low) | bits) >> 7) & ones;
    }
    const int different = static_cast<int>((differences * ones) >> 56);
    return static_cast<int>(mostLetters) - different;
}

/// The most equal letters with a known value of the class.
class ByLetters {
public:
    ByLetters(const Known& known, const Feature& feature) : m_known(static_cast<std::size_t>(known.kinds))
    {
        for (std::size_t i = 0; i < known.trials.size(); ++i)
            if (const auto& value = feature.values[known.trials[i]]; !value.empty())
                m_known[static_cast<std::size_t>(known.classes[i])].push_back(lettersOf(value));
    }

    double score(const std::string& value, int kind) const
    {
        const Letters own = lettersOf(value);
        int best = 0;
        for (const Letters& other : m_known[static_cast<std::size_t>(kind)]) best = std::max(best, equalLetters(own, other));
        return best;
    }

private:
    std::vector<std::vector<Letters>> m_known;
};

/// Log likelihood of all letters, each place taken as independent (naive Bayes).
class ByAllLetters {
public:
    ByAllLetters(const Known& known, const Feature& feature)
        : m_counts(static_cast<std::size_t>(known.kinds) * mostLetters * letterKinds),
          m_values(static_cast<std::size_t>(known.kinds))
    {
        for (std::size_t i = 0; i < known.trials.size(); ++i) {
            const auto kind = static_cast<std::size_t>(known.classes[i]);
            const auto& value = feature.values[known.trials[i]];
            if (value.empty()) continue;
            ++m_values[kind];
            for (std::size_t at = 0; at < std::min(value.size(), mostLetters); ++at) ++m_counts[cell(kind, at, value[at])];
        }
    }

    double score(const std::string& value, int which) const
    {
        const auto kind = static_cast<std::size_t>(which);
        double sum = 0;
        for (std::size_t at = 0; at < std::min(value.size(), mostLetters); ++at)
            sum += std::log((m_counts[cell(kind, at, value[at])] + 0.5F) / (m_values[kind] + 8));
        return sum;
    }

private:
    static constexpr std::size_t letterKinds = 128;
    static std::size_t cell(std::size_t kind, std::size_t at, char letter)
    {
        return (kind * mostLetters + at) * letterKinds + (static_cast<unsigned char>(letter) & 127U);
    }

    std::vector<float> m_counts;
    std::vector<float> m_values;
};

class Values {
public:
    Values(const SeenStudy& study, const Truth& truth)
        : m_study(study),
          m_pieces(pieces(study, truth)),
          m_places(places(m_pieces)),
          m_conditions(conditions(study, truth)),
          m_sameness(sameness(study, truth)),
          m_conditionNames(conditionNames(truth)),
          m_ratings{ratingsOf(study)},
          m_learnedPlaces(halvesOf(study, m_places)),
          m_learnedPieces(halvesOf(study, m_pieces)),
          m_learnedConditions(halvesOf(study, m_conditions)),
          m_learnedSameness(halvesOf(study, m_sameness))
    {
    }

    std::vector<Guess> all(const std::vector<Feature>& features)
    {
        for (const Feature& feature : features) {
            fromNames(feature);
            byEqual(feature);
            byNearest(feature);
        }
        return std::move(m_guesses);
    }

private:
    struct Source {
        const char* name;
        const Question* question;
        const std::vector<Known>* known;
        bool isQuadratic;  ///< also compares every two texts
    };
    std::array<Source, 5> sources() const
    {
        return {{{"a rating trial", &m_pieces, &m_ratings, true},
                 {"learned slot", &m_places, &m_learnedPlaces, false},
                 {"learned fabric", &m_pieces, &m_learnedPieces, false},
                 {"learned condition", &m_conditions, &m_learnedConditions, true},
                 {"learned sameness", &m_sameness, &m_learnedSameness, false}}};
    }

    /// `scoreOf`: of a trial and a class.
    template <class Score>
    void count(Tally& tally, const Question& question, const std::vector<int>& values, int serves, const Score& scoreOf) const
    {
        tally.beginPart();
        std::vector<double> scores;
        for (std::size_t item = 0; item < question.trials.size(); ++item) {
            const std::size_t trial = question.trials[item];
            if ((serves >= 0 && m_study.trials[trial].slot % 2 != serves) || values[trial] < 0) continue;
            scores.clear();
            for (const int kind : question.classes[item]) scores.push_back(scoreOf(trial, kind));
            tally.take(scores, question.truth[item], question.chance[item]);
        }
    }

    void byEqual(const Feature& feature)
    {
        std::set<std::vector<int>> seen;
        for (const View& view : views) {
            std::vector<std::string> texts;
            for (const auto& value : feature.values) texts.push_back(view.of(value));
            bool repeats = false;
            const auto values = numbersOfEqual(texts, repeats);
            if (!repeats || !seen.insert(values).second) continue;
            for (const Source& source : sources()) {
                Tally tally(std::string("equal values: ") + source.name, view.name + feature.name, source.question->target);
                for (const Known& known : *source.known) {
                    const ByEqualValues equal(known, values);
                    count(tally, *source.question, values, known.serves,
                          [&](std::size_t trial, int kind) { return equal.score(values[trial], kind); });
                }
                tally.addTo(m_guesses);
            }
        }
    }

    void byNearest(const Feature& feature)
    {
        Coded coded;
        coded.equal = numbersOfEqual(feature.values, coded.repeats);
        coded.places = placesOf(feature.values, coded.isText);
        for (const Source& source : sources()) {
            Tally order(std::string("nearest by order: ") + source.name, feature.name, source.question->target);
            Tally letters(std::string("nearest by letters: ") + source.name, feature.name, source.question->target);
            Tally allLetters(std::string("all letters together: ") + source.name, feature.name, source.question->target);
            for (const Known& known : *source.known) {
                const ByOrder byOrder(known, coded);
                count(order, *source.question, coded.equal, known.serves,
                      [&](std::size_t trial, int kind) { return byOrder.score(coded.places[trial], kind); });
                if (!coded.isText) continue;
                const ByAllLetters byAllLetters(known, feature);
                count(allLetters, *source.question, coded.equal, known.serves,
                      [&](std::size_t trial, int kind) { return byAllLetters.score(feature.values[trial], kind); });
                if (!source.isQuadratic) continue;
                const ByLetters byLetters(known, feature);
                count(letters, *source.question, coded.equal, known.serves,
                      [&](std::size_t trial, int kind) { return byLetters.score(feature.values[trial], kind); });
            }
            for (Tally* tally : {&order, &letters, &allLetters}) tally->addTo(m_guesses);
        }
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
            for (const auto& name : m_conditionNames) scores.push_back(feature.values[m_conditions.trials[item]] == name);
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
    Question m_pieces, m_places, m_conditions, m_sameness;
    std::vector<std::string> m_conditionNames;
    std::vector<Known> m_ratings, m_learnedPlaces, m_learnedPieces, m_learnedConditions, m_learnedSameness;
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
