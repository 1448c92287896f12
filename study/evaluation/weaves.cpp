#include "study/evaluation/weaves.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/models/photograph_at_pitch.h"
#include "study/evaluation/leaks.h"

namespace study::evaluation {

namespace {

namespace fabrics = rendering::fabrics;
namespace models = rendering::models;

constexpr std::size_t photographsPerCall = 6;

void compareWaves(WeaveComparison& weave, const cv::Mat& photograph, const cv::Mat& heightMm)
{
    // Compare on the pixels of the relief. If the scale is unknown, these are the pixels of the photograph.
    cv::Mat seen = photograph;
    if (seen.size() != heightMm.size()) cv::resize(photograph, seen, heightMm.size(), 0, 0, cv::INTER_AREA);
    weave.photograph = rendering::signals::dominantWave(seen);
    weave.relief = rendering::signals::dominantWave(heightMm);
    if (!weave.comparable()) return;
    weave.periodChange = weave.relief->periodPx / weave.photograph->periodPx - 1;
    weave.turnDeg = rendering::signals::angleBetween(*weave.photograph, *weave.relief);
    weave.shareOfRelief = rendering::signals::waveShare(heightMm, *weave.relief);
    weave.shareOfPhotograph = rendering::signals::waveShare(seen, *weave.photograph);
}

std::string figure(const char* format, double value)
{
    char text[40];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string waveText(const std::optional<rendering::signals::DominantWave>& wave)
{
    return wave ? figure("%6.2f px ", wave->periodPx) + figure("%4.0f deg", wave->directionDeg) : std::string("no clear wave");
}

nlohmann::ordered_json waveJson(const std::optional<rendering::signals::DominantWave>& wave)
{
    if (!wave) return nullptr;
    return {{"period_px", wave->periodPx}, {"direction_deg", wave->directionDeg}, {"prominence", wave->prominence}};
}

}  // namespace

bool WeaveComparison::kept() const
{
    return comparable() && std::abs(periodChange) <= mostPeriodChange && turnDeg <= mostTurnDeg &&
           shareOfRelief >= leastShareRatio * shareOfPhotograph && shareOfRelief <= mostShareRatio * shareOfPhotograph;
}

WeaveReport evaluateWeaves(const fabrics::Dataset& dataset, const EvaluationRequest& request, const Report& report,
                           const Generate& generate)
{
    WeaveReport weaves;
    weaves.dataset = dataset.name;
    models::GenerationOptions options;
    options.model = request.model.empty() ? models::shippedModel() : request.model;
    options.quality = request.quality;
    options.friction = false;
    const models::ModelCardFields card = models::readModelCardFields(options.model);
    weaves.model = card.summary.name;
    for (const auto& [fabric, count] : photographsTrainedOn(dataset, card.summary.trainingSampleHashes))
        weaves.trainedOn += count;
    for (const auto& fabric : dataset.fabrics)
        for (const int index : fabrics::sampleIndices(dataset, fabric.id, Modality::Visual))
            weaves.photographs.push_back({fabric.id, fabric.name, index, {}, {}, 0, 0, 0, 0, {}});
    if (weaves.photographs.empty())
        throw protocols::badInput({"the data set has no photographs to test with", dataset.folder.string(),
                                   "visual/*.png of at least one fabric", "import photographs with `vis2hap import photos`"});
    const fabrics::PhotographViews views(dataset);
    for (std::size_t first = 0; first < weaves.photographs.size(); first += photographsPerCall) {
        const std::size_t end = std::min(weaves.photographs.size(), first + photographsPerCall);
        std::vector<models::InputPhotograph> photographs;
        for (std::size_t i = first; i < end; ++i)
            photographs.push_back({fabrics::readPhotograph(dataset, weaves.photographs[i].fabric, weaves.photographs[i].index),
                                   views.mmPerPixel(weaves.photographs[i].fabric, weaves.photographs[i].index),
                                   views.lightDeg(weaves.photographs[i].fabric, weaves.photographs[i].index),
                                   dataset.fabric(weaves.photographs[i].fabric).fibre});
        const auto answers = generate(photographs, options);
        for (std::size_t i = first; i < end; ++i) {
            const models::InputPhotograph& input = photographs[i - first];
            compareWaves(weaves.photographs[i], input.photograph(models::usedPart(input, card.architecture)),
                         answers[i - first].heightMm);
            weaves.photographs[i].facts = answers[i - first].photograph;
        }
        if (report) report("reliefs of photographs", static_cast<int>(end), static_cast<int>(weaves.photographs.size()));
    }
    return weaves;
}

nlohmann::ordered_json weavesJson(const WeaveReport& weaves)
{
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const WeaveComparison& weave : weaves.photographs) {
        nlohmann::ordered_json row{{"fabric", weave.fabric.value},
                                   {"name", weave.name},
                                   {"index", weave.index},
                                   {"photograph", waveJson(weave.photograph)},
                                   {"relief", waveJson(weave.relief)}};
        row["period_change"] = weave.comparable() ? nlohmann::ordered_json(weave.periodChange) : nullptr;
        row["turn_deg"] = weave.comparable() ? nlohmann::ordered_json(weave.turnDeg) : nullptr;
        row["share_of_photograph"] = weave.comparable() ? nlohmann::ordered_json(weave.shareOfPhotograph) : nullptr;
        row["share_of_relief"] = weave.comparable() ? nlohmann::ordered_json(weave.shareOfRelief) : nullptr;
        row["kept"] = weave.photograph ? nlohmann::ordered_json(weave.kept()) : nullptr;
        constexpr const char* none = "the photograph or the relief has no clear wave";
        if (!weave.comparable())
            for (const char* field : {"period_change", "turn_deg", "share_of_photograph", "share_of_relief"})
                row["why"][field] = none;
        if (!weave.photograph) row["why"]["photograph"] = row["why"]["kept"] = "the photograph has no clear wave";
        if (!weave.relief) row["why"]["relief"] = "the relief has no clear wave";
        rows.push_back(row);
    }
    return {{"schema", "vis2hap.evaluation/1"},
            {"dataset", weaves.dataset},
            {"model", weaves.model},
            {"photographs_trained_on", weaves.trainedOn},
            {"weaves", rows}};
}

std::string weavesText(const WeaveReport& weaves)
{
    std::string text = "Generated reliefs of photographs without measurements: model \"" + weaves.model + "\" on \"" +
                       weaves.dataset +
                       "\"\n  strongest wave of the photograph and of the relief, period and direction, on the same pixels\n";
    if (weaves.trainedOn > 0)
        text += "  MEMORY: the model was trained on " + std::to_string(weaves.trainedOn) + " of these " +
                std::to_string(weaves.photographs.size()) + " photographs; what it made of them also measures memory\n";
    std::size_t width = 0;
    for (const WeaveComparison& weave : weaves.photographs) width = std::max(width, weave.name.size());
    int kept = 0, withWave = 0;
    for (const WeaveComparison& weave : weaves.photographs) {
        std::string name = weave.name;
        name.resize(width, ' ');
        text += "  " + weave.fabric.value + " " + name + " " + figure("%3.0f", weave.index) + "  photograph " +
                waveText(weave.photograph) + "  relief " + waveText(weave.relief);
        if (weave.comparable())
            text += "  off by " + figure("%5.1f %%", 100 * weave.periodChange) + figure(" and %4.1f deg", weave.turnDeg) +
                    figure(", share of power %4.1f %%", 100 * weave.shareOfRelief) +
                    figure(" (photograph %4.1f %%)", 100 * weave.shareOfPhotograph);
        if (weave.photograph) {
            ++withWave;
            kept += weave.kept() ? 1 : 0;
            text += weave.kept() ? "  kept" : "  NOT KEPT";
        }
        if (weave.facts.assumedMmPerPixel)
            text += figure("  (scale unknown, taken as %.3f mm/px)", *weave.facts.assumedMmPerPixel);
        text += "\n";
    }
    return text + "  kept within 5 % and 5 deg, with a third to twice the photograph's share of power: " + std::to_string(kept) +
           " of " + std::to_string(withWave) + " photographs with a clear wave\n";
}

}  // namespace study::evaluation
