#include "study/photographs/photograph_steps.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "rendering/composition/photograph_warnings.h"
#include "rendering/composition/render_fabrics.h"
#include "rendering/composition/render_json.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/fabrics/recordings/photograph_files.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/models/photograph_check.h"
#include "rendering/signals/shape_from_shading.h"
#include "study/looking/open_study.h"
#include "study/looking/picture_decoder.h"
#include "study/photographs/friction_pictures.h"
#include "study/photographs/photograph_protocol.h"

namespace study::photographs {

namespace {

namespace fs = std::filesystem;

cv::Mat pixelsOf(const fs::path& file)
{
    looking::requireNotOfOpenStudy(file);
    std::error_code unknown;
    if (fs::is_regular_file(file, unknown) && fs::file_size(file, unknown) == 0)
        throw protocols::badInput({"the file is empty (0 bytes)", file.string(), "an image", "copy it again from the camera"});
    return rendering::fabrics::readPhotographFile(file, looking::decodeByQt);
}

std::vector<fs::path> find(const fs::path& place)
{
    looking::requireNotOfOpenStudy(place);
    std::vector<fs::path> files;
    for (const auto& source : rendering::fabrics::sourceFiles(std::vector{place}, rendering::fabrics::photographEndings(),
                                                              rendering::fabrics::FabricNaming::FolderOrFile))
        files.push_back(source.file);
    std::sort(files.begin(), files.end());
    return files;
}

app::SeenPhotograph see(const fs::path& file, int mostPx)
{
    cv::Mat pixels = pixelsOf(file);
    const QSize size(pixels.cols, pixels.rows);
    const double shrink = 1.0 * mostPx / std::max(pixels.cols, pixels.rows);
    const auto shrunk = [&](int side) { return std::max(1, static_cast<int>(std::lround(side * shrink))); };
    if (shrink < 1) cv::resize(pixels, pixels, {shrunk(pixels.cols), shrunk(pixels.rows)}, 0, 0, cv::INTER_AREA);
    const QImage view(pixels.data, pixels.cols, pixels.rows, static_cast<qsizetype>(pixels.step), QImage::Format_RGB888);
    return {view.copy(), size};
}

std::string inMm(double value) { return protocols::fixed(value, value < 0.1 ? 3 : 2) + " mm"; }

std::vector<std::string> scaleWarnings(const rendering::models::CheckedPhotograph& checked)
{
    if (checked.isScaleDoubtful())
        return {"its weave repeats every " + inMm(*checked.weaveMm) + ", finer than cloth is (" + inMm(checked.finestWeaveMm) +
                "); check the scale"};
    if (checked.facts.assumedMmPerPixel)
        return {"the scale is unknown; " + inMm(*checked.facts.assumedMmPerPixel) +
                " per pixel is assumed, as if its threads were those of ordinary clothing"};
    return {};
}

/// The warnings of `vis2hap render` about one photograph, then those about its scale.
QStringList warningsOf(const std::string& fabric, int index, const rendering::models::InputPhotograph& photograph,
                       const rendering::models::ModelCardFields& card)
{
    const protocols::FabricId id(fabric);
    const auto checked = checkPhotograph(photograph, card);
    rendering::RenderedFabrics one;
    one.samples[id].visual = index;
    one.signals[id].photograph = checked.facts;
    one.signals[id].likeness = rendering::models::shippedClothCheck().judge(photograph.photograph);
    one.signals[id].colourVariation = rendering::signals::colourVariation(photograph.photograph);
    QStringList lines;
    for (const auto& warnings : {rendering::strangePhotographs(one), rendering::uncertainFriction(one),
                                 rendering::cutPhotographs(one), rendering::shadingWarnings(one)})
        for (const auto& warning : warnings) lines << QString::fromStdString(warning);
    for (const auto& warning : scaleWarnings(checked)) lines << QString::fromStdString(fabric + ": " + warning);
    return lines;
}

std::vector<QStringList> check(const app::PhotographSet& set, const app::ToolProgress& progress)
{
    const auto card = rendering::models::readModelCardFields(rendering::models::shippedModel());
    std::map<std::string, int> counts;
    std::vector<QStringList> warnings;
    for (const auto& [file, fabric] : set.photographs) {
        progress(1.0 * static_cast<double>(warnings.size()) / static_cast<double>(set.photographs.size()),
                 file.filename().string());
        warnings.push_back(warningsOf(fabric, counts[fabric]++, {pixelsOf(file), set.mmPerPixel}, card));
    }
    return warnings;
}

void write(const app::PhotographSet& set, const fs::path& folder, const app::ToolProgress& progress)
{
    looking::requireNotOfOpenStudy(folder);
    rendering::fabrics::NewPhotographSet made{{}, set.mmPerPixel, folder, pixelsOf};
    for (const auto& [file, fabric] : set.photographs) made.photographs.push_back({file, fabric});
    makePhotographSet(made, [&](int done, int total) { progress(1.0 * done / std::max(1, total), "photographs written"); });
}

QImage draw(const app::FrictionPictureRequest& request, const app::ToolProgress& progress)
{
    looking::requireNotOfOpenStudy(request.dataset);
    const auto dataset = rendering::fabrics::readDataset(request.dataset);
    rendering::RenderRequest render;
    for (const auto& condition : request.conditions) render.conditions.emplace_back(condition);
    for (const auto& fabric : dataset.fabrics) render.fabrics.push_back(fabric.id);
    const auto rendered = renderFabrics(
        dataset, render, [&](int done, int total, const std::string& what) { progress(1.0 * done / std::max(1, total), what); });
    std::vector<FrictionRow> rows;
    for (const auto& fabric : dataset.fabrics) {
        FrictionRow row{
            fabric.name, rendering::fabrics::readPhotograph(dataset, fabric.id, rendered.samples.at(fabric.id).visual), {}};
        for (const auto& condition : rendered.conditions) row.images.push_back(condition.images.at(fabric.id));
        rows.push_back(std::move(row));
    }
    auto style = request.theme == app::Theme::Light ? looking::lightSheet() : looking::darkSheet();
    style.fontPx = request.fontPx;
    style.pixelRatio = request.pixelRatio;
    return drawFrictionRows(rows, request.captions, request.widthPx, style);
}

}  // namespace

app::PhotographSteps photographSteps() { return {find, see, check, write, draw, writePhotographProtocol}; }

}  // namespace study::photographs
