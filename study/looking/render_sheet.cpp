#include "study/looking/render_sheet.h"

#include <QBuffer>
#include <algorithm>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "rendering/composition/fabric_signals.h"

namespace study::looking {

namespace {

using protocols::FabricId;
using rendering::Signal;

const char* const shownConditions[] = {"h_g", "f_g", "h_g&f_g"};

bool canRender(const rendering::fabrics::Dataset& dataset, const FabricId& fabric, const rendering::SampleChoice& samples,
               const char* condition, rendering::DisplayScale scale)
{
    return !rendering::missingInput(dataset, fabric, samples, protocols::conditionNamed(condition), scale);
}

/// The measured signals of the sheet are those that conditions h and f need.
std::set<Signal> measuredOnes(const rendering::fabrics::Dataset& dataset, const FabricId& fabric,
                              const rendering::SampleChoice& samples)
{
    std::set<Signal> needed;
    if (canRender(dataset, fabric, samples, "h", rendering::DisplayScale::Pixels))
        needed.insert({Signal::TactileFrame, Signal::PhotometricHeight});
    if (canRender(dataset, fabric, samples, "f", rendering::DisplayScale::Pixels))
        needed.insert({Signal::FrictionRecord, Signal::MeasuredTrace});
    return needed;
}

ContactMap mapOf(const rendering::FabricSignals& signals, Signal signal, std::optional<double> mmPerPixel)
{
    const auto found = signals.images.find(signal);
    return found == signals.images.end() ? ContactMap{} : ContactMap{found->second, mmPerPixel};
}

ContactTrace traceOf(const rendering::FabricSignals& signals, Signal signal, std::optional<double> mmPerSample)
{
    const auto found = signals.traces.find(signal);
    return found == signals.traces.end() ? ContactTrace{} : ContactTrace{found->second, mmPerSample.value_or(0)};
}

void addMeasured(ContactRow& row, const rendering::FabricSignals& signals)
{
    row.measuredHeight = mapOf(signals, Signal::PhotometricHeight, signals.tactileMmPerPixel);
    row.measuredFriction = traceOf(signals, Signal::MeasuredTrace, signals.traceMmPerSample);
    row.measuredQuantity = signals.measuredQuantity;
}

void addGenerated(ContactRow& row, const rendering::FabricSignals& signals)
{
    row.photograph = mapOf(signals, Signal::Photograph, signals.photographMmPerPixel);
    // Signals generated from a photograph of unknown scale have an unknown scale too.
    row.generatedHeight =
        mapOf(signals, Signal::GeneratedHeight, signals.photographMmPerPixel ? signals.generatedMmPerPixel : std::nullopt);
    row.generatedFriction = traceOf(signals, Signal::GeneratedTrace, signals.generatedTraceMmPerSample);
    if (signals.likeness == rendering::models::ClothLikeness::NotCloth)
        row.remark = "not like cloth: means nothing";
    else if (signals.likeness == rendering::models::ClothLikeness::Unusual)
        row.remark = "unusual for cloth: doubtful";
}

rendering::SampleChoice samplesOf(const rendering::fabrics::Dataset& dataset, const rendering::RenderRequest& request,
                                  const FabricId& fabric)
{
    const auto chosen = request.samples.find(fabric);
    return chosen != request.samples.end() ? chosen->second : rendering::firstSamples(dataset, fabric);
}

bool isEmpty(const ContactRow& row)
{
    return row.photograph.values.empty() && row.measuredHeight.values.empty() && row.measuredFriction.values.empty();
}

}  // namespace

ContactSheet contactSheetOf(const rendering::fabrics::Dataset& dataset, const rendering::RenderRequest& request,
                            const std::function<void(int, int, const std::string&)>& progress)
{
    ContactSheet sheet;
    sheet.title = dataset.name + ": photographs, measured and generated signals of each fabric";
    if (dataset.pairing == rendering::fabrics::Pairing::Weak)
        sheet.title += "; photographs and measurements are from different places";
    rendering::RenderRequest render = request;
    render.conditions.clear();
    render.mapping = {};  // the display needs 8 bits without dither
    render.mapping.response = request.mapping.response;
    for (const char* condition : shownConditions) {
        render.conditions.emplace_back(condition);
        sheet.frictionColumns.emplace_back(condition);
    }
    std::erase_if(render.fabrics, [&](const FabricId& fabric) {
        return !canRender(dataset, fabric, samplesOf(dataset, request, fabric), "h_g", request.scale);
    });
    rendering::RenderedFabrics made;
    if (!render.fabrics.empty()) made = renderFabrics(dataset, render, progress);
    rendering::SignalComputation computation(dataset, request.generation.quality);
    for (const FabricId& fabric : request.fabrics) {
        ContactRow row;
        row.id = fabric.value;
        row.name = dataset.fabric(fabric).name;
        const auto samples = samplesOf(dataset, request, fabric);
        addMeasured(row, computation.measured(fabric, samples, measuredOnes(dataset, fabric, samples), made));
        if (std::find(render.fabrics.begin(), render.fabrics.end(), fabric) != render.fabrics.end())
            addGenerated(row, made.signals.at(fabric));
        for (std::size_t i = 0; i < sheet.frictionColumns.size(); ++i) {
            const bool isThere = i < made.conditions.size() && made.conditions[i].images.contains(fabric);
            row.frictionImages.push_back(isThere ? made.conditions[i].images.at(fabric) : cv::Mat());
        }
        sheet.rows.push_back(row);
    }
    if (std::all_of(sheet.rows.begin(), sheet.rows.end(), isEmpty))
        throw protocols::badInput({"these fabrics have no photograph, no measured height and no friction record",
                                   dataset.folder.string(), "a data set with at least one signal", "import recordings first"});
    return sheet;
}

void writeContactSheet(const std::filesystem::path& png, const ContactSheet& sheet)
{
    QByteArray bytes;
    QBuffer buffer(&bytes);
    looking::drawContactSheet(sheet, looking::lightSheet()).save(&buffer, "PNG");
    protocols::writeWholeFile(png, std::string_view(bytes.constData(), static_cast<std::size_t>(bytes.size())));
}

}  // namespace study::looking
