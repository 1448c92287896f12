#include "study/making/image_folder.h"

#include <nlohmann/json.hpp>

#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "rendering/images/image_io.h"

namespace study::making {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* manifestName = "images.json";
constexpr int signalsSchema = 3;  ///< changes with the fields of the comparison of signals, which is kept beside the images

fs::path imagePath(const fs::path& folder, const protocols::FabricId& fabric, const protocols::ConditionId& condition)
{
    return folder / fabric.value / (protocols::fileNameOf(condition) + ".png");
}

/// None for a damaged manifest.
std::optional<ordered_json> manifestIn(const fs::path& file)
{
    try {
        return protocols::parseStrictOrderedJson(protocols::readWholeFile(file, protocols::largestJson), file.string());
    } catch (const protocols::Error&) {
        return std::nullopt;
    }
}

/// Throws nlohmann's exceptions for a manifest with other fields.
std::optional<KeptImages> keptIn(const fs::path& folder, const std::string& key, const rendering::RenderRequest& request)
{
    if (!fs::exists(folder / manifestName)) return std::nullopt;
    const auto manifest = manifestIn(folder / manifestName);
    if (!manifest || manifest->value("key", "") != key || !manifest->contains("stamps")) return std::nullopt;
    KeptImages kept;
    kept.signalsJson = manifest->at("signals").dump();
    kept.stamps = manifest->at("stamps").get<std::vector<std::string>>();
    for (const auto& condition : request.conditions)
        for (const auto& fabric : request.fabrics) {
            const auto file = imagePath(folder, fabric, condition);
            const auto expected = manifest->at("sha256").value(fs::relative(file, folder).string(), "");
            if (!fs::exists(file) || protocols::sha256OfFile(file) != expected) return std::nullopt;
            kept.images[condition][fabric] = rendering::readPng(file);
        }
    return kept;
}

}  // namespace

std::string imageFolderKey(const database::StudyFacts& facts, const rendering::RenderRequest& request)
{
    ordered_json inputs{{"program", facts.programVersion},
                        {"dataset", facts.datasetSha256},
                        {"model", facts.modelSha256},
                        {"signals", signalsSchema}};
    for (const auto& [fabric, sample] : request.samples)
        inputs["samples"][fabric.value] = {sample.visual, sample.tactile, sample.friction};
    for (const auto& condition : request.conditions) inputs["conditions"].push_back(condition.value);
    inputs["mapping"] = {static_cast<int>(request.scale), static_cast<int>(request.extension), request.percentiles.low,
                         request.percentiles.high, request.mapping.dither};
    if (request.mapping.response) inputs["response"] = request.mapping.response->sha256;
    return protocols::sha256(inputs.dump());
}

std::optional<KeptImages> readImageFolder(const fs::path& folder, const std::string& key, const rendering::RenderRequest& request)
{
    try {
        return keptIn(folder, key, request);
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;  // a damaged folder is made anew
    }
}

void writeImageFolder(const fs::path& folder, const std::string& key, const std::string& renderJson,
                      const rendering::RenderedFabrics& rendering, const std::string& signalsJson,
                      const std::vector<std::string>& stamps)
{
    ordered_json manifest{
        {"schema", "vis2hap.images/1"}, {"key", key}, {"signals", ordered_json::parse(signalsJson)}, {"stamps", stamps}};
    protocols::FolderDraft draft(folder, protocols::Earlier::FilesJoined);
    for (const auto& condition : rendering.conditions)
        for (const auto& [fabric, image] : condition.images) {
            const auto file = draft.file(imagePath("", fabric, condition.condition));
            rendering::writePng(file, image, protocols::Sync::Later);
            manifest["sha256"][file.lexically_relative(draft.path()).string()] = protocols::sha256OfFile(file);
        }
    protocols::writeWholeFile(draft.file("render.json"), renderJson, protocols::Sync::Later);
    protocols::writeWholeFile(draft.file(manifestName), manifest.dump(1) + "\n", protocols::Sync::Later);
    draft.putInPlace({"render.json", manifestName});
}

}  // namespace study::making
