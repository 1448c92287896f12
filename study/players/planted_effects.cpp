#include "study/players/planted_effects.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/files/id_rule.h"
#include "protocols/files/number_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/random.h"

namespace study::players {

namespace {

using nlohmann::json;
using protocols::ConditionId;
using protocols::JsonDocument;
using protocols::Protocol;
using protocols::QuestionId;

constexpr double mostPoints = 1e6;
constexpr const char* plantStep = "correct the file";

/// The parts of a plant's file, each with its place.
class PlantReader {
public:
    PlantReader(const JsonDocument& document, const Protocol& protocol) : m_document(document), m_protocol(protocol) {}

    [[noreturn]] void refuse(const std::string& pointer, const std::string& what, const std::string& expected) const
    {
        throw m_document.faultAt(pointer, what, expected, plantStep);
    }

    const json& at(const std::string& pointer) const { return m_document.root().at(json::json_pointer(pointer)); }

    /// The object there, which has no other keys than these.
    const json& object(const std::string& pointer, const std::vector<std::string>& keys) const
    {
        const json& value = at(pointer);
        std::string known;
        for (const std::string& key : keys) known += (known.empty() ? "" : ", ") + key;
        if (!value.is_object()) refuse(pointer, "it is no object", known.empty() ? "{...}" : "an object with " + known);
        for (const auto& [key, part] : value.items())
            if (!keys.empty() && std::ranges::find(keys, key) == keys.end())
                refuse(pointer + "/" + protocols::pointerStep(key), "unknown key '" + key + "'", "one of " + known);
        return value;
    }

    double number(const std::string& pointer, double low, double high) const
    {
        const json& value = at(pointer);
        const double number = value.is_number() ? value.get<double>() : low - 1;
        if (!(number >= low && number <= high))
            refuse(pointer, value.dump() + " is out of range",
                   "a number from " + protocols::shortest(low) + " to " + protocols::shortest(high));
        return number;
    }

    double numberOr(const std::string& pointer, const char* key, double usual, double low, double high) const
    {
        return at(pointer).contains(key) ? number(pointer + "/" + key, low, high) : usual;
    }

    /// The effects of a question, where `mean` with each of them stays within low and high.
    std::map<ConditionId, double> effects(const std::string& question, double mean, double low, double high) const
    {
        std::map<ConditionId, double> all;
        if (!at(question).contains("effects")) return all;
        for (const auto& [key, value] : object(question + "/effects", {}).items()) {
            const std::string pointer = question + "/effects/" + protocols::pointerStep(key);
            const ConditionId id = protocols::faultOf(key) ? ConditionId(key) : protocols::conditionIdFrom(key);
            if (std::ranges::find(m_protocol.conditions, id) == m_protocol.conditions.end())
                refuse(pointer, "the study has no condition '" + key + "'", "one of " + conditions());
            if (all.contains(id))
                refuse(pointer, "condition '" + id.value + "' has two effects, under two spellings", "each condition once");
            all[id] = number(pointer, low - mean, high - mean);
        }
        return all;
    }

    /// The kind of the question of this name.
    const protocols::AnswerKind& kindOf(const std::string& pointer, const std::string& id) const
    {
        if (const auto* question = questionWith(m_protocol, QuestionId(id))) return question->kind;
        std::string known;
        for (const auto& phase : m_protocol.phases)
            for (const auto& question : phase.questions) known += (known.empty() ? "" : ", ") + question.id.value;
        refuse(pointer, "the study has no question '" + id + "'", "one of " + known);
    }

private:
    std::string conditions() const
    {
        std::string known;
        for (const ConditionId& one : m_protocol.conditions) known += (known.empty() ? "" : ", ") + one.value;
        return known;
    }

    const JsonDocument& m_document;
    const Protocol& m_protocol;
};

PlantedChoice choiceFrom(const PlantReader& reader, const std::string& pointer)
{
    if (!reader.object(pointer, {"right", "effects"}).contains("right"))
        reader.refuse(pointer, "'right' is missing", "\"right\": the probability of a right answer");
    PlantedChoice choice;
    choice.right = reader.number(pointer + "/right", 0, 1);
    choice.effects = reader.effects(pointer, choice.right, 0, 1);
    return choice;
}

PlantedRating ratingFrom(const PlantReader& reader, const std::string& pointer, const protocols::RatingScale& scale)
{
    const double low = scale.min.value / 10.0, high = scale.max.value / 10.0;
    if (!reader.object(pointer, {"mean", "person_sd", "fabric_sd", "sd", "effects"}).contains("mean"))
        reader.refuse(pointer, "'mean' is missing", "\"mean\": the mean rating without an effect");
    PlantedRating rating;
    rating.mean = reader.number(pointer + "/mean", low, high);
    rating.personSd = reader.numberOr(pointer, "person_sd", rating.personSd, 0, mostPoints);
    rating.fabricSd = reader.numberOr(pointer, "fabric_sd", rating.fabricSd, 0, mostPoints);
    rating.sd = reader.numberOr(pointer, "sd", rating.sd, 0, mostPoints);
    rating.effects = reader.effects(pointer, rating.mean, low, high);
    return rating;
}

/// A planted answer of one participant.
class PlantedPlayer {
public:
    PlantedPlayer(const PlantedEffects& effects, ShownIn shown, const protocols::ParticipantId& participant, std::uint64_t seed)
        : m_effects(effects),
          m_shown(std::move(shown)),
          m_participant(participant.value),
          m_seed(seed),
          m_random(protocols::Random::stream(seed, "planted answers of " + participant.value)),
          m_isCareless(effects.careless.contains(participant))
    {
    }

    /// Nothing where the usual participant answers.
    std::optional<SimulatedParticipant::Judgement> answer(const protocols::BlindedTrial& trial,
                                                          const protocols::Question& question)
    {
        if (m_isCareless) return carelessAnswer(trial, question.kind);
        const auto& entry = m_shown(trial);
        if (const auto choice = m_effects.choices.find(question.id); choice != m_effects.choices.end())
            return SimulatedParticipant::Judgement{chosen(trial, question.kind, choice->second, entry), time(7.0)};
        if (const auto rating = m_effects.ratings.find(question.id); rating != m_effects.ratings.end())
            return SimulatedParticipant::Judgement{rated(trial, question, rating->second, entry), time(4.0)};
        return std::nullopt;
    }

private:
    double time(double median) { return median * std::exp(0.3 * m_random.normal()); }

    /// A shift that depends on question and thing alone.
    double shiftOf(const std::string& what, double sd) const
    {
        return sd * protocols::Random::stream(m_seed, "planted shift " + what).normal();
    }

    static protocols::Tenths onScale(double points, const protocols::RatingScale& scale)
    {
        const int most = (scale.max.value - scale.min.value) / scale.step.value;
        const long steps = std::lround((10 * points - scale.min.value) / scale.step.value);
        return {scale.min.value + scale.step.value * static_cast<int>(std::clamp<long>(steps, 0, most))};
    }

    session::GivenAnswer chosen(const protocols::BlindedTrial& trial, const protocols::AnswerKind& kind,
                                const PlantedChoice& planted, const protocols::AllocationKey::Entry& entry)
    {
        const auto effect = planted.effects.find(entry.condition);
        double right = planted.right + (effect == planted.effects.end() ? 0 : effect->second);
        if (entry.condition == protocols::catchTrialId()) right = 1.0 / protocols::alternativesOf(kind);
        const bool isRight = m_random.uniform() < right;
        if (std::holds_alternative<protocols::SameDifferent>(kind))
            return session::Sameness{(trial.alternatives.front() == entry.fabric) == isRight};
        std::vector<protocols::FabricId> others = trial.alternatives;
        std::erase(others, entry.fabric);
        if (isRight || others.empty()) return entry.fabric;
        return others[m_random.below(others.size())];
    }

    /// A mismatched presentation is rated as blank glass is.
    protocols::Tenths rated(const protocols::BlindedTrial& trial, const protocols::Question& question,
                            const PlantedRating& planted, const protocols::AllocationKey::Entry& entry)
    {
        const auto& scale = std::get<protocols::Rating>(question.kind).scale;
        const double noise = planted.sd * m_random.normal();
        const bool isMismatched = trial.alternatives.front() != entry.fabric;
        if (isMismatched || entry.condition == protocols::catchTrialId())
            return onScale(scale.min.value / 10.0 + std::abs(noise), scale);
        const auto effect = planted.effects.find(entry.condition);
        return onScale(planted.mean + (effect == planted.effects.end() ? 0 : effect->second) +
                           shiftOf(question.id.value + " of " + m_participant, planted.personSd) +
                           shiftOf(question.id.value + " with " + entry.fabric.value, planted.fabricSd) + noise,
                       scale);
    }

    /// Mostly the first slot, "same" and the middle of the scale, too soon after the touch.
    SimulatedParticipant::Judgement carelessAnswer(const protocols::BlindedTrial& trial, const protocols::AnswerKind& kind)
    {
        const double seconds = m_random.uniform(0.15, 0.45);
        const bool isRoutine = m_random.uniform() < 0.9;
        const session::GivenAnswer answer =
            std::visit(protocols::Overloaded{
                           [&](const protocols::ForcedChoice&) -> session::GivenAnswer {
                               return isRoutine ? trial.alternatives.front() : trial.alternatives.back();
                           },
                           [&](const protocols::Rating& rating) -> session::GivenAnswer {
                               const double middle = (rating.scale.min.value + rating.scale.max.value) / 20.0;
                               const double spread = (rating.scale.max.value - rating.scale.min.value) / 40.0;
                               return onScale(isRoutine ? middle : middle + m_random.uniform(-spread, spread), rating.scale);
                           },
                           [&](const protocols::SameDifferent&) -> session::GivenAnswer { return session::Sameness{isRoutine}; },
                           [](const protocols::FreeText&) -> session::GivenAnswer { return session::Words{}; }},
                       kind);
        return {answer, seconds};
    }

    const PlantedEffects& m_effects;
    ShownIn m_shown;
    std::string m_participant;
    std::uint64_t m_seed;
    protocols::Random m_random;
    bool m_isCareless;
};

void readChoices(const PlantReader& reader, PlantedEffects& effects)
{
    for (const auto& [id, value] : reader.object("/choices", {}).items()) {
        const std::string pointer = "/choices/" + protocols::pointerStep(id);
        if (protocols::alternativesOf(reader.kindOf(pointer, id)) == 0)
            reader.refuse(pointer, "question " + id + " has no right answer", "a choice, or same or different");
        effects.choices[QuestionId(id)] = choiceFrom(reader, pointer);
    }
}

void readRatings(const PlantReader& reader, PlantedEffects& effects)
{
    for (const auto& [id, value] : reader.object("/ratings", {}).items()) {
        const std::string pointer = "/ratings/" + protocols::pointerStep(id);
        const auto* rating = std::get_if<protocols::Rating>(&reader.kindOf(pointer, id));
        if (rating == nullptr) reader.refuse(pointer, "question " + id + " is no rating", "a question with a scale");
        effects.ratings[QuestionId(id)] = ratingFrom(reader, pointer, rating->scale);
    }
}

void readCareless(const PlantReader& reader, const std::string& where, PlantedEffects& effects)
{
    const json& list = reader.at("/careless");
    if (!list.is_array()) reader.refuse("/careless", "it is no list", "ids of simulated participants, such as [\"SIM04\"]");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string pointer = "/careless/" + std::to_string(i);
        if (!list[i].is_string()) reader.refuse(pointer, "it is no text", "the id of a participant, such as \"SIM04\"");
        protocols::requireGoodId(list[i].get<std::string>(), "a participant", where);
        effects.careless.insert(protocols::ParticipantId(list[i].get<std::string>()));
    }
}

}  // namespace

PlantedEffects plantedEffectsFromJson(std::string_view text, const std::string& where, const Protocol& protocol)
{
    const JsonDocument document(std::string(text), where);
    const PlantReader reader(document, protocol);
    const json& root = reader.object("", {"schema", "comment", "choices", "ratings", "careless"});
    if (!root.contains("schema") || root["schema"] != "vis2hap.plant/1")
        reader.refuse(root.contains("schema") ? "/schema" : "", "the file plants no effects", "\"schema\": \"vis2hap.plant/1\"");
    PlantedEffects effects;
    if (root.contains("choices")) readChoices(reader, effects);
    if (root.contains("ratings")) readRatings(reader, effects);
    if (root.contains("careless")) readCareless(reader, where, effects);
    if (effects.choices.empty() && effects.ratings.empty() && effects.careless.empty())
        reader.refuse("", "the file plants nothing", "choices, ratings or careless");
    return effects;
}

Judge plantedJudge(const PlantedEffects& effects, const ShownIn& shown, const protocols::ParticipantId& participant,
                   std::uint64_t seed, Judge usual)
{
    auto player = std::make_shared<PlantedPlayer>(effects, shown, participant, seed);
    return [player, usual = std::move(usual)](const protocols::BlindedTrial& trial, const protocols::Question& question) {
        const auto asUsual = usual(trial, question);
        return player->answer(trial, question).value_or(asUsual);
    };
}

}  // namespace study::players
