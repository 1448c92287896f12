// vis2hap render DATASET --fabric ID|all --condition ID|all --out DIR
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <sstream>

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/number_text.h"
#include "protocols/files/place_lock.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "rendering/composition/earlier_render.h"
#include "rendering/composition/image_warnings.h"
#include "rendering/composition/photograph_warnings.h"
#include "rendering/composition/render_fabrics.h"
#include "rendering/composition/render_json.h"
#include "rendering/images/image_io.h"
#include "rendering/models/exchange.h"
#include "rendering/response/response_file.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/cache_option.h"
#include "study/commands/parts/explanation.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/progress.h"
#include "study/looking/render_sheet.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;

struct RenderCall {
    std::string dataset, fabric = "all", condition = "all", out, model, quality = "balanced", scale = "pixels";
    std::optional<int> sample;
    bool evenStrange = false;
    std::shared_ptr<bool> noCache = std::make_shared<bool>(false);
    std::string extension = "tile", percentiles, shading = "linear", lightFrom = "above";
    int bits = 8;
    bool dither = false;
    std::uint64_t ditherSeed = 1;
    std::string sheet, response;
};

/// The response that --response names. It was measured at the 256 levels of a display, so 16 bits have none.
std::shared_ptr<const rendering::DisplayResponse> responseFor(const RenderCall& call)
{
    if (call.bits != 8)
        throw protocols::badInput({"a response of a display has 256 levels",
                                   "--bits " + std::to_string(call.bits) + " with --response", "--bits 8",
                                   "leave one of the options out"});
    return std::make_shared<rendering::DisplayResponse>(rendering::readResponse(call.response));
}

std::vector<protocols::FabricId> fabricList(const rendering::fabrics::Dataset& dataset, const std::string& text)
{
    std::vector<protocols::FabricId> ids;
    if (text == "all") {
        for (const auto& fabric : dataset.fabrics) ids.push_back(fabric.id);
        return ids;
    }
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');) ids.push_back(dataset.fabric(protocols::FabricId(part)).id);
    if (ids.empty())
        throw protocols::badInput({"no fabric is named", "--fabric", "ids, comma-separated, or all", "name at least one fabric"});
    return ids;
}

/// One index for every signal. Each signal that the conditions read must have a sample with this index.
std::map<protocols::FabricId, rendering::SampleChoice> chosenSamples(const rendering::fabrics::Dataset& dataset,
                                                                     std::optional<int> sample)
{
    std::map<protocols::FabricId, rendering::SampleChoice> samples;
    if (sample)
        for (const auto& fabric : dataset.fabrics) samples[fabric.id] = {*sample, *sample, *sample};
    return samples;
}

/// "LO,HI" in any locale.
rendering::Percentiles percentilesFrom(const std::string& text)
{
    if (text.empty()) return {};
    const auto comma = text.find(',');
    const auto low = protocols::numberIn(text.substr(0, comma));
    const auto high = comma == std::string::npos ? std::nullopt : protocols::numberIn(text.substr(comma + 1));
    if (!low || !high)
        throw protocols::badInput({"\"" + text + "\" does not give two percentiles", "--range-percentiles",
                                   "LO,HI, e.g. 0.1,99.9", "correct the percentiles"});
    return {*low, *high};
}

void writeRendering(protocols::FolderDraft& draft, const rendering::RenderedFabrics& rendering, const std::string& json)
{
    for (const auto& condition : rendering.conditions)
        for (const auto& [fabric, image] : condition.images)
            rendering::writePng(draft.file(fs::path(fabric.value) / (protocols::fileNameOf(condition.condition) + ".png")), image,
                                protocols::Sync::Later);
    protocols::writeWholeFile(draft.file("render.json"), json, protocols::Sync::Later);
    draft.putInPlace({"render.json"});
}

/// Merges the JSON with that of an earlier call in the same folder.
rendering::JoinedRender savedJson(const fs::path& out, const std::string& json)
{
    const auto file = out / "render.json";
    return fs::exists(file) ? rendering::joined(json, protocols::readWholeFile(file), file.string())
                            : rendering::JoinedRender{json, {}};
}

/// Writes images and JSON beside those of earlier calls. Another call into the same folder waits.
rendering::JoinedRender written(const fs::path& out, const rendering::RenderedFabrics& rendering, const std::string& json)
{
    const protocols::PlaceLock lock(out);
    const bool isNew = !fs::exists(out);
    auto saved = savedJson(out, json);
    protocols::FolderDraft draft(out, protocols::Earlier::FilesJoined);
    if (isNew && fs::exists(out))
        throw protocols::environmentFault(
            {"another program made the folder at the same time", out.string(), "one of them at a time", "render again"});
    writeRendering(draft, rendering, saved.json);
    return saved;
}

/// How often each signal was computed, and what the cache gave.
std::string foundText(const rendering::RenderedFabrics& rendering)
{
    std::string text;
    for (const auto& [signal, times] : rendering.computed) {
        const auto time = rendering.milliseconds.find(signal);
        text += "  computed " + rendering::nameOf(signal) + ": " + std::to_string(times) + " times" +
                (time == rendering.milliseconds.end() ? "" : ", " + protocols::fixed(time->second, 1) + " ms") + "\n";
    }
    for (const auto& condition : rendering.conditions)
        text += "  composed " + condition.condition.value + ": " + protocols::fixed(condition.milliseconds, 1) + " ms\n";
    return text + "  ranges of maps that the cache knew: " + std::to_string(rendering.keptRanges) + "\n";
}

/// "15 fabrics", or how many each condition has where some lack its signals or the asked sample.
std::string rangeText(const rendering::fabrics::Dataset& dataset, const rendering::RenderedFabrics& rendering)
{
    std::string without;
    for (const auto& condition : rendering.conditions)
        if (condition.rangeOver.size() < dataset.fabrics.size())
            without += "; " + condition.condition.value + " over " + std::to_string(condition.rangeOver.size()) +
                       ", because the others lack its signals or this sample";
    return std::to_string(dataset.fabrics.size()) + " fabrics" + without;
}

int render(const RenderCall& call, StageTimes stages)
{
    stages.begin("reading the data set");
    const auto dataset = rendering::fabrics::readDataset(call.dataset);
    rendering::RenderRequest request;
    request.conditions = protocols::conditionList(call.condition);
    request.fabrics = fabricList(dataset, call.fabric);
    request.samples = chosenSamples(dataset, call.sample);
    request.scale = call.scale == "physical" ? rendering::DisplayScale::Physical : rendering::DisplayScale::Pixels;
    request.extension = call.extension == "mirror" ? rendering::Extension::Mirror : rendering::Extension::Tile;
    request.percentiles = percentilesFrom(call.percentiles);
    request.mapping = {call.bits, call.dither, call.ditherSeed};
    if (!call.response.empty()) request.mapping.response = responseFor(call);
    request.shading.method =
        call.shading == "bumps" ? rendering::signals::ShadingMethod::GaussianBumps : rendering::signals::ShadingMethod::Linear;
    request.shading.lightFromBelow = call.lightFrom == "below";
    request.generation.model = call.model;
    request.generation.quality = rendering::models::qualityNamed(call.quality);
    request.cache = cacheUnless(*call.noCache);
    stages.print(rendering::explain(request.conditions));
    // The sheet is drawn first, so that a fault leaves nothing behind.
    std::optional<looking::ContactSheet> sheet;
    if (!call.sheet.empty()) {
        Progress progress("contact sheet");
        sheet = looking::contactSheetOf(dataset, request,
                                        [&](int done, int total, const std::string& what) { progress.show(done, total, what); });
    }
    stages.begin("signals and images");
    Progress progress("friction images");
    const auto rendering =
        renderFabrics(dataset, request, [&](int done, int total, const std::string& what) { progress.show(done, total, what); });
    if (!call.evenStrange) refuseOtherThings(rendering);
    stages.begin("checking and writing");
    const auto saved = written(call.out, rendering, renderJson(dataset, request, rendering));
    if (sheet) looking::writeContactSheet(call.sheet, *sheet);
    for (const auto& warning : saved.warnings) std::fprintf(stderr, "warning: %s\n", protocols::printable(warning).c_str());
    for (const auto& warning : rendering::shadingWarnings(rendering))
        std::fprintf(stderr, "warning: %s\n", protocols::printable(warning).c_str());
    for (const auto& warnings :
         {rendering::strangePhotographs(rendering), rendering::uncertainFriction(rendering), rendering::cutPhotographs(rendering),
          rendering::mixedQuantities(rendering), rendering::describe(rendering::imageFaults(rendering), rendering)})
        for (const auto& warning : warnings) std::fprintf(stderr, "warning: %s\n", protocols::printable(warning).c_str());
    for (const auto& line : rendering::describeMaps(rendering)) std::printf("%s\n", protocols::printable(line).c_str());
    std::printf("%s: friction images of %zu fabrics x %zu conditions; render.json has the ranges over %s; traces run along x\n",
                protocols::printable(call.out).c_str(), request.fabrics.size(), request.conditions.size(),
                protocols::printable(rangeText(dataset, rendering)).c_str());
    stages.end();
    stages.print(foundText(rendering));
    return 0;
}

}  // namespace

void addRender(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("render", "render friction images of fabrics under conditions");
    auto call = std::make_shared<RenderCall>();
    command->add_option("DATASET", call->dataset, "the data set")->required();
    command->add_option("--fabric", call->fabric, "ids, comma-separated, or all")->capture_default_str();
    command->add_option("--condition", call->condition, "ids, comma-separated, or all; h_g+f_g means h_g&f_g")
        ->capture_default_str();
    command->add_option("--out", call->out, "folder to write DIR/F01/h_g+f_g.png and DIR/render.json to")->required();
    command->add_option("--sample", call->sample, "sample index for every signal (default: the first one)");
    command->add_option("--model", call->model, "weights (default: the shipped ones)");
    command->add_option("--quality", call->quality, "quality of the generators")
        ->check(CLI::IsMember({"fast", "balanced", "accurate"}))
        ->capture_default_str();
    command->add_option("--scale", call->scale, "pixels: 1:1 as in the paper; physical: in true millimetres")
        ->check(CLI::IsMember({"pixels", "physical"}))
        ->capture_default_str();
    command->add_option("--extension", call->extension, "fills the screen by tile (the texture continues) or mirror")
        ->check(CLI::IsMember({"tile", "mirror"}))
        ->capture_default_str();
    command
        ->add_option("--shading", call->shading,
                     "shape from shading in v_shape: linear (Pentland) or bumps (Gaussian, the paper's reference)")
        ->check(CLI::IsMember({"linear", "bumps"}))
        ->capture_default_str();
    command
        ->add_option("--light-from", call->lightFrom,
                     "direction of light in v_shape: above, as people assume; below turns bumps into dents")
        ->check(CLI::IsMember({"above", "below"}))
        ->capture_default_str();
    command->add_option("--range-percentiles", call->percentiles,
                        "LO,HI: range of all fabrics' pixels (default 0,100: minimum and maximum)");
    command->add_option("--bits", call->bits, "bits per pixel of the PNG files; the display uses 8")
        ->check(CLI::IsMember({8, 16}))
        ->capture_default_str();
    command->add_option("--response", call->response,
                        "response.json of the display: friction on the glass becomes linear in the map, instead of the levels");
    command->add_flag("--dither", call->dither, "add noise of one level before rounding");
    command->add_option("--dither-seed", call->ditherSeed, "seed of that noise")->capture_default_str();
    command->add_option(
        "--sheet", call->sheet,
        "PNG to write with one row per fabric: photograph, measured and generated height and friction, friction images");
    command->add_flag("--even-strange", call->evenStrange, "generate from photographs that do not look like cloth, too");
    addCacheOption(*command, call->noCache);
    command->callback([call, command, &action] {
        if (!call->sheet.empty()) action.surroundings = Surroundings::Offscreen;
        action.work = [call, command] { return render(*call, StageTimes(isExplained(*command))); };
    });
}

}  // namespace study::commands
