#include "rendering/fabrics/recordings/import.h"

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "rendering/fabrics/recordings/import_kinds.h"
#include "rendering/fabrics/recordings/import_stage.h"

namespace rendering::fabrics {

namespace {

struct Kind {
    ImportKind kind;
    std::string_view name;
    Lines (*import)(const ImportRequest&, ImportStage&);
};

constexpr Kind kinds[] = {
    {ImportKind::Photos, "photos", importPhotos},
    {ImportKind::Gelsight, "gelsight", importGelsight},
    {ImportKind::FrictionCsv, "friction-csv", importFrictionFiles},
    {ImportKind::Tribometer, "tribometer", importFrictionFiles},
    {ImportKind::Labview, "labview", importFrictionFiles},
    {ImportKind::Slide, "slide", importFrictionFiles},
};

void writePlots(const std::filesystem::path& folder, const std::vector<ImportStage::Plot>& plots)
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
    for (const Kind& kind : kinds) {
        if (kind.name == name) return kind.kind;
        known += (known.empty() ? "" : ", ") + std::string(kind.name);
    }
    throw protocols::badInput({"\"" + std::string(name) + "\" is no kind of recording", "KIND", "one of " + known, ""});
}

std::vector<std::string> importRecordings(const ImportRequest& request)
{
    ImportStage stage(request.out);
    const std::size_t fabricsBefore = stage.dataset().fabrics.size();
    Lines lines;
    for (const Kind& kind : kinds)
        if (kind.kind == request.kind) lines = kind.import(request, stage);
    if (stage.dataset().procedural) {
        stage.dataset().procedural = false;
        lines.emplace_back("the data set was procedural; with real recordings in it, it no longer is");
    }
    if (const std::size_t fabrics = stage.dataset().fabrics.size(); !stage.isNew() && fabrics > fabricsBefore)
        lines.push_back("the data set has " + std::to_string(fabrics) + " fabrics now, " + std::to_string(fabricsBefore) +
                        " before: ranges of friction images made before were over those alone; render all again to compare them");
    stage.commit();
    writePlots(request.plots, stage.plots());
    return lines;
}

}  // namespace rendering::fabrics
