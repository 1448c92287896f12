#include "rendering/models/generation.h"

#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "rendering/models/child_process.h"
#include "rendering/models/exchange.h"
#include "rendering/models/model_card.h"
#include "rendering/models/photograph_at_pitch.h"
#include "protocols/files/temporary_folder.h"

namespace rendering::models {

namespace {

void checkPhotographs(std::span<const PhotographToTouch> photographs)
{
    for (const PhotographToTouch& photograph : photographs) {
        if (photograph.photograph.empty() || photograph.photograph.type() != CV_8UC3)
            throw protocols::badInput({"an empty photograph, or one that is not 8-bit RGB", "generators", "CV_8UC3", ""});
        if (photograph.mmPerPixel && !(*photograph.mmPerPixel > 1e-5 && *photograph.mmPerPixel < 100))
            throw protocols::badInput({"a photograph's pitch is out of range", "generators", "millimetres a pixel", ""});
    }
}

/// How a photograph was brought before the networks.
struct Shown {
    cv::Size size;  ///< of its part, its own pixels
    bool middleOnly = false;
    std::optional<double> assumedMmPerPixel;
};

/// Nothing is known of millimetres there, so the height lies on the photograph's own pixels.
void backToPixels(GeneratedSignals& signals, const cv::Size& size, double mmPerPixel)
{
    if (signals.heightMm.empty()) return;
    if (signals.heightMm.size() != size) cv::resize(signals.heightMm, signals.heightMm, size, 0, 0, cv::INTER_AREA);
    signals.heightMmPerPixel = mmPerPixel;
}

}  // namespace

std::vector<GeneratedSignals> generate(std::span<const PhotographToTouch> photographs, const GenerationOptions& options)
{
    if (photographs.empty()) return {};
    checkPhotographs(photographs);
    GenerationOptions wish = options;
    if (wish.model.empty()) wish.model = shippedModel();
    wish.model = std::filesystem::absolute(wish.model);
    const ModelCardFields card = readModelCardFields(wish.model);
    checkWeightsFile(wish.model, card);
    const protocols::TemporaryFolder folder;
    RequestWriter request(folder.path(), wish);
    std::vector<Shown> shown;
    for (const PhotographToTouch& photograph : photographs) {
        const double pitch =
            photograph.mmPerPixel.value_or(assumedMmPerPixel(photograph.photograph, card.architecture.mmPerPixel));
        const SeenPhotograph seen = photographAtPitch({photograph.photograph, pitch}, card.architecture.mmPerPixel);
        request.add({seen.rgb, card.architecture.mmPerPixel});
        shown.push_back({seen.part.size(), seen.middleOnly, photograph.mmPerPixel ? std::nullopt : std::optional(pitch)});
    }
    request.finish();
    runGeneratorProgram({"generate", folder.path().string()}, folder.path() / "messages");
    std::vector<GeneratedSignals> answers = readAnswers(folder.path());
    if (answers.size() != photographs.size())
        throw protocols::workFailed({"vis2hap-nn answered " + std::to_string(answers.size()) + " of " +
                                         std::to_string(photographs.size()) + " photographs",
                                     "generators", "", ""});
    for (std::size_t i = 0; i < answers.size(); ++i) {
        answers[i].photograph.middleOnly = shown[i].middleOnly;
        answers[i].photograph.assumedMmPerPixel = shown[i].assumedMmPerPixel;
        if (shown[i].assumedMmPerPixel) backToPixels(answers[i], shown[i].size, *shown[i].assumedMmPerPixel);
    }
    return answers;
}

}  // namespace rendering::models
