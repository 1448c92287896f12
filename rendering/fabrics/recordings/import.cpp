#include "rendering/fabrics/recordings/import.h"

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/recordings/import_friction.h"
#include "rendering/fabrics/recordings/import_images.h"
#include "rendering/fabrics/recordings/import_stage.h"

namespace rendering::fabrics {

namespace {

struct Importer {
    ImportKind kind;
    std::string_view name;
    std::vector<std::string> (*import)(const ImportRequest&, ImportStage&);
};

constexpr Importer importers[] = {
    {ImportKind::Photos, "photos", importPhotos},
    {ImportKind::Gelsight, "gelsight", importGelsight},
    {ImportKind::FrictionCsv, "friction-csv", importFrictionFiles},
    {ImportKind::Tribometer, "tribometer", importFrictionFiles},
    {ImportKind::Labview, "labview", importFrictionFiles},
    {ImportKind::Slide, "slide", importFrictionFiles},
};

void writePlots(const std::filesystem::path& folder, const std::vector<ImportStage::StrokePlot>& plots)
{
    if (folder.empty() || plots.empty()) return;
    protocols::FolderDraft draft(folder, protocols::Earlier::FilesJoined);
    for (const auto& [name, svg] : plots) protocols::writeWholeFile(draft.file(name), svg, protocols::Sync::Later);
    draft.putInPlace();
}

}  // namespace

ImportKind importKindNamed(std::string_view name)
{
    std::string known;
    for (const Importer& importer : importers) {
        if (importer.name == name) return importer.kind;
        known += (known.empty() ? "" : ", ") + std::string(importer.name);
    }
    throw protocols::badInput({"\"" + std::string(name) + "\" is not a kind of recording", "KIND", "one of " + known + ", scans",
                               "choose one of these kinds"});
}

std::vector<std::string> importRecordings(const ImportRequest& request)
{
    ImportStage stage(request.out);
    const std::size_t fabricsBefore = stage.dataset().fabrics.size();
    std::vector<std::string> lines;
    for (const Importer& importer : importers)
        if (importer.kind == request.kind) lines = importer.import(request, stage);
    if (request.fibre) stage.tellFibre(*request.fibre);
    if (stage.dataset().procedural) {
        stage.dataset().procedural = false;
        lines.emplace_back("the data set contains real recordings now, so it is no longer marked as procedural");
    }
    if (const std::size_t fabrics = stage.dataset().fabrics.size(); !stage.isNew() && fabrics > fabricsBefore)
        lines.push_back("the data set has " + std::to_string(fabrics) + " fabrics now (before: " + std::to_string(fabricsBefore) +
                        "): earlier friction images use the range of the earlier fabrics; render all again to compare them");
    stage.commit();
    writePlots(request.plots, stage.plots());
    return lines;
}

}  // namespace rendering::fabrics
