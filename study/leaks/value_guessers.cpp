#include "study/leaks/value_guessers.h"

#include <array>
#include <charconv>
#include <set>
#include <utility>

#include "study/leaks/questions.h"
#include "study/leaks/tally.h"
#include "study/leaks/value_comparers.h"
#include "study/leaks/value_parts.h"

namespace study::leaks {

namespace {

class Values {
public:
    Values(const SeenStudy& study, const Truth& truth)
        : m_study(study),
          m_pieces(pieces(study, truth)),
          m_places(places(m_pieces)),
          m_conditions(conditions(study, truth)),
          m_sameness(sameness(study, truth)),
          m_anchors(anchors(study, truth)),
          m_conditionNames(conditionNames(truth)),
          m_ratings{ratingsOf(study)},
          m_learnedPlaces(halvesOf(study, m_places)),
          m_learnedPieces(halvesOf(study, m_pieces)),
          m_learnedConditions(halvesOf(study, m_conditions)),
          m_learnedSameness(halvesOf(study, m_sameness)),
          m_learnedAnchors(halvesOf(study, m_anchors))
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
        const TrialQuestion* question;
        const std::vector<KnownTrials>* known;
        bool isQuadratic;  ///< also compares every two texts
    };
    std::array<Source, 6> sources() const
    {
        return {{{"a rating trial", &m_pieces, &m_ratings, true},
                 {"learned slot", &m_places, &m_learnedPlaces, false},
                 {"learned fabric", &m_pieces, &m_learnedPieces, false},
                 {"learned condition", &m_conditions, &m_learnedConditions, true},
                 {"learned sameness", &m_sameness, &m_learnedSameness, false},
                 {"learned anchor", &m_anchors, &m_learnedAnchors, false}}};
    }

    /// `scoreOf`: of a trial and a class.
    template <class Score>
    void count(Tally& tally, const TrialQuestion& question, const std::vector<int>& values, int serves,
               const Score& scoreOf) const
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
        for (const ValuePart& part : valueParts()) {
            std::vector<std::string> texts;
            for (const auto& value : feature.values) texts.push_back(part.of(value));
            bool repeats = false;
            const auto values = numbersOfEqual(texts, repeats);
            if (!repeats || !seen.insert(values).second) continue;
            for (const Source& source : sources()) {
                Tally tally(std::string("equal values: ") + source.name, part.name + feature.name, source.question->target);
                for (const KnownTrials& known : *source.known) {
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
        const CodedValues forms = coded(feature.values);
        for (const Source& source : sources()) {
            Tally order(std::string("nearest by order: ") + source.name, feature.name, source.question->target);
            Tally letters(std::string("nearest by letters: ") + source.name, feature.name, source.question->target);
            Tally allLetters(std::string("all letters together: ") + source.name, feature.name, source.question->target);
            for (const KnownTrials& known : *source.known) {
                const ByOrder byOrder(known, forms);
                count(order, *source.question, forms.equal, known.serves,
                      [&](std::size_t trial, int kind) { return byOrder.score(forms.places[trial], kind); });
                if (!forms.isText) continue;
                const ByAllLetters byAllLetters(known, feature);
                count(allLetters, *source.question, forms.equal, known.serves,
                      [&](std::size_t trial, int kind) { return byAllLetters.score(feature.values[trial], kind); });
                if (!source.isQuadratic) continue;
                const ByLetters byLetters(known, feature);
                count(letters, *source.question, forms.equal, known.serves,
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
    TrialQuestion m_pieces, m_places, m_conditions, m_sameness, m_anchors;
    std::vector<std::string> m_conditionNames;
    std::vector<KnownTrials> m_ratings, m_learnedPlaces, m_learnedPieces, m_learnedConditions, m_learnedSameness,
        m_learnedAnchors;
    std::vector<Guess> m_guesses;
};

}  // namespace

std::vector<Guess> guessesByValues(const SeenStudy& study, const std::vector<Feature>& features, const Truth& truth)
{
    return Values(study, truth).all(features);
}

}  // namespace study::leaks
