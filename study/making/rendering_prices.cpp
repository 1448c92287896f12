#include "study/making/rendering_prices.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <optional>

#include "protocols/condition.h"
#include "rendering/composition/fabric_signals.h"
#include "rendering/composition/render_json.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/descriptive.h"
#include "stats/tests/t_tests.h"
#include "study/evaluation/height_comparison.h"
#include "study/players/percept.h"

namespace study::making {

namespace {

using protocols::Condition;
using protocols::ConditionId;
using protocols::FabricId;
using protocols::Quality;
using rendering::FabricSignals;
using rendering::RenderedCondition;
using rendering::RenderedFabrics;
using rendering::Signal;
using reports::PriceFact;
using reports::PriceMeasure;
using reports::RenderingPrice;
using stats::Value;

/// Share of the middle of its distribution that order statistics must cover.
constexpr double coverage = 0.95;

constexpr const char* noChoice = "its signals are used as they were recorded";
constexpr const char* notComputedAnew = "a signal was not computed anew";
constexpr const char* noRelief = "the condition has no relief";
constexpr const char* noHeight = "the condition has no relief in millimetres";
constexpr const char* noFriction = "the condition has no friction";
constexpr const char* noMeasured = "the study shows no measured signal of the same kind";

bool carriesQuality(const ConditionId& id) { return protocols::qualityOf(id).has_value(); }

/// The measured condition with the same parts: h for h_g and v_shape, f for f_g, h&f for h_g&f_g; none for measured ones.
std::optional<std::string> measuredCounterpart(const Condition& condition)
{
    using protocols::ConditionGroup, protocols::FrictionSource, protocols::ReliefSource;
    if (condition.group == ConditionGroup::Measured || !condition.hasQuality()) return std::nullopt;
    const bool relief = condition.relief != ReliefSource::None, friction = condition.friction != FrictionSource::None;
    return relief && friction ? "h&f" : relief ? "h" : "f";
}

const RenderedCondition* renderedAs(const RenderedFabrics& rendering, const ConditionId& id)
{
    const auto found = std::ranges::find(rendering.conditions, id, &RenderedCondition::condition);
    return found == rendering.conditions.end() ? nullptr : &*found;
}

/// The accurate rendering of a row, under its own id or as the usual quality.
const RenderedCondition* accurateOf(const RenderedFabrics& rendering, const Condition& row)
{
    for (const ConditionId& id : {withQuality(row, Quality::Accurate), row.conditionId()})
        if (const auto* rendered = renderedAs(rendering, id); rendered && rendered->quality == Quality::Accurate) return rendered;
    return nullptr;
}

/// The rendering of a measured row that the study shows, the accurate one first.
const RenderedCondition* measuredRendering(const RenderedFabrics& rendering, const std::string& row)
{
    const Condition& condition = protocols::conditionNamed(row);
    if (const auto* accurate = accurateOf(rendering, condition)) return accurate;
    return renderedAs(rendering, condition.conditionId());
}

/// One value for each fabric, or the reason why a fabric has none.
using ByFabric = std::vector<Value>;

std::optional<std::string> reasonIn(const ByFabric& values)
{
    if (values.empty()) return "no fabric was rendered";
    for (const Value& value : values)
        if (!value.exists()) return value.why();
    return std::nullopt;
}

std::vector<double> numbersOf(const ByFabric& values)
{
    std::vector<double> numbers;
    for (const Value& value : values) numbers.push_back(*value);
    return numbers;
}

PriceFact undefinedFact(const std::string& why)
{
    return {Value::undefined(why), {Value::undefined(why), Value::undefined(why)}};
}

/// Mean with Student's interval.
PriceFact meanFact(const ByFabric& values)
{
    if (const auto why = reasonIn(values)) return undefinedFact(*why);
    const auto numbers = numbersOf(values);
    const auto test = stats::oneSampleTTest(numbers);
    if (test.why.empty()) return {test.estimate, test.ci};
    return {stats::meanOf(numbers), {Value::undefined(test.why), Value::undefined(test.why)}};
}

/// Number of order statistics to leave out at each end, so that the others cover the median with at least `coverage`;
/// nothing where even the extremes do not.
std::optional<std::size_t> leftOut(std::size_t n)
{
    const double outside = (1 - coverage) / 2;
    double probability = std::pow(0.5, static_cast<double>(n)), tail = probability;
    if (tail > outside) return std::nullopt;
    for (std::size_t k = 1; k < n; ++k) {
        probability *= static_cast<double>(n - k + 1) / static_cast<double>(k);
        tail += probability;
        if (tail > outside) return k - 1;
    }
    return std::nullopt;
}

/// Median with the interval of order statistics, because the first photograph of a run may take many times as long.
PriceFact medianFact(const ByFabric& values)
{
    if (const auto why = reasonIn(values)) return undefinedFact(*why);
    auto numbers = numbersOf(values);
    std::ranges::sort(numbers);
    PriceFact fact = undefinedFact("needs at least 6 fabrics");
    fact.value = stats::median(numbers);
    if (const auto out = leftOut(numbers.size())) fact.ci95 = {numbers[*out], numbers[numbers.size() - 1 - *out]};
    return fact;
}

/// Sum over the computed signals of an image. A trace is computed with its spectrogram.
Value millisecondsOf(const Condition& row, const FabricSignals& signals)
{
    double sum = 0;
    for (const Signal signal : rendering::signalsFor(row)) {
        if (rendering::recordingOf(signal) == signal || signal == Signal::GeneratedTrace) continue;
        const auto found = signals.milliseconds.find(signal);
        if (found == signals.milliseconds.end() || !(found->second > 0)) return Value::undefined(notComputedAnew);
        sum += found->second;
    }
    return sum;
}

cv::Mat middleOf(const cv::Mat& map, const cv::Size& size)
{
    return map(cv::Rect({(map.cols - size.width) / 2, (map.rows - size.height) / 2}, size));
}

/// Root mean square of the difference over that of the accurate relief about its mean, percent. Constants do not count, because
/// the range of the display removes them.
Value reliefError(const cv::Mat& relief, const cv::Mat& accurate)
{
    const cv::Size size(std::min(relief.cols, accurate.cols), std::min(relief.rows, accurate.rows));
    cv::Mat truth, difference;
    middleOf(accurate, size).convertTo(truth, CV_64F);
    middleOf(relief, size).convertTo(difference, CV_64F);
    difference -= truth;
    cv::Scalar mean, sd, meanOfTruth, sdOfTruth;
    cv::meanStdDev(difference, mean, sd);
    cv::meanStdDev(truth, meanOfTruth, sdOfTruth);
    if (!(sdOfTruth[0] > 0)) return Value::undefined("an accurate relief is flat");
    return 100 * sd[0] / sdOfTruth[0];
}

Value relativeError(double value, double truth)
{
    if (!(std::abs(truth) > 0)) return Value::undefined("the mean friction is 0");
    return 100 * std::abs(value - truth) / std::abs(truth);
}

/// Where friction multiplies a relief only its mean is used; else mean absolute difference of the traces over the mean, percent.
Value frictionError(const rendering::Sources& sources, const rendering::Sources& accurate, bool meanOnly)
{
    if (meanOnly) return relativeError(sources.meanFriction.value_or(0), accurate.meanFriction.value_or(0));
    const std::size_t n = std::min(sources.trace.size(), accurate.trace.size());
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        difference += std::abs(sources.trace[i] - accurate.trace[i]);
        sum += accurate.trace[i];
    }
    if (!(std::abs(sum) > 0)) return Value::undefined("the mean friction is 0");
    return 100 * difference / std::abs(sum);
}

/// Distance of the spectra of the generated and the measured height, dB.
Value heightSpectrum(const FabricSignals& generated, const FabricSignals& measured)
{
    const auto height = generated.images.find(Signal::GeneratedHeight), press = measured.images.find(Signal::PhotometricHeight);
    if (height == generated.images.end() || press == measured.images.end()) return Value::undefined(noMeasured);
    const double pitch = measured.tactileMmPerPixel.value_or(generated.generatedMmPerPixel.value_or(1));
    evaluation::HeightMap known{press->second, pitch};
    const auto made = evaluation::atPitch({height->second, generated.generatedMmPerPixel.value_or(pitch)}, pitch);
    if (known.heightMm.type() != CV_32FC1) known.heightMm.convertTo(known.heightMm, CV_32F);
    const int side = std::min({made.heightMm.cols, made.heightMm.rows, known.heightMm.cols, known.heightMm.rows});
    return evaluation::bandDistance(heightFeatures(made, side), heightFeatures(known, side));
}

struct FeltDifference {
    double texture = 0, slipperiness = 0;
    double together() const { return std::hypot(texture, slipperiness); }
};

FeltDifference feltBetween(const players::Percept& a, const players::Percept& b)
{
    return {textureDistance(a, b), slipperinessDistance(a, b)};
}

/// Compares the renderings of one study; every image is felt once.
class PriceList {
public:
    PriceList(const RenderedFabrics& rendering, const rendering::DisplayResponse* response)
        : m_rendering(rendering), m_response(response)
    {
    }

    RenderingPrice priceOf(const ConditionId& id)
    {
        const Condition& row = protocols::conditionNamed(id.value);
        const RenderedCondition& rendered = *renderedAs(m_rendering, id);
        RenderingPrice price{id.value,
                             std::string(row.id),
                             nameOf(rendered.quality),
                             rendering::settingsOf(rendered.quality).dump(),
                             !carriesQuality(id),
                             rendered.images.size(),
                             {}};
        price[PriceMeasure::Milliseconds] = medianFact(
            over(rendered, [&](const FabricId& fabric) { return millisecondsOf(row, signalsAt(rendered).at(fabric)); }));
        addErrors(price, row, rendered);
        addMeasured(price, row, rendered);
        return price;
    }

private:
    const std::map<FabricId, FabricSignals>& signalsAt(const RenderedCondition& rendered) const
    {
        return m_rendering.signalsAt.at(rendered.quality);
    }

    static ByFabric over(const RenderedCondition& rendered, const std::function<Value(const FabricId&)>& valueOf)
    {
        ByFabric values;
        for (const auto& [fabric, image] : rendered.images) values.push_back(valueOf(fabric));
        return values;
    }

    const players::Percept& felt(const RenderedCondition& rendered, const FabricId& fabric)
    {
        const auto key = std::pair(rendered.condition, fabric);
        if (const auto known = m_felt.find(key); known != m_felt.end()) return known->second;
        const cv::Mat& image = rendered.images.at(fabric);
        const auto percept = players::feel(m_response != nullptr ? frictionOnDisplay(image, *m_response) : image);
        return m_felt.emplace(key, percept).first->second;
    }

    FeltDifference difference(const RenderedCondition& a, const RenderedCondition& b, const FabricId& fabric)
    {
        const players::Percept first = felt(a, fabric);
        return feltBetween(first, felt(b, fabric));
    }

    void addErrors(RenderingPrice& price, const Condition& row, const RenderedCondition& rendered)
    {
        const RenderedCondition* accurate = accurateOf(m_rendering, row);
        constexpr PriceMeasure measures[] = {PriceMeasure::ReliefError, PriceMeasure::FrictionError, PriceMeasure::FeltDifference,
                                             PriceMeasure::FeltTexture, PriceMeasure::FeltSlipperiness};
        if (accurate == nullptr) {
            for (const PriceMeasure measure : measures) price[measure] = undefinedFact(noChoice);
            return;
        }
        const bool relief = row.relief != protocols::ReliefSource::None,
                   friction = row.friction != protocols::FrictionSource::None;
        const auto sources = [&](const RenderedCondition& one, const FabricId& fabric) {
            return sourcesOf(row, signalsAt(one).at(fabric));
        };
        price[PriceMeasure::ReliefError] =
            relief ? meanFact(over(rendered,
                                   [&](const FabricId& fabric) {
                                       return reliefError(sources(rendered, fabric).relief, sources(*accurate, fabric).relief);
                                   }))
                   : undefinedFact(noRelief);
        price[PriceMeasure::FrictionError] =
            friction ? meanFact(over(rendered,
                                     [&](const FabricId& fabric) {
                                         return frictionError(sources(rendered, fabric), sources(*accurate, fabric), relief);
                                     }))
                     : undefinedFact(noFriction);
        const auto feltFact = [&](const auto& part) {
            return meanFact(
                over(rendered, [&](const FabricId& fabric) { return Value(part(difference(rendered, *accurate, fabric))); }));
        };
        price[PriceMeasure::FeltDifference] = feltFact([](const FeltDifference& one) { return one.together(); });
        price[PriceMeasure::FeltTexture] = feltFact([](const FeltDifference& one) { return one.texture; });
        price[PriceMeasure::FeltSlipperiness] = feltFact([](const FeltDifference& one) { return one.slipperiness; });
    }

    void addMeasured(RenderingPrice& price, const Condition& row, const RenderedCondition& rendered)
    {
        constexpr PriceMeasure measures[] = {PriceMeasure::HeightSpectrum, PriceMeasure::MeanFrictionError,
                                             PriceMeasure::FeltFromMeasured};
        const auto counterpart = measuredCounterpart(row);
        const char* why = row.group == protocols::ConditionGroup::Measured ? "its signals are measured" : noMeasured;
        const RenderedCondition* measured = counterpart ? measuredRendering(m_rendering, *counterpart) : nullptr;
        if (measured == nullptr) {
            for (const PriceMeasure measure : measures) price[measure] = undefinedFact(why);
            return;
        }
        price[PriceMeasure::HeightSpectrum] = meanFact(over(rendered, [&](const FabricId& fabric) {
            if (row.relief != protocols::ReliefSource::GeneratedHeight) return Value::undefined(noHeight);
            return heightSpectrum(signalsAt(rendered).at(fabric), signalsAt(*measured).at(fabric));
        }));
        price[PriceMeasure::MeanFrictionError] = meanFact(over(rendered, [&](const FabricId& fabric) {
            const auto& made = signalsAt(rendered).at(fabric).generatedMeanFriction;
            const FabricSignals& known = signalsAt(*measured).at(fabric);
            if (row.friction == protocols::FrictionSource::None) return Value::undefined(noFriction);
            if (!made || !known.measuredMeanFriction || known.measuredQuantity != "mu") return Value::undefined(noMeasured);
            return relativeError(*made, *known.measuredMeanFriction);
        }));
        price[PriceMeasure::FeltFromMeasured] = meanFact(
            over(rendered, [&](const FabricId& fabric) { return Value(difference(rendered, *measured, fabric).together()); }));
    }

    const RenderedFabrics& m_rendering;
    const rendering::DisplayResponse* m_response;
    std::map<std::pair<ConditionId, FabricId>, players::Percept> m_felt;
};

}  // namespace

std::vector<ConditionId> accurateReferences(const std::vector<ConditionId>& conditions)
{
    std::vector<ConditionId> references;
    if (std::ranges::none_of(conditions, carriesQuality)) return references;
    for (const ConditionId& id : conditions) {
        const Condition& row = protocols::conditionNamed(id.value);
        if (!row.hasQuality()) continue;
        const ConditionId accurate = withQuality(row, Quality::Accurate);
        const auto isIn = [&](const std::vector<ConditionId>& list) { return std::ranges::find(list, accurate) != list.end(); };
        if (!isIn(conditions) && !isIn(references)) references.push_back(accurate);
    }
    return references;
}

std::vector<RenderingPrice> renderingPrices(const std::vector<ConditionId>& conditions, const RenderedFabrics& rendering,
                                            const rendering::DisplayResponse* response)
{
    std::vector<RenderingPrice> prices;
    if (std::ranges::none_of(conditions, carriesQuality)) return prices;
    PriceList list(rendering, response);
    for (const ConditionId& id : conditions) prices.push_back(list.priceOf(id));
    return prices;
}

}  // namespace study::making
