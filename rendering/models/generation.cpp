#include "rendering/models/generation.h"

#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/temporary_folder.h"
#include "rendering/models/exchange.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/models/photograph_at_pitch.h"
#include "rendering/models/process/child_process.h"

namespace rendering::models {

namespace {

void checkPhotographs(std::span<const InputPhotograph> photographs)
{
    for (const InputPhotograph& photograph : photographs) {
        if (photograph.photograph.empty() || photograph.photograph.type() != CV_8UC3)
            throw protocols::badInput(
                {"the photograph is empty or not 8-bit RGB", "generators", "8-bit RGB", "convert it to 8-bit RGB"});
        if (photograph.mmPerPixel && !(*photograph.mmPerPixel > 1e-5 && *photograph.mmPerPixel < 100))
            throw protocols::badInput({"the pitch of the photograph is out of range", "generators", "0.00001 to 100 mm per pixel",
                                       "correct the pitch of the camera"});
        if (photograph.lightDeg && !(*photograph.lightDeg >= -360 && *photograph.lightDeg <= 360))
            throw protocols::badInput({"the side of the lamp is out of range", "generators", "-360 to 360 degrees",
                                       "correct the side, or leave it out"});
    }
}

/// Part of a photograph that was passed to the networks.
struct UsedPart {
    cv::Size size;  ///< in the photograph's own pixels
    bool middleOnly = false;
    std::optional<double> assumedMmPerPixel;
};

/// Scales the height to the photograph's own pixels, because their size in millimetres is unknown.
void scaleToPhotograph(GeneratedSignals& signals, const cv::Size& size, double mmPerPixel)
{
    if (signals.heightMm.empty()) return;
    if (signals.heightMm.size() != size) cv::resize(signals.heightMm, signals.heightMm, size, 0, 0, cv::INTER_AREA);
    signals.heightMmPerPixel = mmPerPixel;
}

}  // namespace

std::vector<GeneratedSignals> generate(std::span<const InputPhotograph> photographs, const GenerationOptions& options)
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
    std::vector<UsedPart> parts;
    double megapixels = 0;
    for (const InputPhotograph& photograph : photographs) {
        const double pitch = photograph.mmPerPixel.value_or(assumedMmPerPixel(photograph.photograph, card.architecture));
        const double pitchOfNetworks = card.architecture.sees ? pitch : card.architecture.mmPerPixel;
        const PhotographAtPitch seen = photographAtPitch({photograph.photograph, pitch}, pitchOfNetworks);
        megapixels += static_cast<double>(seen.rgb.total()) / 1e6;
        request.add({seen.rgb, pitchOfNetworks, photograph.lightDeg, photograph.fibre});
        parts.push_back({seen.part.size(), seen.middleOnly, photograph.mmPerPixel ? std::nullopt : std::optional(pitch)});
    }
    request.finish();
    runGeneratorProgram({"generate", folder.path().string()}, folder.path() / "messages", generationLimits(megapixels));
    std::vector<GeneratedSignals> answers = readAnswers(folder.path());
    if (answers.size() != photographs.size())
        throw protocols::workFailed({"vis2hap-nn answered " + std::to_string(answers.size()) + " of " +
                                         std::to_string(photographs.size()) + " photographs",
                                     "generators", "an answer for each photograph", "build both executables again"});
    for (std::size_t i = 0; i < answers.size(); ++i) {
        answers[i].photograph.middleOnly = parts[i].middleOnly;
        answers[i].photograph.assumedMmPerPixel = parts[i].assumedMmPerPixel;
        if (parts[i].assumedMmPerPixel) scaleToPhotograph(answers[i], parts[i].size, *parts[i].assumedMmPerPixel);
    }
    return answers;
}

}  // namespace rendering::models
