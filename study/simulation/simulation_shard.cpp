#include "study/simulation/simulation_shard.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/protocol_json.h"
#include "protocols/secrets/secret_key.h"

namespace study::simulation {

namespace {

using nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "the numbers of a shard are little-endian");

constexpr int mostSimulated = 10'000'000;

template <class Number>
std::string hexOf(const std::vector<Number>& numbers)
{
    return protocols::hexText({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

/// Fails for another number of numbers than `count`.
template <class Number>
std::vector<Number> numbersFrom(const ordered_json& hex, std::size_t count)
{
    const std::string bytes = protocols::ofHexText(hex.get_ref<const std::string&>(), "shard");
    if (bytes.size() != count * sizeof(Number)) throw ordered_json::other_error::create(501, "other numbers of answers", nullptr);
    std::vector<Number> numbers(count);
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

/// A whole number from 0 to `most`; fails for any other.
int countIn(const ordered_json& json, const char* key, int most = mostSimulated)
{
    const std::uint64_t number = json.at(key).get_ref<const ordered_json::number_unsigned_t&>();
    if (number > static_cast<std::uint64_t>(most)) throw ordered_json::other_error::create(501, "impossible count", nullptr);
    return static_cast<int>(number);
}

/// Whether a participant can have given this number to the question.
bool isPossible(const protocols::AnswerKind& kind, std::int16_t value)
{
    if (value == SimulatedAnswers::none) return true;
    if (std::holds_alternative<protocols::FreeText>(kind)) return false;
    const auto* rating = std::get_if<protocols::Rating>(&kind);
    return rating != nullptr ? rating->scale.holds({value}) : value == 0 || value == 1;
}

/// Whether it is known of answers to same or different, and of no others, which pairs were the same.
bool arePossiblePairs(const SimulatedAnswers& one, const QuestionPlaces& question)
{
    for (std::size_t i = question.first; i < question.first + question.count(); ++i) {
        const bool isPair = asksForSameness(question) && one.values[i] != SimulatedAnswers::none;
        const bool isKnown = one.wasSame[i] == 0 || one.wasSame[i] == 1;
        if (isPair ? !isKnown : one.wasSame[i] != SimulatedAnswers::noPair) return false;
    }
    return true;
}

bool isPossibleTime(double seconds) { return std::isnan(seconds) || (std::isfinite(seconds) && seconds >= 0); }

SimulatedAnswers answersOfOne(const ordered_json& json, const MemoryStudy& study)
{
    const auto questions = placesOfQuestions(study);
    std::size_t values = 0;
    for (const QuestionPlaces& question : questions) values += question.count();
    SimulatedAnswers one;
    one.number = countIn(json, "participant");
    one.hasWithdrawn = json.at("withdrawn").get<bool>();
    one.voided = countIn(json, "voided");
    one.corrections = countIn(json, "corrections");
    one.refusals = countIn(json, "refusals");
    one.values = numbersFrom<std::int16_t>(json.at("values"), values);
    one.seconds = numbersFrom<double>(json.at("seconds"), values);
    if (json.contains("was_same")) one.wasSame = numbersFrom<std::int8_t>(json.at("was_same"), values);
    for (const QuestionPlaces& question : questions) {
        if (!one.wasSame.empty() && !arePossiblePairs(one, question))
            throw ordered_json::other_error::create(501, "an impossible pair", nullptr);
        for (std::size_t i = question.first; i < question.first + question.count(); ++i)
            if (!isPossible(*question.kind, one.values[i]) || !isPossibleTime(one.seconds[i]))
                throw ordered_json::other_error::create(501, "an impossible answer", nullptr);
    }
    return one;
}

protocols::Error otherShard(const std::string& what, const std::string& where)
{
    return protocols::badInput({what, where, "a shard as `vis2hap simulate --in-memory` writes it", "run this shard again"});
}

}  // namespace

SimulationRequest shareOf(const SimulationRequest& whole, const stats::Share& share)
{
    const auto behind = [&](std::size_t parts) {
        return static_cast<int>(static_cast<std::uint64_t>(whole.count) * parts / share.parts);
    };
    SimulationRequest own = whole;
    own.first = whole.first + behind(share.part);
    own.count = behind(share.part + 1) - behind(share.part);
    return own;
}

ordered_json sharedOptions(const database::StudyStore& store, const SimulationRequest& whole, bool hasMishaps)
{
    const auto& facts = store.facts();
    const auto version = store.protocolVersions().back();
    ordered_json fabrics = ordered_json::array();
    for (const auto& fabric : facts.fabrics) fabrics.push_back(fabric.value);
    return {{"study", facts.name},
            {"protocol", version.json},
            {"protocol_sha256", version.sha256},
            {"made_by", facts.programVersion},
            {"made_with", facts.madeWith},
            {"key_sha256", facts.keySha256},
            {"dataset_sha256", facts.datasetSha256},
            {"fabrics", fabrics},
            {"participants", whole.count},
            {"mishaps", hasMishaps},
            {"seed", whole.seed}};
}

SharedSimulation sharedSimulationFrom(const ordered_json& options, const std::string& where)
{
    try {
        SharedSimulation simulation;
        MemoryStudy& study = simulation.study;
        study.name = options.at("study").get<std::string>();
        study.protocolSha256 = options.at("protocol_sha256").get<std::string>();
        study.protocol = protocols::keptProtocolFromJson(options.at("protocol").get<std::string>(), where,
                                                         options.at("made_by").get<std::string>());
        std::set<std::string> named;
        for (const ordered_json& fabric : options.at("fabrics")) {
            study.fabrics.emplace_back(fabric.get<std::string>());
            if (!named.insert(study.fabrics.back().value).second)
                throw ordered_json::other_error::create(501, "a fabric twice", nullptr);
        }
        simulation.madeWith = options.at("made_with").get<std::string>();
        simulation.participants = countIn(options, "participants");
        simulation.hasMishaps = options.at("mishaps").get<bool>();
        return simulation;
    } catch (const ordered_json::exception&) {
        throw otherShard("the options of the shards are damaged", where);
    }
}

ordered_json answersJson(const std::vector<SimulatedAnswers>& answers)
{
    ordered_json json = ordered_json::array();
    for (const SimulatedAnswers& one : answers) {
        json.push_back({{"participant", one.number},
                        {"withdrawn", one.hasWithdrawn},
                        {"voided", one.voided},
                        {"corrections", one.corrections},
                        {"refusals", one.refusals},
                        {"values", hexOf(one.values)},
                        {"seconds", hexOf(one.seconds)}});
        if (!one.wasSame.empty()) json.back()["was_same"] = hexOf(one.wasSame);
    }
    return json;
}

std::vector<SimulatedAnswers> answersFrom(const ordered_json& json, const SharedSimulation& simulation, int first, int count,
                                          const std::string& where)
{
    std::vector<SimulatedAnswers> answers;
    try {
        for (const ordered_json& one : json) answers.push_back(answersOfOne(one, simulation.study));
    } catch (const ordered_json::exception&) {
        throw otherShard("the answers of the shard are damaged", where);
    } catch (const protocols::Error&) {
        throw otherShard("the answers of the shard are damaged", where);
    }
    for (std::size_t i = 0; i < answers.size(); ++i)
        if (answers[i].number != first + static_cast<int>(i)) throw otherShard("the shard has other participants", where);
    if (answers.size() != static_cast<std::size_t>(count)) throw otherShard("the shard has other participants", where);
    return answers;
}

}  // namespace study::simulation
