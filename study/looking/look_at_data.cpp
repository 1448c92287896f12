#include "study/looking/look_at_data.h"

#include <algorithm>

#include "rendering/fabrics/dataset_check.h"
#include "study/looking/dataset_sheet.h"
#include "study/looking/open_study.h"
#include "study/looking/sheet.h"

namespace study::looking {

namespace {

namespace fs = std::filesystem;

QStringList listOf(const std::vector<std::string>& texts)
{
    QStringList list;
    for (const std::string& text : texts) list << QString::fromStdString(text);
    return list;
}

app::DataOverview openData(const fs::path& folder)
{
    const auto seen = overviewOf(folder);
    app::DataOverview overview{QString::fromStdString(seen.name), QString::fromStdString(seen.about), {}};
    for (const auto& fabric : seen.fabrics)
        overview.fabrics.push_back({QString::fromStdString(fabric.id), QString::fromStdString(fabric.name),
                                    QString::fromStdString(fabric.structure), fabric.photographs, fabric.frames,
                                    fabric.knownHeights, fabric.strokes, fabric.most()});
    return overview;
}

/// Columns as wide as fill the width; text must stay readable in them.
app::DataSheet drawData(const app::DataSheetRequest& request)
{
    const auto seen = sheetOf(request.folder, request.fabric.toStdString(), request.sample);
    if (seen.signals.empty()) return {{}, {}, listOf(seen.faults)};
    SheetStyle style = request.theme == app::Theme::DarkRoom ? darkSheet() : lightSheet();
    style.fontPx = request.fontPx;
    style.pixelRatio = request.pixelRatio;
    const int narrowest = static_cast<int>(22 * style.fontPx);
    const int perRow = std::clamp(request.widthPx / narrowest, 1, static_cast<int>(seen.signals.size()));
    constexpr int between = 14;
    style.columnPx = (request.widthPx - between) / perRow - between;
    return {drawSheet(seen.signals, style, perRow), describe(seen.signals), listOf(seen.faults)};
}

QStringList checkData(const fs::path& folder, const std::function<void(double)>& progress)
{
    requireNotOfOpenStudy(folder);
    return listOf(
        rendering::fabrics::faultsOfDataset(folder, [&](int done, int total) { progress(1.0 * done / std::max(1, total)); }));
}

}  // namespace

app::LookAtData lookAtData() { return {openData, drawData, checkData}; }

}  // namespace study::looking
