#include "rendering/fabrics/import.h"

#include "protocols/errors.h"
#include "rendering/fabrics/import_kinds.h"
#include "rendering/fabrics/import_stage.h"

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
    Lines lines;
    for (const Kind& kind : kinds)
        if (kind.kind == request.kind) lines = kind.import(request, stage);
    if (stage.dataset().procedural) {
        stage.dataset().procedural = false;
        lines.emplace_back("the data set was procedural; with real recordings in it, it no longer is");
    }
    stage.commit();
    return lines;
}

}  // namespace rendering::fabrics
