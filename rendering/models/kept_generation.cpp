#include "rendering/models/kept_generation.h"

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "protocols/files/sha256.h"
#include "protocols/json_count.h"
#include "rendering/cache/cache_key.h"
#include "rendering/cache/packed_result.h"
#include "rendering/models/exchange.h"
#include "rendering/models/model_card.h"
#include "rendering/models/process/child_process.h"

namespace rendering::models {

namespace {

using nlohmann::json;

/// Height and friction are kept apart: a condition may need only one of them.
enum class Kept { Height, Friction };

std::string hashOfPixels(const cv::Mat& photograph)
{
    const cv::Mat whole = photograph.isContinuous() ? photograph : photograph.clone();
    return protocols::sha256({reinterpret_cast<const char*>(whole.data), whole.total() * whole.elemSize()});
}

std::string keyOf(cache::ResultCache& cache, Kept part, const std::string& generators, const InputPhotograph& photograph,
                  const GenerationOptions& options)
{
    return cache::CacheKey(cache, part == Kept::Height ? "generated height" : "generated friction")
        .add("generators", generators)
        .add("quality", nameOf(options.quality))
        .add("columns", photograph.photograph.cols)
        .add("rows", photograph.photograph.rows)
        .add("type", photograph.photograph.type())
        .add("pixels", hashOfPixels(photograph.photograph))
        .add("mm_per_pixel", photograph.mmPerPixel)
        .add("light_deg", photograph.lightDeg)
        .add("fibre", photograph.fibre && part == Kept::Friction ? nameOf(*photograph.fibre) : std::string())
        .hex();
}

json jsonOrNull(const std::optional<double>& number) { return number ? json(*number) : json(nullptr); }

std::optional<double> numberFrom(const json& value)
{
    return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

std::string packedHeight(const GeneratedSignals& signals)
{
    const json facts{{"mm_per_pixel", signals.heightMmPerPixel},
                     {"ms", signals.heightMilliseconds},
                     {"middle_only", signals.photograph.middleOnly},
                     {"assumed_mm_per_pixel", jsonOrNull(signals.photograph.assumedMmPerPixel)}};
    return cache::packed({facts.dump(), {signals.heightMm}});
}

std::string packedFriction(const GeneratedSignals& signals)
{
    const auto& interval = signals.photograph.meanFriction;
    const auto& parameters = signals.spectrogramParameters;
    const json facts{{"mm_per_sample", signals.traceMmPerSample},
                     {"ms", signals.frictionMilliseconds},
                     {"mean", signals.meanFriction},
                     {"interval", interval ? json{interval->low, interval->high} : json(nullptr)},
                     {"spectrogram", {parameters.windowLength, parameters.hop, parameters.fftSize, parameters.sampleRateHz}},
                     {"middle_only", signals.photograph.middleOnly},
                     {"assumed_mm_per_pixel", jsonOrNull(signals.photograph.assumedMmPerPixel)}};
    return cache::packed({facts.dump(), {signals.spectrogram, cv::Mat(signals.trace, true)}});
}

void takePhotographFacts(GeneratedSignals& signals, const json& facts)
{
    signals.photograph.middleOnly = facts.at("middle_only").get<bool>();
    signals.photograph.assumedMmPerPixel = numberFrom(facts.at("assumed_mm_per_pixel"));
}

/// The array that a result holds at the place. Throws std::exception where it has another type: its values would be read beyond
/// its end.
const cv::Mat& keptArray(const cache::PackedResult& result, std::size_t place, int type)
{
    const cv::Mat& array = result.arrays.at(place);
    if (array.empty() || array.type() != type) throw std::invalid_argument("a kept array is empty or has another type");
    return array;
}

/// Throws std::exception where it is not.
double positive(const json& value)
{
    const double number = value.get<double>();
    if (!(number > 0)) throw std::invalid_argument("a kept length is not positive");
    return number;
}

/// Throws std::exception, as takeFriction() does, for other fields and arrays.
void takeHeight(GeneratedSignals& signals, const cache::PackedResult& result)
{
    const json facts = json::parse(result.factsJson);
    takePhotographFacts(signals, facts);
    signals.heightMm = keptArray(result, 0, CV_32FC1);
    signals.heightMmPerPixel = positive(facts.at("mm_per_pixel"));
    signals.heightMilliseconds = facts.at("ms").get<double>();
}

void takeFriction(GeneratedSignals& signals, const cache::PackedResult& result)
{
    const json facts = json::parse(result.factsJson);
    takePhotographFacts(signals, facts);
    signals.spectrogram = keptArray(result, 0, CV_32FC1);
    const cv::Mat& trace = keptArray(result, 1, CV_64FC1);
    signals.trace.assign(trace.begin<double>(), trace.end<double>());
    signals.traceMmPerSample = positive(facts.at("mm_per_sample"));
    signals.frictionMilliseconds = facts.at("ms").get<double>();
    signals.meanFriction = facts.at("mean").get<double>();
    if (const auto& interval = facts.at("interval"); !interval.is_null())
        signals.photograph.meanFriction = FrictionInterval{interval.at(0).get<double>(), interval.at(1).get<double>()};
    const auto& parameters = facts.at("spectrogram");
    signals.spectrogramParameters = {protocols::wholeOf<int>(parameters.at(0)), protocols::wholeOf<int>(parameters.at(1)),
                                     protocols::wholeOf<int>(parameters.at(2)), parameters.at(3).get<double>()};
}

/// False where the cache does not have this part.
bool takeKept(cache::ResultCache& cache, Kept part, const std::string& key, GeneratedSignals& signals)
{
    const auto bytes = cache.find(key);
    const auto result = bytes ? cache::unpacked(*bytes) : std::nullopt;
    if (!result) return false;
    try {
        part == Kept::Height ? takeHeight(signals, *result) : takeFriction(signals, *result);
        return true;
    } catch (const std::exception&) {  // of another layout
        return false;
    }
}

/// Moves the parts that were asked for into the answer that may hold another part already.
void join(GeneratedSignals& into, GeneratedSignals&& from, bool height, bool friction)
{
    if (height) {
        into.heightMm = from.heightMm;
        into.heightMmPerPixel = from.heightMmPerPixel;
        into.heightMilliseconds = from.heightMilliseconds;
    }
    if (friction) {
        into.spectrogram = from.spectrogram;
        into.trace = std::move(from.trace);
        into.traceMmPerSample = from.traceMmPerSample;
        into.frictionMilliseconds = from.frictionMilliseconds;
        into.meanFriction = from.meanFriction;
        into.spectrogramParameters = from.spectrogramParameters;
        into.photograph.meanFriction = from.photograph.meanFriction;
    }
    into.photograph.middleOnly = from.photograph.middleOnly;
    into.photograph.assumedMmPerPixel = from.photograph.assumedMmPerPixel;
}

}  // namespace

std::string identityOfGenerators(cache::ResultCache& cache, const GenerationOptions& options)
{
    const auto model = options.model.empty() ? shippedModel() : options.model;
    return readModelCard(model).sha256 + " " + cache.hashOfFile(cardOf(model)) + " " + cache.hashOfFile(generatorProgram());
}

std::vector<GeneratedSignals> KeptGeneration::operator()(std::span<const InputPhotograph> photographs,
                                                         const GenerationOptions& options)
{
    if (m_cache == nullptr) {
        m_generated += static_cast<int>(photographs.size());
        return m_generate(photographs, options);
    }
    const std::string generators = identityOfGenerators(*m_cache, options);
    std::vector<GeneratedSignals> answers(photographs.size());
    std::vector<InputPhotograph> missing;
    std::vector<std::size_t> places;
    GenerationOptions wanted = options;
    wanted.height = wanted.friction = false;
    for (std::size_t i = 0; i < photographs.size(); ++i) {
        bool isWhole = true;
        for (const auto& [part, isAsked, isWanted] :
             {std::tuple{Kept::Height, options.height, &wanted.height}, {Kept::Friction, options.friction, &wanted.friction}})
            if (isAsked && !takeKept(*m_cache, part, keyOf(*m_cache, part, generators, photographs[i], options), answers[i])) {
                *isWanted = true;
                isWhole = false;
            }
        if (isWhole) continue;
        missing.push_back(photographs[i]);
        places.push_back(i);
    }
    if (missing.empty()) return answers;
    auto made = m_generate(missing, wanted);
    m_generated += static_cast<int>(missing.size());
    if (made.size() != missing.size()) return made;  // the caller refuses answers of another number
    for (std::size_t i = 0; i < made.size(); ++i) {
        if (wanted.height) m_cache->keep(keyOf(*m_cache, Kept::Height, generators, missing[i], options), packedHeight(made[i]));
        if (wanted.friction)
            m_cache->keep(keyOf(*m_cache, Kept::Friction, generators, missing[i], options), packedFriction(made[i]));
        join(answers[places[i]], std::move(made[i]), wanted.height, wanted.friction);
    }
    return answers;
}

}  // namespace rendering::models
